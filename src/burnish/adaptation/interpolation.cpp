#include "burnish/adaptation/interpolation.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

namespace burnish {
namespace {

Vec3f between(std::span<const Vec3f> normals) {
  Vec3d sum;
  for (const Vec3f& normal : normals) sum += Vec3d(normal);
  return Vec3f(normalized(sum));
}

Color between(std::span<const Color> colors) {
  Color mean;
  const auto count = static_cast<unsigned>(colors.size());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    unsigned sum = 0;
    for (const Color& color : colors) sum += color[i];
    mean[i] = static_cast<std::uint8_t>((sum + count / 2) / count);
  }
  return mean;
}

PointNoise between(std::span<const PointNoise> noise) {
  return *std::max_element(noise.begin(), noise.end(), [](const auto& a, const auto& b) {
    return std::tie(a.along, a.across) < std::tie(b.along, b.across);
  });
}

Origin between(std::span<const Origin> origin) {
  const bool invented =
      std::all_of(origin.begin(), origin.end(), [](Origin o) { return o == Origin::invented; });
  return invented ? Origin::invented : Origin::interpolated;
}

/// Of numbers that measure the mean, of numbers that count or name the smallest.
template <class T>
requires std::is_arithmetic_v<T> T between(std::span<const T> numbers) {
  if constexpr (std::is_integral_v<T>) {
    return *std::min_element(numbers.begin(), numbers.end());
  } else {
    double sum = 0;
    for (const T number : numbers) sum += number;
    return static_cast<T>(sum / static_cast<double>(numbers.size()));
  }
}

float largest(std::span<const float> numbers) {
  return *std::max_element(numbers.begin(), numbers.end());
}

/// Adds to an attribute that is there `combine` of the parents' values for each new vertex.
template <std::size_t N, class T, class Combine>
void append(std::vector<T>& values, std::span<const Parents<N>> vertices, Combine combine) {
  if (values.empty()) return;
  values.reserve(values.size() + vertices.size());
  for (const Parents<N>& parents : vertices) {
    std::array<T, N> of_parents;
    for (std::size_t i = 0; i < N; ++i) of_parents[i] = values[parents[i]];
    values.push_back(combine(std::span<const T>(of_parents)));
  }
}

}  // namespace

void inherit_attributes(TriangleAttributes& attributes, std::span<const std::uint32_t> first) {
  const auto inherit = [&](auto& of_parents) {
    if (of_parents.empty()) return;
    auto values = std::exchange(of_parents, {});
    of_parents.reserve(first.back());
    for (std::size_t t = 0; t < values.size(); ++t) {
      of_parents.insert(of_parents.end(), first[t + 1] - first[t], values[t]);
    }
  };
  inherit(attributes.origin);
  inherit(attributes.owner);
}

template <std::size_t N>
void append_interpolated(Attributes& attributes, std::size_t count,
                         std::span<const Parents<N>> vertices) {
  const auto add = [&](auto& values) {
    append<N>(values, vertices, [](auto of_parents) { return between(of_parents); });
  };
  if (attributes.origin.empty() && !vertices.empty()) attributes.origin.assign(count, Origin::seen);
  add(attributes.normals);
  add(attributes.colors);
  append<N>(attributes.sigma, vertices, largest);
  add(attributes.noise);
  add(attributes.observations);
  add(attributes.origin);
  for (Channel& channel : attributes.channels) std::visit(add, channel.values);
}

template void append_interpolated(Attributes&, std::size_t, std::span<const Parents<2>>);
template void append_interpolated(Attributes&, std::size_t, std::span<const Parents<3>>);

}  // namespace burnish
