#include "burnish/shapes/teapot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "burnish/core/disjoint_sets.h"
#include "burnish/core/topology.h"
#include "support/test_data.h"

namespace burnish {
namespace {

std::size_t components_by_vertices(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  std::size_t count = mesh.positions.size();
  for (const auto& [a, b, c] : mesh.triangles) {
    count -= sets.unite(a, b);
    count -= sets.unite(b, c);
  }
  return count;
}

TEST(Teapot, HasTheCountsOfThePapersModel) {
  const TriangleMesh mesh = make_teapot();
  EXPECT_EQ(mesh.positions.size(), 1177u);
  EXPECT_EQ(mesh.triangles.size(), 2256u);
  const Topology t = topology(mesh);
  EXPECT_EQ(t.boundary_edges, 96u);
  EXPECT_EQ(t.boundary_loops, 6u);  // rim, lid, two ends of the handle and two of the spout
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(t.unused_vertices, 0u);
  EXPECT_EQ(components_by_vertices(mesh), 3u);
  EXPECT_EQ(t.components,
            4u);  // across edges the handle is apart: it touches the body in one vertex
  EXPECT_EQ(t.non_manifold_vertices, 1u);
}

TEST(Teapot, EveryFinenessIsWeldedAndOriented) {
  for (const int cells : {2, 3, 5, 8, 16}) {
    SCOPED_TRACE(cells);
    const TriangleMesh mesh = make_teapot(cells);
    const Topology t = topology(mesh);
    const auto n = static_cast<std::size_t>(cells);
    EXPECT_EQ(mesh.triangles.size(), 64 * n * n - 8 * n);
    EXPECT_EQ(t.boundary_edges, 16 * n);
    EXPECT_TRUE(t.oriented());
  }
}

TEST(Teapot, IsOrientedOutwards) {
  const TriangleMesh mesh = make_teapot(12);
  double six_volumes = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_volumes +=
        dot(Vec3d(mesh.positions[a]), cross(Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])));
    // Whatever of the body is wider than the spout's root faces away from the axis.
    const Vec3d middle =
        (Vec3d(mesh.positions[a]) + Vec3d(mesh.positions[b]) + Vec3d(mesh.positions[c])) / 3.;
    if (middle.z < 0.2 || middle.z > 0.5 || std::abs(middle.x) > 1.5) continue;
    const Vec3d out{middle.x, middle.y, 0};
    const Vec3d area = cross(Vec3d(mesh.positions[b]) - Vec3d(mesh.positions[a]),
                             Vec3d(mesh.positions[c]) - Vec3d(mesh.positions[a]));
    EXPECT_GT(dot(area, out), 0);
  }
  EXPECT_GT(six_volumes, 0);
}

/// The triangles, each beginning with its smallest vertex, sorted.
std::vector<Triangle> in_order(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Teapot, IsThePapersModelTriangleByTriangle) {
  BURNISH_DATA_OR_SKIP(path, "teapot/teapot_zup_1177v_2256f_exact.obj");
  std::ifstream file(path);
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3d& p = points.emplace_back();
      words >> p.x >> p.y >> p.z;
    } else if (kind == "f") {
      Triangle& t = triangles.emplace_back();
      words >> t[0] >> t[1] >> t[2];
      for (std::uint32_t& v : t) --v;
    }
  }
  ASSERT_EQ(triangles.size(), 2256u);
  TriangleMesh mesh = make_teapot();
  std::vector<std::uint32_t> counterpart;
  for (const Vec3f& p : mesh.positions) {
    const auto distance = [&](const Vec3d& q) { return norm(Vec3d(p) - q); };
    const auto nearest =
        std::min_element(points.begin(), points.end(),
                         [&](const Vec3d& a, const Vec3d& b) { return distance(a) < distance(b); });
    EXPECT_LT(distance(*nearest), 4e-7);  // three coordinates below 4 rounded to float
    counterpart.push_back(static_cast<std::uint32_t>(nearest - points.begin()));
  }
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = counterpart[v];
  }
  EXPECT_EQ(in_order(mesh.triangles), in_order(triangles));
}

}  // namespace
}  // namespace burnish
