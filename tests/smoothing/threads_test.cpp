#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/equalize.h"
#include "burnish/smoothing/gaussian.h"
#include "burnish/smoothing/humphrey.h"
#include "burnish/smoothing/laplacian.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "burnish/smoothing/windowed_sinc.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

/// Small work runs on one thread whatever the context says; this is enough for all of them.
constexpr int kPasses = 5;

template <class Smooth>
void expect_same_bytes(Smooth smooth) {
  TriangleMesh before = test::with_noise(make_sphere(1, 7), 0.01, 1);
  before.attributes.sigma.assign(before.positions.size(), 0.001f);
  TriangleMesh expected;
  for (const int threads : {1, 2, 3, 8}) {
    TriangleMesh mesh = before;
    Context context;
    context.threads = threads;
    ASSERT_TRUE(smooth(mesh, context));
    if (threads == 1) expected = mesh;
    EXPECT_EQ(mesh, expected) << threads << " threads";
  }
}

TEST(SmoothingThreads, NearestFarthestGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_nearest_farthest(mesh, {.iterations = kPasses}, context);
  });
}

TEST(SmoothingThreads, OneRingMeanGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_one_ring_mean(mesh, {.iterations = kPasses}, context);
  });
}

TEST(SmoothingThreads, GaussianGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_gaussian(mesh, {.iterations = kPasses}, context);
  });
}

TEST(SmoothingThreads, CotangentsGiveTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_laplacian(mesh, {.weights = LaplacianWeights::cotangent, .iterations = kPasses},
                            context);
  });
}

TEST(SmoothingThreads, HumphreyGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_humphrey(mesh, {.iterations = kPasses}, context);
  });
}

TEST(SmoothingThreads, WindowedSincGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_windowed_sinc(mesh, {.iterations = kPasses}, context);
  });
}

TEST(SmoothingThreads, EqualizeGivesTheSameBytes) {
  expect_same_bytes([](TriangleMesh& mesh, const Context& context) {
    return smooth_equalize(mesh, {.iterations = kPasses}, context);
  });
}

}  // namespace
}  // namespace burnish
