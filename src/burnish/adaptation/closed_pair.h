#pragma once

#include "burnish/core/edge_table.h"

namespace burnish {

/// Whether `edge` belongs to a closed surface of just two triangles, which have the same three
/// corners. Cut in parts, the two would have the edges between these in common, and the surface
/// would not be manifold any more.
bool in_closed_pair(const EdgeTable& edges, std::uint32_t edge);

}  // namespace burnish
