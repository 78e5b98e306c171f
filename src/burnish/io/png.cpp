#include "burnish/io/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "burnish/io/atomic_writer.h"

namespace burnish {
namespace {

constexpr std::uint32_t kMaxSide = 65535;
constexpr std::size_t kDeflateRatio = 1032;  ///< no zlib stream expands more than that

/// What libpng's callbacks share with us. libpng leaves by longjmp, past destructors: so the
/// functions that call setjmp own nothing, and all that is owned lives here, above them.
struct Session {
  char message[160] = "";  ///< of the error that ended the session
  std::string written;
  std::span<const std::byte> unread;
};

Session& session(png_voidp pointer) {
  return *static_cast<Session*>(pointer);
}

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  Session& ended = session(png_get_error_ptr(png));
  std::snprintf(ended.message, sizeof ended.message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, std::size_t count) {
  bool full = false;
  try {
    session(png_get_io_ptr(png)).written.append(reinterpret_cast<const char*>(data), count);
  } catch (const std::bad_alloc&) {
    full = true;
  }
  if (full) png_error(png, "out of memory");
}

void flush(png_structp) {}

void take(png_structp png, png_bytep data, std::size_t count) {
  std::span<const std::byte>& unread = session(png_get_io_ptr(png)).unread;
  if (count > unread.size()) png_error(png, "the file ends too early");
  std::memcpy(data, unread.data(), count);
  unread = unread.subspan(count);
}

/// How an image lies in memory.
struct Layout {
  std::uint32_t width, height;
  int color_type, bit_depth;
  const std::byte* rows;
  std::size_t row_bytes;
  bool leave_out_alpha = false;  ///< rows have four bytes a pixel, of which three are written
};

bool encode(png_structp png, png_infop info, Session& to, const Layout& image) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &to, append, flush);
  png_set_IHDR(png, info, image.width, image.height, image.bit_depth, image.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // A third of the time of libpng's own choices; pictures are about as large, depth 15 % larger.
  png_set_compression_level(png, 3);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
  png_write_info(png, info);
  if (image.bit_depth == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  if (image.leave_out_alpha) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    png_write_row(png, reinterpret_cast<png_const_bytep>(image.rows + row * image.row_bytes));
  }
  png_write_end(png, info);
  return true;
}

Result<std::string> encode(const Layout& image, std::size_t elements) {
  const bool sized = image.width > 0 && image.height > 0 && image.width <= kMaxSide &&
                     image.height <= kMaxSide &&
                     elements == std::size_t{image.width} * image.height;
  if (!sized) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} pixels for a picture of {} x {} (sides from 1 to {})", elements,
                             image.width, image.height, kMaxSide),
                 {}};
  }
  Session to;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &to, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool done = info && encode(png, info, to, image);
  png_destroy_write_struct(&png, &info);
  if (done) return std::move(to.written);
  return Error{
      ErrorCode::out_of_memory, std::string("PNG could not be encoded: ") + to.message, {}};
}

/// What a PNG's first chunk says.
struct Header {
  png_uint_32 width = 0, height = 0;
  int bit_depth = 0, color_type = 0;
};

bool read_header(png_structp png, png_infop info, Session& from, Header& header) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &from, take);
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);  // judged below, with our own words
  png_set_chunk_malloc_max(png, 1 << 20);
  png_set_chunk_cache_max(png, 16);
  png_read_info(png, info);
  png_get_IHDR(png, info, &header.width, &header.height, &header.bit_depth, &header.color_type,
               nullptr, nullptr, nullptr);
  return true;
}

bool read_rows(png_structp png, png_infop info, std::uint16_t* values, const Header& header) {
  if (setjmp(png_jmpbuf(png))) return false;
  if (std::endian::native == std::endian::little) png_set_swap(png);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 row = 0; row < header.height; ++row) {
      png_read_row(png, reinterpret_cast<png_bytep>(values + std::size_t{row} * header.width),
                   nullptr);
    }
  }
  png_read_end(png, nullptr);
  return true;
}

std::string_view kind(const Header& header) {
  if (header.color_type == PNG_COLOR_TYPE_PALETTE) return "a palette";
  if (header.color_type != PNG_COLOR_TYPE_GRAY) return "colours";
  return "8-bit or coarser values";
}

Result<void> judge(const Header& header, std::size_t bytes, std::size_t max_pixels) {
  if (header.color_type != PNG_COLOR_TYPE_GRAY || header.bit_depth != 16) {
    return Error{ErrorCode::unsupported,
                 fmt::format("the PNG holds {}, a depth image holds 16-bit grey", kind(header)),
                 {}};
  }
  const std::size_t pixels = std::size_t{header.width} * header.height;
  if (pixels > max_pixels || pixels / kDeflateRatio * 2 > bytes) {
    return Error{
        ErrorCode::bad_file,
        fmt::format("the header claims {} x {} pixels, more than {} bytes or a depth image "
                    "can hold",
                    header.width, header.height, bytes),
        {}};
  }
  return {};
}

/// Owns libpng's two objects.
struct Reader {
  explicit Reader(Session& from)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &from, on_error, on_warning)),
        info(png ? png_create_info_struct(png) : nullptr) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  png_structp png;
  png_infop info;
};

}  // namespace

Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                               std::span<const Color> pixels) {
  const bool opaque =
      std::all_of(pixels.begin(), pixels.end(), [](const Color& c) { return c[3] == 255; });
  return encode({width, height, opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, 8,
                 std::as_bytes(pixels).data(), width * sizeof(Color), opaque},
                pixels.size());
}

Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint16_t> values) {
  return encode({width, height, PNG_COLOR_TYPE_GRAY, 16, std::as_bytes(values).data(),
                 width * sizeof(std::uint16_t)},
                values.size());
}

Result<void> write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                       std::span<const Color> pixels) {
  auto bytes = encode_png(width, height, pixels);
  if (!bytes) return std::move(bytes).error();
  return write_file(path, *bytes);
}

Result<GreyPng> decode_grey_png(std::span<const std::byte> bytes, std::size_t max_pixels) {
  Session from;
  from.unread = bytes;
  const Reader reader(from);
  if (!reader.info) return Error{ErrorCode::out_of_memory, "no memory to read the PNG", {}};
  Header header;
  if (!read_header(reader.png, reader.info, from, header)) {
    return Error{ErrorCode::bad_file, std::string("damaged PNG: ") + from.message, {}};
  }
  if (auto sound = judge(header, bytes.size(), max_pixels); !sound) return sound.error();
  GreyPng image{header.width, header.height, {}};
  image.values.resize(std::size_t{header.width} * header.height);
  if (!read_rows(reader.png, reader.info, image.values.data(), header)) {
    return Error{ErrorCode::bad_file, std::string("damaged PNG: ") + from.message, {}};
  }
  return image;
}

}  // namespace burnish
