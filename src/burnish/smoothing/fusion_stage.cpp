#include "burnish/smoothing/fusion_stage.h"

#include "burnish/base/parallel.h"

namespace burnish {

bool FusionStage::look(const Context& context, const std::vector<Vec3d>& positions) {
  if (!measure_faces(context.part(0, 0.05), mesh_.triangles, positions, faces_) ||
      !normal_candidates(faces_, work_.vertex_neighbours, context.part(0.05, 1), candidates_)) {
    return false;
  }
  if (last_.empty()) roughness_ = burnish::roughness(candidates_);
  return true;
}

FusionInput FusionStage::input() const {
  return {&candidates_, &faces_, &work_.vertex_neighbours, roughness_, first_, last_};
}

bool FusionStage::fuse(const Context& context, const FusionNetwork& network) {
  FaceNormals fused(faces_.normals.size());
  const FusionInput seen = input();
  const bool complete = parallel_for(context, fused.size(), [&](IndexRange range) {
    FusionFeatures features;
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const FusionFrame frame = fusion_features(seen, f, features);
      fused[f] = fused_normal(network, features, frame);
      fused[f].set_w(faces_.normals[f].w());
    }
  });
  if (!complete) return false;
  if (first_.empty()) first_ = faces_.normals;
  last_ = std::move(fused);
  return true;
}

}  // namespace burnish
