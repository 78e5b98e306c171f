#include <algorithm>

#include "burnish/report/lettering.h"
#include "burnish/report/numbers.h"
#include "burnish/report/picture.h"
#include "burnish/report/plates.h"
#include "burnish/report/shade.h"

namespace burnish {
namespace {

constexpr std::uint32_t kGap = 6;
constexpr Color kInk{34, 38, 44, 255}, kSoft{90, 98, 109, 255}, kPaper{251, 250, 248, 255};

/// The plate's name and, where it has one, its scale, at the upper left of a picture on a ground of
/// their own.
void write_label(Image& picture, const Plate& plate, double size) {
  const auto pixels = [](double length) { return static_cast<std::uint32_t>(length); };
  const double pad = 4 * size, name = text_width(plate.name, size);
  const std::string low = plate.scale ? limit_text(*plate.scale, plate.scale->low) : "";
  const std::string high = plate.scale ? limit_text(*plate.scale, plate.scale->high) : "";
  Image bar(plate.scale ? picture.width / 5 : 0, pixels(7 * size), kPaper);
  for (std::uint32_t x = 0; x < bar.width; ++x) {
    for (std::uint32_t y = 0; y < bar.height; ++y) bar.at(x, y) = color_of((x + 0.5) / bar.width);
  }
  const double scale = pad + text_width(low, size) + bar.width + 2 * pad + text_width(high, size);
  const double width = 2 * pad + name + (plate.scale ? scale : 0);
  paste(picture, Image(pixels(width), pixels(9 * size + 2 * pad), kPaper), 0, 0);
  write_text(picture, pad, pad, plate.name, kSoft, size);
  if (!plate.scale) return;
  double column = 2 * pad + name;
  write_text(picture, column, pad, low, kSoft, size);
  column += text_width(low, size) + pad;
  paste(picture, bar, pixels(column), pixels(pad));
  write_text(picture, column + bar.width + pad, pad, high, kSoft, size);
}

}  // namespace

Image contact_sheet(const Record& record, const Plates& plates) {
  if (plates.plates.empty()) return Image(1, 1, kPaper);
  std::uint32_t width = 0, height = 0;
  for (const Plate& plate : plates.plates) {
    for (const Image& picture : plate.pictures) {
      width = std::max(width, picture.width), height = std::max(height, picture.height);
    }
  }
  const double size = std::max(1.0, width / 320.0);
  const auto head = static_cast<std::uint32_t>(line_height(size) * 1.4);
  const auto columns = static_cast<std::uint32_t>(plates.phases.size());
  const auto rows = static_cast<std::uint32_t>(plates.plates.size());
  Image sheet(columns * (width + kGap) - kGap, head + rows * (height + kGap) - kGap, kPaper);
  for (std::uint32_t c = 0; c < columns; ++c) {
    const std::string& name = record.phases[plates.phases[c]].name;
    write_text(sheet, c * (width + kGap) + 4 * size, 4 * size, name, kInk, size);
    for (std::uint32_t r = 0; r < rows; ++r) {
      const Plate& plate = plates.plates[r];
      Image picture = plate.pictures[c];
      if (c == 0 && !picture.pixels.empty()) write_label(picture, plate, size);
      paste(sheet, picture, c * (width + kGap), head + r * (height + kGap));
    }
  }
  return sheet;
}

}  // namespace burnish
