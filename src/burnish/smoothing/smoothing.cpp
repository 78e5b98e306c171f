#include "burnish/smoothing/smoothing.h"

#include <algorithm>
#include <cmath>

namespace burnish {

std::vector<std::pair<std::string, BoundaryRule>> boundary_rule_names() {
  return {{"fixed", BoundaryRule::fixed},
          {"along_boundary", BoundaryRule::along_boundary},
          {"free", BoundaryRule::free}};
}

Facts SmoothingReport::facts() const {
  return {{"iterations", static_cast<double>(iterations), ""},
          {"moved_vertices", static_cast<double>(moved_vertices), ""},
          {"rms_move", rms_move, "m"},
          {"max_move", max_move, "m"}};
}

SmoothingReport report_moves(const std::vector<Vec3f>& before, const TriangleMesh& after,
                             int iterations) {
  SmoothingReport report{.iterations = iterations};
  double sum = 0, largest = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const double moved = squared_norm(Vec3d(after.positions[v]) - Vec3d(before[v]));
    report.moved_vertices += moved > 0;
    sum += moved;
    largest = std::max(largest, moved);
  }
  report.rms_move = before.empty() ? 0 : std::sqrt(sum / static_cast<double>(before.size()));
  report.max_move = std::sqrt(largest);
  return report;
}

}  // namespace burnish
