#include "burnish/registration/projective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/registration_pairs.h"
#include "support/threads.h"

namespace burnish {
namespace {

struct Outcome {
  test::FramePair pair;
  PairRegistration found;

  /// How far the middle of what matched is from where it should be, m.
  double error() const {
    const Vec3d p = found.T_target_source.inverse()(found.centre);
    return norm(found.T_target_source(p) - pair.T_target_source(p));
  }
};

constexpr std::uint32_t kCoarseness = 2;
constexpr SurfaceViewParams kCoarseView{.window = 2};

Outcome outcome_of(test::FramePair pair, const Context& context = {}) {
  const SurfaceView source = surface_view(pair.source, kCoarseView).value();
  const SurfaceView target = surface_view(pair.target, kCoarseView).value();
  const ProjectiveParams params{.reach = pair.reach, .step = 1};
  auto found = register_projective(source, target, pair.guess, params, context);
  return {std::move(pair), std::move(found).value()};
}

TEST(Projective, FindsAndAcceptsGoodPairs) {
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Outcome outcome = outcome_of(test::good_pair(i, kCoarseness));
    EXPECT_TRUE(outcome.found.accepted())
        << outcome.pair.kind << " " << i << ": " << outcome.found.reason;
    EXPECT_LT(outcome.error(), 0.004) << outcome.pair.kind << " " << i;
  }
}

TEST(Projective, RefusesBadPairsForWhatIsWrongWithThem) {
  const std::map<std::string, Refusal> expected{
      {"plate", Refusal::not_held},
      {"cylinder", Refusal::not_held},
      {"sphere", Refusal::not_held},
      {"5 % overlap", Refusal::too_little_overlap},
      {"moved object", Refusal::contradiction},
      {"no overlap", Refusal::contradiction},
      {"wrong intrinsics", Refusal::contradiction},
  };
  for (std::uint64_t i = 0; i < 7; ++i) {
    test::FramePair pair = test::bad_pair(i, kCoarseness);
    // Even the true pose is not to be believed where so little speaks for it.
    if (pair.kind == "5 % overlap") pair.guess = pair.T_target_source;
    const Outcome outcome = outcome_of(std::move(pair));
    const std::vector<Refusal>& refusals = outcome.found.refusals;
    EXPECT_EQ(std::count(refusals.begin(), refusals.end(), expected.at(outcome.pair.kind)), 1)
        << outcome.pair.kind << ": " << outcome.found.reason;
    EXPECT_EQ(outcome.found.reason.empty(), outcome.found.accepted());
  }
}

TEST(Projective, SameBytesForAnyNumberOfThreads) {
  const test::FramePair pair = test::good_pair(0, kCoarseness);
  const Outcome one = outcome_of(pair, test::with_threads(1));
  const Outcome many = outcome_of(pair, test::with_threads(3));
  EXPECT_EQ(one.found.T_target_source, many.found.T_target_source);
  EXPECT_EQ(one.found.covariance, many.found.covariance);
  EXPECT_EQ(one.found.inlier_rmse, many.found.inlier_rmse);
}

}  // namespace
}  // namespace burnish
