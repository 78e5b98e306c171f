#include "judged_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

using std::numbers::pi;

TriangleMesh moved(TriangleMesh mesh, const std::function<Vec3d(const Vec3d&)>& place) {
  for (Vec3f& p : mesh.positions) p = Vec3f(place(Vec3d(p)));
  return mesh;
}

/// Polar angle and radius (0 to 1) of a point of the square [-1, 1]^2 carried to the unit disc ring
/// by ring (Shirley and Chiu 1997).
std::array<double, 2> on_disc(double x, double y) {
  const double radius = std::max(std::abs(x), std::abs(y));
  if (radius == 0) return {0, 0};
  if (std::abs(x) >= std::abs(y)) return {pi / 4 * y / x + (x < 0 ? pi : 0), radius};
  return {pi / 2 - pi / 4 * x / y + (y < 0 ? pi : 0), radius};
}

/// The radius in direction `angle` of a polygon whose corners lie `step` apart, at the radii
/// `outer` and `inner` in turn.
double polygon(double angle, double step, double outer, double inner) {
  double a = std::fmod(angle + 4 * pi, 2 * step);
  if (a > step) a = 2 * step - a;
  return outer * inner * std::sin(step) / (outer * std::sin(a) + inner * std::sin(step - a));
}

/// A solid between two lids: at height z (-1 to 1) its outline is `width(z)` times outline(angle).
TriangleMesh turned(int cells, double height, const std::function<double(double)>& outline,
                    const std::function<double(double)>& width) {
  return moved(make_box({2, 2, 2}, cells), [&](const Vec3d& p) {
    const auto [angle, share] = on_disc(p.x, p.y);
    const double radius = share * outline(angle) * width(p.z);
    return Vec3d{radius * std::cos(angle), radius * std::sin(angle), p.z * height / 2};
  });
}

double one(double) {
  return 1;
}

TriangleMesh rounded_box() {
  constexpr double kPower = 6;
  return moved(make_box({2, 2, 2}, 24), [](const Vec3d& p) {
    const double length =
        std::pow(std::pow(std::abs(p.x), kPower) + std::pow(std::abs(p.y), kPower) +
                     std::pow(std::abs(p.z), kPower),
                 1 / kPower);
    return Vec3d{p.x, 0.8 * p.y, 0.6 * p.z} / length;
  });
}

TriangleMesh bumps() {
  return moved(make_sphere(1, 4), [](const Vec3d& p) {
    return p * (1 + 0.12 * std::sin(5 * p.x) * std::sin(5 * p.y) * std::sin(5 * p.z + 1));
  });
}

/// A tube around a trefoil knot.
TriangleMesh knot() {
  constexpr double kTube = 0.45;
  return moved(make_torus(2, 1, 216, 20), [](const Vec3d& p) {
    const double t = std::atan2(p.y, p.x), outwards = std::hypot(p.x, p.y) - 2;
    const Vec3d centre{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                       -std::sin(3 * t)};
    const Vec3d speed{std::cos(t) + 4 * std::cos(2 * t), -std::sin(t) + 4 * std::sin(2 * t),
                      -3 * std::cos(3 * t)};
    const Vec3d turn{-std::sin(t) - 8 * std::sin(2 * t), -std::cos(t) + 8 * std::cos(2 * t),
                     9 * std::sin(3 * t)};
    const Vec3d binormal = normalized(cross(speed, turn));
    const Vec3d normal = cross(binormal, normalized(speed));
    return centre + kTube * (p.z * binormal - outwards * normal);
  });
}

/// The surface of a set of unit cubes that touch in faces only, each face cut into cells x cells.
TriangleMesh cubes(const std::function<bool(int, int, int)>& filled, int extent, int cells) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto next = static_cast<std::uint32_t>(mesh.positions.size());
    const auto [it, added] = known.try_emplace(lattice, next);
    if (added) {
      mesh.positions.push_back(Vec3f(Vec3<int>{lattice[0], lattice[1], lattice[2]}));
    }
    return it->second;
  };
  const auto add_face = [&](std::array<int, 3> cube, std::size_t axis, int side) {
    const std::size_t u = (axis + (side > 0 ? 1 : 2)) % 3, v = (axis + (side > 0 ? 2 : 1)) % 3;
    for (int i = 0; i < cells * cells; ++i) {
      const auto corner = [&](int right, int up) {
        std::array<int, 3> lattice{cube[0] * cells, cube[1] * cells, cube[2] * cells};
        lattice[axis] += side > 0 ? cells : 0;
        lattice[u] += i % cells + right, lattice[v] += i / cells + up;
        return vertex(lattice);
      };
      const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  };
  for (int n = 0; n < extent * extent * extent; ++n) {
    const std::array<int, 3> cube{n % extent, n / extent % extent, n / extent / extent};
    if (!filled(cube[0], cube[1], cube[2])) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> next = cube;
        next[axis] += side;
        const bool inside =
            std::all_of(next.begin(), next.end(), [&](int i) { return i >= 0 && i < extent; });
        if (!inside || !filled(next[0], next[1], next[2])) add_face(cube, axis, side);
      }
    }
  }
  return mesh;
}

struct NamedShape {
  std::string_view name;
  TriangleMesh (*make)();
};

constexpr std::array<NamedShape, 12> kShapes{{
    {"sphere", [] { return make_sphere(1, 4); }},
    {"torus", [] { return make_torus(1, 0.4, 96, 40); }},
    {"box",
     [] {
       return make_box({1, 1, 1}, 24);
     }},
    {"rounded_box", rounded_box},
    {"cylinder", [] { return turned(24, 2, one, one); }},
    {"cone", [] { return turned(24, 2, one, [](double z) { return 0.7 - 0.3 * z; }); }},
    {"vase",
     [] {
       return turned(28, 2.2, one, [](double z) { return 0.7 + 0.2 * std::cos(2.4 * z + 0.6); });
     }},
    {"hexagon",
     [] {
       return turned(
           24, 1, [](double a) { return polygon(a, pi / 3, 1, 1); }, one);
     }},
    {"star",
     [] {
       return turned(
           30, 1, [](double a) { return polygon(a + pi / 4, pi / 5, 1, 0.7); }, one);
     }},
    {"bumps", bumps},
    {"knot", knot},
    {"stairs", [] { return cubes([](int x, int, int z) { return z <= x; }, 4, 8); }},
}};

TriangleMesh of_size(TriangleMesh mesh, double extent) {
  Vec3f low = mesh.positions.front(), high = low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const Vec3f size = high - low;
  const double scale = extent / std::max({size.x, size.y, size.z});
  return moved(std::move(mesh), [scale](const Vec3d& p) { return scale * p; });
}

}  // namespace

std::span<const std::string_view> judged_shapes() {
  static const auto names = [] {
    std::array<std::string_view, kShapes.size()> all;
    std::transform(kShapes.begin(), kShapes.end(), all.begin(),
                   [](const NamedShape& shape) { return shape.name; });
    return all;
  }();
  return names;
}

Result<TriangleMesh> judged_shape(const std::string& name) {
  for (const NamedShape& shape : kShapes) {
    if (shape.name == name) return of_size(shape.make(), 0.3);
  }
  return make_shape(name);
}

}  // namespace burnish
