#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace burnish {

/// Indices in the order of (value, index), the least first, whose values change. Every change costs
/// O(log size).
class IndexHeap {
 public:
  struct Item {
    double value;
    std::uint32_t index;
    friend bool operator<(const Item& a, const Item& b) {
      return a.value != b.value ? a.value < b.value : a.index < b.index;
    }
  };

  /// `items` have different indices below `indices`.
  IndexHeap(std::vector<Item> items, std::size_t indices)
      : items_(std::move(items)), places_(indices, kNowhere) {
    for (std::size_t i = 0; i < items_.size(); ++i) places_[items_[i].index] = number(i);
    for (std::size_t i = items_.size() / 2; i-- > 0;) sink(i);
  }

  std::size_t size() const { return items_.size(); }
  bool contains(std::uint32_t index) const { return places_[index] != kNowhere; }

  Item pop() {
    const Item least = items_.front();
    places_[least.index] = kNowhere;
    const Item last = items_.back();
    items_.pop_back();
    if (!items_.empty()) {
      put(0, last);
      sink(0);
    }
    return least;
  }

  void change(std::uint32_t index, double value) {
    const std::size_t i = places_[index];
    items_[i].value = value;
    sink(i);
    rise(places_[index]);
  }

 private:
  static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();
  static std::uint32_t number(std::size_t i) { return static_cast<std::uint32_t>(i); }

  void put(std::size_t i, const Item& item) {
    items_[i] = item;
    places_[item.index] = number(i);
  }

  void rise(std::size_t i) {
    const Item item = items_[i];
    for (; i > 0 && item < items_[(i - 1) / 2]; i = (i - 1) / 2) put(i, items_[(i - 1) / 2]);
    put(i, item);
  }

  void sink(std::size_t i) {
    const Item item = items_[i];
    for (std::size_t below = 2 * i + 1; below < items_.size(); below = 2 * i + 1) {
      if (below + 1 < items_.size() && items_[below + 1] < items_[below]) ++below;
      if (!(items_[below] < item)) break;
      put(i, items_[below]);
      i = below;
    }
    put(i, item);
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> places_;  ///< per index where it is
};

}  // namespace burnish
