#include "burnish/io/xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/io/finish.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

constexpr TextStyle kStyle{.blanks = " \t\v\f,;", .comment = '#'};
constexpr std::size_t kMaxColumns = 64;
constexpr std::size_t kBlockRows = 4096;

/// Goes to the next line with data.
bool next_row(Cursor& cursor) {
  while (cursor.next_filled_line()) {
    Cursor ahead = cursor;
    if (!ahead.word().starts_with("//")) return true;
    cursor.next_line();
  }
  return false;
}

/// How many numbers the line has; none where a word is not a number.
std::optional<std::size_t> numbers_on_line(Cursor cursor) {
  std::size_t count = 0;
  for (double ignored = 0; !cursor.at_line_end(); ++count) {
    if (!cursor.number(ignored)) return std::nullopt;
  }
  return count;
}

/// Whether three channels are directions, or colours, in every row.
enum class Meaning { normals, colors, unknown };

Meaning meaning_of(std::span<const std::vector<double>* const, 3> columns) {
  bool normals = true;
  bool bytes = true;
  bool fractions = true;
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    double squares = 0;
    for (const auto* column : columns) {
      const double value = (*column)[i];
      squares += value * value;
      bytes = bytes && value >= 0 && value <= 255 && value == std::floor(value);
      fractions = fractions && value >= 0 && value <= 1;
    }
    normals = normals && (squares == 0 || std::abs(squares - 1) < 0.01);
  }
  return normals ? Meaning::normals : bytes || fractions ? Meaning::colors : Meaning::unknown;
}

void name_six_columns(Attributes& attributes) {
  const auto values = [&](std::size_t c) {
    return &std::get<std::vector<double>>(attributes.channels[c].values);
  };
  const std::vector<double>* columns[3] = {values(0), values(1), values(2)};
  const std::size_t count = columns[0]->size();
  const Meaning meaning = meaning_of(columns);
  if (meaning == Meaning::unknown) return;
  if (meaning == Meaning::normals) {
    for (std::size_t i = 0; i < count; ++i) {
      attributes.normals.push_back(
          Vec3f(Vec3d{(*columns[0])[i], (*columns[1])[i], (*columns[2])[i]}));
    }
  } else {
    const bool up_to_255 = std::any_of(columns, columns + 3, [](const auto* column) {
      return std::any_of(column->begin(), column->end(), [](double value) { return value > 1; });
    });
    const double scale = up_to_255 ? 1 : 255;
    const auto part = [&](std::size_t c, std::size_t i) {
      return static_cast<std::uint8_t>(std::lround((*columns[c])[i] * scale));
    };
    for (std::size_t i = 0; i < count; ++i)
      attributes.colors.push_back({part(0, i), part(1, i), part(2, i), 255});
  }
  attributes.channels.clear();
}

Result<GeometryFile> read_rows(std::string_view bytes, const std::string& name, const Vec3d& origin,
                               const Context& context) {
  Cursor cursor(bytes, name, kStyle);
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.take(3);
  GeometryFile file;
  if (!next_row(cursor)) return cursor.line_error("the file has no points");
  std::optional<std::size_t> count = numbers_on_line(cursor);
  if (!count || *count == 1) {
    file.notes.push_back("the first line is left out");
    cursor.next_line();
    if (!next_row(cursor)) return cursor.line_error("the file has no points");
    count = numbers_on_line(cursor);
  }
  if (!count || *count < 3 || *count > kMaxColumns) {
    return cursor.line_error(fmt::format("a line of 3 to {} numbers was expected", kMaxColumns));
  }
  const bool wide = origin != Vec3d{};
  std::vector<Field> fields;
  for (const char* axis : {"x", "y", "z"})
    fields.push_back({axis, wide ? NumberType::float64 : NumberType::float32});
  for (std::size_t c = 3; c < *count; ++c)
    fields.push_back({fmt::format("column_{}", c + 1), NumberType::float64});
  VertexColumns columns(fields, cursor.remaining() / (2 * *count) / 4, origin);
  std::vector<std::byte> packed(8 * *count * kBlockRows);
  std::vector<Column> block;
  for (std::size_t c = 0; c < *count; ++c) block.push_back({packed.data() + 8 * c, 8 * *count});
  std::size_t rows = 0;
  std::size_t total = 0;
  while (next_row(cursor)) {
    for (std::size_t c = 0; c < *count; ++c) {
      if (!parse_number(cursor, fields[c].type, packed.data() + 8 * (rows * *count + c))) {
        return cursor.line_error(
            fmt::format("point {} was expected to have {} numbers", total, *count));
      }
    }
    if (!cursor.at_line_end())
      return cursor.line_error(fmt::format("point {} has more than {} numbers", total, *count));
    cursor.next_line();
    ++total;
    if (++rows < kBlockRows) continue;
    columns.append(block, rows, false);
    rows = 0;
    context.progress(static_cast<double>(cursor.offset()) / static_cast<double>(bytes.size()));
    if (context.cancelled()) return cancelled();
  }
  columns.append(block, rows, false);
  columns.finish(file);
  if (*count == 6) name_six_columns(file.mesh.attributes);
  return file;
}

}  // namespace

bool recognise_xyz(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 4096), {}, kStyle);
  if (!next_row(cursor)) return false;
  const auto count = numbers_on_line(cursor);
  return count && *count >= 3;
}

Result<GeometryFile> read_xyz(std::string_view bytes, const std::string& name,
                              const Context& context) {
  auto file = read_with_origin(
      [&](const Vec3d& origin) { return read_rows(bytes, name, origin, context); });
  if (!file) return file;
  return finish_reading(std::move(*file), name);
}

}  // namespace burnish
