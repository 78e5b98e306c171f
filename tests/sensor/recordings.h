#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "burnish/io/depth_image.h"
#include "burnish/io/file.h"
#include "burnish/io/png.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/sensor/recording.h"
#include "support/test_data.h"

namespace burnish::test {

/// Depths of a `width` x `height` image that no other image of the same size has.
inline std::vector<std::uint16_t> some_depths(std::uint32_t width, std::uint32_t height,
                                              int image) {
  std::vector<std::uint16_t> depths(std::size_t{width} * height);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    depths[i] = static_cast<std::uint16_t>(i % 17 == 0 ? 0 : 500 + (31 * i + 997 * image) % 3000);
  }
  return depths;
}

/// The bytes of a number as a recording holds them.
template <class T>
std::string raw(T value) {
  std::string bytes(sizeof(T), 0);
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/// The same of many numbers.
inline std::string raw_depths(const std::vector<std::uint16_t>& depths) {
  return {reinterpret_cast<const char*>(depths.data()), 2 * depths.size()};
}

inline std::string bytes_of(const std::filesystem::path& path) {
  const auto file = read_file(path);
  EXPECT_TRUE(file) << path;
  return file ? std::string(file->text()) : std::string();
}

/// Without waiting for the disk, as tests need not.
inline void write_text(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline void write_depth(const std::filesystem::path& path, std::uint32_t width,
                        std::uint32_t height, int image) {
  write_text(path, encode_png(width, height, some_depths(width, height, image)).value());
}

/// The names of all files below a folder, sorted.
inline std::vector<std::string> files_below(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.push_back(std::filesystem::relative(entry.path(), folder).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The numbers in the depth image `i` of an import.
inline std::vector<std::uint16_t> imported_depths(const std::filesystem::path& folder, int i) {
  const std::string number = std::to_string(i);
  const std::string name = "frame-" + std::string(6 - number.size(), '0') + number + ".depth.png";
  const auto image = read_depth_image(folder / name);
  EXPECT_TRUE(image) << name;
  if (!image) return {};
  return {image->values.begin(), image->values.end()};
}

/// Expects that an import fails in the way given and leaves nothing in the place of its output.
inline void expect_refused(const std::filesystem::path& recording, ErrorCode code,
                           const std::string& place, const std::string& reason,
                           const ImportParams& params = {}) {
  const TemporaryFolder out;
  const auto report = import_recording(recording, out / "frames", params);
  ASSERT_FALSE(report) << reason;
  EXPECT_EQ(report.error().code, code) << report.error().text();
  EXPECT_NE(report.error().where.find(place), std::string::npos) << report.error().text();
  EXPECT_NE(report.error().message.find(reason), std::string::npos) << report.error().text();
  EXPECT_FALSE(std::filesystem::exists(out / "frames"));
}

}  // namespace burnish::test
