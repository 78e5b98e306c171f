#pragma once

#include <span>

#include "burnish/adaptation/removal.h"
#include "burnish/core/attributes.h"

namespace burnish {

/// Lets the vertices that others are merged into say what is true of both. shares[k] is how far
/// from `into` (0) to `vertex` (1) the place of removal k lies; where it is 0 the vertex that stays
/// has not moved, and what is known of it stays as it is. Else, of each attribute that is there:
///   normals       between the two, of unit length
///   colors        between the two, rounded
///   sigma         the larger: a place in between is known no better than what it lies between
///   noise, observations, channels of integers   of the nearer
///   origin        the less trusted
///   channels of floats   between the two
/// O(removals).
void merge_attributes(Attributes& attributes, std::span<const Removal> removals,
                      std::span<const float> shares);

}  // namespace burnish
