#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace burnish::test {

/// How a program ended and what it printed.
struct Outcome {
  int status = 0;  ///< its exit status, or 128 + the signal that ended it
  std::string out, err;
  double seconds = 0;
};

/// Runs `words` (the program's path first) with nothing on standard input; with `interrupt_after`
/// above zero it gets SIGINT after that time.
Outcome run_program(const std::vector<std::string>& words,
                    std::chrono::milliseconds interrupt_after = std::chrono::milliseconds(0));

}  // namespace burnish::test
