#include "burnish/io/vertex_columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish {
namespace {

/// Converts `rows` values of a column and writes every `step`-th element of `out`.
template <class To, class Convert>
void scatter(const Column& column, NumberType type, bool swap, std::size_t rows, To* out,
             std::size_t step, Convert convert) {
  with_type(type, [&](auto zero) {
    using From = decltype(zero);
    const std::byte* at = column.data;
    if (swap) {
      for (std::size_t i = 0; i < rows; ++i, at += column.stride)
        out[i * step] = convert(load<From>(at, true));
    } else {
      for (std::size_t i = 0; i < rows; ++i, at += column.stride)
        out[i * step] = convert(load<From>(at, false));
    }
  });
}

/// Three float columns that lie side by side are copied as whole vectors.
bool copy_vectors(const Column* columns, std::size_t rows, bool swap, Vec3f* out) {
  const std::size_t stride = columns[0].stride;
  const bool together = !swap && columns[1].data == columns[0].data + sizeof(float) &&
                        columns[2].data == columns[0].data + 2 * sizeof(float) &&
                        columns[1].stride == stride && columns[2].stride == stride;
  if (!together) return false;
  if (stride == sizeof(Vec3f)) {
    std::memcpy(static_cast<void*>(out), columns[0].data, rows * sizeof(Vec3f));
    return true;
  }
  const std::byte* at = columns[0].data;
  for (std::size_t i = 0; i < rows; ++i, at += stride)
    std::memcpy(static_cast<void*>(out + i), at, sizeof(Vec3f));
  return true;
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.f, 255.f)));
}

}  // namespace

std::vector<Color> colors_from_floats(std::span<const float> values, bool up_to_255) {
  const float scale = up_to_255 ? 1.f : 255.f;
  std::vector<Color> colors(values.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    colors[i / 4][i % 4] = std::isnan(values[i]) ? std::uint8_t{255} : to_byte(values[i] * scale);
  }
  return colors;
}

VertexColumns::VertexColumns(std::vector<Field> fields, std::size_t expected, const Vec3d& origin)
    : fields_(std::move(fields)), taken_(fields_.size()), expected_(expected), origin_(origin) {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    for (std::size_t j = 0; j < i && !taken_[i]; ++j) {
      if (fields_[j].name != fields_[i].name) continue;
      taken_[i] = true;
      notes_.push_back("the second field named '" + shown(fields_[i].name) + "' is left out");
    }
  }
  add_positions();
  add_normals();
  add_colors();
  add_measures();
  add_noise();
  add_channels();
}

/// Takes the fields of these names, and the optional one if it is there; none where one is missing.
VertexColumns::Indices VertexColumns::take(std::initializer_list<std::string_view> names,
                                           std::string_view optional) {
  Indices found;
  const auto find = [&](std::string_view name) {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (taken_[i] || fields_[i].name != name) continue;
      found.push_back(i);
      return true;
    }
    return false;
  };
  if (!std::all_of(names.begin(), names.end(), find)) return {};
  if (!optional.empty()) find(optional);
  for (const std::size_t i : found) taken_[i] = true;
  return found;
}

void VertexColumns::add_positions() {
  const Indices xyz = take({"x", "y", "z"});
  if (xyz.empty()) return;
  has_positions_ = true;
  bool all_float = true;
  for (const std::size_t i : xyz) {
    const NumberType type = fields_[i].type;
    all_float = all_float && type == NumberType::float32;
    wide_positions_ = wide_positions_ || (type != NumberType::float32 && size_of(type) >= 4);
  }
  positions_.reserve(expected_);
  decoders_.push_back([this, xyz, all_float](const Block& block) {
    positions_.resize(block.first + block.rows);
    Vec3f* out = positions_.data() + block.first;
    const Column columns[3] = {block.columns[xyz[0]], block.columns[xyz[1]], block.columns[xyz[2]]};
    if (all_float && copy_vectors(columns, block.rows, block.swap, out)) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double origin = all_float ? 0 : origin_[axis];
      scatter(
          columns[axis], fields_[xyz[axis]].type, block.swap, block.rows, &out->x + axis, 3,
          [origin](auto value) { return static_cast<float>(static_cast<double>(value) - origin); });
    }
  });
}

void VertexColumns::add_normals() {
  Indices xyz = take({"nx", "ny", "nz"});
  if (xyz.empty()) xyz = take({"normal_x", "normal_y", "normal_z"});
  if (xyz.empty()) return;
  attributes_.normals.reserve(expected_);
  decoders_.push_back([this, xyz](const Block& block) {
    attributes_.normals.resize(block.first + block.rows);
    Vec3f* out = attributes_.normals.data() + block.first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scatter(block.columns[xyz[axis]], fields_[xyz[axis]].type, block.swap, block.rows,
              &out->x + axis, 3, [](auto value) { return static_cast<float>(value); });
    }
    for (std::size_t i = 0; i < block.rows; ++i) {
      if (!is_finite(out[i])) out[i] = {};
    }
  });
}

void VertexColumns::add_colors() {
  const auto of_type = [&](const Indices& fields, auto accepts) {
    return std::all_of(fields.begin(), fields.end(),
                       [&](std::size_t i) { return accepts(fields_[i].type); });
  };
  const auto give_back = [&](const Indices& fields) {
    for (const std::size_t i : fields) taken_[i] = false;
  };
  struct Names {
    std::string_view red, green, blue, alpha;
  };
  static constexpr Names kNames[] = {
      {"red", "green", "blue", "alpha"},
      {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
      {"r", "g", "b", "a"}};
  for (const Names& names : kNames) {
    const Indices parts = take({names.red, names.green, names.blue}, names.alpha);
    if (parts.empty()) continue;
    if (of_type(parts, [](NumberType type) { return type == NumberType::uint8; })) {
      attributes_.colors.reserve(expected_);
      decoders_.push_back([this, parts](const Block& block) {
        attributes_.colors.resize(block.first + block.rows, Color{255, 255, 255, 255});
        for (std::size_t part = 0; part < parts.size(); ++part) {
          scatter(block.columns[parts[part]], NumberType::uint8, false, block.rows,
                  attributes_.colors[block.first].data() + part, 4,
                  [](auto value) { return static_cast<std::uint8_t>(value); });
        }
      });
      return;
    }
    if (of_type(parts, is_floating)) {
      notes_.push_back("floating-point colours are kept in 8 bits");
      float_colors_.reserve(4 * expected_);
      decoders_.push_back([this, parts](const Block& block) {
        float_colors_.resize(4 * (block.first + block.rows), std::nanf(""));
        for (std::size_t part = 0; part < parts.size(); ++part) {
          scatter(block.columns[parts[part]], fields_[parts[part]].type, block.swap, block.rows,
                  float_colors_.data() + 4 * block.first + part, 4,
                  [](auto value) { return static_cast<float>(value); });
        }
      });
      return;
    }
    give_back(parts);
  }
  for (const std::string_view name : {"rgba", "rgb"}) {
    const Indices packed = take({name});
    if (packed.empty()) continue;
    if (size_of(fields_[packed[0]].type) != 4) {
      give_back(packed);
      continue;
    }
    attributes_.colors.reserve(expected_);
    const bool has_alpha = name == "rgba";
    decoders_.push_back([this, field = packed[0], has_alpha](const Block& block) {
      attributes_.colors.resize(block.first + block.rows);
      scatter(block.columns[field], NumberType::uint32, block.swap, block.rows,
              attributes_.colors.data() + block.first, 1, [has_alpha](auto value) {
                const auto bits = static_cast<std::uint32_t>(value);
                const auto part = [bits](int shift) {
                  return static_cast<std::uint8_t>(bits >> shift);
                };
                return Color{part(16), part(8), part(0), has_alpha ? part(24) : std::uint8_t{255}};
              });
    });
    return;
  }
}

void VertexColumns::add_measures() {
  const auto add = [&](std::string_view name, auto& values) {
    using T = typename std::remove_reference_t<decltype(values)>::value_type;
    const Indices field = take({name});
    if (field.empty()) return;
    if (fields_[field[0]].type != number_type_of<T>()) {
      taken_[field[0]] = false;
      return;
    }
    values.reserve(expected_);
    decoders_.push_back([&values, index = field[0]](const Block& block) {
      values.resize(block.first + block.rows);
      scatter(block.columns[index], number_type_of<T>(), block.swap, block.rows,
              values.data() + block.first, 1, [](auto value) { return static_cast<T>(value); });
    });
  };
  add("sigma", attributes_.sigma);
  add("observations", attributes_.observations);
  add("origin", origins_);
}

void VertexColumns::add_noise() {
  const Indices parts = take({"noise_x", "noise_y", "noise_z", "noise_along", "noise_across"});
  if (parts.empty()) return;
  const bool all_float = std::all_of(parts.begin(), parts.end(), [&](std::size_t i) {
    return fields_[i].type == NumberType::float32;
  });
  if (!all_float) {
    for (const std::size_t i : parts) taken_[i] = false;
    return;
  }
  static_assert(sizeof(PointNoise) == 5 * sizeof(float));
  attributes_.noise.reserve(expected_);
  decoders_.push_back([this, parts](const Block& block) {
    attributes_.noise.resize(block.first + block.rows);
    float* out = &attributes_.noise[block.first].axis.x;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      scatter(block.columns[parts[part]], NumberType::float32, block.swap, block.rows, out + part,
              parts.size(), [](auto value) { return static_cast<float>(value); });
    }
  });
}

void VertexColumns::add_channels() {
  std::vector<std::size_t> fields;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (!taken_[i]) fields.push_back(i);
  }
  attributes_.channels.resize(fields.size());
  for (std::size_t c = 0; c < fields.size(); ++c) {
    const Field& field = fields_[fields[c]];
    attributes_.channels[c].name = field.name;
    with_type(field.type, [&](auto zero) {
      using From = decltype(zero);
      using T = std::conditional_t<sizeof(From) == 8, double, From>;
      if constexpr (sizeof(From) == 8 && std::is_integral_v<From>) {
        notes_.push_back("the 64-bit integers of '" + shown(field.name) + "' are kept as doubles");
      }
      auto& values = attributes_.channels[c].values.template emplace<std::vector<T>>();
      values.reserve(expected_);
      decoders_.push_back([this, c, index = fields[c]](const Block& block) {
        auto& out = std::get<std::vector<T>>(attributes_.channels[c].values);
        out.resize(block.first + block.rows);
        scatter(block.columns[index], fields_[index].type, block.swap, block.rows,
                out.data() + block.first, 1, [](auto value) { return static_cast<T>(value); });
      });
    });
  }
}

void VertexColumns::append(std::span<const Column> columns, std::size_t rows, bool swap) {
  if (rows == 0) return;
  for (const Decoder& decode : decoders_) decode({columns, rows, count_, swap});
  count_ += rows;
}

void VertexColumns::finish(GeometryFile& file) {
  if (!float_colors_.empty()) {
    const bool up_to_255 = std::any_of(float_colors_.begin(), float_colors_.end(),
                                       [](float value) { return value > 1; });
    attributes_.colors = colors_from_floats(float_colors_, up_to_255);
  }
  if (std::all_of(origins_.begin(), origins_.end(),
                  [](std::uint8_t value) { return value <= 2; })) {
    attributes_.origin.resize(origins_.size());
    std::transform(origins_.begin(), origins_.end(), attributes_.origin.begin(),
                   [](std::uint8_t value) { return static_cast<Origin>(value); });
  } else {
    attributes_.channels.push_back({"origin", std::move(origins_)});
  }
  file.mesh.positions = std::move(positions_);
  file.mesh.attributes = std::move(attributes_);
  file.mesh.frame.origin = wide_positions_ ? origin_ : Vec3d{};
  file.notes.insert(file.notes.end(), notes_.begin(), notes_.end());
}

}  // namespace burnish
