#pragma once

namespace burnish {

/// Reads the decimal at the beginning of [first, last), as std::from_chars does and to the same
/// bit, where that takes one exact division or multiplication: up to 19 digits that make an
/// integer of at most 2^53, and a power of ten from -22 to 22 (Clinger 1990). That is nearly every
/// number in a file, and several times as fast. Gives the place behind the number; null, and
/// `value` as it was, for all other texts, numbers or not.
const char* read_plain_decimal(const char* first, const char* last, double& value);
const char* read_plain_decimal(const char* first, const char* last, float& value);

}  // namespace burnish
