#pragma once

#include <functional>
#include <string>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/base/rigid.h"
#include "burnish/core/depth_frame.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish::test {

/// Whatever an operation of any family takes or gives: clouds, a mesh, or frames.
struct Workpiece {
  std::vector<PointCloud> clouds;
  TriangleMesh mesh;
  std::vector<DepthFrame> frames{};
};

/// What came out of an operation.
struct Outcome {
  Workpiece output;
  Facts facts;
};

/// Every bit of it, for comparisons where nothing may differ at all.
std::string bytes(const Workpiece& workpiece);
std::string bytes(const Outcome& outcome);

/// A short name for a string of bytes (FNV-1a, 64 bits, hexadecimal).
std::string digest(const std::string& bytes);

/// How far two outcomes may be apart.
struct Tolerance {
  double position = 0;  ///< as a share of the bounding box's diagonal
  double facts = 0;     ///< relative
};

/// Empty where the two are equal within `tolerance`, element by element; otherwise the first
/// difference in words.
std::string difference(const Outcome& expected, const Outcome& actual, const Tolerance& tolerance);

/// The same for points and triangles in any order: every point must have a partner of its own.
std::string unordered_difference(const Outcome& expected, const Outcome& actual,
                                 const Tolerance& tolerance);

/// The workpiece in other units: positions and sigma times `factor`.
Workpiece scaled(Workpiece workpiece, double factor);
/// The facts in other units, by the power of metres in their unit.
Facts scaled(Facts facts, double factor);

/// The workpiece turned about the origin.
Workpiece rotated(Workpiece workpiece, const std::array<Vec3d, 3>& rows);

/// Clouds without grid and missing pixels; meshes stay.
Workpiece unorganized(Workpiece workpiece);

/// Frames, points, vertices and triangles in another order, corners counted from another one.
/// `new_index[v]`, where it is asked for, is where the mesh's vertex v went.
Workpiece relabelled(const Workpiece& workpiece, std::uint64_t seed,
                     std::vector<std::uint32_t>* new_index = nullptr);

}  // namespace burnish::test
