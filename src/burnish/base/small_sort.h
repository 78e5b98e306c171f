#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace burnish {

/// Sorts by `before`, fast for few items in random order: where a general sort would guess wrongly
/// at every second comparison, each goes straight to the place that the number of smaller keys
/// gives. `key(item)` is a float that rises along `before` but need not tell all items apart; what
/// it leaves in disorder is mended by insertion. Items are small and copyable. O(n^2) for up to 64.
template <class T, class Key, class Before>
void small_sort(std::span<T> items, Key key, Before before) {
  constexpr std::size_t kFew = 64;
  const std::size_t count = items.size();
  if (count > kFew) {
    std::sort(items.begin(), items.end(), before);
    return;
  }
  std::array<float, kFew> keys;
  std::array<T, kFew> sorted;
  for (std::size_t i = 0; i < count; ++i) keys[i] = key(items[i]);
  for (std::size_t i = 0; i < count; ++i) {
    const float own = keys[i];
    std::int32_t place = 0;
    for (std::size_t j = 0; j < i; ++j) place += keys[j] <= own;
    for (std::size_t j = i + 1; j < count; ++j) place += keys[j] < own;
    sorted[static_cast<std::size_t>(place)] = items[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t j = i;
    for (; j > 0 && before(sorted[i], items[j - 1]); --j) items[j] = items[j - 1];
    items[j] = sorted[i];
  }
}

}  // namespace burnish
