#include "burnish/smoothing/smoothing_weights.h"

#include <gtest/gtest.h>

#include <limits>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

void set_weights(TriangleMesh& mesh, std::vector<float> weights) {
  mesh.attributes.channels = {{std::string(kSmoothingWeight), std::move(weights)}};
}

TEST(SmoothingWeights, HoldBackEachVertexByItsOwn) {
  const TriangleMesh before = test::with_noise(make_sphere(1, 3), 0.02, 1);
  TriangleMesh free = before, held = before;
  std::vector<float> weights;
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    weights.push_back(static_cast<float>(v % 5) / 4);
  }
  set_weights(held, weights);
  ASSERT_TRUE(smooth_one_ring_mean(free));
  ASSERT_TRUE(smooth_one_ring_mean(held));
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const Vec3d from(before.positions[v]), to(free.positions[v]);
    const Vec3d expected = from + static_cast<double>(weights[v]) * (to - from);
    EXPECT_LT(norm(Vec3d(held.positions[v]) - expected), 2e-7);
    if (weights[v] == 0) {
      EXPECT_EQ(held.positions[v], before.positions[v]);
    }
  }
}

TEST(SmoothingWeights, OfOneChangeNothing) {
  const TriangleMesh before = test::with_noise(make_sphere(1, 3), 0.02, 1);
  TriangleMesh plain = before, weighted = before;
  set_weights(weighted, std::vector<float>(before.positions.size(), 1));
  ASSERT_TRUE(smooth_nearest_farthest(plain, {.iterations = 3}));
  ASSERT_TRUE(smooth_nearest_farthest(weighted, {.iterations = 3}));
  EXPECT_EQ(plain.positions, weighted.positions);
}

TEST(SmoothingWeights, RefusesWhatIsNone) {
  TriangleMesh mesh = make_grid(2, 2);
  set_weights(mesh, {1, 1, 1, 1, 1, 1.5f, 1, 1, 1});
  const auto above = smoothing_weights(mesh);
  ASSERT_FALSE(above);
  EXPECT_EQ(above.error().code, ErrorCode::bad_geometry);
  EXPECT_NE(above.error().text().find("vertex 5"), std::string::npos);
  set_weights(mesh, {1, 1, 1, 1, 1, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1});
  EXPECT_FALSE(smooth_one_ring_mean(mesh));
  mesh.attributes.channels[0].values = std::vector<double>(9, 1);
  EXPECT_FALSE(smoothing_weights(mesh));
  mesh.attributes.channels.clear();
  ASSERT_TRUE(smoothing_weights(mesh));
  EXPECT_TRUE(smoothing_weights(mesh)->empty());
}

}  // namespace
}  // namespace burnish
