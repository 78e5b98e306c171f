#pragma once

#include "conformance/workpiece.h"

namespace burnish::test {

/// Three organized clouds of one scene from three places: a wavy slanted wall with a ball before
/// it, with noise, missing pixels, points that fly between ball and wall, stray points, and every
/// attribute. No two distances in it are equal.
const std::vector<PointCloud>& sample_clouds();

/// Three frames of that scene from the first place, with shares of noise and observations.
const std::vector<DepthFrame>& sample_frames();

/// A noisy height field with a hole and random diagonals, a small one, a tetrahedron, an unused
/// vertex, and every attribute.
const TriangleMesh& sample_mesh();

}  // namespace burnish::test
