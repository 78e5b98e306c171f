#include <gtest/gtest.h>

#include "burnish/catalogue/operations.h"

namespace burnish {
namespace {

TEST(Method, ReadsANameAlone) {
  const auto method = parse_method("taubin");
  ASSERT_TRUE(method);
  EXPECT_EQ(method->name, "taubin");
  EXPECT_TRUE(method->settings.empty());
}

TEST(Method, ReadsSettingsInTheirOrder) {
  const auto method = parse_method("taubin:lambda=0.5,reach=5 mm,note=a=b");
  ASSERT_TRUE(method);
  EXPECT_EQ(method->settings, (Settings{{"lambda", "0.5"}, {"reach", "5 mm"}, {"note", "a=b"}}));
}

TEST(Method, IsWrittenAsItIsRead) {
  for (const char* text : {"taubin", "taubin:lambda=0.5", "cells:spacing=2mm,normals=true"}) {
    EXPECT_EQ(to_string(parse_method(text).value()), text);
  }
}

TEST(Method, RefusesEveryOtherForm) {
  for (const char* text :
       {"", ":", "a:", ":x=1", "a:x", "a:x=", "a:=1", "a:x=1,", "a:,x=1", "a:x=1,,y=2"}) {
    const auto method = parse_method(text);
    ASSERT_FALSE(method) << text;
    EXPECT_EQ(method.error().code, ErrorCode::invalid_argument);
    EXPECT_EQ(method.error().message,
              "'" + std::string(text) + "' is not of the form NAME[:key=value,...]");
  }
}

TEST(Find, GivesTheOperationOfThatName) {
  const auto found = find_smooth("one_ring_mean");
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)->info.name, "one_ring_mean");
}

TEST(Find, AnswersAnUnknownNameWithTheKnownOnes) {
  const auto found = find_smooth("polish");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(found.error().message.find("'polish' is no method to smooth, known: "), 0u);
  EXPECT_NE(found.error().message.find("one_ring_mean"), std::string::npos);
}

TEST(Catalogue, ListsEveryFamily) {
  std::size_t operations = 0;
  for (const auto family : families()) operations += operations_of(family).size();
  EXPECT_EQ(operations, average_operations().size() + filter_operations().size() +
                            clean_operations().size() + merge_operations().size() +
                            fuse_operations().size() + thin_operations().size() +
                            triangulate_operations().size() + repair_operations().size() +
                            smooth_operations().size() + simplify_operations().size() +
                            refine_operations().size());
  EXPECT_TRUE(operations_of("bake").empty());
}

TEST(Catalogue, AnOperationReadsItsSettings) {
  const SmoothOperation& smooth = *find_smooth("one_ring_mean").value();
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  ASSERT_TRUE(smooth.run(mesh, {{"boundary", "free"}, {"iterations", "1"}}, {}));
  const Vec3f centre{1.f / 3, 1.f / 3, 0};
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{centre, centre, centre}));
  const auto refused = smooth.run(mesh, {{"iterations", "-1"}}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_argument);
}

}  // namespace
}  // namespace burnish
