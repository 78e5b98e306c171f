#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burnish {

/// Some elements of arrays, in whatever order; runs of successive ones are copied at once.
class Selection {
 public:
  Selection(std::span<const std::uint32_t> kept) : size_(kept.size()) {
    for (const std::uint32_t i : kept) {
      if (!runs_.empty() && i == runs_.back().end) {
        ++runs_.back().end;
      } else {
        runs_.push_back({i, i + 1});
      }
    }
  }
  Selection(const std::vector<std::uint32_t>& kept) : Selection(std::span(kept)) {}

  /// The selected elements of `values`; an empty array stays empty.
  template <class T>
  std::vector<T> of(const std::vector<T>& values) const {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(size_);
    for (const Run& run : runs_) {
      if (run.end - run.begin == 1) {
        result.push_back(values[run.begin]);
      } else {
        result.insert(result.end(), values.begin() + run.begin, values.begin() + run.end);
      }
    }
    return result;
  }

 private:
  struct Run {
    std::uint32_t begin, end;
  };
  std::vector<Run> runs_;
  std::size_t size_;
};

/// The elements `kept` of `values`, in that order; an empty array stays empty.
template <class T>
std::vector<T> gather(const std::vector<T>& values, const Selection& kept) {
  return kept.of(values);
}

}  // namespace burnish
