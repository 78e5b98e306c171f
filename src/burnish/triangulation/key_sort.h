#pragma once

#include <algorithm>
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

/// Sorts those of equal keys, which are next to each other, by `before`.
template <class Before>
void sort_equal_keys(std::vector<Keyed>& items, Before before) {
  for (auto begin = items.begin(); begin != items.end();) {
    auto end = begin + 1;
    while (end != items.end() && end->key == begin->key) ++end;
    if (end - begin > 1) std::sort(begin, end, before);
    begin = end;
  }
}

}  // namespace burnish
