#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cstring>
#include <iostream>

#include "openmesh_smoothing.h"

// peer_openmesh IN OUT equation1|own: ten passes, boundaries fixed.
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  Mesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, argv[1])) return 1;
  if (std::strcmp(argv[3], "equation1") == 0) {
    equation1_passes(mesh, 10);
  } else {
    own_passes(mesh, 10);
  }
  return OpenMesh::IO::write_mesh(mesh, argv[2], OpenMesh::IO::Options::Binary) ? 0 : 1;
}
