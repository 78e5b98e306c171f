#pragma once

#include "burnish/base/facts.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What a triangulation did.
struct TriangulationReport {
  std::size_t points = 0;            ///< with a position
  std::size_t missing_points = 0;    ///< pixels of an organized cloud without one
  std::size_t duplicate_points = 0;  ///< that lie where another one does, which is taken for both
  std::size_t unused_points = 0;     ///< that no triangle uses; they are left out of the mesh
  std::size_t triangles = 0;
  std::size_t invented_triangles = 0;  ///< that close a hole between measured points

  Facts facts() const {
    return {{"points", static_cast<double>(points), ""},
            {"missing_points", static_cast<double>(missing_points), ""},
            {"duplicate_points", static_cast<double>(duplicate_points), ""},
            {"unused_points", static_cast<double>(unused_points), ""},
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
