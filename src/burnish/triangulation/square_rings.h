#pragma once

#include <array>
#include <cstdint>

#include "burnish/triangulation/pixel_squares.h"

// Which pixels around a pixel are its neighbours, from the four squares that it is a corner of.
namespace burnish {

namespace square_rings_detail {

/// A count of two bits for each of the eight places around a pixel, see core/grid_rings.h.
using Counts = std::uint16_t;

constexpr Counts one(int place) {
  return static_cast<Counts>(1 << (2 * place));
}

/// How many triangles of a square lie on the edges from one of its corners to the three others,
/// which are at these places around it. Corners and places in the order a, b, c, d.
constexpr std::array<Counts, 32> edge_counts(std::size_t corner, std::array<int, 4> places) {
  constexpr std::size_t a = 0, b = 1, c = 2, d = 3;
  struct Cut {
    Square has;
    bool rising;
    std::array<std::size_t, 3> corners;
  };
  constexpr Cut cuts[] = {
      {kC, false, {a, c, d}}, {kB, false, {a, d, b}}, {kA, true, {a, c, b}}, {kD, true, {b, c, d}}};
  std::array<Counts, 32> table{};
  for (std::size_t square = 0; square < table.size(); ++square) {
    for (const Cut& cut : cuts) {
      const bool is_there = (square & cut.has) != 0 && ((square & kRising) != 0) == cut.rising;
      const auto& [p, q, r] = cut.corners;
      if (!is_there || (p != corner && q != corner && r != corner)) continue;
      for (const std::size_t other : {p, q, r}) {
        if (other != corner)
          table[square] = static_cast<Counts>(table[square] + one(places[other]));
      }
    }
  }
  return table;
}

inline constexpr auto kAsA = edge_counts(0, {-1, 4, 6, 7});
inline constexpr auto kAsB = edge_counts(1, {3, -1, 5, 6});
inline constexpr auto kAsC = edge_counts(2, {1, 2, -1, 4});
inline constexpr auto kAsD = edge_counts(3, {0, 1, 3, -1});

}  // namespace square_rings_detail

/// The mask of the neighbours of a pixel that has these squares around it, its own with the pixel
/// in corner a; 0 where it is no vertex, or one of its edges has one triangle only.
inline std::uint8_t inner_ring(Square above_left, Square above, Square left, Square own) {
  using namespace square_rings_detail;
  const unsigned counts = kAsD[above_left] + kAsC[above] + kAsB[left] + kAsA[own];
  const unsigned inner = (counts & 0x5555) == 0 ? ~0u : 0;
  unsigned mask = counts >> 1 & 0x5555 & inner;
  mask = (mask | mask >> 1) & 0x3333;
  mask = (mask | mask >> 2) & 0x0f0f;
  return static_cast<std::uint8_t>(mask | mask >> 4);
}

}  // namespace burnish
