#include "burnish/pipeline/confinement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "burnish/pipeline/phases.h"
#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {
namespace {

const Region kUpperHalf = Box{{-2, -2, 0}, {2, 2, 2}};

TriangleMesh with_channel(TriangleMesh mesh, Channel::Values values) {
  mesh.attributes.channels = {{"before", std::vector<float>(mesh.positions.size(), 1)},
                              {std::string(kSmoothingWeight), std::move(values)},
                              {"after", std::vector<float>(mesh.positions.size(), 2)}};
  return mesh;
}

/// One pass of the mean over a rough sphere, confined to its upper half.
Result<void> smooth_upper_half(TriangleMesh& mesh, Record& record,
                               const Region& region = kUpperHalf) {
  return smooth_in_phases(mesh, {{"one_ring_mean", {}}, {"one_ring_mean", {}}}, {region, {}}, true,
                          record, {});
}

TEST(Confinement, MovesWhatIsInsideAndNothingElse) {
  const TriangleMesh before = make_sphere(1, 2);
  TriangleMesh confined = before, everywhere = before;
  Record record;
  const std::vector<Method> once{{"one_ring_mean", {}}};
  ASSERT_TRUE(smooth_in_phases(confined, once, {kUpperHalf, {}}, true, record, {}));
  ASSERT_TRUE(smooth_in_phases(everywhere, once, {}, true, record, {}));
  std::size_t inside = 0;
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const bool free = before.positions[v].z >= 0;
    EXPECT_EQ(confined.positions[v], (free ? everywhere : before).positions[v]) << v;
    EXPECT_NE(everywhere.positions[v], before.positions[v]) << v;
    inside += free;
  }
  EXPECT_EQ(record.steps.front().verb, "confine");
  EXPECT_EQ(record.steps.front().settings.front().second, "box:-2,-2,0,2,2,2");
  EXPECT_EQ(record.steps.front().facts.front().value, static_cast<double>(inside));
}

TEST(Confinement, IsDecidedBeforeTheFirstPhase) {
  // The pole leaves this ball with the first pass, and moves on with the second.
  const TriangleMesh before = make_uv_sphere(1, 8, 5);
  const Region ball = Ball{{0, 0, 1}, 1e-3};
  TriangleMesh mesh = before;
  Record record;
  ASSERT_TRUE(smooth_upper_half(mesh, record, ball));
  ASSERT_EQ(record.phases.size(), 3u);
  const std::size_t pole = before.positions.size() - 1;
  EXPECT_LT(record.phases[1].mesh.positions[pole].z, 0.99f);
  EXPECT_LT(mesh.positions[pole].z, record.phases[1].mesh.positions[pole].z - 0.01f);
  for (std::size_t v = 0; v < pole; ++v) EXPECT_EQ(mesh.positions[v], before.positions[v]);
}

TEST(Confinement, RegionsAreOfTheWorld) {
  TriangleMesh mesh = make_sphere(1, 2);
  mesh.frame.origin = {0, 0, 10};
  EXPECT_FALSE(vertices_inside(mesh, kUpperHalf));
  EXPECT_TRUE(vertices_inside(mesh, Box{{-2, -2, 10}, {2, 2, 12}}));
}

TEST(Confinement, LeavesNoTraceInMeshAndPhases) {
  TriangleMesh mesh = make_sphere(1, 2);
  Record record;
  ASSERT_TRUE(smooth_upper_half(mesh, record));
  EXPECT_TRUE(mesh.attributes.channels.empty());
  for (const Phase& phase : record.phases) EXPECT_TRUE(phase.mesh.attributes.channels.empty());
}

TEST(Confinement, WeightsOfTheMeshCountInsideAndStayAsTheyWere) {
  const TriangleMesh sphere = make_sphere(1, 2);
  std::vector<float> half(sphere.positions.size(), 0.5f);
  const TriangleMesh before = with_channel(sphere, half);
  TriangleMesh confined = before, everywhere = before;
  Record record;
  const std::vector<Method> once{{"one_ring_mean", {}}};
  ASSERT_TRUE(smooth_in_phases(confined, once, {kUpperHalf, {}}, true, record, {}));
  ASSERT_TRUE(smooth_in_phases(everywhere, once, {}, true, record, {}));
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    EXPECT_EQ(confined.positions[v],
              before.positions[v].z >= 0 ? everywhere.positions[v] : before.positions[v]);
  }
  EXPECT_EQ(confined.attributes.channels, before.attributes.channels);
  for (const Phase& phase : record.phases) {
    EXPECT_EQ(phase.mesh.attributes.channels, before.attributes.channels) << phase.name;
  }
}

TEST(Confinement, RefusesWhatItCannotHeedAndLeavesTheMesh) {
  const TriangleMesh sphere = make_sphere(1, 2);
  const std::size_t count = sphere.positions.size();
  Record record;
  for (const TriangleMesh& before : {with_channel(sphere, std::vector<float>(count, 1.5f)),
                                     with_channel(sphere, std::vector<int>(count, 1))}) {
    TriangleMesh mesh = before;
    const auto done = smooth_upper_half(mesh, record);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::bad_geometry);
    EXPECT_EQ(mesh, before);
  }
  TriangleMesh mesh = sphere;
  const auto nowhere = smooth_upper_half(mesh, record, Ball{{5, 5, 5}, 1});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::invalid_argument);
  EXPECT_NE(nowhere.error().message.find("sphere:5,5,5,1"), std::string::npos);
}

TEST(Confinement, AFailedSmoothingLeavesNoTraceEither) {
  TriangleMesh mesh = make_sphere(1, 2);
  const TriangleMesh before = mesh;
  Record record;
  ASSERT_FALSE(smooth_in_phases(mesh, {{"one_ring_mean", {{"iterations", "-1"}}}}, {kUpperHalf, {}},
                                false, record, {}));
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  ASSERT_FALSE(
      smooth_in_phases(mesh, {{"one_ring_mean", {}}}, {kUpperHalf, {}}, false, record, context));
  EXPECT_EQ(mesh, before);
}

const std::vector<Method> kMidpointTwice{{"midpoint", {}}, {"midpoint", {}}};

/// Triangles with a corner in the region.
std::size_t triangles_at(const TriangleMesh& mesh, const Region& region) {
  const std::vector<bool> inside = vertices_inside(mesh, region).value();
  return static_cast<std::size_t>(std::count_if(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const Triangle& t) { return inside[t[0]] || inside[t[1]] || inside[t[2]]; }));
}

TEST(Confinement, RefinesEveryTriangleThatMeetsTheRegionAsElsewhere) {
  // A ball inside one of the two triangles, which no vertex lies in; the mesh is not at the origin.
  TriangleMesh before = make_grid(4, 4);
  before.frame.origin = {10, 0, 0};
  const Region ball = Ball{{11.7, 1.2, 0}, 0.1};
  ASSERT_FALSE(vertices_inside(before, ball));
  TriangleMesh confined = before, everywhere = before;
  Record record;
  const std::vector<Method> four{{"midpoint", {{"iterations", "4"}}}};
  ASSERT_TRUE(refine_in_phases(confined, four, ball, true, record, {}));
  ASSERT_TRUE(refine_in_phases(everywhere, four, {}, false, record, {}));
  EXPECT_EQ(triangles_at(confined, ball), triangles_at(everywhere, ball));
  EXPECT_LT(confined.triangles.size(), everywhere.triangles.size() / 2);
  ASSERT_EQ(record.steps.size(), 3u);
  EXPECT_EQ(record.steps[0].verb, "confine");
  EXPECT_EQ(record.steps[0].facts.front().value, 3);
  EXPECT_EQ(record.steps[1].verb, "refine");
  ASSERT_EQ(record.phases.size(), 2u);
  EXPECT_EQ(record.phases[0].name, "original");
  EXPECT_EQ(record.phases[1].mesh, confined);
}

TEST(Confinement, OfARefinementIsDecidedForEachPhase) {
  // The middle of the first phase's edge lies in the region of the second.
  TriangleMesh mesh = make_grid(4, 4);
  const Region box = Box{{1.4, 1.4, -1}, {1.6, 1.6, 1}};
  Record record;
  ASSERT_TRUE(refine_in_phases(mesh, kMidpointTwice, box, false, record, {}));
  EXPECT_EQ(record.steps[0].facts.front().value, 4);  // both triangles of a square
  EXPECT_EQ(record.steps[2].facts.front().value, 7);  // the six around its middle
  EXPECT_TRUE(mesh.attributes.channels.empty());
}

TEST(Confinement, ChannelsOfTheMeshGrowWithIt) {
  const std::size_t count = make_grid(4, 4).positions.size();
  std::vector<float> weights(count, 1);
  weights[0] = 0;
  TriangleMesh mesh = make_grid(4, 4);
  mesh.attributes.channels = {{"refinement", weights},
                              {"refinement before", std::vector<std::uint8_t>(count, 7)}};
  TriangleMesh unconfined = mesh;
  Record record;
  ASSERT_TRUE(
      refine_in_phases(mesh, kMidpointTwice, Box{{-1, -1, -1}, {5, 5, 5}}, false, record, {}));
  ASSERT_TRUE(refine_in_phases(unconfined, kMidpointTwice, {}, false, record, {}));
  EXPECT_EQ(mesh, unconfined) << "a region around all of it changes nothing";
  ASSERT_TRUE(check(mesh));
  ASSERT_EQ(mesh.attributes.channels.size(), 2u);
  EXPECT_EQ(mesh.attributes.channels[0].name, "refinement");
  EXPECT_EQ(mesh.attributes.channels[1].name, "refinement before");
  EXPECT_GT(mesh.positions.size(), count);
}

TEST(Confinement, AFailedRefinementLeavesNoTrace) {
  const TriangleMesh before = make_grid(4, 4);
  for (const Region& region : {Region(Ball{{9, 9, 9}, 1}), Region(Box{{0, 0, 1}, {4, 4, 2}})}) {
    TriangleMesh mesh = before;
    Record record;
    const auto done = refine_in_phases(mesh, kMidpointTwice, region, false, record, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::invalid_argument);
    EXPECT_NE(done.error().message.find(to_string(region)), std::string::npos);
    EXPECT_EQ(mesh, before);
  }
  TriangleMesh mesh = before;
  Record record;
  EXPECT_FALSE(refine_in_phases(mesh, {{"loop", {{"iterations", "16"}}}},
                                Region(Ball{{0, 0, 0}, 1}), false, record, {}));
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace burnish
