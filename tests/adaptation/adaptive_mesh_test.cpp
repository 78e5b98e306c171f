#include "burnish/adaptation/adaptive_mesh.h"

#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"
#include "support/adaptive_promises.h"
#include "support/bunny.h"
#include "support/test_data.h"
#include "support/threads.h"

namespace burnish {
namespace {

const PointTest kEverywhere = [](const Vec3d&) { return true; };

PointTest ball(const Vec3d& centre, double radius) {
  return [=](const Vec3d& p) { return squared_norm(p - centre) <= radius * radius; };
}

PointTest outside_of(const PointTest& inside) {
  return [=](const Vec3d& p) { return !inside(p); };
}

AdaptiveMesh adaptive(const TriangleMesh& mesh, std::uint64_t seed = 1) {
  auto made = AdaptiveMesh::make(mesh, test::random_removals(mesh, mesh.positions.size(), seed));
  EXPECT_TRUE(made) << made.error().text();
  return *std::move(made);
}

std::vector<std::uint32_t> vertices_in(const TriangleMesh& mesh, const PointTest& inside) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (inside(mesh.frame.origin + Vec3d(mesh.positions[v]))) found.push_back(v);
  }
  return found;
}

TEST(AdaptiveMesh, RefinesARegionWhollyAndBringsNothingBackWithoutNeed) {
  const TriangleMesh sphere = make_sphere(1, 4);
  AdaptiveMesh mesh = adaptive(sphere);
  ASSERT_TRUE(mesh.reduce(kEverywhere));
  const std::size_t coarsest = mesh.triangle_count();
  EXPECT_LT(coarsest, 100u);
  const PointTest cap = ball({0, 0, 1}, 0.5);
  ASSERT_TRUE(mesh.refine(cap));
  const std::vector<std::uint32_t> there = mesh.vertices(), wanted = vertices_in(sphere, cap);
  EXPECT_TRUE(std::includes(there.begin(), there.end(), wanted.begin(), wanted.end()));
  EXPECT_LT(mesh.triangle_count(), sphere.triangles.size() / 2);

  const TriangleMesh refined = mesh.mesh();
  ASSERT_TRUE(mesh.reduce(outside_of(cap)));
  EXPECT_EQ(mesh.mesh(), refined) << "all that came back outside lies on what is inside";
  ASSERT_TRUE(mesh.reduce(kEverywhere));
  EXPECT_EQ(mesh.triangle_count(), coarsest);
}

TEST(AdaptiveMesh, ReducesARegionAndLeavesTheRest) {
  const TriangleMesh sphere = make_sphere(1, 4);
  AdaptiveMesh mesh = adaptive(sphere);
  const PointTest cap = ball({0, 0, 1}, 0.5);
  ASSERT_TRUE(mesh.reduce(cap));
  EXPECT_LT(vertices_in(mesh.mesh(), cap).size(), vertices_in(sphere, cap).size());
  EXPECT_EQ(vertices_in(mesh.mesh(), outside_of(cap)).size(),
            vertices_in(sphere, outside_of(cap)).size());
}

TEST(AdaptiveMesh, LevelsByErrorAndByTriangles) {
  const TriangleMesh torus = make_torus(1, 0.4, 24, 12);
  AdaptiveMesh mesh = adaptive(torus);
  const double half = static_cast<double>(mesh.log()[mesh.log().size() / 2].error);
  mesh.to_error(half);
  for (std::uint32_t k = 0; k < mesh.log().size(); ++k) {
    EXPECT_EQ(mesh.removed(k), static_cast<double>(mesh.log()[k].error) <= half);
  }
  EXPECT_EQ(mesh.error(), half);
  // A closed surface loses two triangles a removal.
  for (const std::size_t count : {torus.triangles.size(), std::size_t{300}, std::size_t{299}}) {
    mesh.to_triangles(count);
    EXPECT_EQ(mesh.triangle_count(), count / 2 * 2);
  }
  mesh.to_triangles(0);
  EXPECT_EQ(mesh.removed_count(), mesh.log().size());
  mesh.to_error(-1);
  EXPECT_EQ(mesh.mesh(), torus);
}

TEST(AdaptiveMesh, RegionsHaveErrorsToo) {
  AdaptiveMesh mesh = adaptive(make_sphere(1, 3));
  const double half = static_cast<double>(mesh.log()[mesh.log().size() / 2].error);
  ASSERT_TRUE(mesh.reduce_to_error(kEverywhere, half));
  const TriangleMesh reduced = mesh.mesh();
  mesh.to_removals(mesh.log().size());
  ASSERT_TRUE(mesh.refine_to_error(kEverywhere, half));
  EXPECT_EQ(mesh.mesh(), reduced);
  mesh.to_error(half);
  EXPECT_EQ(mesh.mesh(), reduced);
}

TEST(AdaptiveMesh, FocusIsFineInsideAndCoarseOutsideWhateverWasBefore) {
  const TriangleMesh sphere = make_sphere(1, 4);
  AdaptiveMesh mesh = adaptive(sphere);
  const PointTest cap = ball({0, 0, 1}, 0.5);
  ASSERT_TRUE(mesh.focus(cap, {.outside_triangles = 700}));
  const TriangleMesh focused = mesh.mesh();
  EXPECT_EQ(vertices_in(focused, cap).size(), vertices_in(sphere, cap).size());
  std::size_t outside = 0;
  for (const Triangle& t : focused.triangles) {
    outside += std::none_of(t.begin(), t.end(),
                            [&](std::uint32_t v) { return cap(Vec3d(focused.positions[v])); });
  }
  EXPECT_LE(outside, 700u);
  EXPECT_GE(outside, 698u) << "a removal takes two triangles";

  mesh.to_triangles(30);
  ASSERT_TRUE(mesh.reduce(cap));
  ASSERT_TRUE(mesh.focus(cap, {.outside_triangles = 700}));
  EXPECT_EQ(mesh.mesh(), focused);

  const double half = static_cast<double>(mesh.log()[mesh.log().size() / 2].error);
  ASSERT_TRUE(mesh.focus(cap, {.inside_error = half, .outside_error = half}));
  const TriangleMesh even = mesh.mesh();
  mesh.to_error(half);
  EXPECT_EQ(mesh.mesh(), even);
}

TEST(AdaptiveMesh, CarriesAttributesAndOwners) {
  TriangleMesh grid = make_grid(6, 6);
  grid.frame.origin = {1000, 2000, 3000};
  for (std::uint32_t v = 0; v < grid.positions.size(); ++v) {
    grid.attributes.sigma.push_back(static_cast<float>(v));
    grid.attributes.normals.push_back({0, 0, 1});
  }
  for (const Triangle& t : grid.triangles) {
    grid.triangle_attributes.owner.push_back(t[1]);
    grid.triangle_attributes.origin.push_back(t[0] % 2 ? Origin::seen : Origin::invented);
  }
  AdaptiveMesh mesh = adaptive(grid);
  const PointTest corner = ball({1000, 2000, 3000}, 4);
  ASSERT_TRUE(mesh.reduce(corner));
  EXPECT_LT(vertices_in(mesh.mesh(), corner).size(), vertices_in(grid, corner).size());
  EXPECT_EQ(vertices_in(mesh.mesh(), outside_of(corner)).size(),
            vertices_in(grid, outside_of(corner)).size());
  const TriangleMesh reduced = mesh.mesh();
  ASSERT_TRUE(check(reduced));
  const std::vector<std::uint32_t> vertices = mesh.vertices();
  ASSERT_EQ(vertices.size(), reduced.positions.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_EQ(reduced.positions[v], grid.positions[vertices[v]]);
    EXPECT_EQ(reduced.attributes.sigma[v], static_cast<float>(vertices[v]));
  }
  EXPECT_EQ(reduced.triangle_attributes.origin.size(), reduced.triangles.size());
  mesh.restore();
  EXPECT_EQ(mesh.mesh(), grid);
}

// Every owner is one of its triangle's corners, before and after.
TEST(AdaptiveMesh, AnOwnerThatIsRemovedBecomesWhatItWentInto) {
  TriangleMesh sphere = make_sphere(1, 2);
  for (const Triangle& t : sphere.triangles) sphere.triangle_attributes.owner.push_back(t[1]);
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.to_triangles(20);
  const TriangleMesh reduced = mesh.mesh();
  for (std::size_t t = 0; t < reduced.triangles.size(); ++t) {
    EXPECT_EQ(reduced.triangle_attributes.owner[t], reduced.triangles[t][1]);
  }
}

TEST(AdaptiveMesh, CancelledCallsChangeNothing) {
  const TriangleMesh sphere = make_sphere(1, 3);
  AdaptiveMesh mesh = adaptive(sphere);
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  for (const Result<void>& done :
       {mesh.reduce(kEverywhere, context), mesh.focus(ball({}, 0.1), {}, context)}) {
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  }
  EXPECT_EQ(mesh.mesh(), sphere);
  const auto made = AdaptiveMesh::make(sphere, mesh.log(), context);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::cancelled);
}

TEST(AdaptiveMesh, IsTheSameForEveryNumberOfThreads) {
  const TriangleMesh sphere = make_sphere(1, 4);
  AdaptiveMesh one = adaptive(sphere);
  AdaptiveMesh four = one;
  ASSERT_TRUE(one.focus(ball({1, 0, 0}, 0.7), {.outside_triangles = 500}, test::with_threads(1)));
  ASSERT_TRUE(four.focus(ball({1, 0, 0}, 0.7), {.outside_triangles = 500}, test::with_threads(4)));
  EXPECT_EQ(one.mesh(), four.mesh());
}

// The same was done once with 10^5 operations, each checked: benchmark/README.md.
TEST(AdaptiveMesh, TheBunnyGoesDownAndUp) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = test::read_bunny(path);
  AdaptiveMesh mesh = adaptive(bunny);
  EXPECT_GT(mesh.log().size(), 34000u);
  const test::SurfaceKind kind(bunny);
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    test::random_operation(mesh, bunny, 0.2, random);
    if (i % 10 == 9) {
      EXPECT_TRUE(test::SurfaceKind(mesh.mesh()).comes_of(kind));
    }
  }
  mesh.restore();
  EXPECT_EQ(mesh.mesh(), bunny);
}

}  // namespace
}  // namespace burnish
