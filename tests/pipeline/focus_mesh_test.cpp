#include "burnish/pipeline/focus_mesh.h"

#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

TriangleMesh far_sphere() {
  TriangleMesh sphere = make_sphere(1, 4);
  sphere.frame.origin = {100, 0, 0};
  sphere.positions.push_back({0, 0, 1});  // that no triangle uses
  return sphere;
}

double fact(const Record& record, std::string_view key) {
  for (const Fact& f : record.steps.at(0).facts) {
    if (f.key == key) return f.value;
  }
  ADD_FAILURE() << key;
  return 0;
}

TEST(FocusMesh, KeepsEveryVertexInsideAndRecordsWhatItDid) {
  TriangleMesh mesh = far_sphere();
  Record record;
  ASSERT_TRUE(focus_mesh(mesh, "box:99,-1,0.5,101,1,1", {.outside_triangles = 1500}, record));
  // The box holds the part of the sphere above half its height: a quarter of its area.
  EXPECT_GT(fact(record, "vertices_inside"), 600);
  EXPECT_EQ(fact(record, "vertices_inside"), fact(record, "vertices_inside_before"));
  EXPECT_LE(fact(record, "triangles_outside"), 1500);
  EXPECT_EQ(fact(record, "triangles"), static_cast<double>(mesh.triangles.size()));
  EXPECT_GT(fact(record, "error_bound"), 0);
  EXPECT_TRUE(record.notes.empty());
  EXPECT_EQ(record.steps.at(0).settings,
            (Settings{{"region", "box:99,-1,0.5,101,1,1"}, {"outside_triangles", "1500"}}));
}

TEST(FocusMesh, SaysWhereTheRegionAllowsNoFewerOutside) {
  TriangleMesh mesh = far_sphere();
  Record record;
  ASSERT_TRUE(focus_mesh(mesh, "box:99,-1,0.5,101,1,1", {.outside_triangles = 1}, record));
  EXPECT_EQ(record.notes.size(), 1u);
}

TEST(FocusMesh, RefusesARegionWithoutAVertex) {
  TriangleMesh mesh = far_sphere();
  const TriangleMesh before = mesh;
  Record record;
  const auto done = focus_mesh(mesh, "sphere:0,0,0,2", {}, record);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(mesh, before);
  EXPECT_TRUE(record.steps.empty());
}

}  // namespace
}  // namespace burnish
