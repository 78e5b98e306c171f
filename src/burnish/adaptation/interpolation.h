#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The vertices that a new one is put between, each with the same part in it; one may be named
/// twice.
template <std::size_t N>
using Parents = std::array<std::uint32_t, N>;

/// Adds new vertices to the attributes of `count` old ones. A new vertex may be a parent of later
/// ones. Of each attribute that is there:
///   normals       the mean of the parents', of unit length
///   colors        the mean, rounded
///   sigma         the largest: a place in between is known no better than what it lies between
///   noise         of the parent with the largest deviation along its axis, of equal ones across it
///   observations  the smallest number
///   channels      of floats the mean, of integers (labels, flags) the smallest
/// origin is made where there is none (the old vertices were seen). The new ones are interpolated,
/// or invented where all their parents are. O(new vertices).
template <std::size_t N>
void append_interpolated(Attributes& attributes, std::size_t count,
                         std::span<const Parents<N>> vertices);

extern template void append_interpolated(Attributes&, std::size_t, std::span<const Parents<2>>);
extern template void append_interpolated(Attributes&, std::size_t, std::span<const Parents<3>>);

/// Gives the parts of each triangle what is known of it: those of triangle t are the new triangles
/// from first[t] to first[t + 1].
void inherit_attributes(TriangleAttributes& attributes, std::span<const std::uint32_t> first);

}  // namespace burnish
