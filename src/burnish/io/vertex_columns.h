#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/io/geometry_file.h"
#include "burnish/io/number_type.h"

namespace burnish {

/// A named number that a file holds for every vertex.
struct Field {
  std::string name;
  NumberType type;
};

/// Where the values of a field lie: the first, and the bytes from one to the next.
struct Column {
  const std::byte* data;
  std::size_t stride;
};

/// Turns columns of numbers into positions and attributes. Fields are known by their names:
///   x y z                                       positions
///   nx ny nz | normal_x normal_y normal_z       normals
///   red green blue [alpha] | r g b [a]          colours, uint8, or floats of 0..1 (or 0..255)
///   rgb | rgba                                  colours packed as 0xAARRGGBB in four bytes
///   sigma (float32), observations (uint32), origin (uint8)
///   noise_x noise_y noise_z noise_along noise_across (float32)   the measurement's noise: its
///   axis,
///                                               standard deviations along and across it, m
/// All others become channels in their own type (64-bit integers: double).
class VertexColumns {
 public:
  /// `expected` vertices are reserved for; the caller has checked that the file can hold them.
  VertexColumns(std::vector<Field> fields, std::size_t expected, const Vec3d& origin);

  bool has_positions() const { return has_positions_; }
  /// Whether positions come in a type that float cannot hold.
  bool wide_positions() const { return wide_positions_; }

  /// The next `rows` vertices; one column per field, in the order of the fields.
  void append(std::span<const Column> columns, std::size_t rows, bool swap);

  /// Moves what was gathered into `file`, whose mesh must be empty.
  void finish(GeometryFile& file);

 private:
  struct Block {
    std::span<const Column> columns;
    std::size_t rows, first;
    bool swap;
  };
  using Decoder = std::function<void(const Block&)>;
  using Indices = std::vector<std::size_t>;

  Indices take(std::initializer_list<std::string_view> names, std::string_view optional = {});
  void add_positions();
  void add_normals();
  void add_colors();
  void add_measures();
  void add_noise();
  void add_channels();

  std::vector<Field> fields_;
  std::vector<bool> taken_;
  std::size_t expected_;
  Vec3d origin_;
  std::size_t count_ = 0;
  bool has_positions_ = false, wide_positions_ = false;
  std::vector<Vec3f> positions_;
  Attributes attributes_;
  std::vector<std::uint8_t> origins_;
  std::vector<float> float_colors_;  ///< 4 per vertex, until their scale is known
  std::vector<Decoder> decoders_;
  std::vector<std::string> notes_;
};

/// Colours from floats, 4 per vertex, of 0..1 or of 0..255; 255 where a float is NaN.
std::vector<Color> colors_from_floats(std::span<const float> values, bool up_to_255);

}  // namespace burnish
