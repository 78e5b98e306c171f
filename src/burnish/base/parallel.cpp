#include "burnish/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

namespace burnish {
namespace {

/// The chunks of [0, count) in the order in which they are to be taken.
class Chunks {
 public:
  Chunks(std::size_t count, std::size_t grain) : count_(count), grain_(grain) {
#ifdef BURNISH_SHUFFLE
    grain_ = std::min<std::size_t>(grain_, 13);
    order_.resize(size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const char* seed = std::getenv("BURNISH_SHUFFLE_SEED");
    std::mt19937 random(seed ? static_cast<unsigned>(std::strtoul(seed, nullptr, 10)) : 1u);
    std::shuffle(order_.begin(), order_.end(), random);
#endif
  }
  std::size_t size() const {
    return (count_ + grain_ - 1) / grain_;
  }
  IndexRange operator[](std::size_t i) const {
    const std::size_t chunk = order_.empty() ? i : order_[i];
    return {chunk * grain_, std::min(count_, (chunk + 1) * grain_)};
  }

 private:
  std::size_t count_, grain_;
  std::vector<std::size_t> order_;  ///< empty: as they come
};

/// The calling thread's arena for so many threads. It is kept: made anew for every loop, oneTBB
/// 2021.8 keeps them all, 4 kB each, and the next loop takes the longer to begin.
tbb::task_arena& arena_of(int threads) {
  thread_local std::optional<tbb::task_arena> arena;
  if (!arena || arena->max_concurrency() != threads) arena.emplace(threads);
  return *arena;
}

}  // namespace

int thread_count(const Context& context) {
  const int machine = std::max(1, tbb::this_task_arena::max_concurrency());
  return context.threads > 0 ? context.threads : machine;
}

bool parallel_for(const Context& context, std::size_t count,
                  const std::function<void(IndexRange)>& body, std::size_t grain) {
  const Chunks chunks(count, std::max<std::size_t>(grain, 1));
  const std::size_t total = chunks.size();
  const auto caller = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stopped{false};

  // oneTBB orders the caller's work before all chunks and these before what follows.
  // ThreadSanitizer does not see that in a library built without it: `stopped` and `done` say it
  // once more.
  stopped.store(false, std::memory_order_release);
  const auto run_chunk = [&](std::size_t i) {
    if (stopped.load(std::memory_order_acquire) || context.cancelled()) {
      stopped.store(true, std::memory_order_release);
      return;
    }
    body(chunks[i]);
    const bool reports = std::this_thread::get_id() == caller;
    const std::size_t now = done.fetch_add(1, std::memory_order_release) + 1;
    if (reports) context.progress(static_cast<double>(now) / static_cast<double>(total));
  };

  const int threads = total > 1 ? thread_count(context) : 1;
  if (threads <= 1) {
    for (std::size_t i = 0; i < total && !stopped; ++i) run_chunk(i);
  } else {
    // Asked for more threads than the machine has, oneTBB would print a warning.
    std::optional<tbb::global_control> allow;
    if (threads > tbb::this_task_arena::max_concurrency()) {
      allow.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(threads));
    }
    arena_of(threads).execute([&] { tbb::parallel_for(std::size_t{0}, total, run_chunk); });
  }
  const bool all_done = done.load(std::memory_order_acquire) == total;
  if (!all_done || context.cancelled()) return false;
  context.progress(1);
  return true;
}

}  // namespace burnish
