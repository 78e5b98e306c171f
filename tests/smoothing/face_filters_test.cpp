#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "burnish/core/adjacency.h"
#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/bilateral.h"
#include "burnish/smoothing/bilateral_normal.h"
#include "burnish/smoothing/guided_normal.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "burnish/smoothing/smoothing_weights.h"
#include "support/random_mesh.h"

// What all smoothings that know the direction of faces have in common.
namespace burnish {
namespace {

using test::random_mesh;
using test::with_noise;

struct Method {
  std::string name;
  std::function<Result<SmoothingReport>(TriangleMesh&, BoundaryRule, const Context&)> smooth;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{
      {"bilateral",
       [](TriangleMesh& mesh, BoundaryRule rule, const Context& context) {
         return smooth_bilateral(mesh, {.boundary = rule}, context);
       }},
      {"bilateral_normal",
       [](TriangleMesh& mesh, BoundaryRule rule, const Context& context) {
         return smooth_bilateral_normal(mesh, {.boundary = rule}, context);
       }},
      {"guided_normal",
       [](TriangleMesh& mesh, BoundaryRule rule, const Context& context) {
         return smooth_guided_normal(mesh, {.iterations = 4, .boundary = rule}, context);
       }},
  };
  return all;
}

class FaceFilters : public testing::TestWithParam<Method> {
 protected:
  TriangleMesh smoothed(TriangleMesh mesh, BoundaryRule rule = BoundaryRule::fixed,
                        const Context& context = {}) const {
    EXPECT_TRUE(GetParam().smooth(mesh, rule, context));
    return mesh;
  }
};

/// Between the normals of two meshes with the same triangles, rad; of all faces or of some.
double mean_normal_error(const TriangleMesh& mesh, const TriangleMesh& truth,
                         const std::vector<std::uint32_t>& faces) {
  double sum = 0;
  for (const std::uint32_t f : faces) {
    const Vec3d a = normalized(area_vector(mesh, f)), b = normalized(area_vector(truth, f));
    sum += std::atan2(norm(cross(a, b)), dot(a, b));
  }
  return sum / static_cast<double>(faces.size());
}

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) faces.push_back(f);
  return faces;
}

/// The faces of a box from -1/2 to 1/2 that touch one of its edges.
std::vector<std::uint32_t> faces_at_edges(const TriangleMesh& box) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < box.triangles.size(); ++f) {
    for (const std::uint32_t v : box.triangles[f]) {
      const Vec3f p = box.positions[v];
      const int sides = (std::abs(p.x) == 0.5f) + (std::abs(p.y) == 0.5f) + (std::abs(p.z) == 0.5f);
      if (sides < 2) continue;
      faces.push_back(f);
      break;
    }
  }
  return faces;
}

TEST(NormalFilters, KeepTheEdgesOfANoisyBox) {
  const int cells = 20;
  const TriangleMesh truth = make_box({1, 1, 1}, cells);
  const TriangleMesh noisy = with_noise(truth, 0.1 / cells, 3);
  TriangleMesh bilateral = noisy, guided = noisy, mean = noisy;
  ASSERT_TRUE(smooth_bilateral_normal(bilateral));
  ASSERT_TRUE(smooth_guided_normal(guided));
  ASSERT_TRUE(smooth_one_ring_mean(mean, {.iterations = 3}));
  // Ten passes over a face and its neighbours average along a walk of ten steps of about one
  // spacing, an area of some 2 pi 10 spacings squared with about 60 vertices: in the flat parts an
  // eighth of the noise should be left. Half of a side's faces have an edge within that reach,
  // beyond which nothing is averaged, and keep up to twice as much.
  const double before = mean_normal_error(noisy, truth, all_faces(truth));
  EXPECT_LT(mean_normal_error(bilateral, truth, all_faces(truth)), before / 4);
  EXPECT_LT(mean_normal_error(guided, truth, all_faces(truth)), before / 4);
  // Near the edges a linear filter turns the normals by more than the noise did.
  const std::vector<std::uint32_t> edges = faces_at_edges(truth);
  const double before_at_edges = mean_normal_error(noisy, truth, edges);
  EXPECT_GT(mean_normal_error(mean, truth, edges), before_at_edges);
  EXPECT_LT(mean_normal_error(bilateral, truth, edges), before_at_edges / 2);
  EXPECT_LT(mean_normal_error(guided, truth, edges), before_at_edges / 2);
}

TEST(NormalFilters, EqualizingMendsBadTriangles) {
  // Noise within the surface only, which folds triangles: no normal asks a vertex to move there.
  TriangleMesh noisy = make_grid(30, 30, 1);
  for (std::size_t v = 0; v < noisy.positions.size(); ++v) {
    Random random(7, v);
    noisy.positions[v].x += static_cast<float>(0.3 * random.normal());
    noisy.positions[v].y += static_cast<float>(0.3 * random.normal());
  }
  const auto folded = [](const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) count += area_vector(mesh, f).z <= 0;
    return count;
  };
  TriangleMesh with = noisy, without = noisy;
  ASSERT_TRUE(smooth_guided_normal(with));
  ASSERT_TRUE(smooth_guided_normal(without, {.equalizing = 0}));
  EXPECT_GE(folded(without), folded(noisy) / 2);
  EXPECT_LT(folded(with), folded(noisy) / 10);
}

TEST_P(FaceFilters, APlaneStaysThatPlane) {
  TriangleMesh plane = with_noise(make_grid(25, 20, 0.1), 0.02, 2);
  for (Vec3f& p : plane.positions) {
    p.z = 0;
    p = Vec3f(Vec3d{0.8 * p.x, p.y, 0.6 * p.x});
  }
  for (const BoundaryRule rule :
       {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
    const TriangleMesh after = smoothed(plane, rule);
    for (const Vec3f& p : after.positions) {
      // Positions up to 2 rounded to float before and after.
      EXPECT_LT(std::abs(0.8 * p.z - 0.6 * p.x), 4 * 2 * 0x1p-24);
    }
  }
}

TEST_P(FaceFilters, TheBoundaryFollowsItsRule) {
  const TriangleMesh before = with_noise(make_grid(16, 16, 0.1), 0.015, 6);
  const std::vector<bool> on_boundary = boundary_vertices(before);
  const TriangleMesh fixed = smoothed(before, BoundaryRule::fixed);
  const TriangleMesh along = smoothed(before, BoundaryRule::along_boundary);
  const TriangleMesh free = smoothed(before, BoundaryRule::free);
  double outline_free = 0, outline_along = 0;
  for (std::uint32_t v = 0; v < before.positions.size(); ++v) {
    if (on_boundary[v]) {
      EXPECT_EQ(fixed.positions[v], before.positions[v]);
      EXPECT_NE(free.positions[v], before.positions[v]);
      EXPECT_NE(along.positions[v], free.positions[v]);
    } else {
      EXPECT_NE(fixed.positions[v], before.positions[v]);
    }
    // How ragged the lower side is, corners left out.
    if (v == 0 || v > 15) continue;
    const auto bend = [v](const TriangleMesh& mesh) {
      const Vec3d bow = Vec3d(mesh.positions[v - 1]) + Vec3d(mesh.positions[v + 1]) -
                        2. * Vec3d(mesh.positions[v]);
      return squared_norm(bow);
    };
    outline_free += bend(free);
    outline_along += bend(along);
  }
  EXPECT_LT(outline_along, outline_free);
}

TEST_P(FaceFilters, PinnedVerticesStay) {
  TriangleMesh before = with_noise(make_sphere(1, 3), 0.03, 4);
  std::vector<float> follows(before.positions.size(), 1);
  for (std::size_t v = 0; v < follows.size(); v += 3) follows[v] = 0;
  before.attributes.channels = {{std::string(kSmoothingWeight), follows}};
  const TriangleMesh after = smoothed(before);
  for (std::size_t v = 0; v < follows.size(); ++v) {
    EXPECT_EQ(after.positions[v] == before.positions[v], follows[v] == 0) << v;
  }
  before.attributes.channels = {
      {std::string(kSmoothingWeight), std::vector<float>(before.positions.size(), 2)}};
  EXPECT_FALSE(GetParam().smooth(before, BoundaryRule::fixed, {}));
}

TEST(NormalFilters, AHalfFreeVertexMakesHalfOfAMove) {
  const TriangleMesh before = with_noise(make_sphere(1, 3), 0.03, 4);
  TriangleMesh free = before, half = before;
  half.attributes.channels = {
      {std::string(kSmoothingWeight), std::vector<float>(before.positions.size(), 0.5f)}};
  for (TriangleMesh* mesh : {&free, &half}) {
    ASSERT_TRUE(smooth_bilateral_normal(*mesh, {.vertex_iterations = 1}));
  }
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const Vec3d middle = 0.5 * (Vec3d(before.positions[v]) + Vec3d(free.positions[v]));
    EXPECT_LT(norm(Vec3d(half.positions[v]) - middle), 4e-7);
  }
}

TEST_P(FaceFilters, OddMeshesAreSmoothedOrLeftButNeverBroken) {
  TriangleMesh one, lonely, degenerate = with_noise(make_grid(5, 5), 0.1, 1),
                            point = make_grid(2, 2);
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  lonely.positions = {{1, 2, 3}, {4, 5, 6}};
  degenerate.triangles.push_back({5, 5, 6});
  degenerate.triangles.push_back({0, 0, 0});
  degenerate.triangles.push_back(degenerate.triangles.front());  // twice
  degenerate.positions[14] = degenerate.positions[15];           // no area
  for (Vec3f& p : point.positions) p = {1, 2, 3};
  for (const TriangleMesh& before :
       {one, lonely, degenerate, point, make_grid(1, 1), TriangleMesh{}, random_mesh(9, 60, 1),
        random_mesh(5, 400, 2)}) {
    for (const double scale : {1., 1e-18, 1e15}) {
      TriangleMesh scaled = before;
      for (Vec3f& p : scaled.positions) p = Vec3f(scale * Vec3d(p));
      for (const BoundaryRule rule :
           {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
        EXPECT_TRUE(check(smoothed(scaled, rule)));
      }
    }
  }
}

TEST_P(FaceFilters, AFanOfThousandsOfTrianglesTakesNoLongerThanOthers) {
  // All pairs of its faces would be a billion.
  const TriangleMesh fan = with_noise(make_cylinder(1, 2, 10000, 1), 1e-6, 1);
  EXPECT_TRUE(check(smoothed(fan)));
}

TEST_P(FaceFilters, GivesTheSameBytesForEveryNumberOfThreads) {
  const TriangleMesh before = with_noise(make_sphere(1, 6), 0.003, 1);
  TriangleMesh expected;
  for (const int threads : {1, 2, 8}) {
    Context context;
    context.threads = threads;
    const TriangleMesh mesh = smoothed(before, BoundaryRule::fixed, context);
    if (threads == 1) expected = mesh;
    EXPECT_EQ(mesh, expected) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(All, FaceFilters, testing::ValuesIn(methods()),
                         [](const auto& method) { return method.param.name; });

}  // namespace
}  // namespace burnish
