#include "conformance/workpiece.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "burnish/base/random.h"

namespace burnish::test {
namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  const std::size_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

void append(std::string& bytes, const Attributes& attributes) {
  append(bytes, attributes.normals);
  append(bytes, attributes.colors);
  append(bytes, attributes.sigma);
  append(bytes, attributes.noise);
  append(bytes, attributes.observations);
  append(bytes, attributes.origin);
  for (const Channel& channel : attributes.channels) {
    bytes += channel.name;
    std::visit([&](const auto& values) { append(bytes, values); }, channel.values);
  }
}

void append(std::string& bytes, const DepthFrame& frame) {
  append(bytes, frame.depth);
  append(bytes, frame.noise_share);
  append(bytes, frame.sigma_share);
  append(bytes, frame.observations);
  const Camera& camera = frame.camera;
  append(bytes, std::vector{camera.width, camera.height});
  append(bytes, std::vector{camera.fx, camera.fy, camera.cx, camera.cy, frame.time});
  append(bytes, std::vector{frame.T_world_camera});
  append(bytes, std::vector{frame.noise});
}

double diagonal(const std::vector<Vec3f>& points) {
  Vec3d low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
  for (const Vec3f& p : points) {
    if (!is_finite(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  return low.x > high.x ? 0 : norm(high - low);
}

bool near(double a, double b, double tolerance) {
  return a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance;
}

bool near(const Vec3f& a, const Vec3f& b, double tolerance) {
  return near(a.x, b.x, tolerance) && near(a.y, b.y, tolerance) && near(a.z, b.z, tolerance);
}

template <class T>
std::string compare(const char* what, const std::vector<T>& expected, const std::vector<T>& actual,
                    double tolerance) {
  if (expected.size() != actual.size()) {
    return fmt::format("{}: {} instead of {}", what, actual.size(), expected.size());
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if constexpr (std::is_same_v<T, Vec3f> || std::is_same_v<T, float>) {
      if (!near(expected[i], actual[i], tolerance)) return fmt::format("{} {} differs", what, i);
    } else {
      if (expected[i] != actual[i]) return fmt::format("{} {} differs", what, i);
    }
  }
  return {};
}

/// The first of some comparisons that found something.
template <class... Findings>
std::string first_of(Findings... findings) {
  std::string first;
  ((first.empty() ? void(first = std::move(findings)) : void()), ...);
  return first;
}

std::string compare(const std::vector<PointNoise>& expected, const std::vector<PointNoise>& actual,
                    double direction, double length) {
  if (expected.size() != actual.size()) return "another number of noises";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const PointNoise &a = expected[i], &b = actual[i];
    if (!near(a.axis, b.axis, direction) || !near(a.along, b.along, length) ||
        !near(a.across, b.across, length)) {
      return fmt::format("noise {} differs", i);
    }
  }
  return {};
}

std::string compare(const Attributes& expected, const Attributes& actual, double length,
                    double tolerance) {
  if (expected.channels != actual.channels) return "channels differ";
  // Directions are numbers near 1; a length that is off by a share of the diagonal turns them by a
  // share of an edge, which may be a hundredth of it.
  return first_of(compare("normal", expected.normals, actual.normals, 1000 * tolerance),
                  compare("color", expected.colors, actual.colors, 0),
                  compare("sigma", expected.sigma, actual.sigma, length * tolerance),
                  compare(expected.noise, actual.noise, 1000 * tolerance, length * tolerance),
                  compare("observations", expected.observations, actual.observations, 0),
                  compare("origin", expected.origin, actual.origin, 0));
}

std::string compare(const DepthFrame& expected, const DepthFrame& actual, double tolerance) {
  const auto farthest = std::max_element(expected.depth.begin(), expected.depth.end());
  const double length = expected.depth.empty() ? 0 : *farthest;
  return first_of(compare("depth", expected.depth, actual.depth, length * tolerance),
                  compare("noise share", expected.noise_share, actual.noise_share, tolerance),
                  compare("sigma share", expected.sigma_share, actual.sigma_share, tolerance),
                  compare("observations", expected.observations, actual.observations, 0));
}

std::string compare(const Facts& expected, const Facts& actual, double tolerance) {
  if (expected.size() != actual.size()) return "other facts";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double size = std::max(std::abs(expected[i].value), std::abs(actual[i].value));
    if (expected[i].key != actual[i].key ||
        !near(expected[i].value, actual[i].value, tolerance * size)) {
      return fmt::format("{} is {} instead of {}", actual[i].key, actual[i].value,
                         expected[i].value);
    }
  }
  return {};
}

void scale(std::vector<Vec3f>& points, Attributes& attributes, double factor) {
  for (Vec3f& p : points) p = Vec3f(factor * Vec3d(p));
  for (float& sigma : attributes.sigma) sigma = static_cast<float>(factor * sigma);
  for (PointNoise& noise : attributes.noise) {
    noise.along = static_cast<float>(factor * noise.along);
    noise.across = static_cast<float>(factor * noise.across);
  }
}

void scale(DepthFrame& frame, double factor) {
  for (float& depth : frame.depth) depth = static_cast<float>(factor * depth);
  frame.T_world_camera.translation = frame.T_world_camera.translation * factor;
  DepthNoise& noise = frame.noise;
  for (double* length : {&noise.z0, &noise.c0, &noise.metres, &noise.min_depth, &noise.max_depth}) {
    *length *= factor;
  }
  noise.c2 /= factor;
}

void rotate(std::vector<Vec3f>& points, Attributes& attributes, const RigidTransform& turn) {
  for (Vec3f& p : points) {
    if (is_finite(p)) p = Vec3f(turn.rotate(Vec3d(p)));
  }
  for (Vec3f& n : attributes.normals) n = Vec3f(turn.rotate(Vec3d(n)));
  for (PointNoise& noise : attributes.noise) {
    noise.axis = Vec3f(turn.rotate(Vec3d(noise.axis)));
  }
}

std::vector<std::uint32_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// Whether each point of `a` finds a point of `b` of its own within `reach`.
std::string match(std::vector<Vec3f> a, std::vector<Vec3f> b, double reach) {
  if (a.size() != b.size()) return fmt::format("{} points instead of {}", b.size(), a.size());
  const auto by_coordinates = [](const Vec3f& p, const Vec3f& q) {
    return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
  };
  std::sort(a.begin(), a.end(), by_coordinates);
  std::sort(b.begin(), b.end(), by_coordinates);
  std::vector<bool> taken(b.size());
  std::size_t first = 0;
  for (const Vec3f& p : a) {
    while (first < b.size() && b[first].x < p.x - reach) ++first;
    std::size_t i = first;
    while (i < b.size() && b[i].x <= p.x + reach && (taken[i] || !near(p, b[i], reach))) ++i;
    if (i == b.size() || b[i].x > p.x + reach) {
      return fmt::format("point ({}, {}, {}) has no partner", p.x, p.y, p.z);
    }
    taken[i] = true;
  }
  return {};
}

/// The triangles as nine numbers, the smallest corner first, sorted.
std::vector<std::array<float, 9>> soup(const TriangleMesh& mesh) {
  std::vector<std::array<float, 9>> result;
  for (Triangle t : mesh.triangles) {
    const auto key = [&](std::uint32_t v) {
      const Vec3f& p = mesh.positions[v];
      return std::array{p.x, p.y, p.z};
    };
    std::rotate(
        t.begin(),
        std::min_element(t.begin(), t.end(), [&](auto v, auto w) { return key(v) < key(w); }),
        t.end());
    std::array<float, 9> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto point = key(t[c]);
      std::copy(point.begin(), point.end(), corners.begin() + static_cast<std::ptrdiff_t>(3 * c));
    }
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::string bytes(const Workpiece& workpiece) {
  std::string result;
  for (const PointCloud& cloud : workpiece.clouds) {
    append(result, cloud.positions);
    append(result, cloud.attributes);
    const GridSize grid = cloud.grid.value_or(GridSize{});
    const Vec3d eye = cloud.viewpoint.value_or(Vec3d{});
    append(result, std::vector{grid.width, grid.height});
    append(result, std::vector{eye, cloud.frame.origin});
  }
  append(result, workpiece.mesh.positions);
  append(result, workpiece.mesh.triangles);
  append(result, workpiece.mesh.attributes);
  append(result, std::vector{workpiece.mesh.frame.origin});
  for (const DepthFrame& frame : workpiece.frames) append(result, frame);
  return result;
}

std::string bytes(const Outcome& outcome) {
  std::string result = bytes(outcome.output);
  for (const Fact& fact : outcome.facts) {
    result += fact.key;
    append(result, std::vector{fact.value});
  }
  return result;
}

std::string digest(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

std::string difference(const Outcome& expected, const Outcome& actual, const Tolerance& tolerance) {
  const auto& clouds = expected.output.clouds;
  if (clouds.size() != actual.output.clouds.size()) return "another number of clouds";
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const PointCloud &a = clouds[i], &b = actual.output.clouds[i];
    const double length = diagonal(a.positions);
    std::string found =
        first_of(compare("position", a.positions, b.positions, length * tolerance.position),
                 compare(a.attributes, b.attributes, length, tolerance.position),
                 std::string(a.grid == b.grid ? "" : "another grid"));
    if (!found.empty()) return found;
  }
  const auto& frames = expected.output.frames;
  if (frames.size() != actual.output.frames.size()) return "another number of frames";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::string found = compare(frames[i], actual.output.frames[i], tolerance.position);
    if (!found.empty()) return found;
  }
  const TriangleMesh &a = expected.output.mesh, &b = actual.output.mesh;
  const double length = diagonal(a.positions);
  return first_of(compare("position", a.positions, b.positions, length * tolerance.position),
                  compare("triangle", a.triangles, b.triangles, 0),
                  compare(a.attributes, b.attributes, length, tolerance.position),
                  compare(expected.facts, actual.facts, tolerance.facts));
}

std::string unordered_difference(const Outcome& expected, const Outcome& actual,
                                 const Tolerance& tolerance) {
  const auto& clouds = expected.output.clouds;
  if (clouds.size() != actual.output.clouds.size()) return "another number of clouds";
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const double reach = diagonal(clouds[i].positions) * tolerance.position;
    std::string found = match(clouds[i].positions, actual.output.clouds[i].positions, reach);
    if (!found.empty()) return found;
  }
  const auto& frames = expected.output.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::string found = compare(frames[i], actual.output.frames[i], tolerance.position);
    if (!found.empty()) return found;
  }
  const auto a = soup(expected.output.mesh), b = soup(actual.output.mesh);
  std::vector<std::array<float, 9>> apart;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(apart));
  if (!apart.empty()) return fmt::format("{} of {} triangles differ", apart.size(), a.size());
  return compare(expected.facts, actual.facts, tolerance.facts);
}

Workpiece scaled(Workpiece workpiece, double factor) {
  for (PointCloud& cloud : workpiece.clouds) {
    scale(cloud.positions, cloud.attributes, factor);
    if (cloud.viewpoint) cloud.viewpoint = *cloud.viewpoint * factor;
  }
  scale(workpiece.mesh.positions, workpiece.mesh.attributes, factor);
  for (DepthFrame& frame : workpiece.frames) scale(frame, factor);
  return workpiece;
}

Facts scaled(Facts facts, double factor) {
  for (Fact& fact : facts) {
    const int power = fact.unit == "m" ? 1 : fact.unit == "m2" ? 2 : fact.unit == "m3" ? 3 : 0;
    fact.value *= std::pow(factor, power);
  }
  return facts;
}

Workpiece rotated(Workpiece workpiece, const std::array<Vec3d, 3>& rows) {
  const RigidTransform turn{rows, {}};
  for (PointCloud& cloud : workpiece.clouds) {
    rotate(cloud.positions, cloud.attributes, turn);
    if (cloud.viewpoint) cloud.viewpoint = turn(*cloud.viewpoint);
  }
  rotate(workpiece.mesh.positions, workpiece.mesh.attributes, turn);
  for (DepthFrame& frame : workpiece.frames) frame.T_world_camera = turn * frame.T_world_camera;
  return workpiece;
}

Workpiece unorganized(Workpiece workpiece) {
  for (PointCloud& cloud : workpiece.clouds) cloud = without_missing(cloud);
  return workpiece;
}

Workpiece relabelled(const Workpiece& workpiece, std::uint64_t seed,
                     std::vector<std::uint32_t>* new_index) {
  Random random(seed);
  Workpiece result = workpiece;
  for (PointCloud& cloud : result.clouds) {
    cloud = select(cloud, shuffled(cloud.positions.size(), random));
  }
  const auto frame_order = shuffled(workpiece.frames.size(), random);
  for (std::size_t i = 0; i < frame_order.size(); ++i) {
    result.frames[i] = workpiece.frames[frame_order[i]];
  }
  const auto old_index = shuffled(workpiece.mesh.positions.size(), random);
  std::vector<std::uint32_t> renamed(old_index.size());
  for (std::uint32_t i = 0; i < old_index.size(); ++i) {
    renamed[old_index[i]] = i;
    result.mesh.positions[i] = workpiece.mesh.positions[old_index[i]];
  }
  result.mesh.attributes = gather(workpiece.mesh.attributes, old_index);
  const auto order = shuffled(workpiece.mesh.triangles.size(), random);
  for (std::size_t t = 0; t < order.size(); ++t) {
    Triangle corners = workpiece.mesh.triangles[order[t]];
    for (std::uint32_t& v : corners) v = renamed[v];
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                corners.end());
    result.mesh.triangles[t] = corners;
  }
  if (new_index) *new_index = std::move(renamed);
  return result;
}

}  // namespace burnish::test
