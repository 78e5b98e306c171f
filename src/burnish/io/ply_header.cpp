#include "burnish/io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace burnish {
namespace {

std::optional<NumberType> type_named(std::string_view name) {
  struct Name {
    std::string_view text;
    NumberType type;
  };
  static constexpr std::array<Name, 20> kNames{{
      {"char", NumberType::int8},       {"uchar", NumberType::uint8},
      {"short", NumberType::int16},     {"ushort", NumberType::uint16},
      {"int", NumberType::int32},       {"uint", NumberType::uint32},
      {"float", NumberType::float32},   {"double", NumberType::float64},
      {"int8", NumberType::int8},       {"uint8", NumberType::uint8},
      {"int16", NumberType::int16},     {"uint16", NumberType::uint16},
      {"int32", NumberType::int32},     {"uint32", NumberType::uint32},
      {"float32", NumberType::float32}, {"float64", NumberType::float64},
      {"int64", NumberType::int64},     {"uint64", NumberType::uint64},
      {"long", NumberType::int64},      {"ulong", NumberType::uint64},
  }};
  for (const Name& known : kNames) {
    if (known.text == name) return known.type;
  }
  return std::nullopt;
}

Result<void> read_format(Cursor& cursor, PlyHeader& header) {
  const std::string_view format = cursor.word();
  header.ascii = format == "ascii";
  header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  if (!header.ascii && format != "binary_big_endian" && format != "binary_little_endian") {
    return cursor.line_error(
        fmt::format("format '{}' is none of ascii, binary_little_endian, "
                    "binary_big_endian",
                    shown(format)));
  }
  return {};
}

Result<void> read_element(Cursor& cursor, PlyHeader& header) {
  PlyElement element;
  element.name = cursor.word();
  if (element.name.empty() || !cursor.number(element.count)) {
    return cursor.line_error("'element NAME COUNT' was expected");
  }
  header.elements.push_back(std::move(element));
  return {};
}

Result<void> read_property(Cursor& cursor, PlyHeader& header) {
  if (header.elements.empty()) return cursor.line_error("a property comes before any element");
  PlyProperty property;
  std::string_view type = cursor.word();
  if (type == "list") {
    const std::string_view count_type = cursor.word();
    property.list_count = type_named(count_type);
    if (!property.list_count || is_floating(*property.list_count)) {
      return cursor.line_error(
          fmt::format("'{}' is no type for the length of a list", shown(count_type)));
    }
    type = cursor.word();
  }
  const auto known = type_named(type);
  if (!known) return cursor.line_error(fmt::format("'{}' is no type of a property", shown(type)));
  property.type = *known;
  property.name = cursor.word();
  if (property.name.empty()) return cursor.line_error("a property has no name");
  header.elements.back().properties.push_back(std::move(property));
  return {};
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.list_count.has_value(); });
}

std::size_t PlyElement::row_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += size_of(p.list_count.value_or(p.type));
  return bytes;
}

Result<PlyHeader> read_ply_header(Cursor& cursor) {
  PlyHeader header;
  bool has_format = false;
  cursor.next_filled_line();
  if (cursor.word() != "ply") return cursor.line_error("a PLY file begins with 'ply'");
  cursor.next_line();
  while (cursor.next_filled_line()) {
    const std::string_view key = cursor.word();
    Result<void> ok;
    if (key == "end_header") {
      if (!has_format) return cursor.line_error("the header has no line 'format'");
      if (!cursor.at_line_end()) return cursor.line_error("'end_header' stands alone on its line");
      cursor.next_line();
      return header;
    }
    if (key == "format") {
      ok = read_format(cursor, header);
      has_format = true;
    } else if (key == "element") {
      ok = read_element(cursor, header);
    } else if (key == "property") {
      ok = read_property(cursor, header);
    } else if (key == "comment") {
      header.facts.read(cursor.rest_of_line());
    } else if (key != "obj_info") {
      return cursor.line_error(fmt::format("'{}' is no keyword of a PLY header", shown(key)));
    }
    if (!ok) return ok.error();
    cursor.next_line();
  }
  return cursor.line_error("the file ends within the header");
}

}  // namespace burnish
