#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "burnish/core/triangle_mesh.h"

namespace burnish::test {

/// The Stanford Bunny from its ASCII PLY (x y z confidence intensity; 3 a b c), without the reader
/// that is tested elsewhere.
inline TriangleMesh read_bunny(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(file, line) && line.rfind("end_header", 0) != 0;) {
    std::istringstream words(line);
    std::string word, what;
    words >> word >> what;
    if (what == "vertex") words >> vertices;
    if (what == "face") words >> faces;
  }
  TriangleMesh mesh;
  mesh.positions.resize(vertices);
  mesh.triangles.resize(faces);
  double ignored = 0;
  for (Vec3f& p : mesh.positions) file >> p.x >> p.y >> p.z >> ignored >> ignored;
  for (Triangle& t : mesh.triangles) file >> ignored >> t[0] >> t[1] >> t[2];
  return mesh;
}

}  // namespace burnish::test
