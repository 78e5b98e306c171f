#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/attributes.h"

namespace burnish {

/// Pixels row by row from the top left, sRGB.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<Color> pixels;  ///< width * height

  Image() = default;
  Image(std::uint32_t columns, std::uint32_t rows, Color fill)
      : width(columns), height(rows), pixels(std::size_t{columns} * rows, fill) {}

  Color& at(std::uint32_t column, std::uint32_t row) {
    return pixels[std::size_t{row} * width + column];
  }
  const Color& at(std::uint32_t column, std::uint32_t row) const {
    return pixels[std::size_t{row} * width + column];
  }

  friend bool operator==(const Image&, const Image&) = default;
};

/// Copies `part` into `image` with its first pixel at (column, row); what does not fit is left out.
void paste(Image& image, const Image& part, std::uint32_t column, std::uint32_t row);

}  // namespace burnish
