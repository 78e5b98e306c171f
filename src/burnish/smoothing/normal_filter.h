#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/face_geometry.h"

// A joint bilateral filter over face normals:
//     n_i' = K sum_j A_j exp(-|c_i - c_j|^2 / (2 sigma_c^2)) exp(-|g_i - g_j|^2 / (2 sigma_s^2))
//     n_j
// over the rows of an adjacency, where K makes the length 1. With guidance g = n it is the filter
// of Zheng et al. 2011, with others the guided one of Zhang et al. 2015. Not part of the library's
// interface.
namespace burnish {

/// The factors of every entry of `neighbours` that stay while the faces do:
/// A_j exp(-|c_i - c_j|^2 / (2 sigma_c^2)), sigma_c in units of FaceSurface. `weights` is made as
/// long as there are entries. O(entries). False where cancelled.
[[nodiscard]] bool near_weights(const Context& context, const Adjacency& neighbours,
                                const FaceGeometry& faces, float sigma_c,
                                std::vector<float>& weights);

/// One pass. `weights`: near_weights. Without guidance (empty) the second factor is 1, which is
/// plain diffusion; sigma_s is the width of a difference of unit vectors. A normal stays as it is
/// where the sum has no direction; areas (w) stay. `filtered` is another array than `normals` and
/// is made as long. O(entries). False where cancelled.
[[nodiscard]] bool filter_normals(const Context& context, const Adjacency& neighbours,
                                  std::span<const float> weights, std::span<const Quad> guidance,
                                  float sigma_s, const FaceNormals& normals, FaceNormals& filtered);

}  // namespace burnish
