#include "burnish/points/column_index.h"

#include "burnish/core/gather.h"

namespace burnish {

ColumnIndex::ColumnIndex(std::vector<std::uint64_t> keys, double across)
    : across_(across), keys_(std::move(keys)) {
  const auto row_of = [&](std::size_t i) { return keys_[i] >> (2 * kBits); };  // with its field
  for (std::size_t i = 0; i < keys_.size();) {
    const std::size_t field = static_cast<std::size_t>(keys_[i] >> (3 * kBits));
    Field& rows = fields_[field];
    const std::uint64_t first = row_of(i);
    rows.first_row = static_cast<std::int64_t>(first & ((1u << kBits) - 1)) - kHalf;
    for (; i < keys_.size() && (keys_[i] >> (3 * kBits)) == field; ++i) {
      while (rows.starts.size() <= row_of(i) - first) {
        rows.starts.push_back(static_cast<std::uint32_t>(i));
      }
    }
    rows.starts.push_back(static_cast<std::uint32_t>(i));
  }
}

ColumnIndex ColumnIndex::subset(std::span<const std::uint32_t> kept) const {
  return {gather(keys_, kept), across_};
}

}  // namespace burnish
