#pragma once

#include <cstdlib>
#include <cstring>

#include "plain_mesh.h"
#include "stopwatch.h"

// What all programs that time ten passes over a mesh share: reading it, so that each can build its
// own from plain arrays, and the clock. No burnish in here: peers are measured without it.
//   passes_NAME MESH mean|equation1
// Each prints the seconds of its adjacency and of ten passes, two numbers a line: on the wall, and
// of the processor.

constexpr int kPasses = 10;

inline bool wants_equation1(int argc, char** argv) {
  if (argc < 3) std::exit(2);
  return std::strcmp(argv[2], "equation1") == 0;
}
