#include "burnish/smoothing/bilateral.h"

#include <gtest/gtest.h>

#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "support/bunny.h"
#include "support/face_filter_reference.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using namespace test;

/// Fleishman et al. 2003 as printed; every vertex free.
std::vector<Vec3d> plain_bilateral(const TriangleMesh& mesh, const BilateralParams& params) {
  std::vector<Vec3d> points = doubles(mesh.positions);
  FaceSets ring(points.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      for (const std::uint32_t w : t) {
        if (v != w) ring[v].insert(w);
      }
    }
  }
  double edge = 0, edges = 0;
  for (std::size_t v = 0; v < ring.size(); ++v) {
    for (const std::size_t w : ring[v]) edge += norm(points[v] - points[w]), ++edges;
  }
  const double sigma_c = params.relative_width * edge / edges;
  FaceSets around;
  for (std::size_t v = 0; v < ring.size(); ++v) {
    around.push_back(plain_ball(v, 2 * sigma_c, points, ring));
  }
  const auto vertex_normals_now = [&] {
    const PlainFaces faces = plain_faces(mesh.triangles, points);
    std::vector<Vec3d> normals(points.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      for (const std::uint32_t v :
           std::set<std::uint32_t>(mesh.triangles[f].begin(), mesh.triangles[f].end())) {
        normals[v] += faces.areas[f] * faces.normals[f];
      }
    }
    for (Vec3d& n : normals) n = normalized(n);
    return normals;
  };
  std::vector<double> deviations;
  const std::vector<Vec3d> first_normals = vertex_normals_now();
  for (std::size_t v = 0; v < ring.size(); ++v) {
    if (around[v].size() < 2) continue;
    double sum = 0, squares = 0;
    for (const std::size_t q : around[v]) {
      const double h = dot(first_normals[v], points[q] - points[v]);
      sum += h;
      squares += h * h;
    }
    const auto n = static_cast<double>(around[v].size());
    deviations.push_back(std::sqrt(squares / n - sum / n * sum / n));
  }
  std::sort(deviations.begin(), deviations.end());
  const double sigma_s = deviations[deviations.size() / 2];
  for (int pass = 0; pass < params.iterations; ++pass) {
    const std::vector<Vec3d> old = points, normals = vertex_normals_now();
    for (std::size_t v = 0; v < ring.size(); ++v) {
      double sum = 0, weights = 0;
      for (const std::size_t q : around[v]) {
        const double h = dot(normals[v], old[q] - old[v]);
        const double weight =
            gaussian_weight(norm(old[q] - old[v]), sigma_c) * gaussian_weight(h, sigma_s);
        sum += weight * h;
        weights += weight;
      }
      points[v] += sum / weights * normals[v];
    }
  }
  return points;
}

TEST(Bilateral, EqualsAPlainEvaluationOnAnyMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    for (const TriangleMesh& before : {random_mesh(60, 70, seed), random_mesh(300, 200, seed),
                                       with_noise(make_sphere(0.7, 3), 0.02, seed),
                                       with_noise(make_grid(12, 9, 0.1), 0.03, seed)}) {
      const BilateralParams params{.boundary = BoundaryRule::free};
      TriangleMesh mesh = before;
      ASSERT_TRUE(smooth_bilateral(mesh, params));
      EXPECT_LT(farthest(mesh.positions, plain_bilateral(before, params)),
                1e-6 * diagonal(before.positions));
    }
  }
}

TEST(Bilateral, EqualsAPlainEvaluationOnTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = read_bunny(path);
  const BilateralParams params{.boundary = BoundaryRule::free};
  TriangleMesh mesh = bunny;
  ASSERT_TRUE(smooth_bilateral(mesh, params));
  EXPECT_LT(farthest(mesh.positions, plain_bilateral(bunny, params)),
            1e-6 * diagonal(bunny.positions));
}

}  // namespace
}  // namespace burnish
