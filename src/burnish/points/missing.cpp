#include "burnish/points/missing.h"

#include <limits>

namespace burnish {

CleaningReport take_out(PointCloud& cloud, const std::vector<std::uint8_t>& removed) {
  CleaningReport report;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < removed.size(); ++i) {
    const bool there = is_finite(cloud.positions[i]);
    report.points_before += there;
    report.points_removed += there && removed[i];
    if (!removed[i]) kept.push_back(i);
  }
  if (!cloud.grid) {
    if (report.points_removed > 0) cloud = select(cloud, kept);
    return report;
  }
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  Attributes& attributes = cloud.attributes;
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (!removed[i]) continue;
    cloud.positions[i] = {kMissing, kMissing, kMissing};
    if (!attributes.normals.empty()) attributes.normals[i] = {};
    if (!attributes.sigma.empty()) attributes.sigma[i] = 0;
    if (!attributes.noise.empty()) attributes.noise[i] = {};
    if (!attributes.observations.empty()) attributes.observations[i] = 0;
  }
  return report;
}

}  // namespace burnish
