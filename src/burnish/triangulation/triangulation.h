#pragma once

#include "burnish/base/facts.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What a triangulation did.
struct TriangulationReport {
  std::size_t points = 0;         ///< with a position
  std::size_t unused_points = 0;  ///< that no triangle uses; they are left out of the mesh
  std::size_t duplicate_points = 0;  ///< of these, that fall on another point
  std::size_t triangles = 0;
  std::size_t invented_triangles = 0;  ///< that close a hole between measured points

  Facts facts() const {
    return {{"points", static_cast<double>(points), ""},
            {"unused_points", static_cast<double>(unused_points), ""},
            {"duplicate_points", static_cast<double>(duplicate_points), ""},
            {"triangles", static_cast<double>(triangles), ""},
            {"invented_triangles", static_cast<double>(invented_triangles), ""}};
  }
};

/// A surface through points, and how it came about.
struct Triangulation {
  TriangleMesh mesh;
  TriangulationReport report;
};

}  // namespace burnish
