#include "heap.h"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>

namespace burnish::app {

void prepare_heap() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kPage = std::size_t{1} << 21, kFirst = 8 * kPage;
  ::mallopt(M_MMAP_THRESHOLD, 128 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  void* first = std::malloc(kFirst);  // to have it, and to give it back to the heap
  const auto begin = (reinterpret_cast<std::uintptr_t>(first) + kPage - 1) / kPage * kPage;
  // Pages are handed out when they are first written: what is not needed costs nothing.
  if (first) (void)::madvise(reinterpret_cast<void*>(begin), kFirst - kPage, MADV_HUGEPAGE);
  std::free(first);
#endif
}

}  // namespace burnish::app
