#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burnish {

/// The elements `kept` of `values`, in that order; an empty array stays empty.
template <class T>
std::vector<T> gather(const std::vector<T>& values, std::span<const std::uint32_t> kept) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(kept.size());
  for (const std::uint32_t i : kept) result.push_back(values[i]);
  return result;
}

}  // namespace burnish
