#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"

// Not part of the library's interface.
namespace burnish {

/// Rows of unknown lengths: `append(row, items)` adds the items of a row to the end of `items`, and
/// looks at nothing that is there. The scratch that it needs `make_append()` gives it, once for
/// every chunk of rows. False where cancelled.
template <class MakeAppend>
[[nodiscard]] bool build_rows(const Context& context, std::size_t count, MakeAppend make_append,
                              Adjacency& rows) {
  // Few chunks, since each may make scratch as long as all the rows.
  const std::size_t grain = std::max<std::size_t>(4096, count / 64 + 1);
  std::vector<std::vector<std::uint32_t>> chunks((count + grain - 1) / grain);
  LargeVector<std::uint32_t> offsets(count + 1, 0);
  const bool complete = parallel_for(
      context, chunks.size(),
      [&](IndexRange range) {
        auto append = make_append();
        for (std::size_t chunk = range.begin; chunk < range.end; ++chunk) {
          std::vector<std::uint32_t>& items = chunks[chunk];
          const std::size_t end = std::min(count, (chunk + 1) * grain);
          for (std::size_t row = chunk * grain; row < end; ++row) {
            const std::size_t before = items.size();
            append(row, items);
            offsets[row + 1] = static_cast<std::uint32_t>(items.size() - before);
          }
        }
      },
      1);
  if (!complete) return false;
  for (std::size_t row = 0; row < count; ++row) offsets[row + 1] += offsets[row];
  LargeVector<std::uint32_t> items(offsets.back());
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    std::copy(chunks[chunk].begin(), chunks[chunk].end(), items.begin() + offsets[chunk * grain]);
  }
  rows = Adjacency(std::move(offsets), std::move(items));
  return true;
}

}  // namespace burnish
