#include <gtest/gtest.h>

#include <cmath>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/exp_of_negative.h"
#include "burnish/smoothing/face_neighbours.h"
#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/normal_filter.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

TEST(ExpOfNegative, IsTheExponential) {
  for (double x = 0; x < 87; x += 0.00371) {
    const Quad four = exp_of_negative(Quad(static_cast<float>(x), 0, 1, 200));
    const double exact = std::exp(-static_cast<double>(static_cast<float>(x)));
    // x / log 2 is rounded to 24 bits, and so is the factor.
    EXPECT_NEAR(four[0] / exact, 1, 3e-7 + (0x1p-24 + 0.3 * 0x1p-24) * x) << x;
    EXPECT_EQ(four[1], 1);
    EXPECT_NEAR(four[2], std::exp(-1.), 1e-7);
    EXPECT_EQ(four[3], 0);
  }
}

TEST(FaceNeighbours, ShareAnEdgeOrAVertex) {
  const TriangleMesh grid = make_grid(5, 5);
  const auto work = begin_face_work(grid, {});
  ASSERT_TRUE(work);
  const std::uint32_t f = 24;  // in the middle: lower triangle of cell (2, 2)
  EXPECT_EQ(work->edge_neighbours.row(f).size(), 3u);
  EXPECT_EQ(work->vertex_neighbours.row(f).size(), 13u);  // with itself
  for (const std::uint32_t g : work->vertex_neighbours.row(f)) {
    const auto back = work->vertex_neighbours.row(g);
    EXPECT_TRUE(std::binary_search(back.begin(), back.end(), f));
  }
}

TEST(ConnectedWithin, LeavesOutTheOtherSideOfAThinWall) {
  // Two sheets, nearer to each other than their vertices are.
  TriangleMesh sheets = make_grid(6, 6);
  const auto own = static_cast<std::uint32_t>(sheets.positions.size());
  const std::size_t faces = sheets.triangles.size();
  for (std::uint32_t v = 0; v < own; ++v) {
    sheets.positions.push_back(sheets.positions[v] + Vec3f{0, 0, 0.1f});
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto [a, b, c] = sheets.triangles[f];
    sheets.triangles.push_back({a + own, c + own, b + own});
  }
  const auto work = begin_face_work(sheets, {});
  ASSERT_TRUE(work);
  FaceGeometry geometry;
  ASSERT_TRUE(measure_faces({}, sheets.triangles, work->surface.positions, geometry));
  Adjacency balls;
  ASSERT_TRUE(connected_within({}, 3, geometry.centroids, work->vertex_neighbours, balls));
  for (std::size_t f = 0; f < sheets.triangles.size(); ++f) {
    std::size_t expected = 0;
    for (std::size_t g = 0; g < sheets.triangles.size(); ++g) {
      const Quad away = geometry.centroids[g] - geometry.centroids[f];
      expected += (f < faces) == (g < faces) && dot3(away, away) < 9;
    }
    EXPECT_EQ(balls.row(f).size(), expected);
    for (const std::uint32_t g : balls.row(f)) EXPECT_EQ(g < faces, f < faces);
  }
}

TEST(FilterNormals, WithoutGuidanceIsDiffusion) {
  const TriangleMesh sphere = test::with_noise(make_sphere(1, 2), 0.05, 1);
  const auto work = begin_face_work(sphere, {});
  ASSERT_TRUE(work);
  FaceGeometry faces;
  ASSERT_TRUE(measure_faces({}, sphere.triangles, work->surface.positions, faces));
  const Adjacency& around = work->vertex_neighbours;
  std::vector<float> weights;
  ASSERT_TRUE(near_weights({}, around, faces, 1, weights));
  FaceNormals plain, wide;
  ASSERT_TRUE(filter_normals({}, around, weights, {}, 1, faces.normals, plain));
  ASSERT_TRUE(filter_normals({}, around, weights, faces.normals, 1e4f, faces.normals, wide));
  for (std::size_t f = 0; f < plain.size(); ++f) {
    EXPECT_LT(norm(Vec3d(plain[f].xyz()) - Vec3d(wide[f].xyz())), 5e-7);
    EXPECT_NEAR(dot3(plain[f], plain[f]), 1, 3e-7);
    EXPECT_EQ(plain[f].w(), faces.normals[f].w());
  }
}

}  // namespace
}  // namespace burnish
