#include "burnish/smoothing/bilateral_normal.h"

#include <utility>

#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/normal_filter.h"
#include "burnish/smoothing/vertex_update.h"

namespace burnish {
namespace {

constexpr float kReach = 1;  // sigma_c, in units of FaceSurface

}  // namespace

const Schema<BilateralNormalParams>& BilateralNormalParams::schema() {
  using P = BilateralNormalParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 10000), "passes over the normals")
          .integer("vertex_iterations", &P::vertex_iterations, between(1, 10000),
                   "passes over the vertices afterwards")
          .real("sigma_s", &P::sigma_s, {.low = 1e-3, .high = 1e3},
                "width of the range weight, a difference of unit normals")
          .real("equalizing", &P::equalizing, between(0, 1),
                "share of the way amid its neighbours that a vertex of a bad triangle makes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_bilateral_normal(TriangleMesh& mesh,
                                                const BilateralNormalParams& params,
                                                const Context& caller) {
  const Context context = for_passes_over(mesh.triangles.size(), caller);
  if (auto valid = BilateralNormalParams::schema().check(params); !valid) return valid.error();
  const Result<FaceWork> work = begin_face_work(mesh, context.part(0, 0.1));
  if (!work) return work.error();
  std::vector<Vec3d> positions = work->surface.positions;
  FaceGeometry faces;
  std::vector<float> weights;
  if (!measure_faces(context.part(0.1, 0.14), mesh.triangles, positions, faces) ||
      !near_weights(context.part(0.14, 0.15), work->vertex_neighbours, faces, kReach, weights)) {
    return cancelled();
  }
  const auto sigma_s = static_cast<float>(params.sigma_s);
  FaceNormals filtered;
  const Context normal_share = context.part(0.15, 0.7);
  for (int i = 0; i < params.iterations; ++i) {
    const Context share = normal_share.part(static_cast<double>(i) / params.iterations,
                                            (i + 1.0) / params.iterations);
    if (!filter_normals(share, work->vertex_neighbours, weights, faces.normals, sigma_s,
                        faces.normals, filtered)) {
      return cancelled();
    }
    std::swap(faces.normals, filtered);
  }

  if (params.iterations > 0) {
    VertexUpdate update(mesh, work->faces_of_vertices,
                        {.boundary = params.boundary, .equalizing = params.equalizing},
                        work->follows);
    if (!update.run(context.part(0.7, 1), faces.normals, params.vertex_iterations, positions)) {
      return cancelled();
    }
  }
  context.progress(1);
  return finish_face_work(mesh, work->surface, positions, params.iterations);
}

}  // namespace burnish
