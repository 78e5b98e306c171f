#include "burnish/smoothing/implicit.h"

#include <algorithm>
#include <array>
#include <optional>

#include "burnish/core/edges.h"
#include "burnish/smoothing/closed_parts.h"
#include "burnish/smoothing/cotangent.h"
#include "burnish/smoothing/ring_mesh.h"
#include "burnish/smoothing/symmetric_solver.h"

namespace burnish {
namespace {

constexpr double kLeastMass = 1e-9;    ///< in squares of the mean edge length
constexpr double kLeastLength = 1e-3;  ///< of an edge along the boundary, in mean edge lengths

/// A link between two vertices that diffusion runs along.
struct Link {
  std::array<std::uint32_t, 2> vertices;
  double stiffness = 0;
};

/// Backward Euler steps of a diffusion among some of the vertices.
class Diffusion {
 public:
  /// `links` has the places of all links; only vertices that are `free` move.
  Diffusion(std::vector<Link> links, const std::vector<bool>& free)
      : links_(std::move(links)), mass_(free.size()), unknown_(free.size(), kNone) {
    for (std::size_t v = 0; v < free.size(); ++v) {
      if (free[v]) {
        unknown_[v] = static_cast<std::uint32_t>(free_.size());
        free_.push_back(static_cast<std::uint32_t>(v));
      }
    }
  }

  std::vector<Link>& links() { return links_; }
  std::vector<double>& mass() { return mass_; }

  /// Solves (M + t S) d = -t S p for the displacements d of the free vertices; those of all others
  /// are taken from `moves`, where the solution is put.
  Result<void> step(const std::vector<Vec3d>& p, double time, std::vector<Vec3d>& moves,
                    const Context& context) {
    std::vector<MatrixTerm> matrix;
    std::vector<Vec3d> sides(free_.size());
    for (std::uint32_t i = 0; i < free_.size(); ++i) matrix.push_back({i, i, mass_[free_[i]]});
    for (const auto& [ends, stiffness] : links_) {
      const double value = time * stiffness;
      for (std::size_t side = 0; side < 2; ++side) {
        const std::uint32_t v = ends[side], w = ends[1 - side], i = unknown_[v];
        if (i == kNone) continue;
        matrix.push_back({i, i, value});
        sides[i] += value * (p[w] - p[v]);
        if (unknown_[w] == kNone) {
          sides[i] += value * moves[w];
        } else if (side == 0) {
          matrix.push_back({i, unknown_[w], -value});
        }
      }
    }
    if (auto solved = solver_.solve(matrix, sides, context); !solved) return solved;
    for (std::size_t i = 0; i < free_.size(); ++i) moves[free_[i]] = sides[i];
    return {};
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<Link> links_;
  std::vector<double> mass_;
  std::vector<std::uint32_t> free_, unknown_;  ///< the free vertices; the number of each among them
  SymmetricSolver solver_;
};

/// The diffusions of a mesh and of its boundary.
class Flow {
 public:
  Flow(const TriangleMesh& mesh, const RingMesh& work, BoundaryRule boundary, double length)
      : triangles_(mesh.triangles), work_(work), length_(length), edges_(edges(mesh)) {
    const std::size_t count = mesh.positions.size();
    std::vector<bool> on_curve(count, false), inner(count), along(count);
    if (boundary == BoundaryRule::along_boundary) on_curve = boundary_vertices(mesh);
    for (std::size_t v = 0; v < count; ++v) {
      const bool moves = !work.rings.row(v).empty();
      inner[v] = moves && !on_curve[v];
      along[v] = moves && on_curve[v];
    }
    std::vector<Link> all, curve;
    for (const Edge& edge : edges_) {
      all.push_back({edge.vertices});
      if (edge.triangles != 2) curve.push_back({edge.vertices});
    }
    surface_.emplace(std::move(all), inner);
    if (boundary == BoundaryRule::along_boundary) curve_.emplace(std::move(curve), along);
    index_triangles();
  }

  /// One step of the given time, m^2. Errors: bad_geometry, cancelled.
  Result<void> step(std::vector<Vec3d>& p, double time, const Context& context) {
    std::vector<Vec3d> moves(p.size());
    if (curve_) {
      weigh_curve(p);
      if (auto done = curve_->step(p, time, moves, context.part(0, 0.1)); !done) return done;
    }
    weigh_surface(p);
    if (auto done = surface_->step(p, time, moves, context.part(0.1, 1)); !done) return done;
    for (std::size_t v = 0; v < p.size(); ++v) p[v] += moves[v];
    return {};
  }

 private:
  /// Finds the three edges of each triangle, each opposite to the corner of its number.
  void index_triangles() {
    const auto find = [&](std::uint32_t v, std::uint32_t w) {
      const std::array<std::uint32_t, 2> ends{std::min(v, w), std::max(v, w)};
      const auto at = std::lower_bound(
          edges_.begin(), edges_.end(), ends,
          [](const Edge& edge, const auto& wanted) { return edge.vertices < wanted; });
      return static_cast<std::uint32_t>(at - edges_.begin());
    };
    for (const auto& [a, b, c] : triangles_) {
      const bool whole = a != b && b != c && c != a;
      sides_.push_back(whole ? Triangle{find(b, c), find(c, a), find(a, b)} : Triangle{});
    }
  }

  void weigh_surface(const std::vector<Vec3d>& p) {
    std::vector<Link>& links = surface_->links();
    std::vector<double>& mass = surface_->mass();
    for (Link& link : links) link.stiffness = 0;
    std::fill(mass.begin(), mass.end(), 0.0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& corners = triangles_[t];
      if (sides_[t] == Triangle{}) continue;
      const Vec3d &a = p[corners[0]], &b = p[corners[1]], &c = p[corners[2]];
      links[sides_[t][0]].stiffness += cotangent(a, b, c) / 2;
      links[sides_[t][1]].stiffness += cotangent(b, c, a) / 2;
      links[sides_[t][2]].stiffness += cotangent(c, a, b) / 2;
      const double third = norm(cross(b - a, c - a)) / 6;
      for (const std::uint32_t v : corners) mass[v] += third;
    }
    for (Link& link : links) link.stiffness = std::max(link.stiffness, 0.0);
    hold_back(mass, kLeastMass * length_ * length_);
  }

  void weigh_curve(const std::vector<Vec3d>& p) {
    std::vector<double>& mass = curve_->mass();
    std::fill(mass.begin(), mass.end(), 0.0);
    for (auto& [ends, stiffness] : curve_->links()) {
      const double length = std::max(norm(p[ends[0]] - p[ends[1]]), kLeastLength * length_);
      stiffness = 1 / length;
      for (const std::uint32_t v : ends) mass[v] += length / 2;
    }
    hold_back(mass, kLeastLength * length_);
  }

  /// A vertex that is to flow at a share of the speed has that much more mass.
  void hold_back(std::vector<double>& mass, double least) const {
    for (std::size_t v = 0; v < mass.size(); ++v) {
      mass[v] = std::max(mass[v], least) / std::max(work_.follow(v), 1e-30);
    }
  }

  const std::vector<Triangle>& triangles_;
  const RingMesh& work_;
  double length_;  ///< mean edge length, m
  std::vector<Edge> edges_;
  std::vector<Triangle> sides_;  ///< per triangle the numbers of its edges; zeros: it has none
  std::optional<Diffusion> surface_, curve_;
};

std::vector<bool> held_back(const RingMesh& work) {
  std::vector<bool> held(work.positions.size());
  for (std::size_t v = 0; v < held.size(); ++v) held[v] = work.follow(v) < 1;
  return held;
}

}  // namespace

const Schema<ImplicitParams>& ImplicitParams::schema() {
  using P = ImplicitParams;
  static const auto schema =
      Schema<P>()
          .real("lambda", &P::lambda, {.low = 0, .high = 1e6, .open_low = true},
                "time of a step in squares of the mean edge length")
          .integer("iterations", &P::iterations, between(0, 10000), "number of steps")
          .choice("volume", &P::volume,
                  {{"kept", VolumePolicy::kept}, {"free", VolumePolicy::free}},
                  "what becomes of the volume of closed parts")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_implicit(TriangleMesh& mesh, const ImplicitParams& params,
                                        const Context& context) {
  if (auto valid = ImplicitParams::schema().check(params); !valid) return valid.error();
  Result<RingMesh> work = ring_mesh(mesh, params.boundary);
  if (!work) return work.error();
  const double length = mean_edge_length(mesh);
  // A mesh whose edges all have length 0 is a point, and nothing flows.
  const int iterations = length > 0 ? params.iterations : 0;
  std::vector<Vec3d>& positions = work->positions;
  std::optional<ClosedParts> parts;
  if (params.volume == VolumePolicy::kept) parts.emplace(mesh, positions, held_back(*work));
  Flow flow(mesh, *work, params.boundary, length);
  for (int step = 0; step < iterations; ++step) {
    const Context share =
        context.part(static_cast<double>(step) / iterations, (step + 1.0) / iterations);
    if (share.cancelled()) return cancelled();
    if (auto done = flow.step(positions, params.lambda * length * length, share); !done) {
      return done.error();
    }
    if (parts) parts->restore(positions);
  }
  return commit_positions(mesh, positions, iterations, context);
}

}  // namespace burnish
