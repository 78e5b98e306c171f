#include "burnish/smoothing/bilateral_normal.h"

#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"
#include "support/bunny.h"
#include "support/face_filter_reference.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using namespace test;

/// Zheng et al. 2011, eq. 3, over each face and those that share a vertex with it, then the
/// vertices.
std::vector<Vec3d> plain_bilateral_normal(const TriangleMesh& mesh,
                                          const BilateralNormalParams& params) {
  std::vector<Vec3d> points = doubles(mesh.positions);
  PlainFaces faces = plain_faces(mesh.triangles, points);
  const double sigma_c = plain_spacing(faces, faces_sharing(mesh.triangles, 2));
  FaceSets neighbours = faces_sharing(mesh.triangles, 1);
  for (std::size_t f = 0; f < neighbours.size(); ++f) neighbours[f].insert(f);
  for (int pass = 0; pass < params.iterations; ++pass) {
    const std::vector<Vec3d> old = faces.normals;
    for (std::size_t i = 0; i < old.size(); ++i) {
      Vec3d sum;
      for (const std::size_t j : neighbours[i]) {
        sum += faces.areas[j] *
               gaussian_weight(norm(faces.centroids[i] - faces.centroids[j]), sigma_c) *
               gaussian_weight(norm(old[i] - old[j]), params.sigma_s) * old[j];
      }
      if (norm(sum) > 0) faces.normals[i] = normalized(sum);
    }
  }
  plain_vertex_update(mesh.triangles, faces.normals,
                      {.passes = params.vertex_iterations,
                       .equalizing = params.equalizing,
                       .free_boundary = params.boundary == BoundaryRule::free},
                      points);
  return points;
}

TEST(BilateralNormal, EqualsAPlainEvaluationOnAnyMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    for (const TriangleMesh& before : {random_mesh(60, 70, seed), random_mesh(300, 200, seed),
                                       with_noise(make_sphere(0.7, 3), 0.02, seed),
                                       with_noise(make_grid(12, 9, 0.1), 0.03, seed)}) {
      for (const BoundaryRule rule : {BoundaryRule::fixed, BoundaryRule::free}) {
        const BilateralNormalParams params{.boundary = rule};
        TriangleMesh mesh = before;
        ASSERT_TRUE(smooth_bilateral_normal(mesh, params));
        EXPECT_LT(farthest(mesh.positions, plain_bilateral_normal(before, params)),
                  1e-6 * diagonal(before.positions));
      }
    }
  }
}

TEST(BilateralNormal, EqualsAPlainEvaluationOnTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = read_bunny(path);
  const BilateralNormalParams params{.iterations = 3, .vertex_iterations = 3};
  TriangleMesh mesh = bunny;
  ASSERT_TRUE(smooth_bilateral_normal(mesh, params));
  EXPECT_LT(farthest(mesh.positions, plain_bilateral_normal(bunny, params)),
            1e-6 * diagonal(bunny.positions));
}

}  // namespace
}  // namespace burnish
