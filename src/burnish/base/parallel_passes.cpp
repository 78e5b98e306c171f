#include "burnish/base/parallel_passes.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

struct Step {
  std::size_t pass, chunk;
};

/// Which steps are done, which may be done next. Every pass begins its chunks in their order.
class Wave {
 public:
  Wave(std::size_t passes, std::span<const std::uint32_t> needs)
      : needs_(needs), begun_(passes, 0), through_(passes, 0), passed_(needs.size(), 0) {}

  /// The next step for a thread that is free; none where all steps have been begun. Waits where
  /// every other step needs one that is not done yet.
  std::optional<Step> take() {
    std::unique_lock lock(mutex_);
    while (!stopped_ && steps_begun_ < steps()) {
      if (const auto step = next()) {
        ++begun_[step->pass];
        ++steps_begun_;
        return step;
      }
      changed_.wait(lock);
    }
    return {};
  }

  /// Gives the share of all steps that is done.
  double finish(const Step& step) {
    const std::lock_guard lock(mutex_);
    ++passed_[step.chunk];
    ++steps_done_;
    std::size_t& through = through_[step.pass];
    while (through < needs_.size() && passed_[through] > step.pass) ++through;
    changed_.notify_all();
    return static_cast<double>(steps_done_) / static_cast<double>(steps());
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

  bool complete() const { return steps_done_ == steps(); }

 private:
  std::size_t steps() const { return begun_.size() * needs_.size(); }

  bool ready(std::size_t pass) const {
    const std::size_t chunk = begun_[pass];
    return chunk < needs_.size() && (pass == 0 || through_[pass - 1] >= needs_[chunk]);
  }

  /// The latest pass that can go on: what it reads has been written last. Any other would do.
  std::optional<Step> next() {
#ifdef BURNISH_SHUFFLE
    std::vector<Step> ready_steps;
    for (std::size_t pass = 0; pass < begun_.size(); ++pass) {
      if (ready(pass)) ready_steps.push_back({pass, begun_[pass]});
    }
    if (ready_steps.empty()) return {};
    return ready_steps[random_() % ready_steps.size()];
#else
    for (std::size_t pass = begun_.size(); pass-- > 0;) {
      if (ready(pass)) return Step{pass, begun_[pass]};
    }
    return {};
#endif
  }

  std::span<const std::uint32_t> needs_;
  std::vector<std::size_t> begun_;     ///< per pass the chunks begun
  std::vector<std::size_t> through_;   ///< per pass the chunks at the front that are done
  std::vector<std::uint32_t> passed_;  ///< per chunk the passes that are done
  std::size_t steps_begun_ = 0, steps_done_ = 0;
  bool stopped_ = false;
#ifdef BURNISH_SHUFFLE
  std::mt19937 random_{1};
#endif
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace

bool parallel_passes(const Context& context, std::size_t passes,
                     std::span<const std::uint32_t> needs,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  Wave wave(passes, needs);
  const auto caller = std::this_thread::get_id();
  const auto work = [&](IndexRange) {
    while (const auto step = wave.take()) {
      if (context.cancelled()) return wave.stop();
      try {
        body(step->pass, step->chunk);
      } catch (...) {
        wave.stop();  // nobody may wait for this step
        throw;
      }
      const double done = wave.finish(*step);
      if (std::this_thread::get_id() == caller) context.progress(done);
    }
  };
  Context workers = context;
  workers.sink = nullptr;
  const auto threads = static_cast<std::size_t>(thread_count(context));
  if (!parallel_for(workers, threads, work, 1) || !wave.complete()) return false;
  context.progress(1);
  return true;
}

}  // namespace burnish
