#pragma once

#include <array>
#include <vector>

// What Open3D makes of a pair of depth frames. Plain types alone: burnish is compiled without
// Eigen's vectors and Open3D with them, so that neither sees the other's matrices.

struct PlainFrame {
  int width, height;
  double fx, fy, cx, cy;
  std::vector<float> depth;                   ///< m; 0 = none
  std::vector<std::array<double, 3>> points;  ///< of every fourth row and column, camera axes
};

using PlainPose = std::array<double, 16>;  ///< row by row

enum class Peer { point_to_plane, generalized, odometry };

/// The pose of the source's camera in the target's from a guess that is off by at most about
/// `reach` (m). Everything that comes after the points (normals, trees, covariances) is within.
PlainPose align_with_open3d(Peer peer, const PlainFrame& source, const PlainFrame& target,
                            const PlainPose& guess, double reach);
