#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What Ozbay and Cinar tabulate for one vertex (Figure 6): its neighbours, their distances, how
/// far these are from their mean, and the angles between successive edges.
struct OneRingTable {
  struct Neighbour {
    std::uint32_t vertex;
    Vec3d position;           ///< in the world, m
    double distance;          ///< Euclidean, m
    double deviation;         ///< |mean distance - distance|, m
    double printed_distance;  ///< see printed_distance()
    double printed_deviation;
  };
  struct Corner {
    std::uint32_t from, to;  ///< neighbours joined by a triangle at the vertex
    double angle;            ///< between the edges to them, rad
  };

  std::uint32_t vertex = 0;
  Vec3d position;
  std::vector<Neighbour> neighbours;  ///< around the vertex, counter-clockwise seen from outside
  std::vector<Corner> corners;        ///< one per triangle, in the same order
  double mean_distance = 0;           ///< m
  double mean_printed_distance = 0;
  double smallest_angle = 0;  ///< of the corners, rad; 0 where there are none
  double largest_angle = 0;

  Facts facts() const;
};

/// The paper calls it Euclidean, but its numbers are sqrt(sqrt|dx| + sqrt|dy| + sqrt|dz|) to every
/// printed digit. Only for reproducing them: it is no length.
double printed_distance(const Vec3d& a, const Vec3d& b);

/// Neighbours begin at the boundary where there is one, otherwise with the smallest number; at a
/// vertex that is not manifold one fan follows the other.
/// Errors: bad_geometry, invalid_argument where there is no such vertex. O(#V + #T).
Result<OneRingTable> one_ring_table(const TriangleMesh& mesh, std::uint32_t vertex);

}  // namespace burnish
