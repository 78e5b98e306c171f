#pragma once

#include <string_view>

#include "burnish/report/image.h"

namespace burnish {

/// Height in pixels from one line of text to the next, at a letter size of `size` pixels per dot.
inline double line_height(double size) {
  return 12 * size;
}

/// Width of `text` in pixels.
double text_width(std::string_view text, double size);

/// Writes a line of text whose upper left corner is at (column, row): letters of one stroke with
/// round ends, 5 x 7 dots of `size` pixels. Letters are written small; what is not ASCII becomes a
/// question mark. Outside the image nothing is written.
void write_text(Image& image, double column, double row, std::string_view text, const Color& color,
                double size);

}  // namespace burnish
