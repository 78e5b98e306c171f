#include "burnish/sensor/matroska.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "burnish/io/cursor.h"

namespace burnish {
namespace {

using namespace std::string_view_literals;

/// The identifiers of the elements that are looked at.
enum Id : std::uint32_t {
  kHead = 0x1A45DFA3,
  kSegment = 0x18538067,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackName = 0x536E,
  kCodec = 0x86,
  kCodecPrivate = 0x63A2,
  kContentEncodings = 0x6D80,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kAttachments = 0x1941A469,
  kAttachedFile = 0x61A7,
  kFileName = 0x466E,
  kFileData = 0x465C,
  kTags = 0x1254C367,
  kTag = 0x7373,
  kSimpleTag = 0x67C8,
  kTagName = 0x45A3,
  kTagString = 0x4487,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
  kBlockGroup = 0xA0,
  kBlock = 0xA1,
};

constexpr std::size_t kFourCcPlace = 16;  ///< in a BITMAPINFOHEADER
constexpr unsigned kLacing = 0x06;        ///< of a block's flags

struct Element {
  std::uint32_t id = 0;
  std::size_t at = 0;  ///< of its body in the file
  std::string_view body;
};

std::uint64_t unsigned_of(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char c : bytes.substr(0, std::min<std::size_t>(bytes.size(), 8)))
    value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

/// Texts may end in zeros.
std::string text_of(std::string_view bytes) {
  return std::string(bytes.substr(0, bytes.find('\0')));
}

/// Takes a number of variable length off the front: as many bytes as the first one has leading
/// zeros, and one. None where there are fewer.
std::optional<std::uint64_t> take_number(std::string_view& bytes, bool keep_mark) {
  if (bytes.empty() || bytes[0] == 0) return std::nullopt;
  const auto first = static_cast<unsigned char>(bytes[0]);
  const std::size_t length = static_cast<std::size_t>(std::countl_zero(first)) + 1;
  if (length > bytes.size()) return std::nullopt;
  std::uint64_t value = unsigned_of(bytes.substr(0, length));
  if (!keep_mark) value &= (std::uint64_t{1} << (7 * length)) - 1;
  bytes.remove_prefix(length);
  return value;
}

class Reader {
 public:
  Reader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  Result<Matroska> read() {
    const auto head = each(Element{0, 0, bytes_}, [this](const Element& e) -> Result<void> {
      return e.id == kSegment ? read_segment(e) : Result<void>{};
    });
    if (!head) return head.error();
    return std::move(file_);
  }

 private:
  Error damaged(std::size_t at, std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, std::move(message), fmt::format("{}, byte {}", name_, at)};
  }

  /// Calls `visit` for every element within another one.
  template <class Visit>
  Result<void> each(const Element& parent, Visit visit) {
    std::string_view rest = parent.body;
    const auto place = [&] { return parent.at + (parent.body.size() - rest.size()); };
    while (!rest.empty()) {
      const std::size_t start = place();
      const auto id = take_number(rest, true);
      if (!id || *id > 0xffffffff) return damaged(start, "no Matroska element begins here");
      const std::size_t before = rest.size();
      const auto size = take_number(rest, false);
      if (!size) return damaged(start, "the file ends within the head of an element");
      const std::size_t length = before - rest.size();
      const bool unknown = *size == (std::uint64_t{1} << (7 * length)) - 1;
      if (unknown && *id != kSegment) {
        return damaged(start, "an element has no size: the recording was not ended properly",
                       ErrorCode::unsupported);
      }
      if (!unknown && *size > rest.size()) {
        return damaged(start,
                       fmt::format("an element claims {} bytes, {} are left", *size, rest.size()));
      }
      const std::size_t taken = unknown ? rest.size() : static_cast<std::size_t>(*size);
      const Element element{static_cast<std::uint32_t>(*id), place(), rest.substr(0, taken)};
      if (auto visited = visit(element); !visited) return visited;
      rest.remove_prefix(taken);
    }
    return {};
  }

  Result<void> read_segment(const Element& segment) {
    return each(segment, [this](const Element& e) -> Result<void> {
      if (e.id == kInfo) return read_info(e);
      if (e.id == kTracks) return read_tracks(e);
      if (e.id == kAttachments) return read_attachments(e);
      if (e.id == kTags) return read_tags(e);
      if (e.id == kCluster) return read_cluster(e);
      return {};
    });
  }

  Result<void> read_info(const Element& info) {
    return each(info, [this](const Element& e) -> Result<void> {
      if (e.id == kTimestampScale) scale_ = unsigned_of(e.body);
      if (scale_ == 0 || scale_ > 1000000000)
        return damaged(e.at, fmt::format("a unit of time has {} ns", scale_));
      return {};
    });
  }

  Result<void> read_tracks(const Element& tracks) {
    return each(tracks, [this](const Element& e) -> Result<void> {
      if (e.id != kTrackEntry) return {};
      file_.tracks.emplace_back();
      return read_track(e, file_.tracks.back());
    });
  }

  Result<void> read_track(const Element& entry, MatroskaTrack& track) {
    return each(entry, [&, this](const Element& e) -> Result<void> {
      if (e.id == kTrackNumber) track.number = unsigned_of(e.body);
      if (e.id == kTrackUid) track.uid = unsigned_of(e.body);
      if (e.id == kTrackName) track.name = text_of(e.body);
      if (e.id == kCodec) track.codec = text_of(e.body);
      if (e.id == kContentEncodings) track.packed = true;
      if (e.id == kCodecPrivate && e.body.size() >= kFourCcPlace + 4)
        track.fourcc = text_of(e.body.substr(kFourCcPlace, 4));
      if (e.id != kVideo) return {};
      return each(e, [&](const Element& video) -> Result<void> {
        if (video.id == kPixelWidth) track.width = unsigned_of(video.body);
        if (video.id == kPixelHeight) track.height = unsigned_of(video.body);
        return {};
      });
    });
  }

  Result<void> read_attachments(const Element& attachments) {
    return each(attachments, [this](const Element& e) -> Result<void> {
      if (e.id != kAttachedFile) return {};
      auto& [name, data] = file_.attachments.emplace_back();
      return each(e, [&name = name, &data = data](const Element& part) -> Result<void> {
        if (part.id == kFileName) name = text_of(part.body);
        if (part.id == kFileData) data = part.body;
        return {};
      });
    });
  }

  Result<void> read_tags(const Element& tags) {
    return each(tags, [this](const Element& tag) -> Result<void> {
      if (tag.id != kTag) return {};
      return each(tag, [this](const Element& e) -> Result<void> {
        if (e.id != kSimpleTag) return {};
        auto& [name, text] = file_.tags.emplace_back();
        return each(e, [&name = name, &text = text](const Element& part) -> Result<void> {
          if (part.id == kTagName) name = text_of(part.body);
          if (part.id == kTagString) text = text_of(part.body);
          return {};
        });
      });
    });
  }

  Result<void> read_cluster(const Element& cluster) {
    std::uint64_t begin = 0;
    return each(cluster, [&, this](const Element& e) -> Result<void> {
      if (e.id == kTimestamp) begin = unsigned_of(e.body);
      if (e.id == kSimpleBlock) return read_block(e, begin);
      if (e.id != kBlockGroup) return {};
      return each(e, [&, this](const Element& part) -> Result<void> {
        return part.id == kBlock ? read_block(part, begin) : Result<void>{};
      });
    });
  }

  /// The track's number, two bytes of time after the cluster's, flags, and an image.
  Result<void> read_block(const Element& block, std::uint64_t begin) {
    constexpr std::uint64_t kLatest = std::numeric_limits<std::int64_t>::max();
    std::string_view rest = block.body;
    const auto number = take_number(rest, false);
    if (!number || rest.size() < 3) return damaged(block.at, "a block ends within its head");
    const auto after = static_cast<std::int16_t>(unsigned_of(rest.substr(0, 2)));
    const auto flags = static_cast<unsigned char>(rest[2]);
    rest.remove_prefix(3);
    if (begin > kLatest / scale_ - 65536) return damaged(block.at, "a time is out of all bounds");
    if (flags & kLacing) {
      return damaged(block.at, "a block holds several images", ErrorCode::unsupported);
    }
    for (MatroskaTrack& track : file_.tracks) {
      if (track.number != *number) continue;
      const std::int64_t time =
          (static_cast<std::int64_t>(begin) + after) * static_cast<std::int64_t>(scale_);
      track.blocks.push_back({time, block.at + (block.body.size() - rest.size()), rest});
    }
    return {};
  }

  std::string_view bytes_;
  std::string name_;
  Matroska file_;
  std::uint64_t scale_ = 1000000;  ///< ns per unit of time
};

}  // namespace

bool recognise_matroska(std::string_view bytes) {
  return bytes.starts_with("\x1A\x45\xDF\xA3"sv);
}

Result<Matroska> read_matroska(std::string_view bytes, const std::string& name) {
  if (!recognise_matroska(bytes)) {
    return Error{ErrorCode::bad_file, "it does not begin as a Matroska file does",
                 name + ", byte 0"};
  }
  return Reader(bytes, name).read();
}

}  // namespace burnish
