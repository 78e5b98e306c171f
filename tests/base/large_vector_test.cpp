#include "burnish/base/large_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace burnish {
namespace {

TEST(LargeVector, HoldsNumbersOfAnyCount) {
  for (const std::size_t count : {0u, 1u, 1000u, 200'000u, 3'000'000u}) {
    LargeVector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 7u);
    numbers.push_back(1);
    const LargeVector<std::uint32_t> copy = numbers;
    ASSERT_EQ(copy.size(), count + 1);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(copy[i], i + 7);
    EXPECT_EQ(copy.back(), 1u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(copy.data()) % 64, 0u);
  }
}

TEST(LargeVector, SetsElementsWhereAValueIsGiven) {
  const LargeVector<double> fives(100'000, 5.);
  EXPECT_EQ(std::accumulate(fives.begin(), fives.end(), 0.), 500'000.);
}

TEST(LargeVector, RefusesWhatNoNumberOfBytesHolds) {
  LargeAllocator<double> allocator;
  EXPECT_THROW((void)allocator.allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

TEST(LargeVector, RefusesWhatNoMemoryHolds) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer ends the program there";
#endif
  LargeAllocator<double> allocator;
  EXPECT_THROW((void)allocator.allocate(static_cast<std::size_t>(-1) / 16), std::bad_alloc);
}

}  // namespace
}  // namespace burnish
