#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/io/ply_body.h"

// The two ways in which numbers stand in a PLY body. Both scanners have the same functions, which
// say whether they could; which one a reader uses is decided once an element.
namespace burnish {

/// The numbers of a binary body, one after the other.
struct BinaryScanner {
  Cursor& cursor;
  std::endian order;

  bool begin_row() { return true; }
  bool end_row() { return true; }
  bool scalar(NumberType type, std::byte* out) {
    const std::byte* bytes = cursor.take(size_of(type));
    if (!bytes) return false;
    std::memcpy(out, bytes, size_of(type));
    if (order != std::endian::native) std::reverse(out, out + size_of(type));
    return true;
  }
  bool skip(NumberType type, std::uint64_t count) {
    return count <= cursor.remaining() / size_of(type) && cursor.take(count * size_of(type));
  }
  /// How many numbers of a type the rest of the file can hold at most.
  std::size_t most(NumberType type) const { return cursor.remaining() / size_of(type); }
  Error error(const std::string& what) const {
    return cursor.byte_error(cursor.at_end() ? "the file ends within " + what
                                             : what + " is cut off");
  }
};

/// The numbers of an ascii body, a row per line.
struct TextScanner {
  Cursor& cursor;

  bool begin_row() { return cursor.next_filled_line(); }
  bool end_row() {
    if (!cursor.at_line_end()) return false;
    cursor.next_line();
    return true;
  }
  bool scalar(NumberType type, std::byte* out) { return parse_number(cursor, type, out); }
  bool skip(NumberType type, std::uint64_t count) {
    std::byte ignored[8];
    for (; count > 0; --count) {
      if (!scalar(type, ignored)) return false;
    }
    return true;
  }
  std::size_t most(NumberType) const { return (cursor.remaining() + 1) / 2; }
  Error error(const std::string& what) const {
    if (cursor.at_end()) return cursor.line_error("the file ends within " + what);
    Cursor rest = cursor;
    const std::string word = shown(rest.word());
    if (word.empty()) return cursor.line_error(what + " has too few numbers");
    return cursor.line_error("'" + word + "' in " + what +
                             " is one number too many or none of its type");
  }
};

/// Calls `use(scanner)` with the one that the body needs.
template <class Use>
Result<void> with_scanner(PlyBody& body, Use use) {
  return body.header.ascii ? use(TextScanner{body.cursor})
                           : use(BinaryScanner{body.cursor, body.header.order});
}

/// A number of any type that is an integer.
template <class Scanner>
bool read_integer(Scanner& scan, NumberType type, std::int64_t& value) {
  std::byte bytes[8];
  if (!scan.scalar(type, bytes)) return false;
  return with_type(type, [&](auto zero) {
    using T = decltype(zero);
    const T number = load<T>(bytes, false);
    if constexpr (std::is_floating_point_v<T>) {
      if (!(std::abs(number) < static_cast<T>(0x1p53)) || number != std::floor(number))
        return false;
    }
    value = static_cast<std::int64_t>(number);
    return true;
  });
}

/// How many numbers `property` has in this row: one, or what the list's length says.
template <class Scanner>
bool read_length(Scanner& scan, const PlyProperty& property, std::int64_t& length) {
  length = 1;
  return !property.list_count || (read_integer(scan, *property.list_count, length) && length >= 0);
}

/// Goes over a row; `visit(property, length)` is told of each of its properties.
template <class Scanner, class Visit>
bool walk_over_row(Scanner& scan, const PlyElement& element, Visit visit) {
  if (!scan.begin_row()) return false;
  for (const PlyProperty& property : element.properties) {
    std::int64_t length = 0;
    if (!read_length(scan, property, length) ||
        !scan.skip(property.type, static_cast<std::uint64_t>(length))) {
      return false;
    }
    visit(property, length);
  }
  return scan.end_row();
}

}  // namespace burnish
