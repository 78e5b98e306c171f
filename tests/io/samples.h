#pragma once

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "burnish/base/random.h"
#include "burnish/io/file_format.h"
#include "burnish/io/geometry_file.h"
#include "support/test_data.h"

namespace burnish::test {

inline const FileFormat& format_named(std::string_view name) {
  for (const FileFormat& format : geometry_formats()) {
    if (format.name == name) return format;
  }
  std::abort();
}

inline Result<GeometryFile> parse(std::string_view format, std::string_view text) {
  return format_named(format).read(text, "sample", Context{});
}

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Any finite float, all magnitudes and both zeros alike.
inline float any_float(Random& random) {
  for (;;) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    if (std::isfinite(value)) return value;
  }
}

inline Vec3f any_vector(Random& random) {
  Vec3f v;
  for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = any_float(random);
  return v;
}

/// A soup of triangles over vertices with arbitrary bits.
inline TriangleMesh any_mesh(std::uint64_t seed, std::size_t vertices = 300,
                             std::size_t triangles = 500) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) mesh.positions.push_back(any_vector(random));
  for (std::size_t t = 0; t < triangles; ++t) {
    Triangle triangle;
    for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random.below(vertices));
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

template <class T>
Channel any_channel(std::string name, Random& random, std::size_t count) {
  std::vector<T> values;
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (std::is_same_v<T, float>)
      values.push_back(any_float(random));
    else if constexpr (std::is_same_v<T, double>)
      values.push_back(random.normal() * 1e100);
    else
      values.push_back(static_cast<T>(random.next()));
  }
  return {std::move(name), std::move(values)};
}

/// Every attribute, and a channel of every type.
inline Attributes any_attributes(std::uint64_t seed, std::size_t count) {
  Random random(seed, 1);
  Attributes a;
  for (std::size_t i = 0; i < count; ++i) {
    a.normals.push_back(any_vector(random));
    Color color;
    for (std::uint8_t& part : color) part = static_cast<std::uint8_t>(random.next());
    a.colors.push_back(color);
    a.sigma.push_back(any_float(random));
    PointNoise noise;
    noise.axis = any_vector(random);
    noise.along = any_float(random);
    noise.across = any_float(random);
    a.noise.push_back(noise);
    a.observations.push_back(static_cast<std::uint32_t>(random.next()));
    a.origin.push_back(static_cast<Origin>(random.below(3)));
  }
  a.channels.push_back(any_channel<std::int8_t>("c_int8", random, count));
  a.channels.push_back(any_channel<std::uint8_t>("c_uint8", random, count));
  a.channels.push_back(any_channel<std::int16_t>("c_int16", random, count));
  a.channels.push_back(any_channel<std::uint16_t>("c_uint16", random, count));
  a.channels.push_back(any_channel<std::int32_t>("c_int32", random, count));
  a.channels.push_back(any_channel<std::uint32_t>("c_uint32", random, count));
  a.channels.push_back(any_channel<float>("c_float", random, count));
  a.channels.push_back(any_channel<double>("c_double", random, count));
  return a;
}

/// An origin and an owner for each of `triangles` triangles.
inline TriangleAttributes any_triangle_attributes(std::uint64_t seed, std::size_t triangles,
                                                  std::size_t vertices) {
  Random random(seed, 2);
  TriangleAttributes known;
  for (std::size_t t = 0; t < triangles; ++t) {
    known.origin.push_back(static_cast<Origin>(random.below(3)));
    known.owner.push_back(static_cast<std::uint32_t>(random.below(vertices)));
  }
  return known;
}

/// An organized cloud with attributes and a missing pixel here and there.
inline PointCloud any_organized_cloud(std::uint64_t seed) {
  PointCloud cloud;
  cloud.grid = GridSize{20, 15};
  cloud.viewpoint = Vec3d{0.25, -1, 3};
  cloud.positions = any_mesh(seed, 300, 1).positions;
  cloud.attributes = any_attributes(seed, 300);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 300; i += 7) cloud.positions[i] = {kNan, kNan, kNan};
  return cloud;
}

/// Whether two arrays are the same to the bit (NaN equals NaN, 0 does not equal -0).
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace burnish::test
