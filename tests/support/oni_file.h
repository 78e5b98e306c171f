#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace burnish::test {

/// The bytes of a number, the lowest first.
template <class T>
std::string oni_number(T value) {
  std::string bytes(sizeof(T), 0);
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/// Packs values as 16z, or with a table as 16zT: pairs of small differences, runs of pairs, wide
/// differences and whole values.
inline std::string packed_16z(std::vector<std::uint16_t> values, bool with_table) {
  std::string packed;
  if (with_table) {
    std::vector<std::uint16_t> table = values;
    std::sort(table.begin(), table.end());
    table.erase(std::unique(table.begin(), table.end()), table.end());
    packed += oni_number(static_cast<std::uint16_t>(table.size()));
    for (const std::uint16_t value : table) packed += oni_number(value);
    for (std::uint16_t& value : values) {
      const auto place = std::lower_bound(table.begin(), table.end(), value) - table.begin();
      value = static_cast<std::uint16_t>(place);
    }
  }
  packed += oni_number(values.front());
  int runs = 0, half = -1;  // pairs of equal values; the first difference of a pair
  const auto flush_runs = [&] {
    if (runs > 0) packed += static_cast<char>(0xE0 + runs);
    runs = 0;
  };
  for (std::size_t i = 1; i < values.size(); ++i) {
    const int step = int{values[i - 1]} - int{values[i]};
    if (std::abs(step) <= 6 && half < 0) {
      half = step + 6;
    } else if (std::abs(step) <= 6) {
      if (half == 6 && step == 0) {
        if (++runs == 15) flush_runs();
      } else {
        flush_runs();
        packed += static_cast<char>(half << 4 | (step + 6));
      }
      half = -1;
    } else {
      flush_runs();
      packed += static_cast<char>(half < 0 ? 0xFF : half << 4 | 0xF);
      half = -1;
      if (std::abs(step) <= 63) {
        packed += static_cast<char>(step + 192);
      } else {
        packed += static_cast<char>(values[i] >> 8);
        packed += static_cast<char>(values[i]);
      }
    }
  }
  flush_runs();
  if (half >= 0) packed += static_cast<char>(half << 4 | 0xD);
  return packed;
}

inline std::string oni_text(std::string_view text) {
  return oni_number(static_cast<std::uint32_t>(text.size() + 1)) + std::string(text) + '\0';
}

inline std::string oni_record(std::uint32_t type, std::uint32_t node, std::string_view fields,
                              std::string_view payload = {}) {
  return std::string("NIR\0", 4) + oni_number(type) + oni_number(node) +
         oni_number(static_cast<std::uint32_t>(28 + fields.size())) +
         oni_number(static_cast<std::uint32_t>(payload.size())) + oni_number(std::uint64_t{0}) +
         std::string(fields) + std::string(payload);
}

inline std::string oni_property(std::uint32_t node, std::string_view name, std::string_view data,
                                bool whole = false) {
  return oni_record(
      whole ? 0x03 : 0x06, node,
      oni_text(name) + oni_number(static_cast<std::uint32_t>(data.size())) + std::string(data));
}

/// A node (2: depth, 3: image) with the properties without which OpenNI2 plays nothing.
inline std::string oni_node(std::uint32_t node, std::uint32_t type, std::string_view codec,
                            std::uint32_t frames, std::uint32_t width, std::uint32_t height,
                            std::uint64_t pixel_format) {
  const std::string mode = oni_number(width) + oni_number(height) + oni_number(std::uint32_t{30});
  const std::uint64_t bytes = std::uint64_t{width} * height * 3;
  return oni_record(0x0D, node,
                    oni_text(type == 2 ? "Depth" : "Image") + oni_number(type) +
                        std::string(codec) + oni_number(frames) + oni_number(std::uint64_t{0}) +
                        oni_number(std::uint64_t{1000000}) + oni_number(std::uint64_t{0})) +
         oni_property(node, "oniRequiredFrameSize", oni_number(bytes), true) +
         oni_property(node, "xnIsGenerating", oni_number(std::uint64_t{1}), true) +
         oni_property(node, "xnDeviceMaxDepth", oni_number(std::uint64_t{10000}), true) +
         oni_property(node, "xnSupportedMapOutputModesCount", oni_number(std::uint64_t{1}), true) +
         oni_property(node, "xnSupportedMapOutputModes", mode) +
         oni_property(node, "xnMapOutputMode", mode) +
         oni_property(node, "oniPixelFormat", oni_number(pixel_format), true) +
         oni_property(node, "xnFOV",
                      oni_number(1.0144686707507438) + oni_number(0.78980943449644714)) +
         oni_property(node, "xnCropping", std::string(12, '\0'));
}

/// What says that the properties are all there.
inline std::string oni_ready(std::uint32_t node) {
  return oni_record(0x09, node, {});
}

/// Where the properties of node 1 end and images begin.
inline std::string oni_data_begin(std::uint32_t frames) {
  return oni_record(0x08, 1, oni_number(frames) + oni_number(std::uint64_t{1000000}));
}

inline std::string oni_data(std::uint32_t node, std::uint64_t microseconds, std::uint32_t frame,
                            std::string_view packed) {
  return oni_record(0x0A, node, oni_number(microseconds) + oni_number(frame), packed);
}

inline std::string oni_file(std::string_view records) {
  return "NI10" + std::string("\1\0\1\0\0\0\0\0", 8) + oni_number(std::uint64_t{1000000}) +
         oni_number(std::uint32_t{2}) + std::string(records) + oni_record(0x0B, 0, {});
}

}  // namespace burnish::test
