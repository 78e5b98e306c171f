#pragma once

#include <string>
#include <utility>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What happens at vertices on an open boundary (or on a non-manifold edge).
enum class BoundaryRule {
  fixed,           ///< they stay where they are
  along_boundary,  ///< their ring is their neighbours along the boundary; corners get rounder
  free,            ///< they move like all others; boundaries creep inwards
};

/// The rules as options call them.
std::vector<std::pair<std::string, BoundaryRule>> boundary_rule_names();

/// What a smoothing did.
struct SmoothingReport {
  int iterations = 0;              ///< passes made
  std::size_t moved_vertices = 0;  ///< that are not where they were
  double rms_move = 0;             ///< over all vertices, m
  double max_move = 0;             ///< m

  Facts facts() const;
};

/// The report on a mesh whose positions were `before`.
SmoothingReport report_moves(const std::vector<Vec3f>& before, const TriangleMesh& after,
                             int iterations);

}  // namespace burnish
