#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/base/vec3.h"
#include "burnish/core/gather.h"

namespace burnish {

/// Red, green, blue, alpha, 0 to 255.
using Color = std::array<std::uint8_t, 4>;

/// Where a vertex comes from: measured by the sensor, put between measured ones, or made up.
enum class Origin : std::uint8_t { seen = 0, interpolated = 1, invented = 2 };

/// How far a measurement may be off, as one standard deviation along an axis (the ray of a depth
/// camera) and one across it: its sensor places the point in a spheroid, thin across the ray and
/// long along it. Both 0: a measurement that is exact.
struct PointNoise {
  Vec3f axis{};      ///< unit length, either way round; of no meaning where along = across
  float along = 0;   ///< m
  float across = 0;  ///< m

  friend bool operator==(const PointNoise&, const PointNoise&) = default;
};

/// One number per vertex under a name of the user's, in the type in which the file held it.
struct Channel {
  using Values =
      std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                   std::vector<std::uint16_t>, std::vector<std::int32_t>,
                   std::vector<std::uint32_t>, std::vector<float>, std::vector<double>>;
  std::string name;
  Values values;

  std::size_t size() const;
  friend bool operator==(const Channel&, const Channel&) = default;
};

/// What is known of each vertex besides its position; each array is empty or as long as there are
/// vertices.
struct Attributes {
  std::vector<Vec3f> normals;  ///< unit length, pointing out of the surface; 0 = unknown
  std::vector<Color> colors;
  std::vector<float> sigma;  ///< one standard deviation of the position across the surface, m
  std::vector<PointNoise>
      noise;  ///< of the measurement that the vertex came from: smoothing, which
              ///< moves the vertex and makes sigma smaller, leaves it alone
  std::vector<std::uint32_t> observations;  ///< how many measurements the vertex is the mean of
  std::vector<Origin> origin;
  std::vector<Channel> channels;

  friend bool operator==(const Attributes&, const Attributes&) = default;
};

/// Whether every array of `attributes` is empty or `count` long; the error names the one that is
/// not.
Result<void> check_lengths(const Attributes& attributes, std::size_t count);

/// The attributes of the elements `kept`, in that order; indices may repeat.
Attributes gather(const Attributes& attributes, const Selection& kept);

}  // namespace burnish
