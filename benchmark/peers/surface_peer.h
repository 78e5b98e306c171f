#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "plain_mesh.h"
#include "stopwatch.h"

// What all programs that make a surface from points share: reading the points, the clock, and
// writing the mesh, so that they differ in the surface alone. No burnish in here: peers are
// measured without it.

using Point = std::array<float, 3>;

struct Points {
  std::vector<Point> positions;
  std::vector<Point> normals;  ///< as many, or none
};

using Surface = PlainMesh;

/// The vertices of a binary little-endian PLY whose vertices come first.
inline Points read_points(const char* path) {
  const auto size_of = [](const std::string& type) -> std::size_t {
    if (type == "double" || type == "float64") return 8;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
    return 4;
  };
  std::ifstream file(path, std::ios::binary);
  std::size_t count = 0, stride = 0, x = 0, nx = 0;
  bool vertices = false, normals = false;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type >> name;
    if (word == "element") {
      vertices = type == "vertex";
      if (vertices) count = std::stoul(name);
    } else if (word == "property" && vertices) {
      if (name == "x") x = stride;
      if (name == "nx") nx = stride, normals = true;
      stride += size_of(type);
    }
  }
  Points points;
  points.positions.resize(count);
  if (normals) points.normals.resize(count);
  std::vector<char> row(stride);
  for (std::size_t i = 0; i < count; ++i) {
    file.read(row.data(), static_cast<std::streamsize>(stride));
    std::memcpy(&points.positions[i], row.data() + x, sizeof(Point));
    if (normals) std::memcpy(&points.normals[i], row.data() + nx, sizeof(Point));
  }
  if (!file || count == 0) {
    std::fprintf(stderr, "%s: a binary PLY with points expected\n", path);
    std::exit(1);
  }
  return points;
}

/// PROGRAM IN OUT ...: reads points, makes a surface of them, prints how long that took and writes
/// it. `prepare(points)` puts them into the library's own types before the clock starts;
/// `build(prepared)` is what is timed; `finish(built)` gives the Surface.
template <class Prepare, class Build, class Finish>
int run_peer(char** argv, Prepare prepare, Build build, Finish finish) {
  const Points points = read_points(argv[1]);
  auto prepared = prepare(points);
  const Stopwatch stopwatch;
  auto built = build(prepared);
  stopwatch.print();
  write_ply(argv[2], finish(built));
  return 0;
}
