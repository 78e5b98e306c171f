#include "burnish/shapes/revolution.h"

#include <cmath>
#include <numbers>

namespace burnish {
namespace {

/// A ring of vertices, or the one vertex on the axis.
struct Ring {
  std::uint32_t first;
  std::uint32_t size;

  std::uint32_t operator[](std::uint32_t segment) const { return first + segment % size; }
};

}  // namespace

TriangleMesh revolve(const std::vector<ProfilePoint>& profile, bool closed, int segments) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(segments);
  std::vector<Ring> rings;
  for (const ProfilePoint& p : profile) {
    rings.push_back({static_cast<std::uint32_t>(mesh.positions.size()), p.radius == 0 ? 1 : count});
    for (std::uint32_t j = 0; j < rings.back().size; ++j) {
      const double angle = 2 * std::numbers::pi * j / count;
      mesh.positions.push_back(
          Vec3f(Vec3d{p.radius * std::cos(angle), p.radius * std::sin(angle), p.z}));
    }
  }
  if (closed) rings.push_back(rings.front());
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const Ring low = rings[i], high = rings[i + 1];
    for (std::uint32_t j = 0; j < count; ++j) {
      if (low.size > 1) mesh.triangles.push_back({low[j], low[j + 1], high[j + 1]});
      if (high.size > 1) mesh.triangles.push_back({low[j], high[j + 1], high[j]});
    }
  }
  return mesh;
}

}  // namespace burnish
