#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Closest points on a triangle mesh, by a tree of bounding boxes. Safe to ask from many threads.
/// Building takes O(#T log #T), a query near the surface O(log #T); all arithmetic is in double.
class ClosestPoint {
 public:
  struct Found {
    Vec3d point;                                                ///< on the mesh
    std::uint32_t triangle = ~0u;                               ///< that holds it
    double distance = std::numeric_limits<double>::infinity();  ///< from the query, m
  };

  /// `mesh` must pass check(); degenerate triangles count as the segments or points that they are.
  /// The mesh is not needed afterwards. Where the context is cancelled it is left as of an empty
  /// mesh.
  explicit ClosestPoint(const TriangleMesh& mesh, const Context& context = {});

  /// Of triangles at the same distance the one with the smaller number. An empty mesh has no
  /// closest point: the triangle is ~0u and the distance infinite.
  Found operator()(const Vec3d& query) const;

 private:
  struct Node {
    Vec3f low, high;
    std::uint32_t first =
        0;  ///< leaf: its first corner triple; else the right child (left: next one)
    std::uint32_t count = 0;  ///< leaf: how many; else 0

    double squared_distance(const Vec3d& query) const;
  };
  struct Corners {
    Vec3f a, b, c;
    std::uint32_t triangle;
  };
  struct Builder;

  std::vector<Node> nodes_;       ///< in depth-first order, the root first
  std::vector<Corners> corners_;  ///< leaf by leaf
};

/// The point of the segment from a to b closest to `query`.
Vec3d closest_on_segment(const Vec3d& query, const Vec3d& a, const Vec3d& b);

/// The point of triangle a, b, c closest to `query`, whatever the triangle's shape.
Vec3d closest_on_triangle(const Vec3d& query, const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace burnish
