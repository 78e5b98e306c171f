#include "burnish/adaptation/quadric_collapse.h"

namespace burnish {

Result<SimplifyReport> simplify_quadric(TriangleMesh& mesh, const SimplifyParams& params,
                                        const Context& context) {
  return simplify(mesh, Placement::optimal, params, context);
}

}  // namespace burnish
