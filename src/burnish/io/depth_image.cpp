#include "burnish/io/depth_image.h"

#include <fmt/format.h>

#include <string_view>

#include "burnish/io/atomic_writer.h"
#include "burnish/io/file.h"
#include "burnish/io/pgm.h"
#include "burnish/io/png.h"
#include "burnish/io/tiff.h"

namespace burnish {
namespace {

Result<DepthImage> decode_png(std::span<const std::byte> bytes) {
  const auto grey = decode_grey_png(bytes, kMaxDepthPixels);
  if (!grey) return grey.error();
  return DepthImage{
      grey->width, grey->height, {grey->values.begin(), grey->values.end()}, "16-bit PNG", true};
}

}  // namespace

Result<DepthImage> decode_depth_image(std::span<const std::byte> bytes) {
  using namespace std::literals;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG"sv)) return decode_png(bytes);
  if (text.starts_with("P2"sv) || text.starts_with("P5"sv)) return decode_pgm(bytes);
  if (text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv)) return decode_tiff(bytes);
  return Error{ErrorCode::bad_file,
               bytes.empty() ? "the file is empty, a PNG, PGM or TIFF is expected"
                             : "the file begins like no PNG, PGM or TIFF",
               {}};
}

Result<DepthImage> read_depth_image(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto image = decode_depth_image(file->bytes());
  if (!image) image.error().where = path.string();
  return image;
}

Result<void> write_depth_png(const std::filesystem::path& path, std::uint32_t width,
                             std::uint32_t height, std::span<const std::uint16_t> values) {
  const auto bytes = encode_png(width, height, values);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

Result<void> write_depth_tiff(const std::filesystem::path& path, std::uint32_t width,
                              std::uint32_t height, std::span<const float> values) {
  const auto bytes = encode_tiff(width, height, values);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace burnish
