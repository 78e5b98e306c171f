#include "burnish/report/image.h"

#include <algorithm>

namespace burnish {

void paste(Image& image, const Image& part, std::uint32_t column, std::uint32_t row) {
  if (column >= image.width || row >= image.height) return;
  const std::uint32_t columns = std::min(part.width, image.width - column);
  const std::uint32_t rows = std::min(part.height, image.height - row);
  for (std::uint32_t y = 0; y < rows; ++y) {
    std::copy_n(&part.at(0, y), columns, &image.at(column, row + y));
  }
}

}  // namespace burnish
