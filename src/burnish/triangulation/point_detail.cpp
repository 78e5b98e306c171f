#include "burnish/triangulation/point_detail.h"

#include <algorithm>

namespace burnish {
namespace {

/// A polygon whose area is less than this share of its squared size has no plane.
constexpr double kFlat = 1e-9;

struct Frame3 {
  Vec3d centre, u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};
};

Vec3d mean_of(std::span<const Vec3f> positions, std::span<const std::uint32_t> around) {
  Vec3d sum;
  for (const std::uint32_t q : around) sum += Vec3d(positions[q]);
  return sum / static_cast<double>(around.size());
}

Frame3 frame_of(std::span<const Vec3f> positions, std::span<const std::uint32_t> around) {
  Frame3 frame;
  frame.centre = mean_of(positions, around);
  Vec3d area;
  double size = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vec3d a = Vec3d(positions[around[i]]) - frame.centre;
    const Vec3d b = Vec3d(positions[around[i + 1 < around.size() ? i + 1 : 0]]) - frame.centre;
    area += cross(a, b);
    size += squared_norm(a);
  }
  if (!(norm(area) > kFlat * size)) return frame;
  const Vec3d w = normalized(area), first = Vec3d(positions[around[0]]) - frame.centre;
  const Vec3d along = first - w * dot(w, first);
  if (!(squared_norm(along) > kFlat * size)) return frame;
  frame.w = w;
  frame.u = normalized(along);
  frame.v = cross(frame.w, frame.u);
  return frame;
}

Vec3f seen_from(const Frame3& frame, const Vec3d& d) {
  return Vec3f(Vec3d{dot(frame.u, d), dot(frame.v, d), dot(frame.w, d)});
}

Vec3d seen_from_outside(const Frame3& frame, const Vec3f& d) {
  const Vec3d local(d);
  return frame.u * local.x + frame.v * local.y + frame.w * local.z;
}

}  // namespace

void order_for_detail(std::span<const Vec3f> positions, std::vector<std::uint32_t>& around) {
  if (around.size() < 3) return;
  const Vec3d centre = mean_of(positions, around);
  const auto distance = [&](std::uint32_t q) { return squared_norm(Vec3d(positions[q]) - centre); };
  const auto farthest =
      std::max_element(around.begin(), around.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  std::rotate(around.begin(), farthest, around.end());
}

PointDetail detail_of(const Vec3f& position, const Vec3f& normal, std::span<const Vec3f> positions,
                      std::span<const std::uint32_t> around) {
  if (around.empty()) return {};
  const Frame3 frame = frame_of(positions, around);
  return {seen_from(frame, Vec3d(position) - frame.centre), seen_from(frame, Vec3d(normal))};
}

void place_detail(const PointDetail& detail, std::span<const Vec3f> positions,
                  std::span<const std::uint32_t> around, Vec3f& position, Vec3f& normal) {
  if (around.empty()) return;
  const Frame3 frame = frame_of(positions, around);
  position = Vec3f(frame.centre + seen_from_outside(frame, detail.offset));
  normal = Vec3f(seen_from_outside(frame, detail.normal));
}

}  // namespace burnish
