#pragma once

#include <memory>
#include <numbers>

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/grid_rings.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

struct OrganizedParams {
  double max_jump = 3.5;  ///< in standard deviations of the difference of two ranges
  double max_angle = 80 * std::numbers::pi / 180;
  double assumed_noise = 1.425e-3;

  static const Schema<OrganizedParams>& schema();
};

/// The surface that one depth image sees: each square of four neighbouring pixels gives two
/// triangles, or one where a corner has no measurement.
///
/// An edge is cut where the two ranges (distances from the viewpoint) differ by more than noise and
/// slope explain: by more than `max_jump` times sqrt(sigma_a^2 + sigma_b^2) (3.5: a step of 5 sigma
/// between equals), and along an edge steeper than a surface seen at `max_angle` between normal and
/// ray. Points without sigma are taken to have `assumed_noise` * range^2 (the default is Kinect
/// v1's, Khoshelham and Elberink 2012). A square is split by its shorter uncut diagonal; of two
/// equally long ones by that from (column, row) to (column + 1, row + 1).
///
/// Triangles are counter-clockwise seen from the viewpoint (from the origin where the cloud names
/// none); pixels that no triangle uses are left out; attributes are carried. Every edge has one or
/// two triangles and all are oriented alike; two patches may touch in a vertex. O(#P).
/// Errors: invalid_argument; bad_geometry where the cloud has no grid; cancelled.
Result<Triangulation> triangulate_organized(const PointCloud& cloud,
                                            const OrganizedParams& params = {},
                                            const Context& context = {});

/// The same for a camera that runs: keeps what it works with from one cloud to the next.
class OrganizedTriangulator {
 public:
  OrganizedTriangulator();
  ~OrganizedTriangulator();
  OrganizedTriangulator(OrganizedTriangulator&&) noexcept;
  OrganizedTriangulator& operator=(OrganizedTriangulator&&) noexcept;

  /// Makes the positions, triangles and frame of `mesh` those of triangulate_organized(cloud,
  /// params, context); its attributes stay. With one thread nothing is allocated where the
  /// triangulator and the mesh have held a cloud of the same size before. Errors: those of
  /// triangulate_organized; `mesh` is then of no meaning.
  Result<void> triangulate(const PointCloud& cloud, const OrganizedParams& params,
                           const Context& context, TriangleMesh& mesh);

  /// Of the last mesh: the pixels that its vertices are, in their order.
  const std::vector<std::uint32_t>& pixels() const;

  /// Of the last mesh: the rings of its inner vertices. O(#pixels).
  void find_rings(GridRings& rings) const;

  class Workspace;  ///< not part of the interface

 private:
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace burnish
