#pragma once

#include <optional>

#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct AreaAndVolume {
  double area = 0;  ///< m^2
  std::optional<double>
      volume;  ///< m^3, of closed and oriented meshes only; negative if inside out

  Facts facts() const;
};

/// Area: the sum over the triangles. Volume: 1/6 sum p0 . (p1 x p2), measured from the middle of
/// the mesh's bounding box, where it is most accurate. Errors: bad_geometry. O(#V + #T).
Result<AreaAndVolume> area_and_volume(const TriangleMesh& mesh);

}  // namespace burnish
