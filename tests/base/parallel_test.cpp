#include "burnish/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <numeric>
#include <thread>

#include "burnish/base/random.h"
#include "support/progress.h"
#include "support/threads.h"

namespace burnish {
namespace {

using test::with_threads;

TEST(ParallelFor, CoversEveryIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::size_t count : {0u, 1u, 99u, 100u, 101u, 12345u}) {
      std::vector<std::atomic<int>> visits(count);
      ASSERT_TRUE(parallel_for(
          with_threads(threads), count,
          [&](IndexRange range) {
            for (std::size_t i = range.begin; i < range.end; ++i) ++visits[i];
          },
          100));
      for (const auto& visit : visits) ASSERT_EQ(visit, 1);
    }
  }
}

TEST(ParallelFor, NeverRunsOnMoreThreadsThanAllowed) {
  std::atomic<int> running{0}, most{0};
  ASSERT_TRUE(parallel_for(
      with_threads(2), 64,
      [&](IndexRange) {
        const int now = ++running;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --running;
      },
      1));
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

/// Resident memory of this process, bytes; 0 where the system does not tell.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0, in_memory = 0;
  file >> pages >> in_memory;
  return in_memory * 4096;
}

TEST(ParallelFor, AsksForNoMoreMemoryHoweverManyLoopsThereAre) {
  const auto loops = [](int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(parallel_for(with_threads(2), 2, [](IndexRange) {}, 1));
    }
  };
  loops(1000);
  const std::size_t before = resident();
  loops(10000);
  EXPECT_LT(resident(), before + (10000 * sizeof(void*)) * 10);  // less than ten words a loop
}

TEST(ParallelFor, LeavesChunksOutOnceCancelled) {
  for (const int threads : {1, 3}) {
    std::stop_source stop;
    Context context = with_threads(threads);
    context.stop = stop.get_token();
    std::atomic<std::size_t> visited{0};
    EXPECT_FALSE(parallel_for(
        context, 100000,
        [&](IndexRange range) {
          visited += range.end - range.begin;
          stop.request_stop();
        },
        10));
    EXPECT_GT(visited, 0u);
    // At most the chunk that each thread had begun.
    EXPECT_LE(visited, 10u * static_cast<std::size_t>(threads));
  }
}

TEST(ParallelFor, ThatIsCancelledBeforehandDoesNothing) {
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  bool called = false;
  EXPECT_FALSE(parallel_for(context, 10, [&](IndexRange) { called = true; }));
  EXPECT_FALSE(called);
  EXPECT_FALSE(parallel_for(context, 0, [&](IndexRange) { called = true; }));
}

TEST(ParallelFor, ReportsRisingProgressFromTheCallingThread) {
  for (const int threads : {1, 3}) {
    test::ProgressLog log;
    Context context = with_threads(threads);
    context.sink = &log;
    ASSERT_TRUE(parallel_for(
        context.part(0.25, 0.75), 1000, [](IndexRange) {}, 10));
    EXPECT_TRUE(log.from_one_thread());
    EXPECT_TRUE(log.monotone());
    ASSERT_FALSE(log.fractions().empty());
    EXPECT_GE(log.fractions().front(), 0.25);
    EXPECT_EQ(log.fractions().back(), 0.75);
  }
}

TEST(ParallelReduce, SumsToTheSameBytesForEveryNumberOfThreads) {
  // Terms of very different size: any other order of addition rounds to another sum.
  Random random(7);
  std::vector<double> terms(50000);
  for (double& term : terms) {
    const double exponent = random.uniform(-20, 20);
    const double mantissa = random.uniform(-1, 1);
    term = std::ldexp(mantissa, static_cast<int>(exponent));
  }
  const auto sum = [&](int threads) {
    double total = 0;
    EXPECT_TRUE(parallel_reduce(
        with_threads(threads), terms.size(), total,
        [&](IndexRange r) { return std::accumulate(&terms[r.begin], &terms[r.end - 1] + 1, 0.0); },
        [](double& all, double part) { all += part; }, 97));
    return total;
  };
  const double once = sum(1);
  EXPECT_NE(once, 0);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(sum(threads), once);
}

TEST(ParallelReduce, JoinsInTheOrderOfTheRanges) {
  std::vector<std::size_t> begins;
  ASSERT_TRUE(parallel_reduce(
      with_threads(3), 1005, begins,
      [](IndexRange r) {
        return std::vector<std::size_t>{r.begin, r.end};
      },
      [](auto& all, auto part) { all.insert(all.end(), part.begin(), part.end()); }, 10));
  ASSERT_EQ(begins.size(), 202u);
  for (std::size_t i = 0; i < 101; ++i) {
    EXPECT_EQ(begins[2 * i], 10 * i);
    EXPECT_EQ(begins[2 * i + 1], std::min<std::size_t>(1005, 10 * i + 10));
  }
}

TEST(ParallelReduce, TellsOfCancellation) {
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  int total = 0;
  EXPECT_FALSE(parallel_reduce(
      context, 10, total, [](IndexRange) { return 1; }, [](int& all, int part) { all += part; }));
}

TEST(Context, APartOfAPartIsAShareOfTheWhole) {
  test::ProgressLog log;
  Context context;
  context.sink = &log;
  context.part(0.5, 1).part(0, 0.5).progress(0.5);
  EXPECT_EQ(log.fractions(), std::vector<double>{0.625});
}

}  // namespace
}  // namespace burnish
