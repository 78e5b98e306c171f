#include "burnish/sensor/recording_oni.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "burnish/io/cursor.h"
#include "burnish/io/depth_image.h"
#include "burnish/sensor/color_image.h"
#include "burnish/sensor/depth_16z.h"
#include "burnish/sensor/nearest_time.h"

namespace burnish {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kFileMark = "NI10";
constexpr std::string_view kRecordMark = "NIR\0"sv;
enum RecordType : std::uint32_t {
  kNodeAddedOld = 0x02,
  kIntProperty = 0x03,
  kGeneralProperty = 0x06,
  kNewData = 0x0A,
  kEnd = 0x0B,
  kNodeAddedFrames = 0x0C,
  kNodeAdded = 0x0D,
};
enum NodeType : std::uint32_t { kDepth = 2, kImage = 3 };
enum PixelFormat : std::uint64_t { kUnsaid = 0, kMillimetres = 100, kTenthMillimetres = 101 };

/// An image of a node, as it is packed.
struct Place {
  double time = 0;  ///< s
  std::size_t at = 0;
  std::string_view bytes;
  bool mirrored = false;
};

struct Node {
  std::uint32_t id = 0, type = 0;
  std::string codec;  ///< "16zT", "16zP", "JPEG", "NONE", ...
  std::uint32_t width = 0, height = 0;
  double horizontal_view = 0, vertical_view = 0;  ///< rad; 0: not said
  std::uint64_t pixel_format = kUnsaid;
  bool mirrored = false;
  std::vector<Place> places;
};

/// Goes from record to record.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), bytes_(bytes) {}

  Result<std::vector<Node>> read() {
    if (!bytes_.starts_with(kFileMark)) return cursor_.byte_error("it does not begin with NI10");
    std::uint8_t major = 0, minor = 0;
    std::uint16_t maintenance = 0;
    cursor_.take(kFileMark.size());
    if (!cursor_.read(major) || !cursor_.read(minor) || !cursor_.read(maintenance) ||
        !cursor_.take(4 + 8 + 4)) {
      return cursor_.byte_error("the file ends within its head");
    }
    // Since 1.0.1 the last number of a record's head, which is of no interest here, has 64 bits.
    const bool wide = std::array<int, 3>{major, minor, maintenance} >= std::array<int, 3>{1, 0, 1};
    const std::size_t head = wide ? 28 : 24;
    while (!ended_ && !cursor_.at_end()) {
      if (auto read = read_record(head); !read) return read.error();
    }
    return std::move(nodes_);
  }

 private:
  Result<void> read_record(std::size_t head) {
    const Cursor::Place start = cursor_.place();
    const auto damaged = [&](std::string message) {
      cursor_.go_to(start);
      return cursor_.byte_error(std::move(message));
    };
    std::uint32_t type = 0, id = 0, fields = 0, payload = 0;
    const std::byte* mark = cursor_.take(kRecordMark.size());
    const bool whole = mark && cursor_.read(type) && cursor_.read(id) && cursor_.read(fields) &&
                       cursor_.read(payload) && cursor_.take(head - 20);
    if (!whole) return damaged("the file ends within the head of a record");
    if (std::memcmp(mark, kRecordMark.data(), kRecordMark.size()) != 0) {
      return damaged("a record does not begin with NIR");
    }
    if (fields < head || fields - head > cursor_.remaining() ||
        payload > cursor_.remaining() - (fields - head)) {
      return damaged(fmt::format("a record claims {} + {} bytes, {} are left", fields, payload,
                                 cursor_.remaining() + head));
    }
    const std::size_t at = cursor_.offset();
    cursor_.take(fields - head + payload);
    Cursor body(bytes_.substr(at, fields - head), {});
    if (!read_fields(type, id, body,
                     {0, at + fields - head, bytes_.substr(at + fields - head, payload)})) {
      return damaged(fmt::format("the fields of a record of type {} end too early", type));
    }
    return {};
  }

  static bool read_text(Cursor& body, std::string& text) {
    std::uint32_t size = 0;
    const std::byte* bytes = nullptr;
    if (!body.read(size) || !(bytes = body.take(size))) return false;
    text.assign(reinterpret_cast<const char*>(bytes), size);
    text.erase(std::min(text.find('\0'), text.size()));
    return true;
  }

  bool read_fields(std::uint32_t type, std::uint32_t id, Cursor& body, Place place) {
    if (type == kEnd) ended_ = true;
    if (type == kNodeAdded || type == kNodeAddedFrames || type == kNodeAddedOld) {
      Node node;
      node.id = id;
      std::string name;
      const std::byte* codec = nullptr;
      if (!read_text(body, name) || !body.read(node.type) || !(codec = body.take(4))) return false;
      node.codec.assign(reinterpret_cast<const char*>(codec), 4);
      nodes_.push_back(std::move(node));
      return true;
    }
    const auto node = std::find_if(nodes_.begin(), nodes_.end(),
                                   [id](const Node& known) { return known.id == id; });
    if (node == nodes_.end()) return true;
    if (type == kIntProperty || type == kGeneralProperty) return read_property(body, *node);
    if (type != kNewData) return true;
    std::uint64_t microseconds = 0;
    if (!body.read(microseconds)) return false;
    place.time = static_cast<double>(microseconds) / 1e6;
    place.mirrored = node->mirrored;
    node->places.push_back(place);
    return true;
  }

  static bool read_property(Cursor& body, Node& node) {
    std::string name;
    std::uint32_t size = 0;
    if (!read_text(body, name) || !body.read(size) || size > body.remaining()) return false;
    if (name == "xnMapOutputMode") return body.read(node.width) && body.read(node.height);
    if (name == "xnFOV") return body.read(node.horizontal_view) && body.read(node.vertical_view);
    if (name == "oniPixelFormat") return read_whole(body, size, node.pixel_format);
    if (name != "xnMirror") return true;
    std::uint64_t mirrored = 0;
    const bool read = read_whole(body, size, mirrored);
    node.mirrored = mirrored != 0;
    return read;
  }

  /// Whole numbers are written with 32 or 64 bits.
  static bool read_whole(Cursor& body, std::uint32_t size, std::uint64_t& value) {
    std::uint32_t narrow = 0;
    if (size >= 8) return body.read(value);
    if (!body.read(narrow)) return false;
    value = narrow;
    return true;
  }

  Cursor cursor_;
  std::string_view bytes_;
  std::vector<Node> nodes_;
  bool ended_ = false;
};

class OniRecording : public Recording {
 public:
  OniRecording(std::string name, FileBytes owner)
      : name_(std::move(name)), owner_(std::move(owner)) {}

  Result<void> open(std::string_view bytes, const ImportParams& params) {
    auto nodes = Reader(bytes, name_).read();
    if (!nodes) return nodes.error();
    for (Node& node : *nodes) {
      if (node.type == kDepth && depth_.id == 0) depth_ = std::move(node);
      if (node.type == kImage && image_.id == 0) image_ = std::move(node);
    }
    if (depth_.places.empty()) return error(0, "there is no depth image in it");
    if (depth_.codec != "16zT" && depth_.codec != "16zP" && depth_.codec != "NONE") {
      return error(0,
                   fmt::format("the depth is packed by {}, 16zT, 16zP or NONE is expected",
                               shown(depth_.codec)),
                   ErrorCode::unsupported);
    }
    if (depth_.width == 0 || depth_.height == 0 || depth_.width > kMaxDepthPixels / depth_.height) {
      return error(0, fmt::format("the depth images are claimed to have {} x {} pixels",
                                  depth_.width, depth_.height));
    }
    if (auto said = understand(); !said) return said;
    find_colors(params.time_window);
    return {};
  }

  std::size_t size() const override { return depth_.places.size(); }

  Result<RecordedFrame> read(std::size_t i) override {
    const Place& place = depth_.places[i];
    RecordedFrame frame{depth_.width, depth_.height, {}};
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    if (depth_.codec == "NONE") {
      if (place.bytes.size() != 2 * pixels) return wrong_size(i, place.bytes.size());
      frame.depth.resize(pixels);
      std::memcpy(frame.depth.data(), place.bytes.data(), 2 * pixels);
    } else {
      auto depth =
          unpack_16z(std::as_bytes(std::span(place.bytes)), depth_.codec == "16zT", pixels);
      if (!depth) return wrong_size(i, place.bytes.size());
      frame.depth = *std::move(depth);
    }
    if (place.mirrored) {
      for (std::size_t row = 0; row < pixels; row += frame.width) {
        std::reverse(frame.depth.begin() + static_cast<std::ptrdiff_t>(row),
                     frame.depth.begin() + static_cast<std::ptrdiff_t>(row + frame.width));
      }
    }
    frame.time = place.time;
    if (!colors_[i]) return frame;
    auto color = read_color(*colors_[i], i);
    if (!color) return color.error();
    frame.color = *std::move(color);
    frame.color.time = colors_[i]->time;
    return frame;
  }

 private:
  Error error(std::size_t at, std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, std::move(message), fmt::format("{}, byte {}", name_, at)};
  }

  Error wrong_size(std::size_t i, std::size_t bytes) const {
    return error(depth_.places[i].at,
                 fmt::format("frame {}: {} bytes of {} do not give {} x {} depths", i, bytes,
                             depth_.codec, depth_.width, depth_.height));
  }

  /// The unit and the camera.
  Result<void> understand() {
    info_.camera.depth_scale = depth_.pixel_format == kTenthMillimetres ? 0.0001 : 0.001;
    if (depth_.pixel_format != kUnsaid && depth_.pixel_format != kMillimetres &&
        depth_.pixel_format != kTenthMillimetres) {
      return error(0,
                   fmt::format("the depth has the pixel format {}, mm or 0.1 mm are expected",
                               depth_.pixel_format),
                   ErrorCode::unsupported);
    }
    const double h = depth_.horizontal_view, v = depth_.vertical_view;
    if (h > 0 && v > 0 && h < std::numbers::pi && v < std::numbers::pi) {
      const double width = depth_.width, height = depth_.height;
      info_.camera.camera = Camera{
          depth_.width, depth_.height, width / 2 / std::tan(h / 2), height / 2 / std::tan(v / 2),
          width / 2,    height / 2};
    }
    const auto mirrored = [](const Place& place) { return place.mirrored; };
    if (std::any_of(depth_.places.begin(), depth_.places.end(), mirrored)) {
      info_.notes.push_back("mirrored depth images were turned back, colour images were not");
    }
    return {};
  }

  void find_colors(double window) {
    colors_.resize(depth_.places.size());
    if (image_.places.empty()) return;
    if (image_.codec != "JPEG" && image_.codec != "NONE") {
      info_.notes.push_back(
          fmt::format("colour images packed by {} are left out", shown(image_.codec)));
      return;
    }
    std::vector<double> times;
    for (const Place& place : image_.places) times.push_back(place.time);
    const NearestTime nearest(std::move(times));
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const auto found = nearest.find(depth_.places[i].time, window);
      if (found) colors_[i] = &image_.places[*found];
    }
  }

  Result<ColorImage> read_color(const Place& place, std::size_t i) const {
    if (is_jpeg(place.bytes)) return ColorImage{std::string(place.bytes), ".jpg"};
    const std::uint64_t pixels = std::uint64_t{image_.width} * image_.height;
    if (image_.codec == "NONE" && pixels > 0 && place.bytes.size() == 3 * pixels) {
      return color_from_rgb(image_.width, image_.height, std::as_bytes(std::span(place.bytes)));
    }
    return error(place.at,
                 fmt::format("the colour image of frame {} is neither JPEG nor {} x {} x 3", i,
                             image_.width, image_.height));
  }

  std::string name_;
  FileBytes owner_;
  Node depth_, image_;
  std::vector<const Place*> colors_;  ///< of each depth image, null: none
};

bool recognise_oni(const RecordingPlace& place) {
  return !place.is_folder && place.bytes.starts_with(kFileMark);
}

Result<std::unique_ptr<Recording>> open_oni_file(const std::filesystem::path& path,
                                                 const ImportParams& params) {
  auto file = map_file(path);
  if (!file) return file.error();
  const std::string_view bytes = file->text();
  return open_oni(bytes, path.string(), params, *std::move(file));
}

}  // namespace

Result<std::unique_ptr<Recording>> open_oni(std::string_view bytes, const std::string& name,
                                            const ImportParams& params, FileBytes owner) {
  auto recording = std::make_unique<OniRecording>(name, std::move(owner));
  if (auto opened = recording->open(bytes, params); !opened) return opened.error();
  return std::unique_ptr<Recording>(std::move(recording));
}

RecordingFormat oni_format() {
  return {"oni", "ONI, OpenNI's recording", recognise_oni, open_oni_file};
}

}  // namespace burnish
