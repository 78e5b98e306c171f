#include "burnish/smoothing/guided_normal.h"

#include "burnish/smoothing/face_neighbours.h"
#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/normal_filter.h"
#include "burnish/smoothing/patch_guidance.h"
#include "burnish/smoothing/vertex_update.h"

namespace burnish {
namespace {

constexpr float kReach = 1;  // sigma_c, in units of FaceSurface

}  // namespace

const Schema<GuidedNormalParams>& GuidedNormalParams::schema() {
  using P = GuidedNormalParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 10000),
                   "rounds of filtering normals and moving vertices")
          .integer("vertex_iterations", &P::vertex_iterations, between(1, 10000),
                   "passes over the vertices in each round")
          .real("relative_radius", &P::relative_radius, {.low = 0, .high = 10},
                "radius of the neighbourhood in mean distances between centroids of neighbours")
          .real("sigma_r", &P::sigma_r, {.low = 1e-3, .high = 1e3},
                "width of the range weight, a difference of unit normals")
          .real("equalizing", &P::equalizing, between(0, 1),
                "share of the way amid its neighbours that a vertex of a bad triangle makes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_guided_normal(TriangleMesh& mesh, const GuidedNormalParams& params,
                                             const Context& caller) {
  const Context context = for_passes_over(mesh.triangles.size(), caller);
  if (auto valid = GuidedNormalParams::schema().check(params); !valid) return valid.error();
  const Result<FaceWork> work = begin_face_work(mesh, context.part(0, 0.03));
  if (!work) return work.error();
  std::vector<Vec3d> positions = work->surface.positions;
  FaceGeometry faces;
  Adjacency ball;
  PatchGuidance patches;
  if (!measure_faces(context.part(0.03, 0.04), mesh.triangles, positions, faces) ||
      !connected_within(context.part(0.04, 0.07), static_cast<float>(params.relative_radius),
                        faces.centroids, work->vertex_neighbours, ball) ||
      !patches.prepare(context.part(0.07, 0.1), work->edge_neighbours, work->vertex_neighbours)) {
    return cancelled();
  }
  VertexUpdate update(mesh, work->faces_of_vertices,
                      {.boundary = params.boundary, .equalizing = params.equalizing},
                      work->follows);
  const auto sigma_r = static_cast<float>(params.sigma_r);
  std::vector<float> weights;
  std::vector<Quad> guidance;
  FaceNormals filtered;
  const Context rounds = context.part(0.1, 1);
  for (int i = 0; i < params.iterations; ++i) {
    const Context share =
        rounds.part(static_cast<double>(i) / params.iterations, (i + 1.0) / params.iterations);
    if (!measure_faces(share.part(0, 0.05), mesh.triangles, positions, faces) ||
        !patches.find(share.part(0.05, 0.35), faces.normals, guidance) ||
        !near_weights(share.part(0.35, 0.4), ball, faces, kReach, weights) ||
        !filter_normals(share.part(0.4, 0.5), ball, weights, guidance, sigma_r, faces.normals,
                        filtered) ||
        !update.run(share.part(0.5, 1), filtered, params.vertex_iterations, positions)) {
      return cancelled();
    }
  }
  context.progress(1);
  return finish_face_work(mesh, work->surface, positions, params.iterations);
}

}  // namespace burnish
