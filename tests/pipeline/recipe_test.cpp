#include "burnish/pipeline/recipe.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(Recipe, DefaultsAreKnownMethods) {
  const auto checked = check(Recipe{});
  EXPECT_TRUE(checked) << checked.error().text();
}

TEST(Recipe, NamesTheUnknownMethodAndTheKnownOnes) {
  Recipe recipe;
  recipe.smooth = {{"polish", {}}};
  const auto checked = check(recipe);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::invalid_argument);
  EXPECT_NE(checked.error().text().find("'polish'"), std::string::npos);
  EXPECT_NE(checked.error().text().find("one_ring_mean"), std::string::npos);
}

TEST(Recipe, NamesTheMethodWhoseParameterCannotBe) {
  for (const Settings& settings : {Settings{{"iterations", "-1"}}, Settings{{"iterations", "many"}},
                                   Settings{{"passes", "1"}}}) {
    Recipe recipe;
    recipe.smooth = {{"one_ring_mean", settings}};
    const auto checked = check(recipe);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().where, "one_ring_mean");
  }
}

TEST(Recipe, ARegionToSmoothNeedsAMethod) {
  Recipe recipe;
  recipe.smooth_region = Ball{{0, 0, 0}, 1};
  EXPECT_TRUE(check(recipe));
  recipe.smooth.clear();
  const auto checked = check(recipe);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::invalid_argument);
}

TEST(Recipe, ABoundAndAFilterOfFramesExcludeEachOther) {
  Recipe recipe;
  recipe.frames.filter = {{"bilateral_depth", {}}};
  recipe.frames.average = Method{"temporal_mean", {}};
  EXPECT_TRUE(check(recipe));
  recipe.bound = NoiseBoundParams{};
  const auto both = check(recipe);
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().message.find("bilateral_depth moves depths"), std::string::npos);
  recipe.frames.filter.clear();
  EXPECT_TRUE(check(recipe));
  recipe.frames.frames_at_once = 0;
  EXPECT_FALSE(check(recipe));
}

TEST(Recipe, ChecksEveryStep) {
  const std::vector<Method> unknown{{"no_such_method", {}}};
  for (const auto& spoil : std::initializer_list<std::function<void(Recipe&)>>{
           [&](Recipe& r) { r.frames.average = unknown[0]; },
           [&](Recipe& r) { r.frames.filter = unknown; },
           [&](Recipe& r) { r.clean_scan = unknown; }, [&](Recipe& r) { r.merge = unknown[0]; },
           [&](Recipe& r) { r.clean_merged = unknown; },
           [&](Recipe& r) { r.triangulate = unknown[0]; }, [&](Recipe& r) { r.repair = unknown; },
           [&](Recipe& r) { r.smooth = unknown; }}) {
    Recipe recipe;
    spoil(recipe);
    EXPECT_FALSE(check(recipe));
  }
}

}  // namespace
}  // namespace burnish
