#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace burnish {

/// Short lists of indices that change one by one, all in one block of memory. A list that outgrows
/// its room moves; the room that it leaves is given to another.
class IndexLists {
 public:
  void resize(std::size_t count) { rows_.resize(count); }

  std::span<const std::uint32_t> row(std::size_t i) const {
    return {items_.data() + rows_[i].begin, rows_[i].size};
  }

  void assign(std::size_t i, std::span<const std::uint32_t> list) {
    Row& row = rows_[i];
    if (list.size() > row.room) {
      free(row);
      allocate(row, list.size());
    }
    row.size = static_cast<std::uint32_t>(list.size());
    std::copy(list.begin(), list.end(), items_.begin() + row.begin);
  }

 private:
  static constexpr std::size_t kStep = 4;  ///< rooms are multiples of it

  struct Row {
    std::uint32_t begin = 0, size = 0, room = 0;
  };

  void free(const Row& row) {
    if (row.room > 0) free_[row.room / kStep].push_back(row.begin);
  }

  void allocate(Row& row, std::size_t size) {
    const std::size_t steps = (size + kStep - 1) / kStep;
    if (free_.size() <= steps) free_.resize(steps + 1);
    row.room = static_cast<std::uint32_t>(steps * kStep);
    if (free_[steps].empty()) {
      row.begin = static_cast<std::uint32_t>(items_.size());
      items_.resize(items_.size() + row.room);
    } else {
      row.begin = free_[steps].back();
      free_[steps].pop_back();
    }
  }

  std::vector<Row> rows_;
  std::vector<std::uint32_t> items_;
  std::vector<std::vector<std::uint32_t>> free_;  ///< begins of unused rooms, by steps of size
};

}  // namespace burnish
