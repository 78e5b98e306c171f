#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "burnish/base/context.h"

namespace burnish {

/// Half-open range of indices.
struct IndexRange {
  std::size_t begin, end;
};

/// Calls `body(range)` for ranges that together cover [0, count) once, on at most context.threads
/// threads, and reports progress from the calling thread. Ranges are `grain` long (the last may be
/// shorter) and come in any order; what `body` writes must depend on the indices alone, not on
/// where a range begins. Returns false, with some ranges left out, where the context was cancelled.
/// `body` must not throw anything but std::bad_alloc.
[[nodiscard]] bool parallel_for(const Context& context, std::size_t count,
                                const std::function<void(IndexRange)>& body,
                                std::size_t grain = 2048);

/// Folds [0, count): `map(range)` gives a partial result for each range of exactly `grain` indices,
/// `join(total, partial)` adds them up in the order of the ranges, so that the sum is the same
/// bytes for any number of threads. Returns false where the context was cancelled.
template <class T, class Map, class Join>
[[nodiscard]] bool parallel_reduce(const Context& context, std::size_t count, T& total, Map map,
                                   Join join, std::size_t grain = 2048) {
  std::vector<T> partials((count + grain - 1) / grain, total);
  const bool complete = parallel_for(
      context, partials.size(),
      [&](IndexRange chunks) {
        for (std::size_t chunk = chunks.begin; chunk < chunks.end; ++chunk) {
          partials[chunk] = map(IndexRange{chunk * grain, std::min(count, (chunk + 1) * grain)});
        }
      },
      1);
  if (!complete) return false;
  for (T& partial : partials) join(total, std::move(partial));
  return true;
}

/// The number of threads that parallel_for uses at most under this context.
int thread_count(const Context& context);

}  // namespace burnish
