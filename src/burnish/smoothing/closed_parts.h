#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The closed parts of a mesh, to be scaled back to their volume. Parts are what hangs together by
/// triangles; closed are those in which every edge has two triangles that run along it in opposite
/// directions.
class ClosedParts {
 public:
  /// Parts with a vertex for which `held` says true are left out.
  ClosedParts(const TriangleMesh& mesh, const std::vector<Vec3d>& positions,
              const std::vector<bool>& held);

  /// Scales each part about the mean of its vertices to the volume it had at first; parts whose
  /// volume has changed its sign stay.
  void restore(std::vector<Vec3d>& positions) const;

 private:
  struct Part {
    std::vector<std::uint32_t> vertices;
    std::vector<Triangle> triangles;
    double volume = 0;
  };
  std::vector<Part> parts_;
};

}  // namespace burnish
