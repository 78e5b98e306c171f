#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/result.h"

namespace burnish {

/// A depth image as its file holds it: no unit, no meaning of single values yet.
struct DepthImage {
  std::uint32_t width = 0, height = 0;
  std::vector<float> values;  ///< width * height, row by row from the top left; may hold NaN
  std::string type;           ///< "16-bit PNG", "PGM", "16-bit TIFF" or "float TIFF"
  bool integer = true;        ///< whole numbers 0 to 65535, which a float holds exactly
};

/// More pixels than this no depth camera has; larger images are refused before memory is taken.
inline constexpr std::size_t kMaxDepthPixels = std::size_t{1} << 23;

/// Reads a 16-bit grey PNG, a PGM (binary or plain, maxval above 255) or a TIFF with one channel of
/// 16-bit unsigned or 32-bit float values, told apart by their first bytes. 8-bit images are
/// refused: they are pictures of depth, not depth. Errors: not_found, io_failure, bad_file for
/// anything damaged, unsupported; they name the file.
Result<DepthImage> read_depth_image(const std::filesystem::path& path);

/// The same from bytes; errors name no file.
Result<DepthImage> decode_depth_image(std::span<const std::byte> bytes);

/// Writes a 16-bit grey PNG; the file appears whole or not at all.
/// Errors: invalid_argument where values.size() is not width * height, io_failure.
Result<void> write_depth_png(const std::filesystem::path& path, std::uint32_t width,
                             std::uint32_t height, std::span<const std::uint16_t> values);

/// The same as an uncompressed TIFF of 32-bit floats, which keeps every bit.
Result<void> write_depth_tiff(const std::filesystem::path& path, std::uint32_t width,
                              std::uint32_t height, std::span<const float> values);

}  // namespace burnish
