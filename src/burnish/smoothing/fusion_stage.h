#pragma once

#include <vector>

#include "burnish/base/context.h"
#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/normal_fusion.h"

// Not part of the library's interface; the training program includes it too.
namespace burnish {

/// Stage after stage: what the network sees of a mesh as it is now, and the normals that it gives.
class FusionStage {
 public:
  /// `mesh` and `work` must outlive this.
  FusionStage(const TriangleMesh& mesh, const FaceWork& work) : mesh_(mesh), work_(work) {}

  /// Looks at the faces. `positions` in units of FaceSurface. Returns false where cancelled.
  [[nodiscard]] bool look(const Context& context, const std::vector<Vec3d>& positions);

  /// What the network sees now.
  FusionInput input() const;

  /// What it makes of it, which the next stage sees too. Returns false where cancelled.
  [[nodiscard]] bool fuse(const Context& context, const FusionNetwork& network);
  const FaceNormals& normals() const { return last_; }
  const Roughness& roughness() const { return roughness_; }

 private:
  const TriangleMesh& mesh_;
  const FaceWork& work_;
  FaceGeometry faces_;
  NormalCandidates candidates_;
  Roughness roughness_;
  FaceNormals first_, last_;
};

}  // namespace burnish
