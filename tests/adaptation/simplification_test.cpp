#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "burnish/adaptation/point_removal.h"
#include "burnish/adaptation/quadric_collapse.h"
#include "burnish/base/random.h"
#include "burnish/core/topology.h"
#include "burnish/measure/area_and_volume.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/shapes/shapes.h"
#include "burnish/spatial/closest_point.h"
#include "support/random_mesh.h"
#include "support/threads.h"

namespace burnish {
namespace {

using Simplify = Result<SimplifyReport> (*)(TriangleMesh&, const SimplifyParams&, const Context&);

struct Way {
  std::string name;
  Simplify run;
};
void PrintTo(const Way& way, std::ostream* out) {
  *out << way.name;
}

class SimplificationBy : public testing::TestWithParam<Way> {
 protected:
  SimplifyReport simplify(TriangleMesh& mesh, const SimplifyParams& params,
                          const Context& context = {}) {
    const auto report = GetParam().run(mesh, params, context);
    EXPECT_TRUE(report);
    return *report;
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, SimplificationBy,
                         testing::Values(Way{"quadric", simplify_quadric},
                                         Way{"point_removal", simplify_point_removal}),
                         [](const auto& way) { return way.param.name; });

/// The largest distance of samples and vertices of `from` to `to`.
double distance(const TriangleMesh& from, const TriangleMesh& to) {
  const ClosestPoint closest(to);
  double largest = 0;
  for (const SurfaceSample& s : surface_samples(from, 20000)) {
    largest = std::max(largest, closest(s.point).distance);
  }
  for (const Vec3f& p : from.positions) {
    largest = std::max(largest, closest(static_cast<Vec3d>(p)).distance);
  }
  return largest;
}

double two_sided(const TriangleMesh& a, const TriangleMesh& b) {
  return std::max(distance(a, b), distance(b, a));
}

/// A grid of which triangles are missing here and there, so that its boundary has ears.
TriangleMesh torn_grid() {
  TriangleMesh mesh = test::with_noise(make_grid(30, 30, 0.05), 0.003, 7);
  Random random(8);
  std::erase_if(mesh.triangles, [&random](const Triangle&) { return random.below(6) == 0; });
  return without_unused_vertices(mesh);
}

std::vector<TriangleMesh> models() {
  return {test::with_noise(make_sphere(1, 4), 0.005, 1), make_box({1, 1, 1}, 12),
          test::with_noise(make_grid(30, 30, 0.05), 0.003, 2), make_torus(1, 0.4, 40, 20)};
}

TEST_P(SimplificationBy, KeepsWhatTheSurfaceIs) {
  for (const TriangleMesh& model : models()) {
    TriangleMesh mesh = model;
    const SimplifyReport report = simplify(mesh, {.ratio = 0.1});
    EXPECT_TRUE(report.target_reached);
    EXPECT_FALSE(report.error_bound);
    EXPECT_EQ(report.triangles, mesh.triangles.size());
    EXPECT_LE(mesh.triangles.size(), model.triangles.size() / 10 + 1);
    EXPECT_GE(mesh.triangles.size() + 2, model.triangles.size() / 10);
    const Topology before = topology(model), after = topology(mesh);
    EXPECT_EQ(after.euler_number, before.euler_number);
    EXPECT_EQ(after.boundary_loops, before.boundary_loops);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.unused_vertices, 0u);
    EXPECT_TRUE(after.oriented());
    EXPECT_EQ(after.duplicate_triangles + after.degenerate_triangles, 0u);
  }
}

TEST_P(SimplificationBy, ItsErrorBoundHolds) {
  std::vector<TriangleMesh> all = models();
  all.push_back(torn_grid());
  for (const TriangleMesh& model : all) {
    for (const double max_error : {0.001, 0.004, 0.02}) {
      TriangleMesh mesh = model;
      const SimplifyReport report = simplify(mesh, {.max_error = max_error});
      EXPECT_LE(mesh.triangles.size(), model.triangles.size());
      ASSERT_TRUE(report.error_bound);
      EXPECT_LE(*report.error_bound, max_error);
      // Positions are floats: what is computed of them agrees to their rounding.
      EXPECT_LE(two_sided(model, mesh), *report.error_bound + 1e-7);
    }
  }
}

TEST_P(SimplificationBy, ABoundInSigmasIsEachVertexsOwn) {
  TriangleMesh model = test::with_noise(make_grid(40, 20, 0.05), 0.004, 3);
  for (const Vec3f& p : model.positions) {
    model.attributes.sigma.push_back(p.x < 1 ? 0.0002f : 0.02f);
  }
  TriangleMesh mesh = model;
  simplify(mesh, {.max_sigmas = 2});
  const auto left = [](const TriangleMesh& m, auto side) {
    return std::count_if(m.positions.begin(), m.positions.end(), side);
  };
  const auto precise = [](const Vec3f& p) { return p.x < 0.9f; };
  const auto coarse = [](const Vec3f& p) { return p.x > 1.1f; };
  EXPECT_GT(left(mesh, precise), left(model, precise) / 2);
  EXPECT_LT(left(mesh, coarse), left(model, coarse) / 5);

  model.attributes.sigma[7] = std::numeric_limits<float>::quiet_NaN();
  const auto nowhere = GetParam().run(model, {.max_sigmas = 2}, {});
  EXPECT_EQ(nowhere.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(nowhere.error().where, "vertex 7");
  TriangleMesh unknown = make_grid(4, 4);
  EXPECT_EQ(GetParam().run(unknown, {.max_sigmas = 1}, {}).error().code, ErrorCode::bad_geometry);
}

TEST_P(SimplificationBy, APlaneNeedsNothingButItsOutline) {
  TriangleMesh mesh = make_grid(20, 10, 0.1);
  simplify(mesh, {.max_error = 1e-6});
  EXPECT_LE(mesh.triangles.size(), 12u);
  EXPECT_NEAR(surface_area(mesh), 2, 1e-5);
}

TEST_P(SimplificationBy, EdgesOfABoxStaySharp) {
  const TriangleMesh box = make_box({1, 1, 1}, 10);
  TriangleMesh mesh = box;
  simplify(mesh, {.target_triangles = 24});
  EXPECT_LE(two_sided(box, mesh), 1e-5);
}

TEST_P(SimplificationBy, LeavesAloneWhatIsNoSurface) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const TriangleMesh model = test::random_mesh(14, 2 + seed, seed);
    TriangleMesh mesh = model;
    simplify(mesh, {.target_triangles = 1});
    const Topology before = topology(model), after = topology(mesh);
    EXPECT_EQ(after.euler_number, before.euler_number);
    EXPECT_EQ(after.non_manifold_edges, before.non_manifold_edges);
    EXPECT_EQ(after.unused_vertices, before.unused_vertices);
    EXPECT_EQ(after.degenerate_triangles, before.degenerate_triangles);
  }
}

TEST_P(SimplificationBy, IsTheSameWithAnyNumberOfThreads) {
  const TriangleMesh model = test::with_noise(make_sphere(1, 5), 0.004, 4);
  TriangleMesh one = model, three = model;
  simplify(one, {.ratio = 0.2}, test::with_threads(1));
  simplify(three, {.ratio = 0.2}, test::with_threads(3));
  EXPECT_EQ(one, three);
}

TEST_P(SimplificationBy, SaysWhereItCannotReachItsTarget) {
  TriangleMesh mesh = make_sphere(1, 2);
  const SimplifyReport report = simplify(mesh, {.target_triangles = 2});
  EXPECT_FALSE(report.target_reached);
  EXPECT_GE(mesh.triangles.size(), 4u);
}

TEST(PointRemoval, LeavesVerticesAsTheyWere) {
  TriangleMesh model = test::with_noise(make_sphere(1, 4), 0.005, 5);
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    model.attributes.sigma.push_back(0.001f * static_cast<float>(v));
    model.attributes.colors.push_back({static_cast<std::uint8_t>(v % 256), 2, 3, 4});
  }
  TriangleMesh mesh = model;
  ASSERT_TRUE(simplify_point_removal(mesh, {.ratio = 0.2}));
  std::size_t from = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v, ++from) {
    while (from < model.positions.size() && model.positions[from] != mesh.positions[v]) ++from;
    ASSERT_LT(from, model.positions.size());
    EXPECT_EQ(mesh.attributes.sigma[v], model.attributes.sigma[from]);
    EXPECT_EQ(mesh.attributes.colors[v], model.attributes.colors[from]);
  }
}

TEST(RemovalLog, ErrorsNeverFallAndHoldAtEveryLength) {
  const TriangleMesh model = test::with_noise(make_sphere(1, 3), 0.01, 6);
  const auto log = removal_log(model);
  ASSERT_TRUE(log);
  EXPECT_GT(log->size(), model.positions.size() * 9 / 10);
  TriangleMesh mesh = model;
  float last = 0;
  for (std::size_t k = 0; k < log->size(); ++k) {
    const Removal& removal = (*log)[k];
    EXPECT_GE(removal.error, last);
    last = removal.error;
    for (Triangle& t : mesh.triangles)
      std::replace(t.begin(), t.end(), removal.vertex, removal.into);
    std::erase_if(mesh.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (k % 100 == 99 || k + 1 == log->size()) {
      const TriangleMesh used = without_unused_vertices(mesh);
      EXPECT_TRUE(topology(used).oriented());
      EXPECT_LE(two_sided(model, used), removal.error + 1e-7);
    }
  }
}

TEST(RemovalLog, GoesNearlyAsFarAsABoundLets) {
  const TriangleMesh model = test::with_noise(make_sphere(1, 4), 0.005, 9);
  const auto log = removal_log(model);
  ASSERT_TRUE(log);
  for (const float bound : {0.01f, 0.03f}) {
    TriangleMesh mesh = model;
    const auto report = simplify_point_removal(mesh, {.max_error = bound});
    ASSERT_TRUE(report);
    const auto within = std::count_if(log->begin(), log->end(),
                                      [bound](const Removal& r) { return r.error <= bound; });
    EXPECT_GE(static_cast<double>(within), 0.8 * static_cast<double>(report->removed_vertices));
  }
}

}  // namespace
}  // namespace burnish
