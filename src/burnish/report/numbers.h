#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace burnish {

// Numbers for people: a unit in which they are neither tiny nor huge, three to four digits that
// mean something, narrow spaces between thousands.

/// A unit to show and by what to multiply a value to be in it.
struct DisplayUnit {
  double factor = 1;
  std::string_view name;
};

/// The unit in which a value of `size` in the unit `si` ("m", "m2", "m3", "rad", "s" or none) is
/// read best: 0.0012 m in mm. Angles come in degrees. An unknown unit is kept.
DisplayUnit display_unit(std::string_view si, double size);

/// Rounded to three significant digits, trailing zeros left out; whole numbers in full;
/// "–" for what is not finite.
std::string number_text(double value);

/// Values of one unit side by side: all with the same number of decimals, so that the largest has
/// three significant digits and the smallest at least one; whole numbers in full.
std::vector<std::string> row_texts(const std::vector<double>& values);

/// "69 451" with narrow no-break spaces.
std::string count_text(std::uint64_t count);

/// The value with the unit that suits it: "1.25 mm", "3.4 s", "69 451".
std::string quantity_text(double value, std::string_view si);

/// A key as words: "rms_move" becomes "RMS move".
std::string words_of(std::string_view key);

}  // namespace burnish
