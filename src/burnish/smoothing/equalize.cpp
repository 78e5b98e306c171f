#include "burnish/smoothing/equalize.h"

#include "burnish/smoothing/length_weights.h"
#include "burnish/smoothing/ring_mesh.h"

namespace burnish {
namespace {

/// Moves every vertex in the directions that its surroundings leave it.
class Equalizer {
 public:
  Equalizer(const TriangleMesh& mesh, const RingMesh& work, const EqualizeParams& params)
      : triangles_(mesh.triangles),
        work_(work),
        fans_(triangles_of_vertices(mesh)),
        step_(params.step) {
    if (params.boundary == BoundaryRule::along_boundary) on_curve_ = boundary_vertices(mesh);
  }

  Vec3d moved(const std::vector<Vec3d>& positions, std::size_t v) const {
    const auto ring = work_.rings.row(v);
    const Vec3d pull = length_weighted_step(positions, ring, v);
    Vec3d within;
    if (on_curve_.empty() || !on_curve_[v]) {
      const Vec3d n = normal(positions, v);
      if (n != Vec3d{}) within = pull - n * dot(n, pull);
    } else if (ring.size() == 2) {
      const Vec3d along = normalized(positions[ring[1]] - positions[ring[0]]);
      within = along * dot(along, pull);
    }
    return positions[v] + step_ * work_.follow(v) * within;
  }

 private:
  Vec3d normal(const std::vector<Vec3d>& positions, std::size_t v) const {
    Vec3d sum;
    for (const std::uint32_t t : fans_.row(v)) {
      const auto [a, b, c] = triangles_[t];
      sum += cross(positions[b] - positions[a], positions[c] - positions[a]);
    }
    return normalized(sum);
  }

  std::span<const Triangle> triangles_;
  const RingMesh& work_;
  Adjacency fans_;
  double step_;
  std::vector<bool> on_curve_;  ///< vertices that slide along the boundary; empty: none
};

}  // namespace

const Schema<EqualizeParams>& EqualizeParams::schema() {
  using P = EqualizeParams;
  static const auto schema =
      Schema<P>()
          .real("step", &P::step, {.low = 0, .high = 0.5, .open_low = true},
                "share of the way to the weighted mean that one pass goes")
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_equalize(TriangleMesh& mesh, const EqualizeParams& params,
                                        const Context& context) {
  if (auto valid = EqualizeParams::schema().check(params); !valid) return valid.error();
  Result<RingMesh> work = ring_mesh(mesh, params.boundary);
  if (!work) return work.error();
  const Equalizer equalizer(mesh, *work, params);
  std::vector<Vec3d>& positions = work->positions;
  std::vector<Vec3d> next = positions;
  for (int pass = 0; pass < params.iterations; ++pass) {
    const Context share = part_of_pass(context, pass, params.iterations, work->rings);
    const bool complete = parallel_for(share, positions.size(), [&](IndexRange range) {
      for (std::size_t v = range.begin; v < range.end; ++v) next[v] = equalizer.moved(positions, v);
    });
    if (!complete) return cancelled();
    std::swap(positions, next);
  }
  return commit_positions(mesh, positions, params.iterations, context);
}

}  // namespace burnish
