#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish::training {

/// A noisy mesh and the same without noise.
struct Example {
  TriangleMesh noisy, clean;
};

/// Random solids and shapes of regular meshes, under noise that is independent from vertex to
/// vertex: of 0.1 to 0.8 mean edges, along the normals, in all directions, or of few vertices only.
std::vector<Example> white_examples(int count, std::uint64_t seed);

/// Random solids as a depth camera sees them: the image grid, noise along the rays that is
/// correlated between pixels as measured on Kinect frames.
std::vector<Example> camera_examples(int count, std::uint64_t seed);

}  // namespace burnish::training
