#include <fmt/format.h>

#include <algorithm>

#include "burnish/io/finish.h"
#include "burnish/io/lzf.h"
#include "burnish/io/pcd.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

constexpr TextStyle kStyle{.comment = '#'};
constexpr std::size_t kBlockRows = 4096;
constexpr std::uint32_t kMaxCount = 64;

struct PcdField {
  std::string name;
  std::uint32_t size = 4, count = 1;
  char type = 'F';
  NumberType number = NumberType::float32;
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::optional<std::uint64_t> width, height, points;
  std::optional<std::array<double, 7>> viewpoint;
  std::string data;
  CommentFacts facts;
};

std::optional<NumberType> number_type(char type, std::uint32_t size) {
  switch (type) {
    case 'I':
      return size == 1   ? std::optional(NumberType::int8)
             : size == 2 ? std::optional(NumberType::int16)
             : size == 4 ? std::optional(NumberType::int32)
             : size == 8 ? std::optional(NumberType::int64)
                         : std::nullopt;
    case 'U':
      return size == 1   ? std::optional(NumberType::uint8)
             : size == 2 ? std::optional(NumberType::uint16)
             : size == 4 ? std::optional(NumberType::uint32)
             : size == 8 ? std::optional(NumberType::uint64)
                         : std::nullopt;
    case 'F':
      return size == 4   ? std::optional(NumberType::float32)
             : size == 8 ? std::optional(NumberType::float64)
                         : std::nullopt;
    default:
      return std::nullopt;
  }
}

class PcdReader {
 public:
  PcdReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
            const Context& context)
      : bytes_(bytes),
        cursor_(bytes, name, kStyle),
        origin_(origin),
        context_(context),
        size_(bytes.size()) {}

  Result<GeometryFile> read();
  bool wide() const { return wide_; }

 private:
  Result<void> read_header();
  Result<void> header_line(std::string_view key);
  template <class Use>
  Result<void> each_field(Use use);
  Result<void> check_header();
  /// The fields that are kept, and of each the byte where it begins in a row.
  std::vector<Field> kept_fields();
  Result<void> read_ascii(VertexColumns& columns);
  Result<void> read_binary(VertexColumns& columns);
  Result<void> read_compressed(VertexColumns& columns);
  std::uint64_t most_unpacked_points() const;
  /// Writers that map the file fill its last page with zeros.
  bool only_zeros_left() const {
    const std::string_view rest = bytes_.substr(cursor_.offset());
    return rest.find_first_not_of('\0') == std::string_view::npos;
  }
  bool keep_going() {
    context_.progress(static_cast<double>(cursor_.offset()) / static_cast<double>(size_));
    return !context_.cancelled();
  }

  struct Kept {
    std::size_t offset, size;         ///< in a row
    std::size_t field_offset, field;  ///< of the field in a row; which field
  };

  std::string_view bytes_;
  Cursor cursor_;
  Vec3d origin_;
  const Context& context_;
  std::size_t size_;
  PcdHeader header_;
  std::vector<Kept> kept_;
  std::size_t row_bytes_ = 0, row_numbers_ = 0;
  GeometryFile file_;
  bool wide_ = false;
};

template <class Use>
Result<void> PcdReader::each_field(Use use) {
  for (PcdField& field : header_.fields) {
    if (!use(field))
      return cursor_.line_error(
          fmt::format("no proper value for the field '{}'", shown(field.name)));
  }
  if (!cursor_.at_line_end()) return cursor_.line_error("there are more values than FIELDS");
  return {};
}

Result<void> PcdReader::header_line(std::string_view key) {
  const auto one = [&](std::optional<std::uint64_t>& value) -> Result<void> {
    std::uint64_t number = 0;
    if (!cursor_.number(number))
      return cursor_.line_error(fmt::format("{} was expected to have a number", key));
    value = number;
    return {};
  };
  if (key == "FIELDS" || key == "COLUMNS") {
    header_.fields.clear();
    for (std::string_view name = cursor_.word(); !name.empty(); name = cursor_.word()) {
      header_.fields.push_back({.name = std::string(name)});
    }
    return {};
  }
  if (key == "SIZE") return each_field([&](PcdField& field) { return cursor_.number(field.size); });
  if (key == "COUNT")
    return each_field([&](PcdField& field) { return cursor_.number(field.count); });
  if (key == "TYPE") {
    return each_field([&](PcdField& field) {
      const std::string_view type = cursor_.word();
      field.type = type.size() == 1 ? type[0] : '?';
      return field.type != '?';
    });
  }
  if (key == "WIDTH") return one(header_.width);
  if (key == "HEIGHT") return one(header_.height);
  if (key == "POINTS") return one(header_.points);
  if (key == "VIEWPOINT") {
    std::array<double, 7> values{};
    for (double& value : values) {
      if (!cursor_.number(value))
        return cursor_.line_error("VIEWPOINT was expected to have 7 numbers");
      if (!std::isfinite(value)) return cursor_.line_error("VIEWPOINT must be finite");
    }
    header_.viewpoint = values;
    return {};
  }
  if (key == "DATA") {
    header_.data = cursor_.word();
    return {};
  }
  if (key == "VERSION") return {};
  return cursor_.line_error(fmt::format("'{}' is no keyword of a PCD header", shown(key)));
}

Result<void> PcdReader::read_header() {
  while (header_.data.empty()) {
    while (cursor_.at_line_end()) {
      if (cursor_.at_end()) return cursor_.line_error("the file ends within the header");
      const std::string_view comment = cursor_.rest_of_line();
      if (!comment.empty()) header_.facts.read(comment.substr(1));
      cursor_.next_line();
    }
    if (auto ok = header_line(cursor_.word()); !ok) return ok;
    if (!header_.data.empty()) {
      if (auto ok = check_header(); !ok) return ok;
    }
    cursor_.next_line();
  }
  return {};
}

Result<void> PcdReader::check_header() {
  if (header_.fields.empty()) return cursor_.line_error("the header has no FIELDS");
  for (PcdField& field : header_.fields) {
    const auto type = number_type(field.type, field.size);
    const bool padding = field.name == "_";
    if ((!type && !padding) || field.count == 0 || field.count > 1000000 || field.size == 0 ||
        field.size > 8) {
      return cursor_.line_error(
          fmt::format("the field '{}' has type {}, size {}, count {}: there is no such number",
                      shown(field.name), shown({&field.type, 1}), field.size, field.count));
    }
    field.number = type.value_or(NumberType::float64);
    row_bytes_ += std::size_t{field.size} * field.count;
    row_numbers_ += field.count;
  }
  const std::uint64_t width = header_.width.value_or(header_.points.value_or(0));
  const std::uint64_t height = header_.height.value_or(1);
  if (width > 0xffffffffu || height > 0xffffffffu || width * height > 0xffffffffu) {
    return cursor_.line_error(fmt::format("the header claims {} x {} points", width, height));
  }
  if (!header_.points) header_.points = width * height;
  if (*header_.points != width * height) {
    return cursor_.line_error(
        fmt::format("POINTS is {}, WIDTH x HEIGHT is {} x {}", *header_.points, width, height));
  }
  if (width > 1 && height > 1) {
    file_.grid = GridSize{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  }
  return {};
}

std::vector<Field> PcdReader::kept_fields() {
  std::vector<Field> fields;
  std::size_t offset = 0;
  for (std::size_t f = 0; f < header_.fields.size(); ++f) {
    const PcdField& field = header_.fields[f];
    const std::size_t field_offset = offset;
    offset += std::size_t{field.size} * field.count;
    if (field.name == "_") continue;
    if (field.count > kMaxCount) {
      file_.notes.push_back(fmt::format("the field '{}' of {} numbers per point is left out",
                                        shown(field.name), field.count));
      continue;
    }
    for (std::size_t i = 0; i < field.count; ++i) {
      fields.push_back(
          {field.count == 1 ? field.name : fmt::format("{}_{}", field.name, i), field.number});
      kept_.push_back({field_offset + i * field.size, field.size, field_offset, f});
    }
  }
  return fields;
}

Result<void> PcdReader::read_ascii(VertexColumns& columns) {
  const std::uint64_t points = *header_.points;
  if (points > (cursor_.remaining() + 1) / (2 * row_numbers_)) {
    return cursor_.byte_error(
        fmt::format("the header claims {} points, {} bytes are left", points, cursor_.remaining()));
  }
  std::vector<std::byte> packed(kBlockRows * row_bytes_);
  std::vector<Column> block;
  for (const Kept& kept : kept_) block.push_back({packed.data() + kept.offset, row_bytes_});
  for (std::uint64_t done = 0; done < points;) {
    const std::size_t rows = std::min<std::size_t>(kBlockRows, points - done);
    std::byte* out = packed.data();
    for (std::size_t row = 0; row < rows; ++row) {
      if (!cursor_.next_filled_line()) {
        return cursor_.line_error(
            fmt::format("the file ends at point {} of {}", done + row, points));
      }
      for (const PcdField& field : header_.fields) {
        for (std::size_t i = 0; i < field.count; ++i) {
          const bool ok = field.name == "_" ? !cursor_.word().empty()
                                            : parse_number(cursor_, field.number, out);
          if (!ok) {
            return cursor_.line_error(
                fmt::format("point {}: {} numbers were expected, the one for '{}' is missing or "
                            "none of its type",
                            done + row, row_numbers_, shown(field.name)));
          }
          out += field.size;
        }
      }
      if (!cursor_.at_line_end())
        return cursor_.line_error(
            fmt::format("point {} has more than {} numbers", done + row, row_numbers_));
      cursor_.next_line();
    }
    columns.append(block, rows, false);
    done += rows;
    if (!keep_going()) return cancelled();
  }
  return {};
}

Result<void> PcdReader::read_binary(VertexColumns& columns) {
  const std::uint64_t points = *header_.points;
  if (points > cursor_.remaining() / row_bytes_) {
    return cursor_.byte_error(
        fmt::format("the header claims {} points of {} bytes, {} bytes are left", points,
                    row_bytes_, cursor_.remaining()));
  }
  std::vector<Column> block(kept_.size());
  for (std::uint64_t done = 0; done < points;) {
    const std::size_t rows = std::min<std::size_t>(kBlockRows, points - done);
    const std::byte* at = cursor_.take(rows * row_bytes_);
    for (std::size_t i = 0; i < kept_.size(); ++i) block[i] = {at + kept_[i].offset, row_bytes_};
    columns.append(block, rows, std::endian::native != std::endian::little);
    done += rows;
    if (!keep_going()) return cancelled();
  }
  return {};
}

/// All values of the first field, then all of the second, ..., packed with LZF.
/// How many points of a compressed file, each of which may take less than a bit, can be unpacked so
/// that they and what is made of them stay within 64 MB + 8 x the file.
std::uint64_t PcdReader::most_unpacked_points() const {
  std::uint64_t bytes = row_bytes_;
  for (const Kept& kept : kept_) bytes += std::max<std::size_t>(4, kept.size);
  return ((std::uint64_t{56} << 20) + 7 * std::uint64_t{size_}) / bytes;
}

Result<void> PcdReader::read_compressed(VertexColumns& columns) {
  std::uint32_t packed_size = 0;
  std::uint32_t size = 0;
  if (!cursor_.read(packed_size) || !cursor_.read(size))
    return cursor_.byte_error("the file ends before the sizes of the data");
  const std::uint64_t points = *header_.points;
  if (size != points * row_bytes_) {
    return cursor_.byte_error(fmt::format("the data unpack to {} bytes, {} points take {}", size,
                                          points, points * row_bytes_));
  }
  const std::byte* packed = cursor_.take(packed_size);
  if (!packed)
    return cursor_.byte_error(fmt::format("{} bytes of data were promised, {} are left",
                                          packed_size, cursor_.remaining()));
  if (points > most_unpacked_points()) {
    return cursor_.byte_error(
        fmt::format(
            "the data unpack to {} bytes, more than fits the memory allowed for a file of {}", size,
            size_),
        ErrorCode::unsupported);
  }
  std::vector<std::byte> unpacked(size);
  if (!unpack_lzf({packed, packed_size}, unpacked))
    return cursor_.byte_error("the compressed data are damaged");
  std::vector<Column> block(kept_.size());
  for (std::uint64_t done = 0; done < points;) {
    const std::size_t rows = std::min<std::size_t>(kBlockRows, points - done);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const PcdField& field = header_.fields[kept_[i].field];
      const std::size_t stride = std::size_t{field.size} * field.count;
      const std::size_t within = kept_[i].offset - kept_[i].field_offset;
      block[i] = {unpacked.data() + kept_[i].field_offset * points + done * stride + within,
                  stride};
    }
    columns.append(block, rows, std::endian::native != std::endian::little);
    done += rows;
    if (!keep_going()) return cancelled();
  }
  return {};
}

Result<GeometryFile> PcdReader::read() {
  if (auto ok = read_header(); !ok) return ok.error();
  if (header_.facts.frame_origin) origin_ = *header_.facts.frame_origin;
  const bool known =
      header_.data == "ascii" || header_.data == "binary" || header_.data == "binary_compressed";
  if (!known)
    return cursor_.line_error(
        fmt::format("DATA '{}' is none of ascii, binary, binary_compressed", shown(header_.data)));
  std::vector<Field> fields = kept_fields();
  const std::uint64_t most =
      header_.data == "binary_compressed" ? most_unpacked_points() : std::uint64_t{size_};
  VertexColumns columns(std::move(fields), std::min(*header_.points, most), origin_);
  if (!columns.has_positions()) return cursor_.line_error("the FIELDS have no x, y and z");
  wide_ = columns.wide_positions() && !header_.facts.frame_origin;
  auto ok = header_.data == "ascii"    ? read_ascii(columns)
            : header_.data == "binary" ? read_binary(columns)
                                       : read_compressed(columns);
  if (!ok) return ok.error();
  columns.finish(file_);
  if (header_.facts.grid) file_.grid = header_.facts.grid;
  file_.viewpoint = header_.facts.viewpoint;
  if (header_.viewpoint && !file_.viewpoint) {
    const auto& v = *header_.viewpoint;
    const bool usual = v == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0};
    if (file_.grid || !usual) file_.viewpoint = Vec3d{v[0], v[1], v[2]};
  }
  if (header_.data == "ascii" ? cursor_.next_filled_line() : !only_zeros_left()) {
    file_.notes.push_back(
        fmt::format("{} bytes after the last point are left out", cursor_.remaining()));
  }
  return std::move(file_);
}

}  // namespace

bool recognise_pcd(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 4096), {}, kStyle);
  if (bytes.starts_with("# .PCD")) return true;
  if (!cursor.next_filled_line()) return false;
  const std::string_view word = cursor.word();
  return word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
}

Result<GeometryFile> read_pcd(std::string_view bytes, const std::string& name,
                              const Context& context) {
  PcdReader first(bytes, name, {}, context);
  auto file = first.read();
  if (!file) return file;
  if (first.wide()) {
    const Vec3d origin = frame_origin(file->mesh.positions);
    if (origin != Vec3d{}) {
      *file = {};
      file = PcdReader(bytes, name, origin, context).read();
      if (!file) return file;
    }
  }
  return finish_reading(std::move(*file), name);
}

}  // namespace burnish
