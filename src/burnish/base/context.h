#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

namespace burnish {

/// Who wants to know how far an operation is. Called only from the thread that called the
/// operation.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void on_progress(double fraction) = 0;       ///< 0 to 1, never falling
  virtual void on_stage(std::string_view /*name*/) {}  ///< a new stage begins
};

/// What an operation is run with: how to stop it, whom to tell, how many threads, which seed.
/// Cheap to copy; passed by const reference; never global.
class Context {
 public:
  std::stop_token stop;
  ProgressSink* sink = nullptr;
  int threads = 0;         ///< at most so many; 0: as many as the machine has
  std::uint64_t seed = 1;  ///< for whatever draws random numbers

  bool cancelled() const { return stop.stop_requested(); }

  /// `fraction` of this context's share is done.
  void progress(double fraction) const {
    if (sink) sink->on_progress(begin_ + (end_ - begin_) * fraction);
  }
  void stage(std::string_view name) const {
    if (sink) sink->on_stage(name);
  }

  /// The share of the bar from `begin` to `end`: context.part(0.2, 0.6).
  Context part(double begin, double end) const {
    Context share = *this;
    share.begin_ = begin_ + (end_ - begin_) * begin;
    share.end_ = begin_ + (end_ - begin_) * end;
    return share;
  }

 private:
  double begin_ = 0, end_ = 1;
};

}  // namespace burnish
