#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/core/attributes.h"

namespace burnish {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Where positions are measured from: world = origin + position. Keeps large (geodetic) coordinates
/// exact while the positions stay float. Metres.
struct Frame {
  Vec3d origin{};
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// Plain arrays: copy it, fill it, hand it on. Nothing is cached and nothing can go stale.
struct TriangleMesh {
  std::vector<Vec3f> positions;       ///< #V, m
  std::vector<Triangle> triangles;    ///< #T, indices below #V
  Attributes attributes;              ///< per vertex
  Frame frame;

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Whether indices are in range, positions finite and attributes #V long. Triangles that name a
/// vertex twice are allowed. Errors: bad_geometry with the first offender. O(#V + #T).
Result<void> check(const TriangleMesh& mesh);

/// The mesh without the vertices that no triangle uses; order kept.
TriangleMesh without_unused_vertices(const TriangleMesh& mesh);

/// Area-weighted vertex normals of unit length; 0 where a vertex has no triangle with an area.
std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh);

/// Twice the area times the unit normal of triangle `t`, in double.
Vec3d area_vector(const TriangleMesh& mesh, std::size_t t);

}  // namespace burnish
