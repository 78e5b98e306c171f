#include "burnish/sensor/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/io/cursor.h"
#include "burnish/io/file.h"

namespace burnish {
namespace {

constexpr TextStyle kStyle{.blanks = " \t,=", .comment = '#'};

bool focused(double fx, double fy) {
  return fx > 0 && fy > 0;
}

Result<CameraFile> read_matrix(Cursor& cursor) {
  std::array<double, 9> m{};
  for (std::size_t i = 0; i < 9; ++i) {
    if (i % 3 == 0) {
      if (!cursor.next_filled_line()) return cursor.line_error("the 3 x 3 matrix ends too early");
    }
    if (!cursor.number(m[i]) || !std::isfinite(m[i])) {
      return cursor.line_error("a row of three numbers is expected");
    }
    if (i % 3 == 2) {
      if (!cursor.at_line_end()) return cursor.line_error("a row of three numbers is expected");
      cursor.next_line();
    }
  }
  const bool intrinsic = m[1] == 0 && m[3] == 0 && m[6] == 0 && m[7] == 0 && m[8] == 1;
  if (!intrinsic || !focused(m[0], m[4])) {
    return cursor.line_error("the matrix is not fx 0 cx / 0 fy cy / 0 0 1 with fx, fy > 0");
  }
  return CameraFile{Camera{0, 0, m[0], m[4], m[2], m[5]}, std::nullopt, {}};
}

/// Keeps what the lines of a camera.txt say until all are read.
struct Keys {
  Camera camera;
  double depth_scale = 0;
  std::string sensor;
  unsigned seen = 0;  ///< of fx, fy, cx, cy

  /// Whether `key` is known and its value could be read.
  bool read(std::string_view key, Cursor& cursor) {
    if (key == "width") return cursor.number(camera.width) && camera.width > 0;
    if (key == "height") return cursor.number(camera.height) && camera.height > 0;
    if (key == "depth_scale") {
      return cursor.number(depth_scale) && depth_scale > 0 && std::isfinite(depth_scale);
    }
    if (key == "sensor") return !(sensor = cursor.word()).empty();
    const std::array<std::pair<std::string_view, double*>, 4> numbers{
        {{"fx", &camera.fx}, {"fy", &camera.fy}, {"cx", &camera.cx}, {"cy", &camera.cy}}};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i].first != key) continue;
      seen |= 1u << i;
      return cursor.number(*numbers[i].second) && std::isfinite(*numbers[i].second);
    }
    return false;
  }
};

Result<CameraFile> read_keys(Cursor& cursor) {
  Keys keys;
  for (; cursor.next_filled_line(); cursor.next_line()) {
    const std::string key(cursor.word());
    if (!keys.read(key, cursor) || !cursor.at_line_end()) {
      return cursor.line_error(
          fmt::format("'{}' is not a key with a sound value (width, height, fx, fy, cx, cy, "
                      "depth_scale, sensor)",
                      key.substr(0, 40)));
    }
  }
  CameraFile file;
  file.sensor = keys.sensor;
  if (keys.depth_scale > 0) file.depth_scale = keys.depth_scale;
  if (keys.seen == 0) return file;
  if (keys.seen != 15 || !focused(keys.camera.fx, keys.camera.fy)) {
    return cursor.line_error("fx > 0, fy > 0, cx and cy are not all there");
  }
  file.camera = keys.camera;
  return file;
}

}  // namespace

Result<CameraFile> read_camera_file(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  Cursor first(file->text(), path.string(), kStyle);
  if (!first.next_filled_line()) return first.line_error("the file is empty");
  double number = 0;
  Cursor cursor(file->text(), path.string(), kStyle);
  return first.number(number) ? read_matrix(cursor) : read_keys(cursor);
}

std::string camera_file_text(const CameraFile& file) {
  std::string text;
  if (file.camera) {
    const Camera& c = *file.camera;
    if (c.width > 0) text += fmt::format("width {}\nheight {}\n", c.width, c.height);
    text += fmt::format("fx {}\nfy {}\ncx {}\ncy {}\n", c.fx, c.fy, c.cx, c.cy);
  }
  if (file.depth_scale)
    text += fmt::format("depth_scale {}  # metres per unit\n", *file.depth_scale);
  if (!file.sensor.empty()) text += fmt::format("sensor {}\n", file.sensor);
  return text;
}

std::string intrinsics_text(const Camera& camera) {
  return fmt::format("{} 0 {}\n0 {} {}\n0 0 1\n", camera.fx, camera.cx, camera.fy, camera.cy);
}

Result<Camera> parse_camera(std::string_view text) {
  Camera camera;
  Cursor cursor(text, "camera", {.blanks = ", "});
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) {
    if (!cursor.number(*value) || !std::isfinite(*value)) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("'{}' is not fx,fy,cx,cy: four numbers in pixels", text),
                   {}};
    }
  }
  if (cursor.at_end() && focused(camera.fx, camera.fy)) return camera;
  return Error{ErrorCode::invalid_argument,
               fmt::format("'{}' is not fx,fy,cx,cy with fx, fy > 0 and nothing behind", text),
               {}};
}

}  // namespace burnish
