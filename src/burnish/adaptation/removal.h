#pragma once

#include <cstdint>

namespace burnish {

/// A half-edge collapse: the vertex `vertex` goes, and every triangle that had a corner at it has
/// that corner at its neighbour `into` instead; the one or two triangles along the edge between
/// them, which would name `into` twice, go too. In a log no vertex moves. Undone, it is a vertex
/// split.
struct Removal {
  std::uint32_t vertex = 0;
  std::uint32_t into = 0;
  float error = 0;  ///< how far the surface may be from the original then, m; along a log of
                    ///< removals it never falls

  friend bool operator==(const Removal&, const Removal&) = default;
};

}  // namespace burnish
