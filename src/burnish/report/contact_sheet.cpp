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

/// The colours of a scale with its ends written beside them, from (column, row) on.
void write_scale(Image& picture, double column, double row, const ColorScale& scale, double size) {
  const std::string low = limit_text(scale, scale.low), high = limit_text(scale, scale.high);
  write_text(picture, column, row, low, kSoft, size);
  const double begin = column + text_width(low, size) + 3 * size;
  Image bar(picture.width / 5, static_cast<std::uint32_t>(7 * size), kPaper);
  for (std::uint32_t x = 0; x < bar.width; ++x) {
    for (std::uint32_t y = 0; y < bar.height; ++y) bar.at(x, y) = color_of((x + 0.5) / bar.width);
  }
  paste(picture, bar, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(row));
  write_text(picture, begin + bar.width + 4 * size, row, high, kSoft, size);
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
      if (c == 0 && !picture.pixels.empty()) {
        write_text(picture, 8 * size, 8 * size, plate.name, kSoft, size);
        if (plate.scale) {
          const double after = 16 * size + text_width(plate.name, size);
          write_scale(picture, after, 8 * size, *plate.scale, size);
        }
      }
      paste(sheet, picture, c * (width + kGap), head + r * (height + kGap));
    }
  }
  return sheet;
}

}  // namespace burnish
