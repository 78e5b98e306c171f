#include "burnish/triangulation/key_sort.h"

#include <array>

namespace burnish {

void sort_by_key(std::vector<Keyed>& items) {
  constexpr std::size_t kDigits = 8;
  const auto digit = [](const Keyed& item, std::size_t place) {
    return item.key >> (8 * place) & 0xff;
  };
  std::array<std::array<std::uint32_t, 256>, kDigits> counts{};
  for (const Keyed& item : items) {
    for (std::size_t place = 0; place < kDigits; ++place) ++counts[place][digit(item, place)];
  }
  std::vector<Keyed> other(items.size());
  for (std::size_t place = 0; place < kDigits; ++place) {
    std::array<std::uint32_t, 256> start{};
    for (std::size_t i = 1; i < 256; ++i) start[i] = start[i - 1] + counts[place][i - 1];
    for (const Keyed& item : items) other[start[digit(item, place)]++] = item;
    items.swap(other);
  }
}

}  // namespace burnish
