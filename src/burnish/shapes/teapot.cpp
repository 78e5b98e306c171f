#include "burnish/shapes/teapot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace burnish {
namespace {

using Row = std::array<Vec3d, 4>;
using Patch = std::array<Row, 4>;  ///< rows from top to bottom, each clockwise seen from above

/// A ring of control points around the z axis. The four quarters approximate a circle of `radius`;
/// `handle` is the length of a quarter's tangent handles in radii. (Newell took 0.56 throughout,
/// but rounded the knob's.)
struct ControlRing {
  double radius, z, handle = 0.56;
};
using Lathe = std::array<ControlRing, 4>;

constexpr Lathe kRim{{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}};
constexpr Lathe kUpperBody{{{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}}};
constexpr Lathe kLowerBody{{{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}}};
constexpr Lathe kKnob{{{0, 3.15}, {0.8, 3.15, 0.5625}, {0, 2.85}, {0.2, 2.7}}};
constexpr Lathe kLid{{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}};
constexpr Lathe kBottom{{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0}, {0, 0}}};

/// A row of a tube's half: from one side in the plane y = 0 over y < 0 to the other side. The
/// tube's other half is its mirror image.
struct TubeRow {
  double x0, z0, x1, z1, width;
};
using Tube = std::array<TubeRow, 4>;

constexpr Tube kUpperHandle{{{-1.6, 2.025, -1.5, 2.25, 0.3},
                             {-2.3, 2.025, -2.5, 2.25, 0.3},
                             {-2.7, 2.025, -3, 2.25, 0.3},
                             {-2.7, 1.8, -3, 1.8, 0.3}}};
constexpr Tube kLowerHandle{{{-2.7, 1.8, -3, 1.8, 0.3},
                             {-2.7, 1.575, -3, 1.35, 0.3},
                             {-2.5, 1.125, -2.65, 0.9375, 0.3},
                             {-2, 0.9, -1.9, 0.6, 0.3}}};
constexpr Tube kLowerSpout{{{1.7, 1.425, 1.7, 0.6, 0.66},
                            {2.6, 1.425, 3.1, 0.825, 0.66},
                            {2.3, 2.1, 2.4, 2.025, 0.25},
                            {2.7, 2.4, 3.3, 2.4, 0.25}}};
constexpr Tube kUpperSpout{{{2.7, 2.4, 3.3, 2.4, 0.25},
                            {2.8, 2.475, 3.525, 2.49375, 0.25},
                            {2.9, 2.475, 3.45, 2.5125, 0.15},
                            {2.8, 2.4, 3.2, 2.4, 0.15}}};

Vec3d quarter_turn(const Vec3d& p) {
  return {p.y, -p.x, p.z};
}
Vec3d mirrored(const Vec3d& p) {
  return {p.x, -p.y, p.z};
}

std::array<Patch, 4> patches_of(const Lathe& lathe) {
  std::array<Patch, 4> quarters;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [r, z, handle] = lathe[i];
    Row row{{{r, 0, z}, {r, -r * handle, z}, {r * handle, -r, z}, {0, -r, z}}};
    for (Patch& quarter : quarters) {
      quarter[i] = row;
      std::transform(row.begin(), row.end(), row.begin(), quarter_turn);
    }
  }
  return quarters;
}

std::array<Patch, 2> patches_of(const Tube& tube) {
  std::array<Patch, 2> halves;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [x0, z0, x1, z1, width] = tube[i];
    const Row row{{{x0, 0, z0}, {x0, -width, z0}, {x1, -width, z1}, {x1, 0, z1}}};
    halves[0][i] = row;
    std::transform(row.rbegin(), row.rend(), halves[1][i].begin(), mirrored);
  }
  return halves;
}

/// A point of a cubic Bezier curve by de Casteljau's steps. std::lerp is exact at t = 0 and t = 1
/// and between equal points, so that curves that meet do so to the last bit.
Vec3d on_curve(Row p, double t) {
  for (std::size_t last = 3; last > 0; --last) {
    for (std::size_t i = 0; i < last; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[i][axis] = std::lerp(p[i][axis], p[i + 1][axis], t);
      }
    }
  }
  return p[0];
}

Vec3d on_patch(const Patch& patch, double across, double along) {
  Row column;
  for (std::size_t i = 0; i < 4; ++i) column[i] = on_curve(patch[i], along);
  return on_curve(column, across);
}

class TeapotBuilder {
 public:
  explicit TeapotBuilder(int cells_per_patch) : cells_(std::max(cells_per_patch, 2)) {
    add(kRim);
    add(kUpperBody);
    add(kLowerBody);
    add(kUpperHandle);
    add(kLowerHandle);
    add(kLowerSpout);
    add(kUpperSpout);
    add(kKnob);
    add(kLid);
    add(kBottom);
  }

  const std::vector<Vec3d>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  template <class Part>
  void add(const Part& part) {
    for (const Patch& patch : patches_of(part)) add_patch(patch);
  }
  void add_patch(const Patch& patch) {
    for (int i = 0; i < cells_; ++i) {
      for (int j = 0; j < cells_; ++j) {
        const auto at = [&](int di, int dj) {
          return vertex(on_patch(patch, static_cast<double>(i + di) / cells_,
                                 static_cast<double>(j + dj) / cells_));
        };
        const std::uint32_t here = at(0, 0), right = at(0, 1), below = at(1, 0), both = at(1, 1);
        add_triangle({here, right, below});
        add_triangle({right, both, below});
      }
    }
  }

  /// Patches that meet evaluate the same control points in the same order there, so that equal
  /// points are equal to the last bit.
  std::uint32_t vertex(const Vec3d& p) {
    const auto [it, added] =
        known_.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(points_.size()));
    if (added) points_.push_back(p + Vec3d{});  // + 0 makes a -0 positive
    return it->second;
  }

  void add_triangle(const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
  }

  int cells_;
  std::vector<Vec3d> points_;
  std::vector<Triangle> triangles_;
  std::map<std::array<double, 3>, std::uint32_t> known_;
};

}  // namespace

TriangleMesh make_teapot(int cells_per_patch) {
  const TeapotBuilder teapot(cells_per_patch);
  TriangleMesh mesh;
  mesh.triangles = teapot.triangles();
  for (const Vec3d& p : teapot.points()) mesh.positions.push_back(Vec3f(p));
  return mesh;
}

std::vector<Vec3d> teapot_points(int cells_per_patch) {
  return TeapotBuilder(cells_per_patch).points();
}

}  // namespace burnish
