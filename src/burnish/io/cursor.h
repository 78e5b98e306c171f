#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "burnish/base/error.h"
#include "burnish/io/decimal.h"

namespace burnish {

/// What characters mean in a text format. A line ends with \n, \r\n or \r, and before `comment`.
struct TextStyle {
  std::string_view blanks = " \t\v\f";  ///< separate words on a line
  char comment = 0;                     ///< from here to the end of the line nothing counts
  char continuation = 0;                ///< right before a line's end: the line goes on
};

/// Reads the bytes of a file from front to back and never beyond their end; every reading function
/// says whether it could. Text and binary reads may be mixed. Numbers are what std::from_chars
/// makes of them: the locale has no say. The bytes must outlive the cursor.
class Cursor {
 public:
  Cursor(std::string_view bytes, std::string name, const TextStyle& style = {});

  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  bool at_end() const { return at_ == end_; }
  std::size_t line() const { return line_; }

  /// A place to come back to.
  struct Place {
    const char* at;
    std::size_t line;
  };
  Place place() const { return {at_, line_}; }
  void go_to(const Place& place) { at_ = place.at, line_ = place.line; }

  /// "NAME, line 12: message" and "NAME, byte 345: message".
  Error line_error(std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, std::move(message), name_ + ", line " + std::to_string(line_)};
  }
  Error byte_error(std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, std::move(message), name_ + ", byte " + std::to_string(offset())};
  }

  // Binary.

  /// The next `count` bytes, or null (and no move) where there are fewer.
  const std::byte* take(std::size_t count) {
    if (count > remaining()) return nullptr;
    const auto* bytes = reinterpret_cast<const std::byte*>(at_);
    at_ += count;
    return bytes;
  }

  /// The next number in the byte order given.
  template <class T>
  bool read(T& value, std::endian order = std::endian::little);

  // Text.

  /// Whether no word is left on this line; true at the end of the bytes.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || kind() == Kind::line_end || kind() == Kind::comment;
  }

  /// Goes to the beginning of the next line, or to the end of the bytes.
  void next_line();

  /// Goes to the next line that has a word; false where there is none. Stays on a line that has
  /// one.
  bool next_filled_line() {
    while (at_line_end()) {
      if (at_end()) return false;
      next_line();
    }
    return true;
  }

  /// The next word on this line; empty where there is none.
  std::string_view word();

  /// The rest of this line, without blanks at its ends; comments and continuations are left in.
  std::string_view rest_of_line();

  /// Reads the next word of this line if all of it is a number that T holds: for integers also
  /// "3.0", for floats also "inf" and "nan"; what is too small for a float is 0. Else false, and no
  /// move.
  template <class T>
  bool number(T& value);

  /// The fast way through a line that is nothing but as many unsigned integers as there are
  /// `values`, of at most nine digits each, and goes to the next line. False, and no move, for any
  /// other line, whatever the other functions say to it.
  bool line_of_integers(std::span<std::uint32_t> values);

 private:
  enum class Kind : std::uint8_t { word, blank, line_end, comment, continuation };

  Kind kind() const { return kinds_[static_cast<unsigned char>(*at_)]; }
  bool ends_word(const char* at) const {
    return at == end_ || kinds_[static_cast<unsigned char>(*at)] != Kind::word;
  }
  void skip_blanks() {
    while (at_ != end_ && (kind() == Kind::blank || (kind() == Kind::continuation && join_lines())))
      ++at_;
  }
  void skip_line_end();
  bool join_lines();
  bool rare_number(double& value);

  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
  std::string name_;
  std::array<Kind, 256> kinds_{};
};

/// A word of a file as a message may show it: at most 40 characters, what is not printable as '?'.
std::string shown(std::string_view word);

/// Reverses the bytes of a number.
template <class T>
T byte_swapped(T value) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

template <class T>
bool Cursor::read(T& value, std::endian order) {
  const std::byte* bytes = take(sizeof(T));
  if (!bytes) return false;
  std::memcpy(&value, bytes, sizeof(T));
  if (order != std::endian::native) value = byte_swapped(value);
  return true;
}

template <class T>
bool Cursor::number(T& value) {
  skip_blanks();
  const char* first = at_;
  if constexpr (std::is_floating_point_v<T>) {
    if (const char* stop = read_plain_decimal(first, end_, value); stop && ends_word(stop)) {
      at_ = stop;
      return true;
    }
  }
  if (end_ - at_ > 1 && *at_ == '+' && at_[1] != '-') ++first;
  const auto [stop, status] = std::from_chars(first, end_, value);
  if (status == std::errc{} && ends_word(stop)) {
    at_ = stop;
    return true;
  }
  const char* start = at_;
  double wide = 0;
  if (!rare_number(wide)) return false;
  if constexpr (std::is_integral_v<T>) {
    if (wide == std::floor(wide) && wide >= static_cast<double>(std::numeric_limits<T>::min()) &&
        wide <= static_cast<double>(std::numeric_limits<T>::max()) && std::abs(wide) < 0x1p53) {
      value = static_cast<T>(wide);
      return true;
    }
  } else if (!std::isfinite(wide) ||
             std::abs(wide) <= static_cast<double>(std::numeric_limits<T>::max())) {
    value = static_cast<T>(wide);
    return true;
  }
  at_ = start;
  return false;
}

}  // namespace burnish
