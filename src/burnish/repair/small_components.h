#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct SmallComponentsParams {
  int min_triangles = 50;     ///< a component with fewer goes, unless it is the largest
  bool largest_only = false;  ///< keep nothing but the component with the most triangles

  static const Schema<SmallComponentsParams>& schema();
};

/// What a repair did.
struct RepairReport {
  std::size_t components = 0;  ///< before
  std::size_t removed_components = 0;
  std::size_t removed_triangles = 0;
  std::size_t removed_vertices = 0;

  Facts facts() const;
};

/// Removes the components (triangles joined across edges) that are too small to be anything but
/// specks of noise, but never the largest, with the vertices that nothing uses then. Of components
/// of equal size the one with the first triangle counts as larger. Order is kept. O(#V + #T log
/// #T). Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<RepairReport> remove_small_components(TriangleMesh& mesh,
                                             const SmallComponentsParams& params = {},
                                             const Context& context = {});

}  // namespace burnish
