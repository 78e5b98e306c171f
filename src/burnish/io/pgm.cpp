#include "burnish/io/pgm.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace burnish {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Takes whole numbers off the front of a text, over white space and comments.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : rest_(text) {}

  std::optional<std::uint32_t> next() {
    skip_to_number();
    std::uint32_t value = 0;
    const auto [end, status] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (status != std::errc{}) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  /// What comes after the number read last.
  std::string_view rest() const { return rest_; }

 private:
  void skip_to_number() {
    while (!rest_.empty() && (is_space(rest_[0]) || rest_[0] == '#')) {
      const std::size_t line_end = rest_.find_first_of("\r\n");
      rest_.remove_prefix(rest_[0] != '#' ? 1 : std::min(line_end, rest_.size()));
    }
  }

  std::string_view rest_;
};

Error damaged(std::string message) {
  return {ErrorCode::bad_file, "damaged PGM: " + std::move(message), {}};
}

Result<void> read_plain(Numbers& numbers, std::uint32_t maxval, std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = numbers.next();
    if (!value) return damaged(fmt::format("{} values of {} are there", i, values.size()));
    if (*value > maxval) {
      return damaged(fmt::format("value {} of pixel {} is above maxval {}", *value, i, maxval));
    }
    values[i] = static_cast<float>(*value);
  }
  return {};
}

Result<void> read_binary(std::string_view pixels, std::uint32_t maxval,
                         std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto high = static_cast<std::uint8_t>(pixels[2 * i]);
    const auto low = static_cast<std::uint8_t>(pixels[2 * i + 1]);
    const std::uint32_t value = 256u * high + low;
    if (value > maxval) {
      return damaged(fmt::format("value {} of pixel {} is above maxval {}", value, i, maxval));
    }
    values[i] = static_cast<float>(value);
  }
  return {};
}

}  // namespace

Result<DepthImage> decode_pgm(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool binary = text.starts_with("P5");
  if (!binary && !text.starts_with("P2")) return damaged("it begins with neither P2 nor P5");

  Numbers numbers(text.substr(2));
  const auto width = numbers.next();
  const auto height = numbers.next();
  const auto maxval = numbers.next();
  if (!width || !height || !maxval) return damaged("width, height and maxval are not all there");
  if (*width == 0 || *height == 0) return damaged("it has no pixels");
  if (*maxval == 0 || *maxval > 65535) return damaged(fmt::format("maxval is {}", *maxval));
  if (*maxval <= 255) {
    return Error{
        ErrorCode::unsupported,
        fmt::format("the PGM holds 8-bit values (maxval {}), a depth image holds 16-bit ones",
                    *maxval),
        {}};
  }

  // One white space ends the header. Then two bytes a pixel; in text a digit and a separator, which
  // the last may lack.
  const std::string_view pixels = numbers.rest().substr(numbers.rest().empty() ? 0 : 1);
  const std::size_t count = std::size_t{*width} * *height;
  if (count > kMaxDepthPixels || count > (pixels.size() + (binary ? 0 : 1)) / 2) {
    return damaged(fmt::format("the header claims {} x {} pixels, {} bytes are there", *width,
                               *height, pixels.size()));
  }
  DepthImage image{*width, *height, std::vector<float>(count), "PGM", true};
  const auto read = binary ? read_binary(pixels, *maxval, image.values)
                           : read_plain(numbers, *maxval, image.values);
  if (!read) return read.error();
  return image;
}

}  // namespace burnish
