#pragma once

#include <optional>

#include "burnish/base/facts.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What a triangulation did.
struct TriangulationReport {
  std::size_t points = 0;            ///< with a position
  std::size_t missing_points = 0;    ///< pixels of an organized cloud without one
  std::size_t duplicate_points = 0;  ///< in the place of another, which stands for both
  std::size_t unused_points = 0;     ///< that no triangle uses; they are left out of the mesh
  std::size_t triangles = 0;
  std::size_t invented_triangles = 0;  ///< that close a hole between measured points

  // Where the method tells them apart.
  std::optional<std::size_t> isolated_points;   ///< with fewer than two others beside them
  std::optional<std::size_t> collinear_points;  ///< without a triangle: the others are in a line
  std::optional<std::size_t> boundary_points;   ///< with triangles on one side only

  Facts facts() const {
    Facts facts{{"points", static_cast<double>(points), ""},
                {"missing_points", static_cast<double>(missing_points), ""},
                {"duplicate_points", static_cast<double>(duplicate_points), ""},
                {"unused_points", static_cast<double>(unused_points), ""},
                {"triangles", static_cast<double>(triangles), ""},
                {"invented_triangles", static_cast<double>(invented_triangles), ""}};
    const auto add = [&facts](const char* key, const std::optional<std::size_t>& count) {
      if (count) facts.push_back({key, static_cast<double>(*count), ""});
    };
    add("isolated_points", isolated_points);
    add("collinear_points", collinear_points);
    add("boundary_points", boundary_points);
    return facts;
  }
};

/// A surface through points, and how it came about.
struct Triangulation {
  TriangleMesh mesh;
  TriangulationReport report;
};

}  // namespace burnish
