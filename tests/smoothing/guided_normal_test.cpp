#include "burnish/smoothing/guided_normal.h"

#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"
#include "support/bunny.h"
#include "support/face_filter_reference.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using namespace test;

/// H of the patch around each face, and its area-mean normal (Zhang et al. 2015, section 3.2).
struct PlainPatches {
  std::vector<double> inconsistency;
  std::vector<Vec3d> mean;
};

PlainPatches plain_patches(const PlainFaces& faces, const FaceSets& members,
                           const FaceSets& across_edges) {
  PlainPatches patches;
  const auto difference = [&](std::size_t a, std::size_t b) {
    if (faces.areas[a] == 0 || faces.areas[b] == 0) return 0.;
    return norm(faces.normals[a] - faces.normals[b]);
  };
  for (std::size_t f = 0; f < members.size(); ++f) {
    double widest = 0, largest = 0, sum = 0;
    Vec3d mean;
    for (const std::size_t a : members[f]) {
      mean += faces.areas[a] * faces.normals[a];
      for (const std::size_t b : members[f]) widest = std::max(widest, difference(a, b));
      for (const std::size_t b : across_edges[a]) {
        if (b < a || members[f].count(b) == 0) continue;
        largest = std::max(largest, difference(a, b));
        sum += difference(a, b);
      }
    }
    patches.inconsistency.push_back(widest * largest / (1e-9 + sum));
    patches.mean.push_back(normalized(mean));
  }
  return patches;
}

std::vector<Vec3d> plain_guided_normal(const TriangleMesh& mesh, const GuidedNormalParams& params) {
  std::vector<Vec3d> points = doubles(mesh.positions);
  const FaceSets across_edges = faces_sharing(mesh.triangles, 2);
  const FaceSets neighbours = faces_sharing(mesh.triangles, 1);
  FaceSets members = neighbours;
  for (std::size_t f = 0; f < members.size(); ++f) members[f].insert(f);
  PlainFaces faces = plain_faces(mesh.triangles, points);
  const double d = plain_spacing(faces, across_edges);
  FaceSets balls;
  for (std::size_t f = 0; f < members.size(); ++f) {
    balls.push_back(plain_ball(f, params.relative_radius * d, faces.centroids, neighbours));
  }
  for (int round = 0; round < params.iterations; ++round) {
    faces = plain_faces(mesh.triangles, points);
    const PlainPatches patches = plain_patches(faces, members, across_edges);
    std::vector<Vec3d> guidance, filtered = faces.normals;
    for (std::size_t f = 0; f < members.size(); ++f) {
      const auto best = *std::min_element(
          members[f].begin(), members[f].end(), [&](std::size_t a, std::size_t b) {
            return patches.inconsistency[a] < patches.inconsistency[b];
          });
      guidance.push_back(patches.mean[best]);
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      Vec3d sum;
      for (const std::size_t j : balls[i]) {
        sum += faces.areas[j] * gaussian_weight(norm(faces.centroids[i] - faces.centroids[j]), d) *
               gaussian_weight(norm(guidance[i] - guidance[j]), params.sigma_r) * faces.normals[j];
      }
      if (norm(sum) > 0) filtered[i] = normalized(sum);
    }
    plain_vertex_update(mesh.triangles, filtered,
                        {.passes = params.vertex_iterations,
                         .equalizing = params.equalizing,
                         .free_boundary = params.boundary == BoundaryRule::free},
                        points);
  }
  return points;
}

void expect_plain_evaluation(const TriangleMesh& before, int rounds) {
  for (const BoundaryRule rule : {BoundaryRule::fixed, BoundaryRule::free}) {
    const GuidedNormalParams params{.iterations = rounds, .boundary = rule};
    TriangleMesh mesh = before;
    ASSERT_TRUE(smooth_guided_normal(mesh, params));
    EXPECT_LT(farthest(mesh.positions, plain_guided_normal(before, params)),
              1e-6 * diagonal(before.positions));
  }
}

TEST(GuidedNormal, EqualsAPlainEvaluationOnAnyMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    // Among triangles without order the normals nearly cancel, and each round makes differences
    // about five times greater.
    expect_plain_evaluation(random_mesh(60, 70, seed), 1);
    expect_plain_evaluation(random_mesh(300, 200, seed), 1);
    expect_plain_evaluation(with_noise(make_sphere(0.7, 3), 0.02, seed), 3);
    expect_plain_evaluation(with_noise(make_grid(12, 9, 0.1), 0.03, seed), 3);
  }
}

TEST(GuidedNormal, EqualsAPlainEvaluationOnTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = read_bunny(path);
  const GuidedNormalParams params{.iterations = 1, .vertex_iterations = 3};
  TriangleMesh mesh = bunny;
  ASSERT_TRUE(smooth_guided_normal(mesh, params));
  EXPECT_LT(farthest(mesh.positions, plain_guided_normal(bunny, params)),
            1e-6 * diagonal(bunny.positions));
}

}  // namespace
}  // namespace burnish
