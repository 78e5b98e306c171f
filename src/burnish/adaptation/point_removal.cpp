#include "burnish/adaptation/point_removal.h"

#include <limits>
#include <utility>

#include "burnish/adaptation/decimation.h"

namespace burnish {

Result<SimplifyReport> simplify_point_removal(TriangleMesh& mesh, const SimplifyParams& params,
                                              const Context& context) {
  return simplify(mesh, Placement::endpoint, params, context);
}

Result<std::vector<Removal>> removal_log(const TriangleMesh& mesh, std::size_t target,
                                         const Context& context) {
  if (auto sound = check_decimated(mesh); !sound) return sound.error();
  std::vector<float> limits(mesh.triangles.size(), std::numeric_limits<float>::infinity());
  Decimation decimation(mesh, Placement::endpoint, DeviationBound(std::move(limits)), context);
  if (auto done = decimation.run_by_error(target, context); !done) return done.error();
  return decimation.take_removals();
}

}  // namespace burnish
