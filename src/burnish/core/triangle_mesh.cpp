#include "burnish/core/triangle_mesh.h"

#include <fmt/format.h>

#include "burnish/core/gather.h"

namespace burnish {
namespace {

Result<void> check_triangle_attributes(const TriangleMesh& mesh) {
  const auto& [origin, owner] = mesh.triangle_attributes;
  const auto check = [&](std::string_view name, std::size_t size) -> Result<void> {
    if (size == 0 || size == mesh.triangles.size()) return {};
    return Error{ErrorCode::bad_geometry,
                 fmt::format("triangle attribute '{}' has {} values for {} triangles", name, size,
                             mesh.triangles.size()),
                 {}};
  };
  if (auto ok = check("origin", origin.size()); !ok) return ok;
  if (auto ok = check("owner", owner.size()); !ok) return ok;
  for (std::size_t t = 0; t < owner.size(); ++t) {
    if (owner[t] < mesh.positions.size()) continue;
    return Error{ErrorCode::bad_geometry,
                 fmt::format("triangle {} has vertex {} of {} as its owner", t, owner[t],
                             mesh.positions.size()),
                 {}};
  }
  return {};
}

}  // namespace

Result<void> check(const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  for (std::size_t v = 0; v < count; ++v) {
    if (!is_finite(mesh.positions[v])) {
      return Error{ErrorCode::bad_geometry, fmt::format("vertex {} is not finite", v), {}};
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= count) {
        return Error{ErrorCode::bad_geometry,
                     fmt::format("triangle {} names vertex {} of {}", t, v, count),
                     {}};
      }
    }
  }
  if (auto sound = check_triangle_attributes(mesh); !sound) return sound;
  return check_lengths(mesh.attributes, count);
}

void keep_triangles(TriangleMesh& mesh, std::span<const std::uint32_t> kept) {
  mesh.triangles = gather(mesh.triangles, kept);
  mesh.triangle_attributes.origin = gather(mesh.triangle_attributes.origin, kept);
  mesh.triangle_attributes.owner = gather(mesh.triangle_attributes.owner, kept);
}

TriangleMesh without_unused_vertices(const TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> renamed(mesh.positions.size(), kUnused);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) renamed[v] = 0;
  }
  for (const std::uint32_t v : mesh.triangle_attributes.owner) renamed[v] = 0;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == kUnused) continue;
    renamed[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(v);
  }
  TriangleMesh result{gather(mesh.positions, kept), mesh.triangles, gather(mesh.attributes, kept),
                      mesh.frame, mesh.triangle_attributes};
  for (Triangle& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) v = renamed[v];
  }
  for (std::uint32_t& v : result.triangle_attributes.owner) v = renamed[v];
  return result;
}

Vec3d area_vector(const TriangleMesh& mesh, std::size_t t) {
  const auto [a, b, c] = mesh.triangles[t];
  const Vec3d p(mesh.positions[a]);
  return cross(Vec3d(mesh.positions[b]) - p, Vec3d(mesh.positions[c]) - p);
}

std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3d> sums;
  std::vector<Vec3f> normals;
  vertex_normals_into(mesh, sums, normals);
  return normals;
}

void vertex_normals_into(const TriangleMesh& mesh, std::vector<Vec3d>& sums,
                         std::vector<Vec3f>& normals) {
  sums.assign(mesh.positions.size(), {});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d area = area_vector(mesh, t);
    for (const std::uint32_t v : mesh.triangles[t]) sums[v] += area;
  }
  normals.resize(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) normals[v] = Vec3f(normalized(sums[v]));
}

}  // namespace burnish
