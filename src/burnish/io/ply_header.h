#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "burnish/io/cursor.h"
#include "burnish/io/finish.h"
#include "burnish/io/number_type.h"

namespace burnish {

struct PlyProperty {
  std::string name;
  NumberType type;
  std::optional<NumberType> list_count;  ///< the type of a list's length, if it is a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  /// Bytes of a row, a list counted as an empty one.
  std::size_t row_bytes() const;
};

struct PlyHeader {
  bool ascii = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  CommentFacts facts;
};

/// Reads up to and with the line `end_header`; the cursor then stands at the first byte of data.
Result<PlyHeader> read_ply_header(Cursor& cursor);

}  // namespace burnish
