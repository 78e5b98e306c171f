#include "burnish/smoothing/automatic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/fusion_stage.h"

namespace burnish {
namespace {

/// Along the normals; `blurs` means over one-rings make it correlated, its size stays.
TriangleMesh with_noise_along_normals(const TriangleMesh& mesh, double sigma, int blurs) {
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  const Adjacency rings = one_rings(mesh);
  std::vector<double> height(mesh.positions.size());
  for (std::size_t v = 0; v < height.size(); ++v) height[v] = Random(3, v).normal();
  for (int i = 0; i < blurs; ++i) {
    const std::vector<double> before = height;
    for (std::size_t v = 0; v < height.size(); ++v) {
      for (const std::uint32_t w : rings.row(v)) height[v] += before[w];
      height[v] /= static_cast<double>(rings.row(v).size() + 1);
    }
  }
  double squares = 0;
  for (const double h : height) squares += h * h;
  const double scale = sigma / std::sqrt(squares / static_cast<double>(height.size()));
  TriangleMesh noisy = mesh;
  for (std::size_t v = 0; v < height.size(); ++v) {
    noisy.positions[v] = Vec3f(Vec3d(mesh.positions[v]) + scale * height[v] * Vec3d(normals[v]));
  }
  return noisy;
}

double mean_normal_error(const TriangleMesh& mesh, const TriangleMesh& truth) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d n = normalized(area_vector(mesh, t)), m = normalized(area_vector(truth, t));
    sum += std::acos(std::clamp(dot(n, m), -1.0, 1.0));
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

TEST(Auto, TakesMostOfTheNoiseAwayFromFlatAndRoundShapes) {
  for (const TriangleMesh& truth : {make_box({1, 1, 1}, 25), make_sphere(1, 4), make_torus()}) {
    for (const double noise : {0.1, 0.3, 0.5}) {
      TriangleMesh mesh = with_noise_along_normals(truth, noise * mean_edge_length(truth), 0);
      const double before = mean_normal_error(mesh, truth);
      const auto report = smooth_auto(mesh);
      ASSERT_TRUE(report);
      EXPECT_LT(mean_normal_error(mesh, truth), 0.35 * before) << noise;
    }
  }
}

TEST(Auto, NearlyLeavesWhatHasNoNoise) {
  // It was trained on noise from 0.05 mean edges on.

  for (const TriangleMesh& truth : {make_box({1, 1, 1}, 25), make_sphere(1, 4)}) {
    TriangleMesh mesh = truth;
    const auto report = smooth_auto(mesh);
    ASSERT_TRUE(report);
    EXPECT_LT(report->rms_move, 0.05 * mean_edge_length(truth));
    EXPECT_LT(mean_normal_error(mesh, truth), 2 * std::numbers::pi / 180);
  }
}

TEST(Auto, TellsCorrelatedNoiseFromIndependent) {
  const TriangleMesh truth = make_sphere(1, 5);
  for (const double noise : {0.1, 0.4}) {
    for (const int blurs : {0, 3}) {
      const TriangleMesh mesh =
          with_noise_along_normals(truth, noise * mean_edge_length(truth), blurs);
      const auto work = begin_face_work(mesh, {});
      ASSERT_TRUE(work);
      FusionStage stage(mesh, *work);
      ASSERT_TRUE(stage.look({}, work->surface.positions));
      EXPECT_EQ(stage.roughness().correlated, blurs > 0) << noise;
    }
  }
}

}  // namespace
}  // namespace burnish
