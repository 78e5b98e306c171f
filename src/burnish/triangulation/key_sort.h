#pragma once

#include <cstdint>
#include <vector>

namespace burnish {

/// A point's number and its place along some curve.
struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

/// Stable sort by key, digit by digit. O(#items).
void sort_by_key(std::vector<Keyed>& items);

}  // namespace burnish
