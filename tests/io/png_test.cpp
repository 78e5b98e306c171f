#include "burnish/io/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include "burnish/base/random.h"

namespace burnish {
namespace {

constexpr std::size_t kMaxPixels = 1 << 20;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::vector<std::uint16_t> noise(std::size_t count) {
  Random random(7);
  std::vector<std::uint16_t> values(count);
  for (auto& value : values) value = static_cast<std::uint16_t>(random.next());
  return values;
}

/// Decodes a picture with libpng's own simple interface.
std::vector<Color> decode_colors(const std::string& encoded) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, encoded.data(), encoded.size()));
  image.format = PNG_FORMAT_RGBA;
  std::vector<Color> pixels(std::size_t{image.width} * image.height);
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
  return pixels;
}

TEST(Png, ColoursComeBackAsTheyWere) {
  std::vector<Color> pixels;
  for (std::uint8_t i = 0; i < 15; ++i) {
    pixels.push_back({i, std::uint8_t(17 * i), std::uint8_t(255 - i), std::uint8_t(i * 16)});
  }
  const auto encoded = encode_png(5, 3, pixels);
  ASSERT_TRUE(encoded);
  EXPECT_EQ(decode_colors(*encoded), pixels);
}

TEST(Png, SixteenBitValuesComeBackAsTheyWere) {
  const auto values = noise(7 * 5);
  const auto encoded = encode_png(7, 5, values);
  ASSERT_TRUE(encoded);
  const auto image = decode_grey_png(bytes_of(*encoded), kMaxPixels);
  ASSERT_TRUE(image) << image.error().text();
  EXPECT_EQ(image->width, 7u);
  EXPECT_EQ(image->height, 5u);
  EXPECT_EQ(image->values, values);
}

TEST(Png, SizesThatDoNotFitThePixelsAreRefused) {
  const std::vector<Color> pixels(6);
  EXPECT_FALSE(encode_png(2, 2, pixels));
  EXPECT_FALSE(encode_png(0, 0, std::span<const Color>{}));
}

TEST(Png, ColourAndPalettePicturesAreNotDepth) {
  const std::vector<Color> pixels(4);
  const auto encoded = encode_png(2, 2, pixels);
  const auto image = decode_grey_png(bytes_of(*encoded), kMaxPixels);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::unsupported);
  EXPECT_NE(image.error().message.find("colours"), std::string::npos);
}

TEST(Png, EveryTruncationIsAnError) {
  const auto encoded = encode_png(7, 5, noise(7 * 5));
  ASSERT_TRUE(encoded);
  for (std::size_t length = 0; length < encoded->size(); ++length) {
    const auto image = decode_grey_png(bytes_of(*encoded).first(length), kMaxPixels);
    ASSERT_FALSE(image) << length;
    EXPECT_EQ(image.error().code, ErrorCode::bad_file);
  }
}

TEST(Png, EveryDamagedByteIsAnErrorOrAnImageOfThatSize) {
  const auto encoded = encode_png(7, 5, noise(7 * 5));
  ASSERT_TRUE(encoded);
  for (std::size_t i = 0; i < encoded->size(); ++i) {
    for (const int bit : {0, 3, 7}) {
      std::string damaged = *encoded;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      const auto image = decode_grey_png(bytes_of(damaged), kMaxPixels);
      EXPECT_TRUE(!image || image->values.size() == 35);
    }
  }
}

TEST(Png, AClaimOfTwoBillionRowsIsRefusedAtOnce) {
  const auto encoded = encode_png(7, 5, noise(7 * 5));
  ASSERT_TRUE(encoded);
  std::string claim = *encoded;
  // Width, height and the checksum of the IHDR chunk that says so.
  claim.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8));
  std::uint32_t crc = ~0u;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint8_t>(claim[i]);
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  crc = ~crc;
  for (std::size_t i = 0; i < 4; ++i) claim[29 + i] = static_cast<char>(crc >> (24 - 8 * i));
  const auto image = decode_grey_png(bytes_of(claim), ~std::size_t{0});
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("2147483647 x 2147483647"), std::string::npos)
      << image.error().message;
}

}  // namespace
}  // namespace burnish
