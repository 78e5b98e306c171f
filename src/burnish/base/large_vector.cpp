#include "burnish/base/large_vector.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace burnish {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;  ///< of the large kind
constexpr std::size_t kLine = 64;

std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

}  // namespace

void* allocate_large(std::size_t bytes) {
  // Less than half a large page is filled sooner in small ones.
  const std::size_t unit = bytes >= kPage / 2 ? kPage : kLine;
  const std::size_t whole = rounded_up(bytes, unit);
  void* memory = whole < bytes ? nullptr : std::aligned_alloc(unit, whole);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // A system that has no large pages says no, and all goes on in small ones.
  if (unit == kPage) (void)::madvise(memory, whole, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory) noexcept {
  std::free(memory);
}

}  // namespace burnish
