#include "burnish/pipeline/table1.h"

#include <gtest/gtest.h>

#include <tuple>

#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "support/progress.h"
#include "support/test_data.h"

namespace burnish {
namespace {

TEST(Table1, WithoutDataRunsEveryMethodOnShapesAndSaysSo) {
  test::ProgressLog log;
  Context context;
  context.sink = &log;
  const Result<Table1> table = reproduce_table1({.data = std::nullopt, .rounds = 1}, context);
  ASSERT_TRUE(table) << table.error().text();
  EXPECT_TRUE(log.monotone());
  EXPECT_EQ(log.fractions().back(), 1);
  ASSERT_EQ(table->models.size(), 4u);
  for (const Table1Model& model : table->models) {
    EXPECT_TRUE(model.generated) << model.name;
    EXPECT_NE(model.source.find("generated"), std::string::npos) << model.source;
    EXPECT_EQ(model.points.attributes, Attributes{}) << "positions alone";
  }
  ASSERT_EQ(table->parts.size(), 3u);
  for (const Table1Part& part : table->parts) {
    ASSERT_EQ(part.rows.size(), 4u);
    const bool pipeline = &part == table->parts.data();
    for (std::size_t i = 0; i < 4; ++i) {
      const Table1Row& row = part.rows[i];
      EXPECT_EQ(row.model, table->models[i].name);
      EXPECT_EQ(row.points, table->models[i].points.positions.size());
      EXPECT_GT(row.triangles, 0u);
      EXPECT_LT(row.seconds(), 1e3);
      EXPECT_EQ(row.smoothing > 0, pipeline) << "the paper smooths its own result alone";
      EXPECT_EQ(row.printed.has_value(), pipeline || i < 2);
    }
  }
  // The surfaces of the two global methods are manifold; on a torus the votes leave nothing out.
  for (std::size_t part = 0; part < 2; ++part) {
    for (const Table1Row& row : table->parts[part].rows)
      EXPECT_EQ(row.shape.non_manifold_edges, 0u) << row.model;
  }
  const Table1Row& torus = table->parts[0].rows[0];
  EXPECT_EQ(torus.triangles, 2 * torus.points);
  EXPECT_EQ(torus.shape.components, 1u);
  EXPECT_TRUE(torus.shape.closed());
  EXPECT_EQ(torus.shape.euler_number, 0);
}

TEST(Table1, TakesTheFilesThatAreThereAndTheHeadOfTheBody) {
  const test::TemporaryFolder folder;
  for (const char* part : {"stanford", "human"}) std::filesystem::create_directory(folder / part);
  const TriangleMesh sphere = make_sphere(1, 4);
  TriangleMesh colored = sphere;
  colored.attributes.colors.assign(sphere.positions.size(), {1, 2, 3, 255});
  ASSERT_TRUE(write_mesh(folder / "stanford/bun_zipper.ply", colored));
  ASSERT_TRUE(write_mesh(folder / "human/makehuman_body_tri.obj", sphere));
  const auto models = table1_models(folder.path());
  ASSERT_TRUE(models) << models.error().text();
  const auto& [bunny, buddha, head, body] =
      std::tie((*models)[0], (*models)[1], (*models)[2], (*models)[3]);
  EXPECT_EQ(bunny.points.positions, sphere.positions);
  EXPECT_EQ(bunny.points.attributes, Attributes{});
  EXPECT_FALSE(bunny.generated);
  EXPECT_TRUE(buddha.generated);
  EXPECT_NE(buddha.source.find("there is no stanford/buddha_photon.obj"), std::string::npos);
  EXPECT_EQ(body.points.positions, sphere.positions);
  // Above 85.5 % of the height of a sphere lie 14.5 % of its area.
  const double share = static_cast<double>(head.points.positions.size()) /
                       static_cast<double>(sphere.positions.size());
  EXPECT_NEAR(share, 0.145, 0.02);
  for (const Vec3f& p : head.points.positions) EXPECT_GT(p.y, -1 + 2 * 0.855 - 1e-3);
}

TEST(Table1, StopsWhenCancelled) {
  test::CancelAt half(0.5);
  const auto table = reproduce_table1({.data = std::nullopt, .rounds = 1}, half.context());
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::cancelled);
}

TEST(Table1, RefusesAFolderThatIsNoneADamagedFileAndNoRounds) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(table1_models(folder / "nowhere").error().code, ErrorCode::not_found);
  EXPECT_EQ(reproduce_table1({.data = std::nullopt, .rounds = 0}).error().code,
            ErrorCode::invalid_argument);
  std::filesystem::create_directory(folder / "stanford");
  std::filesystem::copy_file(test::source_folder() / "LICENSE", folder / "stanford/bun_zipper.ply");
  const auto models = table1_models(folder.path());
  ASSERT_FALSE(models);
  EXPECT_NE(models.error().where.find("bun_zipper.ply"), std::string::npos);
}

}  // namespace
}  // namespace burnish
