#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/base/random.h"
#include "support/fan_geometry.h"

// After every edit a fan cloud is, bit for bit, what building it from its active points gives.
namespace burnish {
namespace {

using test::differing_fans;

// Instrumented builds are slower by an order of magnitude and more.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BURNISH_INSTRUMENTED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BURNISH_INSTRUMENTED
#endif
#endif
#ifdef BURNISH_INSTRUMENTED
constexpr std::size_t kManyEdits = 20000;
#else
constexpr std::size_t kManyEdits = 1000000;
#endif

struct Oriented {
  Vec3f position, normal;
};

/// On the unit sphere.
Oriented on_sphere(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  const Vec3f n(normalized(Vec3d{x, y, z}));
  return {n, n};
}

/// On two parallel sheets nearer to each other than the points.
Oriented on_sheets(Random& random) {
  const double x = random.uniform(), y = random.uniform();
  const bool upper = random.below(2) == 0;
  return {Vec3f(Vec3d{x, y, upper ? 0.003 : 0}), Vec3f{0, 0, upper ? 1.f : -1.f}};
}

Oriented on_lattice(Random& random) {
  const auto x = static_cast<float>(random.below(12)), y = static_cast<float>(random.below(12)),
             z = static_cast<float>(random.below(3));
  return {{x, y, z}, {}};
}

Oriented on_line(Random& random) {
  const auto x = static_cast<float>(random.uniform());
  return {{x, 2 * x, -x}, {}};
}

Oriented at_one_of_few_places(Random& random) {
  const auto x = static_cast<float>(random.below(4)), y = static_cast<float>(random.below(4));
  return {{x, y, 0}, {}};
}

using Draw = Oriented (*)(Random&);

/// Random edits that leave about `size` points, compared every `period` edits.
void play(const FanCloudParams& params, Draw draw, bool with_normals, std::size_t size,
          std::size_t edits, std::size_t period) {
  Random random(params.k + 7 * size);
  FanCloud cloud = FanCloud::build({}, {}, params).value();
  for (std::size_t edit = 1; edit <= edits; ++edit) {
    const auto any = static_cast<std::uint32_t>(random.below(cloud.size() + 1));
    const std::uint64_t chance = random.below(2 * size);
    if (any == cloud.size() || chance > cloud.size() || cloud.state(any) == FanState::removed) {
      const Oriented point = draw(random);
      ASSERT_TRUE(cloud.add(point.position, with_normals ? point.normal : Vec3f{}));
    } else if (random.below(2) == 0) {
      ASSERT_TRUE(cloud.remove(any));
    } else {
      ASSERT_TRUE(cloud.set_active(any, !cloud.active(any)));
    }
    if (edit % period == 0) {
      ASSERT_EQ(differing_fans(cloud), 0u) << "after " << edit << " edits";
    }
  }
}

class FanCloudEditsOf : public testing::TestWithParam<FanVariant> {
 protected:
  FanCloudParams params() const { return {.variant = GetParam()}; }
};

TEST_P(FanCloudEditsOf, EqualTheRebuildOnASphere) {
  play(params(), on_sphere, false, 400, 2000, 40);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildWhereNormalsTellSheetsApart) {
  play(params(), on_sheets, true, 300, 1500, 40);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildOnALatticeFullOfTies) {
  play(params(), on_lattice, false, 300, 2000, 30);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildOnALine) {
  play(params(), on_line, false, 60, 1000, 10);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildAmongCoincidentPoints) {
  play(params(), at_one_of_few_places, false, 60, 2000, 10);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildWithFewPoints) {
  play(params(), on_sphere, false, 6, 1000, 1);
}

TEST_P(FanCloudEditsOf, EqualTheRebuildWithOtherSettings) {
  FanCloudParams few = params(), wide = params();
  few.k = 3, few.cap = 1, few.gap_angle = 2.5;
  wide.k = 20, wide.cap = 4, wide.gap_angle = 0.7;
  play(few, on_sphere, false, 200, 1000, 40);
  play(wide, on_sphere, false, 200, 500, 50);
}

TEST(FanCloudEdits, AMillionEqualTheRebuildAtEveryThousandth) {
  play({.k = 4, .cap = 2}, on_sphere, false, 800, kManyEdits, 1000);
}

/// A cloud of `size` points after some edits.
void edit_cloud_of(std::size_t size) {
  Random random(size);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < size; ++i) points.push_back(on_sphere(random).position);
  FanCloud cloud = FanCloud::build(points).value();
  for (int edit = 0; edit < 2000; ++edit) {
    ASSERT_TRUE(cloud.remove(static_cast<std::uint32_t>(random.below(size))));
    ASSERT_TRUE(cloud.add(on_sphere(random).position));
  }
  EXPECT_EQ(differing_fans(cloud), 0u);
}

TEST(FanCloudEdits, EqualTheRebuildInALargeCloud) {
  edit_cloud_of(kManyEdits / 10);
}

INSTANTIATE_TEST_SUITE_P(Variants, FanCloudEditsOf,
                         testing::Values(FanVariant::ring, FanVariant::delaunay),
                         [](const auto& variant) {
                           return variant.param == FanVariant::ring ? "ring" : "delaunay";
                         });

}  // namespace
}  // namespace burnish
