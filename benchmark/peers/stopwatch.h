#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>

/// Prints the seconds since it was made: on the wall, and of the processor on all threads.
class Stopwatch {
 public:
  void print() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    const double processor = static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC;
    std::printf("%.6f %.6f\n", wall.count(), processor);
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};
