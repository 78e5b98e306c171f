#include "burnish/base/quantity.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

namespace burnish {
namespace {

struct Unit {
  std::string_view name;
  double factor;
};

std::span<const Unit> units_of(Quantity quantity) {
  static constexpr Unit kLengths[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}};
  static constexpr Unit kAngles[] = {{"rad", 1}, {"deg", std::numbers::pi / 180}};
  static constexpr Unit kTimes[] = {{"s", 1}, {"ms", 0.001}};
  switch (quantity) {
    case Quantity::length:
      return kLengths;
    case Quantity::angle:
      return kAngles;
    case Quantity::time:
      return kTimes;
    case Quantity::number:
      break;
  }
  return {};
}

std::string expected(Quantity quantity) {
  std::string text = "a number";
  for (const Unit& unit : units_of(quantity)) {
    text += fmt::format("{}{}", text.size() == 8 ? " in " : ", ", unit.name);
  }
  return text;
}

}  // namespace

Result<double> parse_quantity(std::string_view text, Quantity quantity) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, status] = std::from_chars(text.data(), end, value);
  std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (status == std::errc{} && std::isfinite(value)) {
    if (unit.empty()) return value;
    for (const Unit& known : units_of(quantity)) {
      // Division by a power of ten rounds once; multiplication by 0.001 would round twice.
      if (unit == known.name)
        return known.factor < 1 && quantity != Quantity::angle
                   ? value / std::round(1 / known.factor)
                   : value * known.factor;
    }
  }
  return Error{
      ErrorCode::invalid_argument, fmt::format("'{}' is not {}", text, expected(quantity)), {}};
}

std::string_view unit_of(Quantity quantity) {
  const auto units = units_of(quantity);
  return units.empty() ? std::string_view{} : units.front().name;
}

std::string quantity_text(double value, Quantity quantity) {
  if (quantity == Quantity::angle && value != 0) {
    const std::string degrees = fmt::format("{:.0f}deg", value * 180 / std::numbers::pi);
    const Result<double> read = parse_quantity(degrees, quantity);
    if (read && *read == value) return degrees;
  }
  return fmt::format("{}", value);
}

}  // namespace burnish
