#include "conformance/samples.h"

#include <cmath>
#include <limits>

#include "burnish/base/random.h"

namespace burnish::test {
namespace {

constexpr std::uint32_t kWidth = 112, kHeight = 84;
constexpr double kFocalLength = 400;
const Vec3d kBallCentre{0.02, -0.01, 0.85};
constexpr double kBallRadius = 0.07;

struct Seen {
  double depth;
  Vec3d normal;
};

/// The wall z = 1.1 + 0.2 x - 0.1 y + 0.01 sin(20 x) sin(17 y), found by fixed-point iteration.
Seen wall(const Vec3d& eye, const Vec3d& ray) {
  double depth = 1, x = 0, y = 0;
  for (int i = 0; i < 30; ++i) {
    x = eye.x + depth * ray.x, y = eye.y + depth * ray.y;
    depth = 1.1 + 0.2 * x - 0.1 * y + 0.01 * std::sin(20 * x) * std::sin(17 * y) - eye.z;
  }
  return {depth, normalized(Vec3d{0.2 + 0.2 * std::cos(20 * x) * std::sin(17 * y),
                                  -0.1 + 0.17 * std::sin(20 * x) * std::cos(17 * y), -1})};
}

/// `ray` has z = 1, so that the ray's parameter is the depth.
Seen look(const Vec3d& eye, const Vec3d& ray) {
  const Vec3d to_eye = eye - kBallCentre;
  const double a = dot(ray, ray), b = dot(ray, to_eye);
  const double root = b * b - a * (dot(to_eye, to_eye) - kBallRadius * kBallRadius);
  if (root < 0) return wall(eye, ray);
  const double depth = (-b - std::sqrt(root)) / a;
  return {depth, normalized(eye + ray * depth - kBallCentre)};
}

void describe(Attributes& attributes, std::size_t count, Random& random) {
  std::vector<float> confidence;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t drawn = random.next();
    attributes.colors.push_back({static_cast<std::uint8_t>(drawn),
                                 static_cast<std::uint8_t>(drawn >> 8),
                                 static_cast<std::uint8_t>(drawn >> 16), 255});
    attributes.observations.push_back(1 + static_cast<std::uint32_t>(random.below(3)));
    attributes.origin.push_back(random.below(20) == 0 ? Origin::interpolated : Origin::seen);
    confidence.push_back(static_cast<float>(random.uniform()));
  }
  attributes.channels.push_back({"confidence", std::move(confidence)});
}

PointCloud scan(const Vec3d& eye, std::uint64_t seed) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.grid = GridSize{kWidth, kHeight};
  cloud.viewpoint = eye;
  Random random(seed);
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column) {
      const Vec3d ray{(column - kWidth / 2.0) / kFocalLength, (row - kHeight / 2.0) / kFocalLength,
                      1};
      Seen seen = look(eye, ray);
      const Vec3d beside{ray.x + 1 / kFocalLength, ray.y, 1};
      const double jump = look(eye, beside).depth - seen.depth;
      const double sigma = 0.001 * seen.depth * seen.depth;
      const std::uint64_t chance = random.below(1000);
      if (std::abs(jump) > 0.05 && chance < 600)
        seen.depth += jump * random.uniform(0.2, 0.8);
      else if (chance < 5)
        seen.depth *= random.uniform(0.5, 0.8);
      seen.depth += sigma * random.normal();
      const bool missing = chance >= 970 || column < 2;
      cloud.positions.push_back(missing ? Vec3f{kNone, kNone, kNone}
                                        : Vec3f(eye + ray * seen.depth));
      cloud.attributes.normals.push_back(Vec3f(seen.normal));
      cloud.attributes.sigma.push_back(static_cast<float>(sigma));
      cloud.attributes.noise.push_back({Vec3f(normalized(ray)), static_cast<float>(sigma),
                                        static_cast<float>(0.8 * seen.depth / kFocalLength)});
    }
  }
  describe(cloud.attributes, cloud.positions.size(), random);
  return cloud;
}

/// Joins `mesh` and a noisy height field with random diagonals, squares of 1 cm, but for those in
/// the hole.
template <class Hole>
void add_height_field(TriangleMesh& mesh, std::uint32_t columns, std::uint32_t rows, double height,
                      Random& random, Hole hole) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto noise = [&] { return 0.0015 * random.normal(); };
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double x = 0.01 * i + noise();
      const double y = 0.01 * j + noise();
      const double z = height + 0.05 * std::sin(9 * x) * std::cos(7 * y) + noise();
      mesh.positions.push_back(Vec3f(Vec3d{x, y, z}));
    }
  }
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      if (hole(i, j)) continue;
      const std::uint32_t a = first + j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      if (random.below(2) == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
}

void add_tetrahedron(TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3f& p : {Vec3f{0.1f, 0.1f, 0.3f}, Vec3f{0.13f, 0.11f, 0.32f},
                         Vec3f{0.09f, 0.14f, 0.31f}, Vec3f{0.12f, 0.12f, 0.37f}}) {
    mesh.positions.push_back(p);
  }
  for (const Triangle& t :
       {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}}) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

TriangleMesh make_sample_mesh() {
  TriangleMesh mesh;
  Random random(5);
  add_height_field(mesh, 90, 70, 0, random,
                   [](auto i, auto j) { return i > 30 && i < 45 && j > 20 && j < 33; });
  add_height_field(mesh, 9, 8, 0.2, random, [](auto, auto) { return false; });
  add_tetrahedron(mesh);
  mesh.positions.push_back({0.5f, 0.5f, 0.5f});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.attributes.sigma.push_back(static_cast<float>(random.uniform(0.001, 0.002)));
    const Vec3d ray = normalized(Vec3d(mesh.positions[v]) - Vec3d{0.4, 0.3, 2});
    mesh.attributes.noise.push_back({Vec3f(ray), mesh.attributes.sigma[v], 0.0008f});
  }
  mesh.attributes.normals = vertex_normals(mesh);
  describe(mesh.attributes, mesh.positions.size(), random);
  return mesh;
}

/// What the camera of a scan saw from the origin.
DepthFrame frame_of(const PointCloud& cloud, std::uint64_t seed) {
  DepthFrame frame;
  frame.camera = {kWidth, kHeight, kFocalLength, kFocalLength, kWidth / 2.0, kHeight / 2.0};
  frame.noise.c2 = 0.001;
  Random random(seed);
  for (const Vec3f& p : cloud.positions) {
    frame.depth.push_back(is_finite(p) ? p.z : 0);
    frame.noise_share.push_back(static_cast<float>(random.uniform(0.5, 1)));
    frame.sigma_share.push_back(static_cast<float>(random.uniform(0.3, 0.5)));
    frame.observations.push_back(1 + static_cast<std::uint32_t>(random.below(3)));
  }
  return frame;
}

}  // namespace

// Made once: every test is a process of its own, and making them takes longer than most tests.
const std::vector<DepthFrame>& sample_frames() {
  static const std::vector<DepthFrame> frames{frame_of(scan({}, 1), 1), frame_of(scan({}, 2), 2),
                                              frame_of(scan({}, 3), 3)};
  return frames;
}

const std::vector<PointCloud>& sample_clouds() {
  static const std::vector<PointCloud> clouds{scan({0, 0, 0}, 1), scan({0.04, 0.01, -0.02}, 2),
                                              scan({-0.02, 0.03, 0.03}, 3)};
  return clouds;
}

const TriangleMesh& sample_mesh() {
  static const TriangleMesh mesh = make_sample_mesh();
  return mesh;
}

}  // namespace burnish::test
