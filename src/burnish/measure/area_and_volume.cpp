#include "burnish/measure/area_and_volume.h"

#include <algorithm>

#include "burnish/core/edges.h"
#include "burnish/measure/surface_samples.h"

namespace burnish {
namespace {

bool closed_and_oriented(const TriangleMesh& mesh) {
  const std::vector<Edge> all = edges(mesh);
  return !all.empty() && std::all_of(all.begin(), all.end(), [](const Edge& edge) {
    return edge.triangles == 2 && !edge.flipped();
  });
}

Vec3d middle(const TriangleMesh& mesh) {
  Vec3f low = mesh.positions.front(), high = low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return 0.5 * (Vec3d(low) + Vec3d(high));
}

}  // namespace

Result<AreaAndVolume> area_and_volume(const TriangleMesh& mesh) {
  if (auto sound = check(mesh); !sound) return sound.error();
  AreaAndVolume result{surface_area(mesh), {}};
  if (!closed_and_oriented(mesh)) return result;
  const Vec3d from = middle(mesh);
  double six_volumes = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    six_volumes += dot(Vec3d(mesh.positions[mesh.triangles[t][0]]) - from, area_vector(mesh, t));
  }
  result.volume = six_volumes / 6;
  return result;
}

Facts AreaAndVolume::facts() const {
  Facts facts{{"area", area, "m2"}};
  if (volume) facts.push_back({"volume", *volume, "m3"});
  return facts;
}

}  // namespace burnish
