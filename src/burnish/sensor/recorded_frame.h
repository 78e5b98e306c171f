#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "burnish/base/rigid.h"

namespace burnish {

/// A colour image as the bytes of a file.
struct ColorImage {
  std::string bytes;             ///< empty: there is none
  std::string ending;            ///< ".png" or ".jpg"
  std::optional<double> time{};  ///< s
};

/// One frame as a depth camera or a recording gives it.
struct RecordedFrame {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> depth;  ///< width * height, row by row, in the camera's unit; 0 = none
  std::string png{};                 ///< the same as a 16-bit PNG, where it comes as one
  std::optional<double> time{};      ///< s
  std::optional<RigidTransform> T_world_camera{};
  ColorImage color{};
};

}  // namespace burnish
