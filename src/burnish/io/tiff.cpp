#include "burnish/io/tiff.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

namespace burnish {
namespace {

constexpr tmsize_t kMaxAllocation = tmsize_t{64} << 20;

/// Bytes in memory as the file that libtiff reads, and the first thing that it complained of.
struct Source {
  std::span<const std::byte> bytes;
  std::size_t position = 0;
  char message[200] = "";

  static Source& of(void* handle) { return *static_cast<Source*>(handle); }
};

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
  Source& source = Source::of(handle);
  const std::size_t left = source.bytes.size() - std::min(source.position, source.bytes.size());
  const std::size_t taken = std::min(left, static_cast<std::size_t>(count));
  if (taken > 0) std::memcpy(to, source.bytes.data() + source.position, taken);
  source.position += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t refuse_to_write(thandle_t, void*, tmsize_t) {
  return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = Source::of(handle);
  const toff_t base = whence == SEEK_SET   ? 0
                      : whence == SEEK_CUR ? source.position
                                           : source.bytes.size();
  return source.position = base + offset;
}

int close(thandle_t) {
  return 0;
}

toff_t size(thandle_t handle) {
  return Source::of(handle).bytes.size();
}

int keep_first_error(TIFF*, void* source, const char*, const char* format, va_list arguments) {
  char(&message)[200] = Source::of(source).message;
  if (message[0] == '\0') std::vsnprintf(message, sizeof message, format, arguments);
  return 1;  // handled: libtiff's own handler, which prints, is not called
}

int ignore_warning(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  if (!options) return {nullptr, &TIFFClose};
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxAllocation);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_first_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
  return {TIFFClientOpenExt("image", "rm", &source, read_bytes, refuse_to_write, seek, close, size,
                            nullptr, nullptr, options.get()),
          &TIFFClose};
}

Error damaged(const Source& source) {
  return {ErrorCode::bad_file,
          fmt::format("damaged TIFF: {}", source.message[0] ? source.message : "it cannot be read"),
          {}};
}

Error unsupported(std::string message) {
  return {ErrorCode::unsupported, std::move(message), {}};
}

struct Layout {
  std::uint32_t width = 0, height = 0;
  bool floating = false;
};

Result<Layout> layout_of(TIFF* tiff, const Source& source) {
  Layout layout;
  std::uint16_t channels = 1, bits = 1, orientation = ORIENTATION_TOPLEFT;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  if (!TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width) ||
      !TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height)) {
    return damaged(source);
  }
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  layout.floating = format == SAMPLEFORMAT_IEEEFP;
  const bool depth = channels == 1 && ((format == SAMPLEFORMAT_UINT && bits == 16) ||
                                       (layout.floating && bits == 32));
  if (!depth) {
    return unsupported(fmt::format(
        "the TIFF holds {} channel(s) of {} bits, a depth image holds one of 16-bit unsigned or "
        "32-bit float values",
        channels, bits));
  }
  if (TIFFIsTiled(tiff)) return unsupported("the TIFF is stored in tiles, strips are expected");
  if (orientation != ORIENTATION_TOPLEFT) {
    return unsupported(fmt::format("the TIFF has orientation {}, 1 is expected", orientation));
  }
  if (layout.width == 0 || std::size_t{layout.width} * layout.height > kMaxDepthPixels) {
    return Error{ErrorCode::bad_file,
                 fmt::format("the header claims {} x {} pixels, more than a depth image can hold",
                             layout.width, layout.height),
                 {}};
  }
  return layout;
}

}  // namespace

Result<DepthImage> decode_tiff(std::span<const std::byte> bytes) {
  Source source;
  source.bytes = bytes;
  const Tiff tiff = open(source);
  if (!tiff) return damaged(source);
  const auto layout = layout_of(tiff.get(), source);
  if (!layout) return layout.error();

  const std::size_t value_bytes = layout->floating ? sizeof(float) : sizeof(std::uint16_t);
  std::vector<std::byte> row(layout->width * value_bytes);
  if (TIFFScanlineSize64(tiff.get()) != row.size()) return damaged(source);
  DepthImage image{layout->width,
                   layout->height,
                   {},
                   layout->floating ? "float TIFF" : "16-bit TIFF",
                   !layout->floating};
  image.values.resize(std::size_t{layout->width} * layout->height);
  for (std::uint32_t y = 0; y < layout->height; ++y) {
    if (TIFFReadScanline(tiff.get(), row.data(), y) != 1) return damaged(source);
    float* values = image.values.data() + std::size_t{y} * layout->width;
    for (std::size_t x = 0; x < layout->width; ++x) {
      std::uint16_t whole;
      if (layout->floating) {
        std::memcpy(values + x, row.data() + x * sizeof(float), sizeof(float));
      } else {
        std::memcpy(&whole, row.data() + x * sizeof whole, sizeof whole);
        values[x] = whole;
      }
    }
  }
  return image;
}

Result<std::string> encode_tiff(std::uint32_t width, std::uint32_t height,
                                std::span<const float> values) {
  if (values.empty() || values.size() > kMaxDepthPixels ||
      values.size() != std::size_t{width} * height) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} values for an image of {} x {}", values.size(), width, height),
                 {}};
  }
  std::string bytes;
  const auto put = [&bytes](std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
  };
  // Tag, type (3: 16 bits, 4: 32 bits), value; in rising order of tags, as the format asks.
  const auto pixel_bytes = static_cast<std::uint32_t>(values.size_bytes());
  const std::array<std::array<std::uint32_t, 3>, 10> entries{
      {{TIFFTAG_IMAGEWIDTH, 4, width},
       {TIFFTAG_IMAGELENGTH, 4, height},
       {TIFFTAG_BITSPERSAMPLE, 3, 32},
       {TIFFTAG_COMPRESSION, 3, COMPRESSION_NONE},
       {TIFFTAG_PHOTOMETRIC, 3, PHOTOMETRIC_MINISBLACK},
       {TIFFTAG_STRIPOFFSETS, 4, 8},
       {TIFFTAG_SAMPLESPERPIXEL, 3, 1},
       {TIFFTAG_ROWSPERSTRIP, 4, height},
       {TIFFTAG_STRIPBYTECOUNTS, 4, pixel_bytes},
       {TIFFTAG_SAMPLEFORMAT, 3, SAMPLEFORMAT_IEEEFP}}};
  bytes.reserve(8 + pixel_bytes + 2 + 12 * entries.size() + 4);
  bytes += "II";
  put(42, 2);
  put(8 + pixel_bytes, 4);
  for (const float value : values) put(std::bit_cast<std::uint32_t>(value), 4);
  put(entries.size(), 2);
  for (const auto& [tag, type, value] : entries) {
    put(tag, 2);
    put(type, 2);
    put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  return bytes;
}

}  // namespace burnish
