#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/subprocess.h"

namespace burnish::test {

/// Runs the program under test; with `interrupt_after_ms` as if Ctrl-C was pressed then.
inline Outcome burnish(std::vector<std::string> words, int interrupt_after_ms = 0) {
  words.insert(words.begin(), BURNISH_PROGRAM);
  return run_program(words, std::chrono::milliseconds(interrupt_after_ms));
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace burnish::test
