#include "burnish/io/depth_image.h"

#include <gtest/gtest.h>
#include <tiffio.h>

#include <cmath>
#include <cstring>

#include "burnish/io/atomic_writer.h"
#include "burnish/io/file.h"
#include "burnish/io/png.h"
#include "support/test_data.h"

namespace burnish {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

/// 4 x 3 values with every byte different somewhere.
const std::vector<std::uint16_t> kValues = {0,   1,    256,   257,  1000, 2000,
                                            640, 4095, 65535, 4660, 255,  40000};
const std::vector<float> kFloats(kValues.begin(), kValues.end());

std::string binary_pgm() {
  std::string text = "P5\n# a comment\n4 3 # another\n65535\n";
  for (const std::uint16_t value : kValues) {
    text += static_cast<char>(value >> 8);
    text += static_cast<char>(value & 255);
  }
  return text;
}

std::string plain_pgm() {
  std::string text = "P2 4 3\r\n65535\n";
  for (const std::uint16_t value : kValues) text += std::to_string(value) + " # c\n";
  return text;
}

/// A TIFF of the given byte order ("wl" or "wb") and value type, with two rows a strip.
template <class T>
std::string tiff(const char* mode, int format, int compression, std::span<const T> values) {
  const test::TemporaryFolder folder;
  const auto path = folder / "image.tiff";
  TIFF* file = TIFFOpen(path.c_str(), mode);
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, 4);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, 3);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, int(8 * sizeof(T)));
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, format);
  TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 2);
  for (std::uint32_t y = 0; y < 3; ++y) {
    std::vector<T> row(values.begin() + 4 * y, values.begin() + 4 * y + 4);
    TIFFWriteScanline(file, row.data(), y);
  }
  TIFFClose(file);
  return std::string(read_file(path)->text());
}

std::string integer_tiff(const char* mode, int compression) {
  return tiff<std::uint16_t>(mode, SAMPLEFORMAT_UINT, compression, kValues);
}

/// The same image in every format that is read.
std::vector<std::string> encodings() {
  return {encode_png(4, 3, kValues).value(),
          binary_pgm(),
          plain_pgm(),
          integer_tiff("wl", COMPRESSION_NONE),
          integer_tiff("wb", COMPRESSION_PACKBITS),
          integer_tiff("wb", COMPRESSION_ADOBE_DEFLATE),
          tiff<float>("wl", SAMPLEFORMAT_IEEEFP, COMPRESSION_NONE, kFloats)};
}

TEST(DepthImage, EveryFormatGivesTheSameValues) {
  for (const std::string& encoded : encodings()) {
    const auto image = decode_depth_image(bytes_of(encoded));
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->width, 4u);
    EXPECT_EQ(image->height, 3u);
    EXPECT_EQ(image->values, kFloats) << image->type;
    EXPECT_EQ(image->integer, image->type != "float TIFF");
  }
}

TEST(DepthImage, EveryTruncationIsAnErrorOrAnImageOfThatSize) {
  for (const std::string& encoded : encodings()) {
    for (std::size_t length = 0; length < encoded.size(); ++length) {
      const auto image = decode_depth_image(bytes_of(encoded).first(length));
      if (!image) {
        // A maxval cut short may say that the values have 8 bits.
        EXPECT_TRUE(image.error().code == ErrorCode::bad_file ||
                    image.error().message.find("8-bit") != std::string::npos)
            << image.error().text();
      } else {
        EXPECT_EQ(image->values.size(), 12u);
      }
    }
  }
}

TEST(DepthImage, ATruncatedBinaryImageIsAlwaysAnError) {
  const std::string pgm = binary_pgm();
  for (std::size_t length = 0; length < pgm.size(); ++length) {
    EXPECT_FALSE(decode_depth_image(bytes_of(pgm).first(length))) << length;
  }
}

TEST(DepthImage, EveryDamagedByteIsAnErrorOrABoundedImage) {
  testing::internal::CaptureStderr();
  for (const std::string& encoded : encodings()) {
    for (std::size_t i = 0; i < encoded.size(); ++i) {
      for (const int flip : {1, 0x80, 0xff}) {
        std::string damaged = encoded;
        damaged[i] = static_cast<char>(damaged[i] ^ flip);
        const auto image = decode_depth_image(bytes_of(damaged));
        EXPECT_TRUE(!image || image->values.size() <= kMaxDepthPixels);
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(DepthImage, ClaimsBeyondTheBytesAreRefused) {
  for (const char* claim : {"P5 2000000000 2000000000 65535\n", "P5 4294967295 4294967295 65535\n",
                            "P2 3000 2000 65535\n1 2 3", "P5 99999999999 1 65535\n"}) {
    const auto image = decode_depth_image(bytes_of(claim));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::bad_file) << image.error().text();
  }
}

TEST(DepthImage, PicturesOfDepthAreRefusedWithTheReason) {
  const std::vector<std::uint8_t> grey(12, 7);
  for (const std::string& encoded :
       {std::string("P5 2 2 255\nabcd"), std::string("P2 2 2 15\n1 2 3 4"),
        tiff<std::uint8_t>("wl", SAMPLEFORMAT_UINT, COMPRESSION_NONE, grey)}) {
    const auto image = decode_depth_image(bytes_of(encoded));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::unsupported);
    EXPECT_NE(image.error().message.find("16-bit"), std::string::npos) << image.error().message;
  }
}

TEST(DepthImage, AValueAboveMaxvalIsRefused) {
  const auto image = decode_depth_image(bytes_of("P2 2 1 1000\n7 1001"));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().message, "damaged PGM: value 1001 of pixel 1 is above maxval 1000");
}

TEST(DepthImage, AWrittenPngIsReadBack) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_depth_png(folder / "a.png", 4, 3, kValues));
  const auto image = read_depth_image(folder / "a.png");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->values, kFloats);
}

TEST(DepthImage, AWrittenTiffKeepsEveryBit) {
  const test::TemporaryFolder folder;
  const std::vector<float> values = {0.f, 1.2345678f, 1e-30f, 4.5f, -1.f, 3.4e38f};
  ASSERT_TRUE(write_depth_tiff(folder / "a.tiff", 3, 2, values));
  const auto image = read_depth_image(folder / "a.tiff");
  ASSERT_TRUE(image) << image.error().text();
  EXPECT_EQ(image->width, 3u);
  EXPECT_EQ(image->values, values);
  EXPECT_FALSE(image->integer);
  EXPECT_FALSE(write_depth_tiff(folder / "b.tiff", 2, 2, values));
}

TEST(DepthImage, ErrorsNameTheFile) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "scan.png", "not an image"));
  const auto image = read_depth_image(folder / "scan.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().where, (folder / "scan.png").string());
  EXPECT_EQ(read_depth_image(folder / "none.png").error().code, ErrorCode::not_found);
}

/// z of an organized binary_compressed PCD whose fields are x y z rgb (4 bytes each), decompressed
/// as liblzf does: a byte below 32 begins that many literals and one, another a copy from before.
std::vector<float> z_of_compressed_pcd(std::string_view text, std::size_t points) {
  const std::string_view marker = "DATA binary_compressed\n";
  text.remove_prefix(text.find(marker) + marker.size());
  std::uint32_t sizes[2];
  std::memcpy(sizes, text.data(), sizeof sizes);
  const auto* in = reinterpret_cast<const std::uint8_t*>(text.data()) + 8;
  const auto* end = in + sizes[0];
  std::vector<std::uint8_t> out;
  out.reserve(sizes[1]);
  while (in < end) {
    const unsigned control = *in++;
    if (control < 32) {
      out.insert(out.end(), in, in + control + 1);
      in += control + 1;
    } else {
      unsigned length = control >> 5;
      if (length == 7) length += *in++;
      std::size_t from = out.size() - ((control & 31) << 8) - *in++ - 1;
      for (unsigned i = 0; i < length + 2; ++i) out.push_back(out[from++]);
    }
  }
  EXPECT_EQ(out.size(), sizes[1]);
  std::vector<float> z(points);
  std::memcpy(z.data(), out.data() + 2 * points * sizeof(float), points * sizeof(float));
  return z;
}

TEST(DepthImage, ARealTiffHoldsTheDepthsOfItsPcd) {
  BURNISH_DATA_OR_SKIP(folder, "depth/kinect_three_encodings");
  const std::string name = "frame_20121214T142255.814212";
  const auto image = read_depth_image(folder / "tiff" / (name + "_depth.tiff"));
  ASSERT_TRUE(image) << image.error().text();
  const auto pcd = read_file(folder / "pcd" / (name + ".pcd"));
  ASSERT_TRUE(pcd);
  const std::vector<float> z = z_of_compressed_pcd(pcd->text(), image->values.size());
  std::size_t measured = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) {
      EXPECT_EQ(image->values[i], 0);
      continue;
    }
    ++measured;
    // Millimetres times 0.001f in single precision, as the recorder computed it.
    ASSERT_EQ(z[i], image->values[i] * 0.001f) << i;
  }
  EXPECT_GT(measured, z.size() / 2);
}

TEST(DepthImage, RealFramesAreReadWhole) {
  BURNISH_DATA_OR_SKIP(depth, "depth");
  for (const char* name : {"kinect_v1_kitchen/frame-000000.depth.png", "primesense/depth.png",
                           "kinect_five_posed/depth/1.pgm"}) {
    const auto image = read_depth_image(depth / name);
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->values.size(), 640u * 480u);
    std::size_t plausible = 0;
    for (const float mm : image->values) plausible += mm > 300 && mm < 10000;
    EXPECT_GT(plausible, 640u * 480u / 4) << name;
  }
}

}  // namespace
}  // namespace burnish
