#include "burnish/sensor/color_image.h"

#include <fmt/format.h>

#include <vector>

#include "burnish/io/cursor.h"
#include "burnish/io/file.h"
#include "burnish/io/png.h"

namespace burnish {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kMaxPixels = std::size_t{1} << 26;

/// `P6 width height 255` over any white space and comments, one white space, three bytes a pixel.
Result<ColorImage> color_from_ppm(std::string_view bytes, const std::string& name) {
  Cursor cursor(bytes, name, {.blanks = " \t\v\f", .comment = '#'});
  cursor.word();
  std::size_t header[3] = {};  // width, height, largest value
  for (std::size_t& value : header) {
    if (!cursor.next_filled_line() || !cursor.number(value)) {
      return cursor.line_error("damaged PPM: width, height and largest value are expected");
    }
  }
  cursor.take(1);
  const auto [width, height, largest] = header;
  if (largest != 255 || width == 0 || height == 0 || width > kMaxPixels || height > kMaxPixels ||
      width * height > kMaxPixels || cursor.remaining() != 3 * width * height) {
    return cursor.byte_error(
        fmt::format("damaged PPM: it claims {} x {} pixels up to {}, {} bytes of pixels are there",
                    width, height, largest, cursor.remaining()));
  }
  const std::size_t size = cursor.remaining();
  return color_from_rgb(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                        {cursor.take(size), size});
}

}  // namespace

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8\xff"sv);
}

Result<ColorImage> color_from_rgb(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::byte> rgb) {
  std::vector<Color> pixels(rgb.size() / 3);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      pixels[i][c] = std::to_integer<std::uint8_t>(rgb[3 * i + c]);
    }
    pixels[i][3] = 255;
  }
  auto png = encode_png(width, height, pixels);
  if (!png) return png.error();
  return ColorImage{*std::move(png), ".png"};
}

Result<ColorImage> read_color_image(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  const std::string_view bytes = file->text();
  if (bytes.starts_with("\x89PNG"sv)) return ColorImage{std::string(bytes), ".png"};
  if (is_jpeg(bytes)) return ColorImage{std::string(bytes), ".jpg"};
  if (bytes.starts_with("P6"sv)) return color_from_ppm(bytes, path.string());
  return Error{ErrorCode::unsupported, "the colour image is neither PNG nor JPEG nor binary PPM",
               path.string()};
}

}  // namespace burnish
