#pragma once

#include <string>
#include <string_view>

#include "burnish/base/result.h"

namespace burnish {

/// What a number measures. Inside it is always in the SI unit (m, rad, s).
enum class Quantity { number, length, angle, time };

/// Reads "5mm", "0.3 m", "30deg", "1.5": a number without a unit is in the SI unit.
/// Errors: invalid_argument with the text and the units that would do.
Result<double> parse_quantity(std::string_view text, Quantity quantity);

/// "m", "rad", "s"; empty for plain numbers.
std::string_view unit_of(Quantity quantity);

/// The shortest text that parse_quantity reads back as `value`: whole degrees as "25deg", all else
/// as a number in the SI unit.
std::string quantity_text(double value, Quantity quantity);

}  // namespace burnish
