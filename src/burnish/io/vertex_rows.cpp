#include "burnish/io/vertex_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace burnish {

template <class T>
void VertexRows::add(std::initializer_list<std::string_view> names, Packer packer) {
  packers_.push_back(
      [pack = std::move(packer), offset = row_bytes_](
          std::size_t first, std::size_t rows, char* out) { pack(first, rows, out + offset); });
  for (const std::string_view name : names) {
    fields_.push_back({std::string(name), number_type_of<T>()});
    row_bytes_ += sizeof(T);
  }
}

template <class T, class Values>
void VertexRows::add_values(std::string_view name, const Values& values) {
  static_assert(sizeof(typename Values::value_type) == sizeof(T));
  add<T>({name}, [this, &values](std::size_t first, std::size_t rows, char* out) {
    for (std::size_t i = 0; i < rows; ++i, out += row_bytes_)
      std::memcpy(out, &values[first + i], sizeof(T));
  });
}

void VertexRows::add_positions() {
  if (view_.framed()) {
    add<double>({"x", "y", "z"}, [this](std::size_t first, std::size_t rows, char* out) {
      for (std::size_t i = 0; i < rows; ++i, out += row_bytes_) {
        const Vec3d p = view_.world(first + i);
        std::memcpy(out, &p, sizeof(p));
      }
    });
    return;
  }
  add<float>({"x", "y", "z"}, [this](std::size_t first, std::size_t rows, char* out) {
    for (std::size_t i = 0; i < rows; ++i, out += row_bytes_)
      std::memcpy(out, &view_.positions[first + i], sizeof(Vec3f));
  });
}

void VertexRows::add_colors(FieldNames names) {
  const std::vector<Color>& colors = view_.attributes.colors;
  if (names == FieldNames::pcd) {
    add<std::uint32_t>({"rgba"}, [this, &colors](std::size_t first, std::size_t rows, char* out) {
      for (std::size_t i = 0; i < rows; ++i, out += row_bytes_) {
        const auto [r, g, b, a] = colors[first + i];
        const Color packed{b, g, r, a};
        std::memcpy(out, packed.data(), packed.size());
      }
    });
    return;
  }
  const bool opaque =
      std::all_of(colors.begin(), colors.end(), [](const Color& c) { return c[3] == 255; });
  const std::size_t parts = opaque ? 3 : 4;
  const Packer pack = [this, &colors, parts](std::size_t first, std::size_t rows, char* out) {
    for (std::size_t i = 0; i < rows; ++i, out += row_bytes_)
      std::memcpy(out, colors[first + i].data(), parts);
  };
  if (opaque) {
    add<std::uint8_t>({"red", "green", "blue"}, pack);
  } else {
    add<std::uint8_t>({"red", "green", "blue", "alpha"}, pack);
  }
}

VertexRows::VertexRows(const GeometryView& view, FieldNames names) : view_(view) {
  const Attributes& attributes = view.attributes;
  add_positions();
  if (!attributes.normals.empty()) {
    const Packer pack = [this, &attributes](std::size_t first, std::size_t rows, char* out) {
      for (std::size_t i = 0; i < rows; ++i, out += row_bytes_) {
        std::memcpy(out, &attributes.normals[first + i], sizeof(Vec3f));
      }
    };
    if (names == FieldNames::ply) {
      add<float>({"nx", "ny", "nz"}, pack);
    } else {
      add<float>({"normal_x", "normal_y", "normal_z"}, pack);
    }
  }
  if (!attributes.colors.empty()) add_colors(names);
  if (!attributes.sigma.empty()) add_values<float>("sigma", attributes.sigma);
  if (!attributes.noise.empty()) {
    static_assert(sizeof(PointNoise) == 5 * sizeof(float));
    add<float>({"noise_x", "noise_y", "noise_z", "noise_along", "noise_across"},
               [this, &attributes](std::size_t first, std::size_t rows, char* out) {
                 for (std::size_t i = 0; i < rows; ++i, out += row_bytes_)
                   std::memcpy(out, &attributes.noise[first + i], sizeof(PointNoise));
               });
  }
  if (!attributes.observations.empty())
    add_values<std::uint32_t>("observations", attributes.observations);
  if (!attributes.origin.empty()) add_values<std::uint8_t>("origin", attributes.origin);
  for (const Channel& channel : attributes.channels) {
    std::visit(
        [&](const auto& values) {
          using T = typename std::remove_cvref_t<decltype(values)>::value_type;
          if (!values.empty()) add_values<T>(channel.name, values);
        },
        channel.values);
  }
}

Result<void> VertexRows::check() const {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const std::string& name = fields_[i].name;
    const bool word = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return c > ' ' && c != 127;
    });
    if (!word) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("the channel name '{}' is not one printable word", name),
                   {}};
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (fields_[j].name == name) {
        return Error{ErrorCode::invalid_argument,
                     fmt::format("there are two fields named '{}'", shown(name)),
                     {}};
      }
    }
  }
  return {};
}

void VertexRows::print(Output& out, const char* row) const {
  for (const Field& field : fields_) {
    if (&field != fields_.data()) out.character(' ');
    with_type(field.type, [&](auto value) {
      std::memcpy(&value, row, sizeof(value));
      out.number(value);
    });
    row += size_of(field.type);
  }
  out.character('\n');
}

void VertexRows::write(Output& out, bool ascii) const {
  std::string block;
  write_rows(out, view_.positions.size(), [&](std::size_t first, std::size_t rows) {
    if (ascii) block.resize(rows * row_bytes_);
    char* packed = ascii ? block.data() : out.room(rows * row_bytes_);
    for (const Packer& pack : packers_) pack(first, rows, packed);
    if (!ascii) return;
    for (std::size_t i = 0; i < rows; ++i) print(out, packed + i * row_bytes_);
  });
}

}  // namespace burnish
