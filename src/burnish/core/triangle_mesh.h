#pragma once

#include <array>
#include <cstdint>
#include <span>
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

/// What is known of each triangle; each array is empty or #T long.
struct TriangleAttributes {
  std::vector<Origin> origin;        ///< invented: closes a hole where nothing was measured
  std::vector<std::uint32_t> owner;  ///< the vertex whose fan the triangle belongs to

  friend bool operator==(const TriangleAttributes&, const TriangleAttributes&) = default;
};

/// Plain arrays: copy it, fill it, hand it on. Nothing is cached and nothing can go stale.
struct TriangleMesh {
  std::vector<Vec3f> positions;     ///< #V, m
  std::vector<Triangle> triangles;  ///< #T, indices below #V
  Attributes attributes;            ///< per vertex
  Frame frame;
  TriangleAttributes triangle_attributes{};

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Whether indices are in range, positions finite, attributes #V and triangle attributes #T long.
/// Triangles that name a vertex twice are allowed. Errors: bad_geometry with the first offender.
/// O(#V + #T).
Result<void> check(const TriangleMesh& mesh);

/// Keeps the triangles `kept`, in that order, with what is known of them. O(#T).
void keep_triangles(TriangleMesh& mesh, std::span<const std::uint32_t> kept);

/// The mesh without the vertices that no triangle uses or has as its owner; order kept.
TriangleMesh without_unused_vertices(const TriangleMesh& mesh);

/// Area-weighted vertex normals of unit length; 0 where a vertex has no triangle with an area.
std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh);

/// The same where there is room for it; `sums` is worked with.
void vertex_normals_into(const TriangleMesh& mesh, std::vector<Vec3d>& sums,
                         std::vector<Vec3f>& normals);

/// Twice the area times the unit normal of triangle `t`, in double.
Vec3d area_vector(const TriangleMesh& mesh, std::size_t t);

}  // namespace burnish
