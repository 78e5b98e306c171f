#include "burnish/shapes/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "burnish/shapes/revolution.h"
#include "burnish/shapes/teapot.h"

namespace burnish {
namespace {

std::uint32_t number_of(std::size_t size) {
  return static_cast<std::uint32_t>(size);
}

void add_cell(TriangleMesh& mesh, std::uint32_t lower_left, std::uint32_t lower_right,
              std::uint32_t upper_left, std::uint32_t upper_right, bool rising) {
  if (rising) {
    mesh.triangles.push_back({lower_left, lower_right, upper_right});
    mesh.triangles.push_back({lower_left, upper_right, upper_left});
  } else {
    mesh.triangles.push_back({lower_left, lower_right, upper_left});
    mesh.triangles.push_back({lower_right, upper_right, upper_left});
  }
}

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  for (const double s : {-1., 1.}) {
    for (const double t : {-g, g}) {
      for (const Vec3d& p : {Vec3d{0, s, t}, Vec3d{s, t, 0}, Vec3d{t, 0, s}}) {
        mesh.positions.push_back(Vec3f(p));
      }
    }
  }
  // Its triangles are the triples of vertices at the distance 2 from each other.
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return squared_norm(Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b])) < 4.1;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!joined(a, b) || !joined(b, c) || !joined(c, a)) continue;
        mesh.triangles.push_back({a, b, c});
        const bool outwards =
            dot(area_vector(mesh, mesh.triangles.size() - 1), Vec3d(mesh.positions[a])) > 0;
        if (!outwards) std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
      }
    }
  }
  return mesh;
}

/// Cuts every triangle in four at the middles of its edges.
void subdivide(TriangleMesh& mesh, std::vector<Vec3d>& directions) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, added] = middles.try_emplace(std::minmax(a, b), number_of(directions.size()));
    if (added) directions.push_back(normalized(directions[a] + directions[b]));
    return it->second;
  };
  std::vector<Triangle> finer;
  finer.reserve(mesh.triangles.size() * 4);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3f& p : mesh.positions) p = Vec3f(Vec3d(p) * factor);
  return mesh;
}

TriangleMesh on_table(TriangleMesh mesh) {
  float lowest = 0;
  for (const Vec3f& p : mesh.positions) lowest = std::min(lowest, p.z);
  for (Vec3f& p : mesh.positions) p.z -= lowest;
  return mesh;
}

using Maker = TriangleMesh (*)();
struct NamedShape {
  std::string_view name;
  Maker make;
};

constexpr std::array<NamedShape, 5> kShapes{{
    {"teapot", [] { return scaled(make_teapot(32), 0.05); }},
    {"sphere", [] { return on_table(make_sphere(0.15, 6)); }},
    {"box",
     [] {
       return on_table(make_box({0.3, 0.2, 0.15}, 32));
     }},
    {"torus", [] { return on_table(make_torus(0.11, 0.045, 256, 128)); }},
    {"cylinder", [] { return on_table(make_cylinder(0.1, 0.25, 256, 32)); }},
}};

}  // namespace

TriangleMesh make_grid(int columns, int rows, double spacing, Diagonal diagonal) {
  columns = std::max(columns, 1), rows = std::max(rows, 1);
  TriangleMesh mesh;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.positions.push_back(Vec3f(Vec3d{column * spacing, row * spacing, 0}));
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t corner = number_of(row * (columns + 1) + column);
      const std::uint32_t above = corner + number_of(columns + 1);
      const bool rising = diagonal == Diagonal::rising ||
                          (diagonal == Diagonal::alternating && (row + column) % 2 == 0);
      add_cell(mesh, corner, corner + 1, above, above + 1, rising);
    }
  }
  return mesh;
}

TriangleMesh make_box(const Vec3d& size, int cells) {
  const int n = std::max(cells, 1);
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [it, added] = known.try_emplace(lattice, number_of(mesh.positions.size()));
    if (added) {
      Vec3d p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis] = size[axis] * (static_cast<double>(lattice[axis]) / n - 0.5);
      }
      mesh.positions.push_back(Vec3f(p));
    }
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      // Looking at the face from outside, u runs to the right and v upwards.
      const std::size_t u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
      const auto at = [&](int i, int j) {
        std::array<int, 3> lattice{};
        lattice[axis] = far ? n : 0;
        lattice[u] = i, lattice[v] = j;
        return vertex(lattice);
      };
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const std::uint32_t lower_left = at(i, j), lower_right = at(i + 1, j);
          const std::uint32_t upper_left = at(i, j + 1), upper_right = at(i + 1, j + 1);
          add_cell(mesh, lower_left, lower_right, upper_left, upper_right, true);
        }
      }
    }
  }
  return mesh;
}

TriangleMesh make_sphere(double radius, int subdivisions) {
  TriangleMesh mesh = icosahedron();
  std::vector<Vec3d> directions;
  for (const Vec3f& p : mesh.positions) directions.push_back(normalized(Vec3d(p)));
  for (int i = 0; i < std::clamp(subdivisions, 0, 9); ++i) subdivide(mesh, directions);
  mesh.positions.clear();
  for (const Vec3d& d : directions) mesh.positions.push_back(Vec3f(d * radius));
  return mesh;
}

TriangleMesh make_uv_sphere(double radius, int segments, int rings) {
  rings = std::max(rings, 2);
  std::vector<ProfilePoint> profile{{0, -radius}};
  for (int i = 1; i < rings; ++i) {
    const double latitude = std::numbers::pi * (static_cast<double>(i) / rings - 0.5);
    profile.push_back({radius * std::cos(latitude), radius * std::sin(latitude)});
  }
  profile.push_back({0, radius});
  return revolve(profile, false, std::max(segments, 3));
}

TriangleMesh make_torus(double major, double minor, int segments, int sides) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i < std::max(sides, 3); ++i) {
    const double angle = 2 * std::numbers::pi * i / std::max(sides, 3);
    profile.push_back({major + minor * std::cos(angle), minor * std::sin(angle)});
  }
  return revolve(profile, true, std::max(segments, 3));
}

TriangleMesh make_cylinder(double radius, double height, int segments, int cells) {
  const int n = std::max(cells, 1);
  const ProfilePoint corners[] = {
      {0, -height / 2}, {radius, -height / 2}, {radius, height / 2}, {0, height / 2}};
  std::vector<ProfilePoint> profile{corners[0]};
  for (std::size_t side = 0; side < 3; ++side) {
    const ProfilePoint from = corners[side], to = corners[side + 1];
    for (int i = 1; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      profile.push_back({from.radius * (1 - t) + to.radius * t, from.z * (1 - t) + to.z * t});
    }
  }
  return revolve(profile, false, std::max(segments, 3));
}

std::span<const std::string_view> shape_names() {
  static const auto names = [] {
    std::array<std::string_view, kShapes.size()> all;
    std::transform(kShapes.begin(), kShapes.end(), all.begin(),
                   [](const NamedShape& shape) { return shape.name; });
    return all;
  }();
  return names;
}

Result<TriangleMesh> make_shape(std::string_view name) {
  std::string known;
  for (const NamedShape& shape : kShapes) {
    if (shape.name == name) return shape.make();
    known += fmt::format("{}{}", known.empty() ? "" : ", ", shape.name);
  }
  return Error{
      ErrorCode::invalid_argument, fmt::format("'{}' is no shape, known: {}", name, known), {}};
}

}  // namespace burnish
