#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>

/// Seconds on the wall, and of the processor on all threads.
struct Seconds {
  double wall, processor;

  void print() const { std::printf("%.6f %.6f\n", wall, processor); }
  friend Seconds operator-(const Seconds& a, const Seconds& b) {
    return {a.wall - b.wall, a.processor - b.processor};
  }
};

/// Counts the seconds since it was made.
class Stopwatch {
 public:
  Seconds seconds() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    return {wall.count(), static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC};
  }
  void print() const { seconds().print(); }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};
