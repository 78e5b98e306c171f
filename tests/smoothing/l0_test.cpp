#include "burnish/smoothing/l0.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "burnish/smoothing/smoothing_weights.h"
#include "support/plain_smoothing.h"

namespace burnish {
namespace {

/// A row of D or R: a weighted sum of up to four vertices.
struct Row {
  std::array<std::uint32_t, 4> vertices{};
  std::array<double, 4> c{};
};

Vec3d times(const Row& row, const std::vector<Vec3d>& p) {
  Vec3d sum;
  for (std::size_t i = 0; i < 4; ++i) sum += row.c[i] * p[row.vertices[i]];
  return sum;
}

struct Wing {
  std::uint32_t v1, v2, v3, v4;
};

/// The edges that have two triangles, with all four vertices.
std::vector<Wing> wings(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> opposite;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) continue;
    for (const auto& [v, w, at] : {std::tuple{a, b, c}, std::tuple{b, c, a}, std::tuple{c, a, b}}) {
      opposite[{std::min(v, w), std::max(v, w)}].push_back(at);
    }
  }
  std::vector<Wing> result;
  for (const auto& [ends, tips] : opposite) {
    if (tips.size() != 2 || tips[0] == tips[1]) continue;
    result.push_back({ends.first, tips[0], ends.second, tips[1]});
  }
  return result;
}

/// The paper's area-based edge operator.
Row edge_operator(const Wing& wing, const std::vector<Vec3d>& p) {
  const Vec3d p1 = p[wing.v1], p2 = p[wing.v2], p3 = p[wing.v3], p4 = p[wing.v4];
  const double a123 = norm(cross(p2 - p1, p3 - p1)) / 2, a134 = norm(cross(p3 - p1, p4 - p1)) / 2;
  const double e2 = dot(p3 - p1, p3 - p1), a = a123 + a134;
  if (a == 0 || e2 == 0) return {};
  const double c1 = (a123 * dot(p4 - p3, p3 - p1) + a134 * dot(p1 - p3, p3 - p2)) / (e2 * a);
  const double c3 = (a123 * dot(p3 - p1, p1 - p4) + a134 * dot(p2 - p1, p1 - p3)) / (e2 * a);
  if (std::abs(c1) >= 1000 || std::abs(c3) >= 1000) return {};
  return {{wing.v1, wing.v2, wing.v3, wing.v4}, {c1, a134 / a, c3, a123 / a}};
}

/// Minimises |p - p*|^2 + sum of weight |row p - target|^2 over the free vertices, starting from p,
/// by conjugate gradients on the gradient as it is, row by row.
struct Term {
  Row row;
  double weight;
  Vec3d target;
};
void minimise(std::vector<Vec3d>& p, const std::vector<Vec3d>& first, const std::vector<bool>& free,
              const std::vector<Term>& terms) {
  const auto apply = [&](const std::vector<Vec3d>& x) {
    std::vector<Vec3d> result = x;
    for (const Term& term : terms) {
      const Vec3d value = term.weight * times(term.row, x);
      for (std::size_t i = 0; i < 4; ++i) result[term.row.vertices[i]] += term.row.c[i] * value;
    }
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (!free[v]) result[v] = {};
    }
    return result;
  };
  const auto product = [](const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += dot(a[v], b[v]);
    return sum;
  };
  std::vector<double> diagonal(p.size(), 1);
  std::vector<Vec3d> residual(p.size());
  for (std::size_t v = 0; v < p.size(); ++v) residual[v] = first[v] - p[v];
  for (const Term& term : terms) {
    const Vec3d value = term.weight * (term.target - times(term.row, p));
    for (std::size_t i = 0; i < 4; ++i) {
      const double c = term.row.c[i];
      residual[term.row.vertices[i]] += c * value;
      diagonal[term.row.vertices[i]] += term.weight * c * c;
    }
  }
  const auto precondition = [&](std::vector<Vec3d> x) {
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = free[v] ? x[v] / diagonal[v] : Vec3d{};
    return x;
  };
  std::vector<Vec3d> step = precondition(residual), scaled = step;
  double size = product(residual, scaled);
  for (int i = 0; i < 20000 && size > 1e-22; ++i) {
    const std::vector<Vec3d> image = apply(step);
    const double length = size / product(step, image);
    for (std::size_t v = 0; v < p.size(); ++v) {
      p[v] += length * step[v];
      residual[v] -= length * image[v];
    }
    scaled = precondition(residual);
    const double next = product(residual, scaled);
    for (std::size_t v = 0; v < p.size(); ++v) step[v] = scaled[v] + next / size * step[v];
    size = next;
  }
}

std::vector<Vec3d> plain_l0(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const test::PlainRings all = test::plain_rings(mesh, BoundaryRule::free);
  const test::PlainRings inner = test::plain_rings(mesh, BoundaryRule::fixed);
  const std::vector<Vec3d> first = test::plain_positions(mesh);
  std::vector<bool> free(first.size());
  double length = 0, links = 0;
  for (std::size_t v = 0; v < first.size(); ++v) {
    free[v] = !rings[v].empty();
    for (const std::uint32_t w : all[v]) length += norm(first[w] - first[v]), links += 1;
  }
  length /= links;
  const std::vector<Wing> edges = wings(mesh);
  double gamma = 0;
  for (const auto& [v1, v2, v3, v4] : edges) {
    const Vec3d m = normalized(cross(first[v2] - first[v1], first[v3] - first[v1]));
    const Vec3d n = normalized(cross(first[v3] - first[v1], first[v4] - first[v1]));
    gamma += 2 * std::atan2(norm(m - n), norm(m + n)) / static_cast<double>(edges.size());
  }
  const double lambda = 0.2 * length * length * gamma;

  std::vector<Vec3d> p = first;
  double alpha = 0.1 * gamma;
  for (double beta = 1e-3; beta < 1e3; beta *= std::sqrt(2.0), alpha /= 2) {
    std::vector<Term> terms;
    for (const Wing& wing : edges) {
      const Row row = edge_operator(wing, p);
      const Vec3d bend = times(row, p);
      terms.push_back({row, beta, dot(bend, bend) <= lambda / beta ? Vec3d{} : bend});
      terms.push_back({{{wing.v1, wing.v2, wing.v3, wing.v4}, {1, -1, 1, -1}}, alpha, Vec3d{}});
    }
    for (std::uint32_t v = 0; v < p.size(); ++v) {
      if (rule != BoundaryRule::along_boundary) continue;
      if (rings[v].size() != 2 || !inner[v].empty()) continue;
      const std::uint32_t a = *rings[v].begin(), b = *rings[v].rbegin();
      const double x = norm(p[a] - p[v]), y = norm(p[b] - p[v]);
      const Row row{{v, a, b, v}, {-1, y / (x + y), x / (x + y), 0}};
      const Vec3d bend = times(row, p);
      terms.push_back({row, beta, dot(bend, bend) <= lambda / beta ? Vec3d{} : bend});
    }
    minimise(p, first, free, terms);
  }
  return p;
}

auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_l0(mesh, {.boundary = rule});
}

TEST(L0, IsAsThePapersFormula) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    test::expect_as_plain(test::random_mesh(30, 40, seed), smooth, plain_l0);
    test::expect_as_plain(test::with_noise(make_sphere(0.7, 2), 0.03, seed), smooth, plain_l0);
    test::expect_as_plain(test::with_noise(make_grid(8, 7, 0.1), 0.02, seed), smooth, plain_l0);
  }
}

/// The small bunny, which is closed: the large one would take half a minute.
TEST(L0, IsAsThePapersFormulaOnTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bunny_3485v.off");
  std::ifstream file(path);
  std::string off;
  std::size_t vertices = 0, faces = 0, ignored = 0;
  file >> off >> vertices >> faces >> ignored;
  TriangleMesh mesh;
  mesh.positions.resize(vertices);
  mesh.triangles.resize(faces);
  for (Vec3f& p : mesh.positions) file >> p.x >> p.y >> p.z;
  for (Triangle& t : mesh.triangles) file >> ignored >> t[0] >> t[1] >> t[2];
  ASSERT_TRUE(file);
  const std::vector<Vec3d> expected = plain_l0(mesh, BoundaryRule::fixed);
  const double reach = 1e-6 * test::diagonal(mesh);
  ASSERT_TRUE(smooth_l0(mesh));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    ASSERT_LE(norm(Vec3d(mesh.positions[v]) - expected[v]), reach);
  }
}

TEST(L0, FlattensTheFacesOfANoisyCubeAndKeepsItsEdges) {
  const TriangleMesh clean = make_box({1, 1, 1}, 10);
  TriangleMesh mesh = test::with_noise(clean, 0.015, 3);
  const auto error = [&](const TriangleMesh& now) {
    double sum = 0;
    for (std::size_t t = 0; t < now.triangles.size(); ++t) {
      const Vec3d m = normalized(area_vector(now, t)), n = normalized(area_vector(clean, t));
      sum += 2 * std::atan2(norm(m - n), norm(m + n));
    }
    return sum / static_cast<double>(now.triangles.size());
  };
  const double before = error(mesh);
  EXPECT_GT(before, 0.15);
  ASSERT_TRUE(smooth_l0(mesh));
  EXPECT_LT(error(mesh), 0.1 * before);
  // Only edges along the cube's own edges are bent: by 90 degrees.
  std::size_t bent = 0;
  for (const auto& [v1, v2, v3, v4] : wings(mesh)) {
    const std::vector<Vec3d> p = test::plain_positions(mesh);
    const Vec3d m = normalized(cross(p[v2] - p[v1], p[v3] - p[v1]));
    const Vec3d n = normalized(cross(p[v3] - p[v1], p[v4] - p[v1]));
    const double angle = 2 * std::atan2(norm(m - n), norm(m + n));
    bent += angle > 0.05;
  }
  EXPECT_NEAR(static_cast<double>(bent), 12 * 10, 12);
}

TEST(L0, PinsVerticesOfWeightZeroAndMovesOthersByTheirShare) {
  TriangleMesh mesh = test::with_noise(make_box({1, 1, 1}, 4), 0.02, 3);
  std::vector<float> weights(mesh.positions.size(), 1);
  weights[7] = weights[20] = 0;
  weights[30] = 0.1f;
  mesh.attributes.channels = {{std::string(kSmoothingWeight), weights}};
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_l0(mesh));
  EXPECT_EQ(mesh.positions[7], before.positions[7]);
  EXPECT_EQ(mesh.positions[20], before.positions[20]);
  // Vertex 30 is on a face of its own, far from the two: they change its move by little.
  TriangleMesh free = before;
  free.attributes.channels.clear();
  ASSERT_TRUE(smooth_l0(free));
  const auto move = [&](const TriangleMesh& now) {
    return norm(Vec3d(now.positions[30]) - Vec3d(before.positions[30]));
  };
  EXPECT_NEAR(move(mesh), 0.1 * move(free), 0.05 * move(free));
}

TEST(L0, SurvivesTrianglesWithoutArea) {
  for (const BoundaryRule rule :
       {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
    TriangleMesh mesh = make_grid(6, 6);
    for (Vec3f& p : mesh.positions) p.y = 0;  // all on a line, many on top of each other
    ASSERT_TRUE(smooth_l0(mesh, {.boundary = rule}));
    EXPECT_TRUE(check(mesh));
    for (Vec3f& p : mesh.positions) p = {1, 2, 3};
    const TriangleMesh point = mesh;
    ASSERT_TRUE(smooth_l0(mesh, {.boundary = rule}));
    EXPECT_EQ(mesh, point);
  }
}

}  // namespace
}  // namespace burnish
