#include "burnish/report/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace burnish {
namespace {

struct NamedUnit {
  double size;   ///< in the SI unit
  double least;  ///< the smallest value, in the SI unit, that is shown in it
  std::string_view name;
};

/// From small to large.
std::span<const NamedUnit> units_of(std::string_view si) {
  static constexpr NamedUnit kLength[] = {
      {1e-6, 0, "µm"}, {1e-3, 1e-4, "mm"}, {1e-2, 1e-2, "cm"}, {1, 1, "m"}};
  static constexpr NamedUnit kArea[] = {{1e-6, 0, "mm²"}, {1e-4, 1e-4, "cm²"}, {1, 0.1, "m²"}};
  static constexpr NamedUnit kVolume[] = {
      {1e-9, 0, "mm³"}, {1e-6, 1e-6, "cm³"}, {1e-3, 1e-3, "l"}, {1, 1, "m³"}};
  static constexpr NamedUnit kTime[] = {
      {1e-3, 0, "ms"}, {1, 0.5, "s"}, {60, 120, "min"}, {3600, 7200, "h"}};
  static constexpr NamedUnit kAngle[] = {{std::numbers::pi / 180, 0, "°"}};
  if (si == "m") return kLength;
  if (si == "m2") return kArea;
  if (si == "m3") return kVolume;
  if (si == "s") return kTime;
  if (si == "rad") return kAngle;
  return {};
}

constexpr std::string_view kThinSpace = "\u202f";

/// Groups of three in the digits before the decimal point; four digits stay together.
std::string grouped(std::string text) {
  const std::size_t begin = text.starts_with('-') ? 1 : 0;
  std::size_t end = text.find_first_not_of("0123456789", begin);
  if (end == std::string::npos) end = text.size();
  if (end - begin > 4) {
    for (std::size_t at = end - 3; at > begin; at -= at - begin < 3 ? at - begin : 3) {
      text.insert(at, kThinSpace);
    }
  }
  if (begin == 1) text.replace(0, 1, "\u2212");
  return text;
}

}  // namespace

DisplayUnit display_unit(std::string_view si, double size) {
  const auto units = units_of(si);
  if (units.empty()) return {1, si};
  const NamedUnit* best = &units.front();
  for (const NamedUnit& unit : units) {
    // A hair below the unit still counts as one of it: 1 mm must not become 1000 µm.
    if (std::abs(size) >= unit.least * (1 - 1e-9)) best = &unit;
  }
  if (size == 0) best = &units[units.size() > 1 ? 1 : 0];
  return {1 / best->size, best->name};
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  if (std::abs(value) < 1e15 && value == std::round(value)) {
    return grouped(fmt::format("{:.0f}", value));
  }
  if (std::abs(value) >= 1e6 || std::abs(value) < 1e-4)
    return grouped(fmt::format("{:.3g}", value));
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  std::string text = fmt::format("{:.{}f}", value, std::max(0, 2 - magnitude));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return grouped(std::move(text));
}

std::vector<std::string> row_texts(const std::vector<double>& values) {
  bool whole = true;
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (!std::isfinite(value) || value == 0) continue;
    whole = whole && value == std::round(value);
    largest = std::max(largest, std::abs(value));
    smallest = std::min(smallest, std::abs(value));
  }
  const auto magnitude = [](double value) {
    return static_cast<int>(std::floor(std::log10(value)));
  };
  const bool one_scale = largest > 0 && largest < 1e6 && smallest > 1e-4;
  std::vector<std::string> texts;
  for (const double value : values) {
    if (whole || !one_scale || !std::isfinite(value)) {
      texts.push_back(number_text(value));
    } else {
      const int decimals = std::max({0, 2 - magnitude(largest), -magnitude(smallest)});
      texts.push_back(value == 0 ? "0" : grouped(fmt::format("{:.{}f}", value, decimals)));
    }
  }
  return texts;
}

std::string count_text(std::uint64_t count) {
  return grouped(fmt::format("{}", count));
}

std::string quantity_text(double value, std::string_view si) {
  const DisplayUnit unit = display_unit(si, value);
  std::string text = number_text(value * unit.factor);
  if (!unit.name.empty()) {
    if (unit.name != "°") text += kThinSpace;
    text += unit.name;
  }
  return text;
}

std::string words_of(std::string_view key) {
  static constexpr std::string_view kAcronyms[] = {"rms", "icp", "id"};
  std::string text;
  while (!key.empty()) {
    const std::size_t end = std::min(key.find('_'), key.size());
    std::string word(key.substr(0, end));
    key.remove_prefix(std::min(end + 1, key.size()));
    bool acronym = false;
    for (const std::string_view known : kAcronyms) acronym = acronym || word == known;
    for (char& c : word) {
      const bool capital = acronym || (text.empty() && &c == word.data());
      if (capital && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

}  // namespace burnish
