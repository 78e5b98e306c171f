#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include "stopwatch.h"

// What all programs that time ten passes over a mesh share: reading it, so that each can build its
// own from plain arrays, and the clock. No burnish in here: peers are measured without it.
//   passes_NAME MESH mean|equation1
// Each prints the seconds of its adjacency and of ten passes, two numbers a line: on the wall, and
// of the processor.

constexpr int kPasses = 10;

struct PlainMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Two numbers of eight bytes, the counts, and then the vertices and the triangles.
inline PlainMesh read_plain_mesh(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t counts[2] = {};
  file.read(reinterpret_cast<char*>(counts), sizeof(counts));
  PlainMesh mesh;
  mesh.positions.resize(counts[0]);
  mesh.triangles.resize(counts[1]);
  file.read(reinterpret_cast<char*>(mesh.positions.data()),
            static_cast<std::streamsize>(counts[0] * 12));
  file.read(reinterpret_cast<char*>(mesh.triangles.data()),
            static_cast<std::streamsize>(counts[1] * 12));
  if (!file) std::exit(1);
  return mesh;
}

inline bool wants_equation1(int argc, char** argv) {
  if (argc < 3) std::exit(2);
  return std::strcmp(argv[2], "equation1") == 0;
}
