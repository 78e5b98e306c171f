#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burnish/base/result.h"

namespace burnish {

/// One image of a track: its bytes, and where they lie in the file.
struct MatroskaBlock {
  std::int64_t nanoseconds = 0;
  std::size_t at = 0;
  std::string_view bytes;
};

struct MatroskaTrack {
  std::uint64_t number = 0, uid = 0;
  std::string name;
  std::string codec;   ///< "V_MS/VFW/FOURCC"
  std::string fourcc;  ///< of that codec: "b16g", "MJPG"
  std::uint64_t width = 0, height = 0;
  bool packed = false;  ///< its blocks are compressed or encrypted once more
  std::vector<MatroskaBlock> blocks;
};

/// What a Matroska file holds, as far as recordings of depth cameras need it. Points into its
/// bytes.
struct Matroska {
  std::vector<MatroskaTrack> tracks;
  std::vector<std::pair<std::string, std::string_view>> attachments;  ///< names and bytes
  std::vector<std::pair<std::string, std::string>> tags;
};

/// Reads a Matroska (RFC 9559 on RFC 8794): all elements have their size, but the segment may go on
/// to the end of the file; one image a block. Goes from head to head, and looks at no image.
/// Errors: bad_file with file and place, unsupported for several images in a block and for clusters
/// of unknown size.
Result<Matroska> read_matroska(std::string_view bytes, const std::string& name);

bool recognise_matroska(std::string_view bytes);

}  // namespace burnish
