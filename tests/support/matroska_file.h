#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace burnish::test {

/// The `bytes` lowest bytes of a number, the highest first.
inline std::string big_endian(std::uint64_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = bytes; i > 0; --i) text += static_cast<char>(value >> 8 * (i - 1));
  return text;
}

/// An element of a Matroska file: its identifier as it is written, its size in eight bytes, and
/// what it holds.
inline std::string element(std::uint32_t id, std::string_view body) {
  const std::size_t length = id > 0xffffff ? 4 : id > 0xffff ? 3 : id > 0xff ? 2 : 1;
  return big_endian(id, length) + '\x01' + big_endian(body.size(), 7) + std::string(body);
}

inline std::string number_element(std::uint32_t id, std::uint64_t value) {
  return element(id, big_endian(value, 8));
}

/// A video track whose codec is a FOURCC in a BITMAPINFOHEADER.
inline std::string track_entry(std::uint64_t number, std::string_view name, std::string_view fourcc,
                               std::uint64_t width, std::uint64_t height) {
  const std::string header = std::string(16, '\0') + std::string(fourcc) + std::string(20, '\0');
  return element(
      0xAE, number_element(0xD7, number) + number_element(0x73C5, 1000 + number) +
                number_element(0x83, 1) + element(0x536E, name) + element(0x86, "V_MS/VFW/FOURCC") +
                element(0x63A2, header) +
                element(0xE0, number_element(0xB0, width) + number_element(0xBA, height)));
}

inline std::string attached_file(std::string_view name, std::string_view data) {
  return element(0x1941A469,
                 element(0x61A7, element(0x466E, name) + element(0x4660, "application/json") +
                                     number_element(0x46AE, 1) + element(0x465C, data)));
}

inline std::string tag(std::string_view name, std::string_view text) {
  return element(0x1254C367,
                 element(0x7373, element(0x63C0, "") + element(0x67C8, element(0x45A3, name) +
                                                                           element(0x4487, text))));
}

/// An image, `time` units after its cluster; a group holds it as newer writers do.
inline std::string block(int track, std::int16_t time, std::string_view image, bool group = false,
                         int flags = 0) {
  const std::string body = big_endian(0x80u | static_cast<unsigned>(track), 1) +
                           big_endian(static_cast<std::uint16_t>(time), 2) +
                           big_endian(static_cast<unsigned>(flags), 1) + std::string(image);
  return group ? element(0xA0, element(0xA1, body)) : element(0xA3, body);
}

inline std::string cluster(std::uint64_t time, std::string_view blocks) {
  return element(0x1F43B675, number_element(0xE7, time) + std::string(blocks));
}

/// A whole file with times in units of 1 ms.
inline std::string matroska_file(std::string_view segment) {
  return element(0x1A45DFA3, element(0x4282, "matroska")) +
         element(0x18538067,
                 element(0x1549A966, number_element(0x2AD7B1, 1000000)) + std::string(segment));
}

}  // namespace burnish::test
