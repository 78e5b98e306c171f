#include "burnish/smoothing/l0.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "burnish/core/edges.h"
#include "burnish/smoothing/ring_mesh.h"
#include "burnish/smoothing/symmetric_solver.h"

namespace burnish {
namespace {

constexpr double kFirstBeta = 1e-3;
constexpr int kSteps = 40;         // by sqrt(2) each, until beta has reached 1e3
constexpr double kLargest = 1000;  // coefficient of an edge that says something

/// A linear expression in up to four vertices that is to become 0: an edge with its two triangles,
/// or a boundary vertex with its two neighbours along the boundary.
struct Expression {
  std::array<std::uint32_t, 4> vertices;
  std::size_t count;          ///< 4: of an edge, 3: of a boundary vertex
  std::array<double, 4> d{};  ///< the coefficients of D
};

/// Those of R, for edges.
constexpr std::array<double, 4> kEven{1, -1, 1, -1};

Vec3d value(const Expression& row, const std::array<double, 4>& coefficients,
            const std::vector<Vec3d>& p) {
  Vec3d sum;
  for (std::size_t i = 0; i < row.count; ++i) sum += coefficients[i] * p[row.vertices[i]];
  return sum;
}

void weigh_edge(Expression& row, const std::vector<Vec3d>& p) {
  const Vec3d &p1 = p[row.vertices[0]], &p2 = p[row.vertices[1]], &p3 = p[row.vertices[2]],
              &p4 = p[row.vertices[3]];
  const double a = norm(cross(p2 - p1, p3 - p1)), b = norm(cross(p3 - p1, p4 - p1));
  const double sum = a + b, square = squared_norm(p3 - p1);
  const double scale = square * sum;
  if (!(scale > 0)) {
    row.d = {};
    return;
  }
  row.d = {(a * dot(p4 - p3, p3 - p1) + b * dot(p1 - p3, p3 - p2)) / scale, b / sum,
           (a * dot(p3 - p1, p1 - p4) + b * dot(p2 - p1, p1 - p3)) / scale, a / sum};
  if (!(std::abs(row.d[0]) < kLargest && std::abs(row.d[2]) < kLargest)) row.d = {};
}

/// The point of the line between the neighbours that divides it as the vertex divides the way.
void weigh_corner(Expression& row, const std::vector<Vec3d>& p) {
  const double a = norm(p[row.vertices[1]] - p[row.vertices[0]]);
  const double b = norm(p[row.vertices[2]] - p[row.vertices[0]]);
  row.d = a + b > 0 ? std::array{-1., b / (a + b), a / (a + b), 0.} : std::array<double, 4>{};
}

/// The edges with two triangles: 1 and 3 are their ends, 2 and 4 the corners opposite.
std::vector<Expression> edge_expressions(const TriangleMesh& mesh) {
  struct Half {
    std::uint32_t low, high, opposite;
    bool operator<(const Half& b) const {
      return std::tie(low, high, opposite) < std::tie(b.low, b.high, b.opposite);
    }
    bool same_edge(const Half& b) const { return low == b.low && high == b.high; }
  };
  std::vector<Half> halves;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) continue;
    halves.push_back({std::min(a, b), std::max(a, b), c});
    halves.push_back({std::min(b, c), std::max(b, c), a});
    halves.push_back({std::min(c, a), std::max(c, a), b});
  }
  std::sort(halves.begin(), halves.end());
  std::vector<Expression> rows;
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t end = i + 1;
    while (end < halves.size() && halves[end].same_edge(halves[i])) ++end;
    const bool pair = end - i == 2 && halves[i].opposite != halves[i + 1].opposite;
    if (pair) {
      rows.push_back(
          {{halves[i].low, halves[i].opposite, halves[i].high, halves[i + 1].opposite}, 4});
    }
    i = end;
  }
  return rows;
}

/// The boundary vertices between two others.
void add_corner_expressions(const TriangleMesh& mesh, std::vector<Expression>& rows) {
  const Adjacency along = boundary_neighbours(mesh);
  for (std::uint32_t v = 0; v < along.size(); ++v) {
    const auto ends = along.row(v);
    if (ends.size() == 2) rows.push_back({{v, ends[0], ends[1], v}, 3});
  }
}

/// Of the angles between the normals at all edges, radians.
double mean_dihedral_angle(const std::vector<Expression>& rows, const std::vector<Vec3d>& p) {
  double sum = 0, count = 0;
  for (const auto& [v, size, d] : rows) {
    const Vec3d m = cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
    const Vec3d n = cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[0]]);
    if (m == Vec3d{} || n == Vec3d{}) continue;
    // The orders 1 2 3 and 1 3 4 turn the same way, so that the angle does not depend on how the
    // triangles are oriented.
    sum += std::atan2(norm(cross(m, n)), dot(m, n));
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// The quadratic problem in p for given D, d, alpha and beta, in displacements from p*.
class Problem {
 public:
  explicit Problem(const RingMesh& work) : first_(work.positions), unknown_(first_.size(), kNone) {
    for (std::uint32_t v = 0; v < first_.size(); ++v) {
      if (work.rings.row(v).empty()) continue;
      unknown_[v] = static_cast<std::uint32_t>(free_.size());
      free_.push_back(v);
    }
  }

  /// `d` has the wanted value of each expression.
  Result<void> solve(const std::vector<Expression>& rows, const std::vector<Vec3d>& d, double alpha,
                     double beta, std::vector<Vec3d>& p, const Context& context) {
    matrix_.clear();
    std::vector<Vec3d> sides(free_.size());
    for (std::uint32_t i = 0; i < free_.size(); ++i) matrix_.push_back({i, i, 1});
    for (std::size_t e = 0; e < rows.size(); ++e) {
      const Expression& row = rows[e];
      const Vec3d wanted = beta * (d[e] - value(row, row.d, first_));
      add(row, row.d, beta, wanted, sides);
      if (row.count == 4) add(row, kEven, alpha, -alpha * value(row, kEven, first_), sides);
    }
    if (auto solved = solver_.solve(matrix_, sides, context); !solved) return solved;
    for (std::size_t i = 0; i < free_.size(); ++i) p[free_[i]] = first_[free_[i]] + sides[i];
    return {};
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  void add(const Expression& row, const std::array<double, 4>& c, double weight,
           const Vec3d& wanted, std::vector<Vec3d>& sides) {
    for (std::size_t i = 0; i < row.count; ++i) {
      const std::uint32_t v = unknown_[row.vertices[i]];
      if (v == kNone) continue;
      sides[v] += c[i] * wanted;
      for (std::size_t k = 0; k <= i; ++k) {
        const std::uint32_t w = unknown_[row.vertices[k]];
        if (w != kNone) matrix_.push_back({v, w, weight * c[i] * c[k]});
      }
    }
  }

  std::vector<Vec3d> first_;
  std::vector<std::uint32_t> free_, unknown_;  ///< who is free; the number of each among them
  std::vector<MatrixTerm> matrix_;
  SymmetricSolver solver_;
};

}  // namespace

const Schema<L0Params>& L0Params::schema() {
  using P = L0Params;
  static const auto schema =
      Schema<P>()
          .real("lambda", &P::lambda, {.low = 0, .high = 1000},
                "price of an edge, in (mean edge length)^2 times the mean dihedral angle")
          .real("alpha", &P::alpha, {.low = 0, .high = 1000},
                "evenness of triangles at first, in mean dihedral angles")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_l0(TriangleMesh& mesh, const L0Params& params,
                                  const Context& context) {
  if (auto valid = L0Params::schema().check(params); !valid) return valid.error();
  Result<RingMesh> work = ring_mesh(mesh, params.boundary);
  if (!work) return work.error();
  std::vector<Vec3d> p = work->positions;
  std::vector<Expression> rows = edge_expressions(mesh);
  const double angle = mean_dihedral_angle(rows, p);
  if (params.boundary == BoundaryRule::along_boundary) add_corner_expressions(mesh, rows);
  const double length = mean_edge_length(mesh);
  const double lambda = params.lambda * length * length * angle;
  double alpha = params.alpha * angle, beta = kFirstBeta;

  Problem problem(*work);
  std::vector<Vec3d> d(rows.size());
  for (int step = 0; step < kSteps; ++step) {
    const Context share = context.part(step / double{kSteps}, (step + 1) / double{kSteps});
    if (share.cancelled()) return cancelled();
    for (std::size_t e = 0; e < rows.size(); ++e) {
      rows[e].count == 4 ? weigh_edge(rows[e], p) : weigh_corner(rows[e], p);
      const Vec3d bend = value(rows[e], rows[e].d, p);
      d[e] = beta * squared_norm(bend) <= lambda ? Vec3d{} : bend;
    }
    if (auto solved = problem.solve(rows, d, alpha, beta, p, share); !solved) {
      return solved.error();
    }
    alpha /= 2;
    beta *= std::numbers::sqrt2;
  }
  for (std::size_t v = 0; v < p.size(); ++v) {
    const Vec3d& first = work->positions[v];
    p[v] = first + work->follow(v) * (p[v] - first);
  }
  return commit_positions(mesh, p, kSteps, context);
}

}  // namespace burnish
