#pragma once

#include <span>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/face_geometry.h"

// Not part of the library's interface.
namespace burnish {

/// One pass of a joint bilateral filter over face normals:
///     n_i' = K sum_j A_j exp(-|c_i - c_j|^2 / (2 sigma_c^2)) exp(-|g_i - g_j|^2 / (2 sigma_s^2))
///     n_j
/// over the rows of `neighbours`, where K makes the length 1. With guidance g = n it is the
/// bilateral filter of Zheng et al. 2011 (eq. 3), with others the guided one of Zhang et al. 2015
/// (eq. 3); without any (empty) the second factor is 1, which is plain diffusion. A normal stays as
/// it is where the sum has no direction. Areas (w) stay. O(entries of `neighbours`).
struct NormalKernel {
  float sigma_c = 1;      ///< in units of FaceSurface
  float sigma_s = 0.35f;  ///< of a difference of unit vectors; not used without guidance
};

/// `filtered` is another array than `normals` and is made as long. False where cancelled.
[[nodiscard]] bool filter_normals(const Context& context, const Adjacency& neighbours,
                                  const std::vector<Quad>& centroids,
                                  std::span<const Quad> guidance, const NormalKernel& kernel,
                                  const FaceNormals& normals, FaceNormals& filtered);

}  // namespace burnish
