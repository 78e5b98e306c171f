#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/equalize.h"
#include "burnish/smoothing/humphrey.h"
#include "burnish/smoothing/implicit.h"
#include "burnish/smoothing/l0.h"
#include "burnish/smoothing/laplacian.h"
#include "burnish/smoothing/smoothing_weights.h"
#include "burnish/smoothing/taubin.h"
#include "burnish/smoothing/windowed_sinc.h"
#include "support/random_mesh.h"

// What the classical smoothings have in common.
namespace burnish {
namespace {

struct Method {
  std::string name;
  std::function<Result<SmoothingReport>(TriangleMesh&, const Context&)> smooth;
};

std::vector<Method> methods() {
  return {
      {"laplacian", [](auto& mesh, auto& context) { return smooth_laplacian(mesh, {}, context); }},
      {"cotangent",
       [](auto& mesh, auto& context) {
         return smooth_laplacian(mesh, {.weights = LaplacianWeights::cotangent}, context);
       }},
      {"taubin", [](auto& mesh, auto& context) { return smooth_taubin(mesh, {}, context); }},
      {"windowed_sinc",
       [](auto& mesh, auto& context) { return smooth_windowed_sinc(mesh, {}, context); }},
      {"humphrey", [](auto& mesh, auto& context) { return smooth_humphrey(mesh, {}, context); }},
      {"equalize", [](auto& mesh, auto& context) { return smooth_equalize(mesh, {}, context); }},
      {"implicit", [](auto& mesh, auto& context) { return smooth_implicit(mesh, {}, context); }},
      {"l0", [](auto& mesh, auto& context) { return smooth_l0(mesh, {}, context); }},
  };
}

TriangleMesh weighted(TriangleMesh mesh, const std::function<float(std::size_t)>& weight) {
  std::vector<float> weights;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) weights.push_back(weight(v));
  mesh.attributes.channels = {{std::string(kSmoothingWeight), std::move(weights)}};
  return mesh;
}

TEST(Smoothings, PinVerticesOfWeightZeroAndNoOthers) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    const TriangleMesh before = weighted(test::with_noise(make_sphere(1, 3), 0.02, 1),
                                         [](std::size_t v) { return v % 3 == 0 ? 0.f : 1.f; });
    TriangleMesh mesh = before;
    ASSERT_TRUE(method.smooth(mesh, {}));
    std::size_t stay = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const bool same = mesh.positions[v] == before.positions[v];
      EXPECT_TRUE(same || v % 3 != 0) << v;
      stay += same;
    }
    EXPECT_EQ(stay, (mesh.positions.size() + 2) / 3);
    EXPECT_EQ(mesh.attributes.channels, before.attributes.channels);
  }
}

TEST(Smoothings, MoveVerticesOfSmallWeightByLittle) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    const TriangleMesh noisy = test::with_noise(make_sphere(1, 3), 0.02, 1);
    TriangleMesh free = noisy, ones = weighted(noisy, [](std::size_t) { return 1.f; });
    TriangleMesh held = weighted(noisy, [](std::size_t) { return 0.01f; });
    const auto full = method.smooth(free, {}), same = method.smooth(ones, {}),
               little = method.smooth(held, {});
    ASSERT_TRUE(full && same && little);
    EXPECT_EQ(free.positions, ones.positions);
    EXPECT_GT(little->rms_move, 0);
    // A hundredth of each move, and moves that follow it are the larger for it: at most 10 times.
    EXPECT_LT(little->rms_move, 0.1 * full->rms_move);
  }
}

TEST(Smoothings, RefuseWeightsThatAreNone) {
  for (const Method& method : methods()) {
    TriangleMesh mesh = weighted(make_sphere(1, 1), [](std::size_t v) { return v == 4 ? 2.f : 1; });
    const TriangleMesh before = mesh;
    const auto report = method.smooth(mesh, {});
    ASSERT_FALSE(report) << method.name;
    EXPECT_EQ(report.error().code, ErrorCode::bad_geometry);
    EXPECT_EQ(mesh, before);
  }
}

TEST(Smoothings, KeepTheBoundaryIsolatedVerticesAndTwoTriangles) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    TriangleMesh mesh = test::with_noise(make_grid(8, 8, 0.1), 0.01, 2);
    mesh.positions.push_back({5, 5, 5});
    const TriangleMesh before = mesh;
    ASSERT_TRUE(method.smooth(mesh, {}));
    EXPECT_EQ(mesh.positions.back(), before.positions.back());
    for (std::size_t v = 0; v < 81; ++v) {
      const bool inside = v % 9 > 0 && v % 9 < 8 && v > 9 && v < 72;
      EXPECT_EQ(mesh.positions[v] != before.positions[v], inside) << v;
    }
    TriangleMesh two = make_grid(1, 1);
    const TriangleMesh both = two;
    ASSERT_TRUE(method.smooth(two, {}));
    EXPECT_EQ(two, both);
  }
}

TEST(Smoothings, SurviveEveryDefect) {
  for (const Method& method : methods()) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      TriangleMesh mesh = test::random_mesh(20 + 10 * seed, 40 * seed, seed);
      const auto report = method.smooth(mesh, {});
      ASSERT_TRUE(report) << method.name << ", " << seed << ": " << report.error().text();
      EXPECT_TRUE(check(mesh));
    }
  }
}

}  // namespace
}  // namespace burnish
