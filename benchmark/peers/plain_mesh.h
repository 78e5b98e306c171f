#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <vector>

// Triangle meshes as every library can take and give them. No burnish in here: peers are measured
// without it.

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

/// A binary PLY.
inline void write_ply(const char* path, const PlainMesh& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.positions.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << mesh.triangles.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
  file.write(reinterpret_cast<const char*>(mesh.positions.data()),
             static_cast<std::streamsize>(mesh.positions.size() * 12));
  for (const auto& triangle : mesh.triangles) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle));
  }
}
