#pragma once

#include <algorithm>
#include <set>
#include <stop_token>
#include <thread>
#include <vector>

#include "burnish/base/context.h"

namespace burnish::test {

/// Keeps what an operation reports.
class ProgressLog : public ProgressSink {
 public:
  void on_progress(double fraction) override {
    fractions_.push_back(fraction);
    threads_.insert(std::this_thread::get_id());
  }
  const std::vector<double>& fractions() const { return fractions_; }
  bool monotone() const { return std::is_sorted(fractions_.begin(), fractions_.end()); }
  /// Whether every report came from the thread that asks.
  bool from_one_thread() const {
    return threads_.size() == 1 && *threads_.begin() == std::this_thread::get_id();
  }

 private:
  std::vector<double> fractions_;
  std::set<std::thread::id> threads_;
};

/// Cancels as soon as a fraction is reported.
class CancelAt : public ProgressSink {
 public:
  explicit CancelAt(double fraction) : fraction_(fraction) {}
  void on_progress(double fraction) override {
    if (fraction >= fraction_ && !stop_.stop_requested()) {
      stop_.request_stop();
      reported_ = fraction;
    }
  }
  Context context() {
    Context result;
    result.stop = stop_.get_token();
    result.sink = this;
    return result;
  }
  /// What was reported when the stop was requested; 2 where it was not.
  double reported() const { return reported_; }

 private:
  double fraction_, reported_ = 2;
  std::stop_source stop_;
};

}  // namespace burnish::test
