#include "burnish/pipeline/live_mesh.h"

namespace burnish {

Result<void> LiveMesh::update(const DepthFrame& frame, const Context& context) {
  if (auto done = unproject_into(frame, params_.unproject, context.part(0, 0.1), cloud_); !done) {
    return done;
  }
  const auto triangulated =
      triangulator_.triangulate(cloud_, params_.triangulate, context.part(0.1, 0.4), mesh_);
  if (!triangulated) return triangulated;
  triangulator_.find_rings(rings_);
  const auto smoothed = passes_.smooth(rings_, triangulator_.pixels(), params_.smooth,
                                       context.part(0.4, 0.9), mesh_.positions);
  if (!smoothed) return smoothed;
  if (params_.normals) {
    std::vector<Vec3f>& normals = mesh_.attributes.normals;
    // Room for all that there can be, so that a frame with more pixels than the first takes no
    // more.
    normals.reserve(frame.depth.size());
    normal_sums_.reserve(frame.depth.size());
    vertex_normals_into(mesh_, normal_sums_, normals);
  }
  context.progress(1);
  return {};
}

}  // namespace burnish
