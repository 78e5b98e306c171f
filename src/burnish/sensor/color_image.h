#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/sensor/recorded_frame.h"

namespace burnish {

/// The colour image in a file: PNG and JPEG (told by their first bytes) as they are, binary PPM of
/// 8 bits as PNG. Errors: not_found, io_failure; unsupported for other kinds; bad_file for a PPM
/// that is damaged.
Result<ColorImage> read_color_image(const std::filesystem::path& path);

/// width * height pixels of red, green and blue as PNG. Errors: those of encode_png.
Result<ColorImage> color_from_rgb(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::byte> rgb);

/// Whether the bytes begin as a JPEG does.
bool is_jpeg(std::string_view bytes);

}  // namespace burnish
