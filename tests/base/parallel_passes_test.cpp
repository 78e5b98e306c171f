#include "burnish/base/parallel_passes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <vector>

#include "support/progress.h"
#include "support/threads.h"

namespace burnish {
namespace {

using test::with_threads;

/// Every chunk needs some that follow it, by turns more and fewer.
std::vector<std::uint32_t> some_needs(std::uint32_t chunks) {
  std::vector<std::uint32_t> needs;
  for (std::uint32_t c = 0; c < chunks; ++c) {
    const std::uint32_t own = std::min(chunks, c + 1 + c % 5);
    needs.push_back(needs.empty() ? own : std::max(own, needs.back()));
  }
  return needs;
}

TEST(ParallelPasses, ComeToAChunkOnceAndAfterWhatItNeeds) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::uint32_t chunks : {0u, 1u, 7u, 200u}) {
      for (const std::size_t passes : {0u, 1u, 2u, 10u}) {
        const std::vector<std::uint32_t> needs = some_needs(chunks);
        std::vector<std::atomic<std::size_t>> passed(chunks);
        std::atomic<int> early{0}, out_of_turn{0};
        ASSERT_TRUE(parallel_passes(with_threads(threads), passes, needs,
                                    [&](std::size_t pass, std::size_t chunk) {
                                      for (std::size_t other = 0; other < needs[chunk]; ++other) {
                                        early += passed[other] < pass;
                                      }
                                      out_of_turn += passed[chunk]++ != pass;
                                    }));
        EXPECT_EQ(early, 0);
        EXPECT_EQ(out_of_turn, 0);
        for (const auto& count : passed) EXPECT_EQ(count, passes);
      }
    }
  }
}

TEST(ParallelPasses, FollowEachOtherBeforeTheFirstIsThrough) {
  const std::vector<std::uint32_t> needs = some_needs(100);
  std::size_t first_done = 0, first_done_when_last_began = 100;
  ASSERT_TRUE(parallel_passes(with_threads(1), 3, needs, [&](std::size_t pass, std::size_t chunk) {
    first_done += pass == 0;
    if (pass == 2 && chunk == 0) first_done_when_last_began = first_done;
  }));
#ifndef BURNISH_SHUFFLE
  EXPECT_LT(first_done_when_last_began, 20u);
#endif
}

TEST(ParallelPasses, StopOnceCancelled) {
  for (const int threads : {1, 3}) {
    std::stop_source stop;
    Context context = with_threads(threads);
    context.stop = stop.get_token();
    std::atomic<int> calls{0};
    EXPECT_FALSE(parallel_passes(context, 10, some_needs(100), [&](std::size_t, std::size_t) {
      ++calls;
      stop.request_stop();
    }));
    EXPECT_LE(calls, threads);
  }
}

TEST(ParallelPasses, HandOnWhatABodyThrows) {
  for (const int threads : {1, 3}) {
    EXPECT_THROW((void)parallel_passes(with_threads(threads), 4, some_needs(50),
                                       [](std::size_t pass, std::size_t chunk) {
                                         if (pass == 1 && chunk == 9) throw std::bad_alloc();
                                       }),
                 std::bad_alloc);
  }
}

TEST(ParallelPasses, ReportProgressThatRisesToOne) {
  for (const int threads : {1, 3}) {
    test::ProgressLog log;
    Context context = with_threads(threads);
    context.sink = &log;
    ASSERT_TRUE(parallel_passes(context, 5, some_needs(40), [](std::size_t, std::size_t) {}));
    EXPECT_TRUE(log.monotone());
    EXPECT_TRUE(log.from_one_thread());
    EXPECT_EQ(log.fractions().back(), 1);
  }
}

}  // namespace
}  // namespace burnish
