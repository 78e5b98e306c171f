#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/base/random.h"
#include "burnish/triangulation/fan_cloud.h"

// After every edit a fan cloud is, bit for bit, what building it from its active points gives.
namespace burnish {
namespace {

FanCloud built(const FanCloud& cloud) {
  std::vector<std::uint8_t> active;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) active.push_back(cloud.active(p));
  return FanCloud::build(cloud.positions(), cloud.normals(), cloud.params(), {}, active).value();
}

bool same_fan(const FanCloud& a, const FanCloud& b, std::uint32_t p) {
  const auto in_use = [](FanState s) { return s == FanState::removed ? FanState::inactive : s; };
  return in_use(a.state(p)) == in_use(b.state(p)) && a.fan_normal(p) == b.fan_normal(p) &&
         std::equal(a.rim(p).begin(), a.rim(p).end(), b.rim(p).begin(), b.rim(p).end());
}

std::size_t differing_fans(const FanCloud& edited) {
  const FanCloud fresh = built(edited);
  std::size_t count = 0;
  for (std::uint32_t p = 0; p < edited.size(); ++p) count += !same_fan(edited, fresh, p);
  return count;
}

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

class FanCloudEdits : public testing::TestWithParam<FanVariant> {
 protected:
  FanCloudParams params() const { return {.variant = GetParam()}; }
};

TEST_P(FanCloudEdits, EqualTheRebuildOnASphere) {
  play(params(), on_sphere, false, 400, 4000, 40);
}

TEST_P(FanCloudEdits, EqualTheRebuildWhereNormalsTellSheetsApart) {
  play(params(), on_sheets, true, 300, 3000, 40);
}

TEST_P(FanCloudEdits, EqualTheRebuildOnALatticeFullOfTies) {
  play(params(), on_lattice, false, 300, 3000, 30);
}

TEST_P(FanCloudEdits, EqualTheRebuildOnALine) {
  play(params(), on_line, false, 60, 1000, 10);
}

TEST_P(FanCloudEdits, EqualTheRebuildAmongCoincidentPoints) {
  play(params(), at_one_of_few_places, false, 60, 2000, 10);
}

TEST_P(FanCloudEdits, EqualTheRebuildWithFewPoints) {
  play(params(), on_sphere, false, 6, 2000, 1);
}

TEST_P(FanCloudEdits, EqualTheRebuildWithOtherSettings) {
  FanCloudParams few = params(), wide = params();
  few.k = 3, few.cap = 1, few.gap_angle = 2.5;
  wide.k = 20, wide.cap = 4, wide.gap_angle = 0.7;
  play(few, on_sphere, false, 200, 2000, 40);
  play(wide, on_sphere, false, 200, 2000, 40);
}

INSTANTIATE_TEST_SUITE_P(Variants, FanCloudEdits,
                         testing::Values(FanVariant::ring, FanVariant::delaunay),
                         [](const auto& variant) {
                           return variant.param == FanVariant::ring ? "ring" : "delaunay";
                         });

}  // namespace
}  // namespace burnish
