#pragma once

#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/pipeline/record.h"
#include "burnish/report/table.h"

namespace burnish {

/// Counts, extent, area and how each phase's mesh hangs together.
Table topology_table(const Record& record);

/// Where vertices and triangles come from; sigma and observations of the vertices. No rows where no
/// phase says anything.
Table trust_table(const Record& record);

/// Angles of all triangles (degrees) and lengths of all their edges (m); an edge counts once for
/// each of its triangles. Triangles without an area have no angles.
struct TriangleShapes {
  std::vector<float> angles, edges;
};
TriangleShapes triangle_shapes(const TriangleMesh& mesh);

/// What measure/triangle_quality.h says of each phase. Errors: bad_geometry, cancelled.
Result<Table> quality_table(const Record& record, const Context& context);

}  // namespace burnish
