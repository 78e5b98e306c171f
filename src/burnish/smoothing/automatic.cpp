#include "burnish/smoothing/automatic.h"

#include "burnish/smoothing/fusion_stage.h"
#include "burnish/smoothing/fusion_weights.h"
#include "burnish/smoothing/vertex_update.h"

namespace burnish {

const Schema<AutoParams>& AutoParams::schema() {
  using P = AutoParams;
  static const auto schema = Schema<P>().choice("boundary", &P::boundary, boundary_rule_names(),
                                                "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_auto(TriangleMesh& mesh, const AutoParams& params,
                                    const Context& caller) {
  const Context context = for_passes_over(mesh.triangles.size(), caller);
  if (auto valid = AutoParams::schema().check(params); !valid) return valid.error();
  const Result<FaceWork> work = begin_face_work(mesh, context.part(0, 0.1));
  if (!work) return work.error();
  std::vector<Vec3d> positions = work->surface.positions;
  FusionStage stage(mesh, *work);
  VertexUpdate update(mesh, work->faces_of_vertices, {.boundary = params.boundary}, work->follows);
  const double share = 0.9 / kFusionStages;
  for (std::size_t s = 0; s < kFusionStages; ++s) {
    const Context part = context.part(0.1 + share * static_cast<double>(s),
                                      0.1 + share * static_cast<double>(s + 1));
    if (!stage.look(part.part(0, 0.6), positions)) return cancelled();
    const bool camera = !mesh.attributes.sigma.empty() || stage.roughness().correlated;
    const FusionNetwork& network = fusion_network(camera ? Noise::camera : Noise::white, s);
    if (!stage.fuse(part.part(0.6, 0.85), network) ||
        !update.run(part.part(0.85, 1), stage.normals(), kFusionVertexPasses, positions)) {
      return cancelled();
    }
  }
  context.progress(1);
  return finish_face_work(mesh, work->surface, positions, static_cast<int>(kFusionStages));
}

}  // namespace burnish
