#include "burnish/adaptation/closed_pair.h"

namespace burnish {

bool in_closed_pair(const EdgeTable& edges, std::uint32_t edge) {
  const auto sides = edges.sides(edge);
  if (sides.size() != 2 || sides[0] / 3 == sides[1] / 3) return false;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t beside = edges.of_side(sides[0] - sides[0] % 3 + i);
    if (beside == kNoEdge) return false;
    const auto others = edges.sides(beside);
    // Sides rise, so that of the same two triangles they come in the same order.
    if (others.size() != 2 || others[0] / 3 != sides[0] / 3 || others[1] / 3 != sides[1] / 3) {
      return false;
    }
  }
  return true;
}

}  // namespace burnish
