#include "burnish/sensor/recording_pclzf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>

#include "burnish/io/cursor.h"
#include "burnish/io/depth_image.h"
#include "burnish/io/file.h"
#include "burnish/io/lzf.h"
#include "burnish/sensor/color_image.h"
#include "burnish/sensor/frame_layout.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = "PCLZF";
constexpr std::string_view kDepthEnding = "_depth.pclzf";
constexpr std::size_t kLzfRatio = 88;  ///< three bytes of LZF give 264 at most

std::size_t bytes_per_pixel(std::string_view kind) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kKinds{
      {{"depth16", 2}, {"rgb24", 3}, {"yuv422", 2}, {"bayer8", 1}}};
  for (const auto& [name, bytes] : kKinds) {
    if (name == kind) return bytes;
  }
  return 0;
}

/// What stands between <tag> and </tag>; nothing where it does not.
std::string_view element(std::string_view xml, std::string_view tag) {
  const std::string open = fmt::format("<{}>", tag), close = fmt::format("</{}>", tag);
  const std::size_t begin = xml.find(open);
  if (begin == xml.npos) return {};
  xml.remove_prefix(begin + open.size());
  const std::size_t end = xml.find(close);
  return end == xml.npos ? std::string_view() : xml.substr(0, end);
}

/// The camera and the depth scale that the frame's XML tells of its depth images.
Result<CameraFile> read_xml(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  const std::string_view depth = element(file->text(), "depth");
  std::array<double, 5> values{};
  constexpr std::array<std::string_view, 5> kTags{"focal_length_x", "focal_length_y",
                                                  "principal_point_x", "principal_point_y",
                                                  "z_multiplication_factor"};
  for (std::size_t i = 0; i < kTags.size(); ++i) {
    Cursor cursor(element(depth, kTags[i]), path.string());
    if (!cursor.next_filled_line() || !cursor.number(values[i]) || !std::isfinite(values[i]) ||
        cursor.next_filled_line()) {
      return Error{ErrorCode::bad_file,
                   fmt::format("a number <{}> is expected within <depth>", kTags[i]),
                   path.string()};
    }
  }
  const auto [fx, fy, cx, cy, scale] = values;
  if (!(fx > 0 && fy > 0 && scale > 0)) {
    return Error{ErrorCode::bad_file, "focal lengths and z_multiplication_factor must be positive",
                 path.string()};
  }
  return CameraFile{Camera{0, 0, fx, fy, cx, cy}, scale, {}};
}

/// The seconds since 1970 of `...20121214T142255.814212`, taken as UTC; none for other names.
std::optional<double> time_from_name(std::string_view name) {
  name = name.substr(std::min(name.find_last_of('_') + 1, name.size()));
  if (name.size() < 15 || name[8] != 'T') return std::nullopt;
  std::array<int, 5> part{};  // year, month, day, hour, minute
  std::size_t at = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (i == 3) ++at;
    const std::size_t digits = i == 0 ? 4 : 2;
    const char* end = name.data() + at + digits;
    if (std::from_chars(name.data() + at, end, part[i]).ptr != end) return std::nullopt;
    at += digits;
  }
  double seconds = 0;
  const char* end = name.data() + name.size();
  const auto [rest, status] =
      std::from_chars(name.data() + at, end, seconds, std::chars_format::fixed);
  const std::chrono::year_month_day date{std::chrono::year(part[0]),
                                         std::chrono::month(static_cast<unsigned>(part[1])),
                                         std::chrono::day(static_cast<unsigned>(part[2]))};
  if (status != std::errc{} || rest != end || !date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * part[3] + 60.0 * part[4] + seconds;
}

class PclzfRecording : public Recording {
 public:
  /// `stems`: the frames' files without _depth.pclzf, _rgb.pclzf and .xml.
  static Result<std::unique_ptr<Recording>> open(std::vector<std::string> stems) {
    auto recording = std::make_unique<PclzfRecording>();
    RecordingInfo& info = recording->info_;
    info.camera.depth_scale = 0.001;
    std::error_code ignored;
    if (const fs::path xml = stems.front() + ".xml"; fs::exists(xml, ignored)) {
      const auto camera = read_xml(xml);
      if (!camera) return camera.error();
      info.camera = *camera;
    }
    recording->timed_ = std::all_of(stems.begin(), stems.end(), [](const std::string& stem) {
      return time_from_name(stem).has_value();
    });
    recording->stems_ = std::move(stems);
    return std::unique_ptr<Recording>(std::move(recording));
  }

  std::size_t size() const override { return stems_.size(); }

  Result<RecordedFrame> read(std::size_t i) override {
    const fs::path path = stems_[i] + std::string(kDepthEnding);
    auto image = read_image(path);
    if (!image) return image.error();
    if (image->kind != "depth16") {
      return Error{ErrorCode::bad_file,
                   fmt::format("it holds {}, depth16 is expected", image->kind), path.string()};
    }
    RecordedFrame frame{image->width, image->height, {}};
    frame.depth.resize(image->values.size() / 2);
    std::memcpy(frame.depth.data(), image->values.data(), image->values.size());
    if (timed_) frame.time = time_from_name(stems_[i]);
    if (auto same = check_camera(i); !same) return same.error();
    auto color = read_color(stems_[i] + "_rgb.pclzf");
    if (!color) return color.error();
    frame.color = *std::move(color);
    frame.color.time = frame.time;
    return frame;
  }

 private:
  static Result<PclzfImage> read_image(const fs::path& path) {
    const auto file = read_file(path);
    if (!file) return file.error();
    return decode_pclzf(file->text(), path.string());
  }

  /// Whether frame `i` is from the camera of the first one, as far as it says.
  Result<void> check_camera(std::size_t i) const {
    std::error_code ignored;
    const fs::path xml = stems_[i] + ".xml";
    if (i == 0 || !fs::exists(xml, ignored)) return {};
    const auto camera = read_xml(xml);
    if (!camera) return camera.error();
    if (camera->camera == info_.camera.camera && camera->depth_scale == info_.camera.depth_scale)
      return {};
    return Error{ErrorCode::bad_file, "the camera is not that of the first frame", xml.string()};
  }

  Result<ColorImage> read_color(const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return ColorImage{};
    const auto image = read_image(path);
    if (!image) return image.error();
    if (image->kind != "rgb24") {
      if (!std::exchange(said_left_out_, true)) {
        info_.notes.push_back(fmt::format("colour images of kind {} are left out", image->kind));
      }
      return ColorImage{};
    }
    const std::size_t pixels = image->values.size() / 3;
    std::vector<std::byte> rgb(image->values.size());
    for (std::size_t p = 0; p < pixels; ++p) {
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * p + c] = image->values[c * pixels + p];
    }
    return color_from_rgb(image->width, image->height, rgb);
  }

  std::vector<std::string> stems_;
  bool timed_ = false, said_left_out_ = false;
};

/// The depth images of a folder without their endings, in natural order.
std::vector<std::string> stems_in(const fs::path& folder) {
  std::vector<std::string> stems;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string path = entry->path().string();
    if (path.ends_with(kDepthEnding)) {
      stems.push_back(path.substr(0, path.size() - kDepthEnding.size()));
    }
  }
  std::sort(stems.begin(), stems.end(), natural_less);
  return stems;
}

bool recognise_pclzf(const RecordingPlace& place) {
  return place.is_folder ? !stems_in(place.path).empty() : place.bytes.starts_with(kMark);
}

Result<std::unique_ptr<Recording>> open_pclzf(const fs::path& path, const ImportParams&) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return PclzfRecording::open(stems_in(path));
  const std::string name = path.string();
  if (!name.ends_with(kDepthEnding)) {
    return Error{ErrorCode::unsupported,
                 fmt::format("a file NAME{} or a folder of them is expected", kDepthEnding), name};
  }
  return PclzfRecording::open({name.substr(0, name.size() - kDepthEnding.size())});
}

}  // namespace

Result<PclzfImage> decode_pclzf(std::string_view bytes, const std::string& name) {
  Cursor cursor(bytes, name);
  const auto damaged = [&](std::string message, ErrorCode code = ErrorCode::bad_file) {
    return cursor.byte_error("damaged PCLZF: " + std::move(message), code);
  };
  if (!bytes.starts_with(kMark)) return damaged("it does not begin with PCLZF");
  cursor.take(kMark.size());
  PclzfImage image;
  std::uint32_t packed = 0, unpacked = 0;
  const std::byte* kind = nullptr;
  const bool whole = cursor.read(image.width) && cursor.read(image.height) &&
                     (kind = cursor.take(16)) && cursor.read(packed) && cursor.read(unpacked);
  if (!whole) return damaged("the file ends within its head");
  image.kind = std::string(reinterpret_cast<const char*>(kind), 16);
  image.kind.erase(
      std::min(image.kind.find_last_not_of(std::string_view(" \0", 2)) + 1, std::size_t{16}));
  const std::size_t per_pixel = bytes_per_pixel(image.kind);
  if (per_pixel == 0) {
    return cursor.byte_error(
        fmt::format("it holds '{}', not depth16, rgb24, yuv422 or bayer8", shown(image.kind)),
        ErrorCode::unsupported);
  }
  const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
  if (pixels == 0 || pixels > kMaxDepthPixels || unpacked != per_pixel * pixels) {
    return damaged(fmt::format("{} x {} pixels of {} are claimed to be {} bytes", image.width,
                               image.height, image.kind, unpacked));
  }
  if (packed != cursor.remaining() || unpacked / kLzfRatio > packed) {
    return damaged(fmt::format("{} packed bytes are claimed to give {}, {} are there", packed,
                               unpacked, cursor.remaining()));
  }
  image.values.resize(unpacked);
  if (!unpack_lzf({cursor.take(packed), packed}, image.values)) return damaged("in what is packed");
  return image;
}

RecordingFormat pclzf_format() {
  return {"pclzf", "PCL's image grabber (NAME_depth.pclzf, NAME_rgb.pclzf, NAME.xml)",
          recognise_pclzf, open_pclzf};
}

}  // namespace burnish
