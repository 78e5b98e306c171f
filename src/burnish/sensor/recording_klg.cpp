#include "burnish/sensor/recording_klg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "burnish/io/cursor.h"
#include "burnish/io/depth_image.h"
#include "burnish/io/zlib_stream.h"
#include "burnish/sensor/color_image.h"

namespace burnish {
namespace {

constexpr std::size_t kFrameHead = 16;
constexpr std::size_t kFirstDepth = 4 + kFrameHead;  ///< where the first frame's depth begins

/// Sizes of depth images that cameras give; no two have the same count of pixels.
constexpr std::array<std::array<std::uint32_t, 2>, 13> kSizes{{{640, 480},
                                                               {320, 240},
                                                               {160, 120},
                                                               {512, 424},
                                                               {640, 576},
                                                               {320, 288},
                                                               {512, 512},
                                                               {1024, 1024},
                                                               {1024, 768},
                                                               {848, 480},
                                                               {424, 240},
                                                               {640, 360},
                                                               {1280, 720}}};

std::array<std::uint32_t, 2> size_of(std::size_t pixels) {
  for (const auto& size : kSizes) {
    if (std::size_t{size[0]} * size[1] == pixels) return size;
  }
  return {0, 0};
}

/// Where a frame lies in the file.
struct Place {
  std::size_t at;  ///< of its head
  std::int64_t microseconds;
  std::uint32_t depth_bytes, color_bytes;
};

Result<std::vector<Place>> find_frames(Cursor& cursor) {
  std::int32_t count = 0;
  if (!cursor.read(count)) return cursor.byte_error("the file ends within the count of frames");
  if (count <= 0) {
    return cursor.byte_error(
        fmt::format("the head counts {} frames, {} bytes follow", count, cursor.remaining()));
  }
  std::vector<Place> places;
  places.reserve(std::min<std::size_t>(count, cursor.remaining() / kFrameHead));
  for (std::int32_t i = 0; i < count; ++i) {
    const auto before = cursor.place();
    Place place{cursor.offset(), 0, 0, 0};
    std::int32_t depth = 0, color = 0;
    if (!cursor.read(place.microseconds) || !cursor.read(depth) || !cursor.read(color)) {
      cursor.go_to(before);
      return cursor.byte_error(
          fmt::format("the file ends before frame {} of the {} that it counts", i, count));
    }
    if (depth <= 0 || color < 0 || std::int64_t{depth} + color > std::int64_t(cursor.remaining())) {
      const std::size_t left = cursor.remaining();
      cursor.go_to(before);
      return cursor.byte_error(
          fmt::format("frame {} of {} claims {} bytes of depth and {} of colour, {} are left", i,
                      count, depth, color, left));
    }
    cursor.take(static_cast<std::size_t>(depth) + static_cast<std::size_t>(color));
    place.depth_bytes = static_cast<std::uint32_t>(depth);
    place.color_bytes = static_cast<std::uint32_t>(color);
    places.push_back(place);
  }
  if (!cursor.at_end()) {
    return cursor.byte_error(fmt::format("the head counts {} frames, {} bytes come after them",
                                         count, cursor.remaining()));
  }
  return places;
}

class KlgRecording : public Recording {
 public:
  KlgRecording(std::string_view bytes, std::string name, std::vector<Place> places, FileBytes owner)
      : bytes_(bytes),
        name_(std::move(name)),
        places_(std::move(places)),
        owner_(std::move(owner)) {
    info_.camera.depth_scale = 0.001;
    info_.registered = true;
  }

  std::size_t size() const override { return places_.size(); }

  Result<RecordedFrame> read(std::size_t i) override {
    const Place& place = places_[i];
    RecordedFrame frame;
    frame.time = static_cast<double>(place.microseconds) / 1e6;
    const std::string_view body = bytes_.substr(place.at + kFrameHead);
    if (auto read = read_depth(body.substr(0, place.depth_bytes), i, frame); !read) {
      return read.error();
    }
    if (place.color_bytes == 0) return frame;
    auto color = read_color(body.substr(place.depth_bytes, place.color_bytes), i, frame);
    if (!color) return color.error();
    frame.color = *std::move(color);
    frame.color.time = frame.time;
    return frame;
  }

 private:
  Error error(std::size_t i, std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, fmt::format("frame {}: {}", i, message),
            fmt::format("{}, byte {}", name_, places_[i].at)};
  }

  Result<void> read_depth(std::string_view packed, std::size_t i, RecordedFrame& frame) const {
    const auto input = std::as_bytes(std::span(packed));
    std::size_t size = input.size();
    const std::byte* pixels = input.data();
    std::vector<std::byte> unpacked;
    if (is_zlib(input)) {
      auto output = unpack_zlib(input, 2 * kMaxDepthPixels);
      if (!output) return error(i, "the depth is a damaged zlib stream");
      unpacked = *std::move(output);
      size = unpacked.size();
      pixels = unpacked.data();
    }
    const auto [width, height] = size_of(size / 2);
    if (size % 2 != 0 || width == 0) {
      return error(i,
                   fmt::format("{} bytes of depth are those of no camera's image (640 x 480, 320 x "
                               "240, ...), and no zlib stream",
                               size),
                   ErrorCode::unsupported);
    }
    frame.width = width;
    frame.height = height;
    frame.depth.resize(size / 2);
    std::memcpy(frame.depth.data(), pixels, size);
    return {};
  }

  Result<ColorImage> read_color(std::string_view bytes, std::size_t i,
                                const RecordedFrame& frame) const {
    if (is_jpeg(bytes)) return ColorImage{std::string(bytes), ".jpg"};
    if (bytes.size() == 3 * frame.depth.size()) {
      return color_from_rgb(frame.width, frame.height, std::as_bytes(std::span(bytes)));
    }
    return error(i, fmt::format("{} bytes of colour are neither JPEG nor {} x {} x 3", bytes.size(),
                                frame.width, frame.height));
  }

  std::string_view bytes_;
  std::string name_;
  std::vector<Place> places_;
  FileBytes owner_;
};

/// It has no mark of its own: what a first frame should be, or the ending, tells it.
bool recognise_klg(const RecordingPlace& place) {
  if (place.is_folder) return false;
  if (place.path.extension() == ".klg") return true;
  if (place.bytes.size() <= kFirstDepth) return false;
  return is_zlib(std::as_bytes(std::span(place.bytes.substr(kFirstDepth)))) ||
         open_klg(place.bytes, {}).has_value();
}

Result<std::unique_ptr<Recording>> open_klg_file(const std::filesystem::path& path,
                                                 const ImportParams&) {
  auto file = map_file(path);
  if (!file) return file.error();
  const std::string_view bytes = file->text();
  return open_klg(bytes, path.string(), *std::move(file));
}

}  // namespace

Result<std::unique_ptr<Recording>> open_klg(std::string_view bytes, const std::string& name,
                                            FileBytes owner) {
  Cursor cursor(bytes, name);
  auto places = find_frames(cursor);
  if (!places) return places.error();
  return std::unique_ptr<Recording>(
      std::make_unique<KlgRecording>(bytes, name, *std::move(places), std::move(owner)));
}

RecordingFormat klg_format() {
  return {"klg", "KLG, log of Kintinuous and ElasticFusion", recognise_klg, open_klg_file};
}

}  // namespace burnish
