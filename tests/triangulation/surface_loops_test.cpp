#include "burnish/triangulation/surface_loops.h"

#include <gtest/gtest.h>

#include <map>

namespace burnish {
namespace {

bool is_crossed(unsigned mask, int edge) {
  const int begin = edge_begin(edge);
  return (mask >> begin & 1) != (mask >> (begin | 1 << edge / 4) & 1);
}

TEST(SurfaceLoops, HoldEveryCrossedEdgeInLoopsOfThreeOrMore) {
  for (unsigned mask = 0; mask < 256; ++mask) {
    for (unsigned turned = 0; turned < 64; ++turned) {
      const SurfaceLoops loops = surface_loops(mask, turned);
      ASSERT_LE(loops.count, 4);
      std::array<int, 4> lengths{};
      for (int edge = 0; edge < 12; ++edge) {
        const int loop = loops.of_edge[static_cast<std::size_t>(edge)];
        ASSERT_EQ(loop >= 0, is_crossed(mask, edge));
        if (loop >= 0) ++lengths[static_cast<std::size_t>(loop)];
      }
      for (int loop = 0; loop < loops.count; ++loop) {
        EXPECT_GE(lengths[static_cast<std::size_t>(loop)], 3) << mask;
      }
    }
  }
}

/// Two cubes side by side along x, in all 4096 states of their twelve corners. Every crossed edge
/// of the face between them is the side of two quadrilaterals' that joins a loop of one to a loop
/// of the other; no two loops may be joined by more than the two crossings of one segment.
TEST(SurfaceLoops, JoinTwoNeighboursOnce) {
  for (unsigned corners = 0; corners < 4096; ++corners) {
    unsigned left = 0, right = 0;  // corner x + 3 (y + 2 z) of the twelve
    for (int c = 0; c < 8; ++c) {
      const int row = 3 * (c >> 1);
      left |= (corners >> ((c & 1) + row) & 1) << c;
      right |= (corners >> ((c & 1) + 1 + row) & 1) << c;
    }
    constexpr unsigned kRight = 1, kLeft = 0;  // the faces of x
    const bool turns = (doubled_faces(left) >> kRight & 1) && (doubled_faces(right) >> kLeft & 1);
    const SurfaceLoops a = surface_loops(left, turns ? 1u << kRight : 0);
    const SurfaceLoops b = surface_loops(right, turns ? 1u << kLeft : 0);
    std::map<std::array<int, 2>, int> joined;
    for (int edge = 4; edge < 12; ++edge) {
      // Edges along y at x = 1 of the left cube are those at x = 0 of the right one.
      const int axis = edge / 4, x_bit = axis == 1 ? 2 : 1;
      if (!(edge % 4 & x_bit)) continue;
      const int at_left = edge, at_right = edge - x_bit;
      const int i = a.of_edge[static_cast<std::size_t>(at_left)];
      const int j = b.of_edge[static_cast<std::size_t>(at_right)];
      ASSERT_EQ(i >= 0, j >= 0);
      if (i >= 0) ++joined[{i, j}];
    }
    for (const auto& [pair, crossings] : joined) EXPECT_EQ(crossings, 2) << corners;
  }
}

}  // namespace
}  // namespace burnish
