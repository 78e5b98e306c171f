#include "burnish/smoothing/vertex_update.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr double kAgreement = 0.8;  ///< least cosine between a normal and the wanted one
constexpr double kQuality = 0.35;   ///< least 4 sqrt(3) A / (sum of squared sides)
constexpr double kCrease = 0.03;    ///< 1 - cosine at which a vertex keeps 1 / e of its freedom

/// Whether the face is too thin, or turned away from its wanted normal.
bool is_bad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& wanted) {
  const Vec3d doubled = cross(b - a, c - a);
  const double length = norm(doubled);
  const double sides = squared_norm(b - a) + squared_norm(c - b) + squared_norm(a - c);
  return !(dot(doubled, wanted) >= kAgreement * length) ||
         !(2 * std::sqrt(3.) * length >= kQuality * sides);
}

}  // namespace

VertexUpdate::VertexUpdate(const TriangleMesh& mesh, const Adjacency& faces_of_vertices,
                           const VertexUpdateRules& rules, std::span<const float> follows)
    : mesh_(mesh),
      faces_of_vertices_(faces_of_vertices),
      equalizing_(rules.equalizing),
      follows_(follows.begin(), follows.end()),
      on_boundary_(boundary_vertices(mesh)) {
  const std::size_t vertices = mesh.positions.size(), faces = mesh.triangles.size();
  if (follows_.empty()) follows_.assign(vertices, 1);
  stays_.assign(vertices, false);
  if (rules.boundary == BoundaryRule::fixed) stays_ = on_boundary_;
  if (rules.boundary == BoundaryRule::along_boundary) along_boundary_ = boundary_neighbours(mesh);
  if (equalizing_ > 0) rings_ = one_rings(mesh);
  pulls_.resize(faces);
  offsets_.resize(faces);
  bad_.resize(faces);
  steps_.resize(vertices);
  equalizers_.resize(vertices);
  moves_.resize(vertices);
  next_moves_.resize(vertices);
}

bool VertexUpdate::run(const Context& context, const FaceNormals& wanted, int passes,
                       std::vector<Vec3d>& positions) {
  step_along_boundary(positions);
  if (!prepare_faces(context.part(0, 0.1), wanted, positions)) return false;
  if (!prepare_vertices(context.part(0.1, 0.2), wanted, positions)) return false;
  std::fill(moves_.begin(), moves_.end(), Quad());
  const Context share = context.part(0.2, 1);
  for (int i = 0; i < passes; ++i) {
    if (!pass(share.part(static_cast<double>(i) / passes, (i + 1.0) / passes), positions)) {
      return false;
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += Vec3d(moves_[v].xyz());
  context.progress(1);
  return true;
}

void VertexUpdate::step_along_boundary(std::vector<Vec3d>& positions) const {
  const std::vector<Vec3d> before = along_boundary_.size() > 0 ? positions : std::vector<Vec3d>();
  for (std::size_t v = 0; v < along_boundary_.size(); ++v) {
    const auto neighbours = along_boundary_.row(v);
    if (neighbours.empty()) continue;
    Vec3d sum = before[v];
    for (const std::uint32_t w : neighbours) sum += before[w];
    const Vec3d mean = sum / static_cast<double>(neighbours.size() + 1);
    positions[v] += static_cast<double>(follows_[v]) * (mean - before[v]);
  }
}

bool VertexUpdate::prepare_faces(const Context& context, const FaceNormals& wanted,
                                 const std::vector<Vec3d>& positions) {
  return parallel_for(context, wanted.size(), [&](IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const auto [i, j, k] = mesh_.triangles[f];
      const Vec3d a = positions[i], b = positions[j], c = positions[k];
      const Quad pull = std::sqrt(wanted[f].w()) * wanted[f];
      pulls_[f] = pull;
      offsets_[f] = dot(Vec3d(pull.xyz()), a + b + c) / 3;
      bad_[f] = is_bad(a, b, c, Vec3d(wanted[f].xyz()));
    }
  });
}

bool VertexUpdate::prepare_vertices(const Context& context, const FaceNormals& wanted,
                                    const std::vector<Vec3d>& positions) {
  return parallel_for(context, positions.size(), [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      Quad columns[3], normal;
      Vec3d start;
      double area = 0;
      bool bad = false;
      for (const std::uint32_t f : faces_of_vertices_.row(v)) {
        const Quad pull = pulls_[f];
        const Vec3d direction(pull.xyz());
        for (int i = 0; i < 3; ++i) columns[i] += pull[i] * pull;
        start += direction * (offsets_[f] - dot(direction, positions[v]));
        area += wanted[f].w();
        normal += wanted[f].w() * wanted[f];
        bad |= bad_[f] != 0;
      }
      const double scale = area > 0 && !stays_[v] ? follows_[v] / area : 0;
      for (int i = 0; i < 3; ++i) steps_[v].columns[i] = static_cast<float>(scale) * columns[i];
      steps_[v].start = Quad(Vec3f(scale * start), static_cast<float>(scale));
      equalizers_[v] = Quad();
      if (!bad || on_boundary_[v] || !(equalizing_ > 0)) continue;
      const Vec3f direction = normalized(normal.xyz());
      double bend = 0;
      for (const std::uint32_t f : faces_of_vertices_.row(v)) {
        if (wanted[f].w() > 0) bend = std::max(bend, 1. - dot(wanted[f].xyz(), direction));
      }
      equalizers_[v] = Quad(
          direction, static_cast<float>(follows_[v] * equalizing_ * std::exp(-bend / kCrease)));
    }
  });
}

Quad VertexUpdate::way_amid(std::size_t v, const std::vector<Vec3d>& positions) const {
  Quad sum;
  float lengths = 0;
  for (const std::uint32_t w : rings_.row(v)) {
    const Quad edge = Quad(Vec3f(positions[w] - positions[v]), 0) + moves_[w] - moves_[v];
    const float length = std::sqrt(dot3(edge, edge));
    sum += length * edge;
    lengths += length;
  }
  if (!(lengths > 0)) return Quad();
  const Quad way = 1 / lengths * sum;
  return way - dot3(way, equalizers_[v]) * equalizers_[v];
}

bool VertexUpdate::pass(const Context& context, const std::vector<Vec3d>& positions) {
  const bool faces_done = parallel_for(context.part(0, 0.5), pulls_.size(), [&](IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const auto [a, b, c] = mesh_.triangles[f];
      const Quad pull = pulls_[f];
      pulls_[f].set_w(dot3(pull, moves_[a] + moves_[b] + moves_[c]) * (1.f / 3));
    }
  });
  if (!faces_done) return false;
  const bool complete = parallel_for(context.part(0.5, 1), positions.size(), [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      const Step& step = steps_[v];
      const Quad move = moves_[v];
      Quad sum;
      for (const std::uint32_t f : faces_of_vertices_.row(v)) sum += pulls_[f].w() * pulls_[f];
      Quad next = move + step.start + step.start.w() * sum - move[0] * step.columns[0] -
                  move[1] * step.columns[1] - move[2] * step.columns[2];
      if (equalizers_[v].w() > 0) next += equalizers_[v].w() * way_amid(v, positions);
      next_moves_[v] = next;
    }
  });
  std::swap(moves_, next_moves_);
  return complete;
}

}  // namespace burnish
