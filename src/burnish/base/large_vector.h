#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace burnish {

/// Memory that is to be filled at once, aligned to 64 bytes. From some megabytes on it is asked of
/// the system in large pages: to hand out a fresh page costs more than to fill it, and large ones
/// are five hundred times fewer. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);
void free_large(void* memory) noexcept;

template <class T>
class LargeAllocator {
 public:
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_large(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t) { free_large(memory); }

  /// Elements without a value are left as they are: whoever makes them fills them.
  void construct(T*) {}
  template <class... Args>
  void construct(T* element, Args&&... args) {
    ::new (static_cast<void*>(element)) T{std::forward<Args>(args)...};
  }

  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

/// A vector of plain numbers for millions of them. resize(count) and LargeVector(count) leave new
/// elements unset, which saves a walk through memory where they are written anyway.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace burnish
