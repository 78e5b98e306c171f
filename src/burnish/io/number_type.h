#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "burnish/io/cursor.h"

namespace burnish {

/// The types of numbers in PLY and PCD files.
enum class NumberType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// Calls `use(T{})` with a value of the C++ type that `type` means.
template <class Use>
decltype(auto) with_type(NumberType type, Use use) {
  switch (type) {
    case NumberType::int8:
      return use(std::int8_t{});
    case NumberType::uint8:
      return use(std::uint8_t{});
    case NumberType::int16:
      return use(std::int16_t{});
    case NumberType::uint16:
      return use(std::uint16_t{});
    case NumberType::int32:
      return use(std::int32_t{});
    case NumberType::uint32:
      return use(std::uint32_t{});
    case NumberType::int64:
      return use(std::int64_t{});
    case NumberType::uint64:
      return use(std::uint64_t{});
    case NumberType::float32:
      return use(float{});
    case NumberType::float64:
      break;
  }
  return use(double{});
}

template <class T>
constexpr NumberType number_type_of() {
  if constexpr (std::is_same_v<T, std::int8_t>) return NumberType::int8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NumberType::uint8;
  if constexpr (std::is_same_v<T, std::int16_t>) return NumberType::int16;
  if constexpr (std::is_same_v<T, std::uint16_t>) return NumberType::uint16;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberType::int32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return NumberType::uint32;
  if constexpr (std::is_same_v<T, float>) return NumberType::float32;
  return NumberType::float64;
}

inline std::size_t size_of(NumberType type) {
  return with_type(type, [](auto zero) { return sizeof(zero); });
}

inline bool is_floating(NumberType type) {
  return type == NumberType::float32 || type == NumberType::float64;
}

/// A number at an address of any alignment.
template <class T>
T load(const std::byte* bytes, bool swap) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return swap ? byte_swapped(value) : value;
}

/// Reads the next word of the cursor's line as a number of `type` and puts it at `out`.
inline bool parse_number(Cursor& cursor, NumberType type, std::byte* out) {
  return with_type(type, [&](auto value) {
    if (!cursor.number(value)) return false;
    std::memcpy(out, &value, sizeof(value));
    return true;
  });
}

}  // namespace burnish
