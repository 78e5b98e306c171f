#include "burnish/base/random.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace burnish {
namespace {

constexpr int kDraws = 1 << 18;

TEST(Random, AStreamDependsOnSeedAndNumberAlone) {
  std::vector<std::uint64_t> forwards(100), backwards(100);
  for (std::size_t i = 0; i < 100; ++i) forwards[i] = Random(5, i).next();
  for (std::size_t i = 100; i-- > 0;) backwards[i] = Random(5, i).next();
  EXPECT_EQ(forwards, backwards);
}

TEST(Random, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (std::uint64_t stream = 0; stream < 50; ++stream)
      firsts.insert(Random(seed, stream).next());
  }
  EXPECT_EQ(firsts.size(), 2500u);
}

TEST(Random, NeverChangesItsNumbers) {
  // Simulated scans are told apart by their seed alone: other numbers would be other scans.
  Random random(1, 2);
  EXPECT_EQ(random.next(), 0xa6c7188e0551111eu);
  EXPECT_EQ(random.next(), 0x6d5016879973635cu);
}

TEST(Random, UniformHasTheMomentsOfTheUniformDistribution) {
  Random random(11);
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
  }
  // Five standard errors: the variance of u is 1/12, that of u^2 is 1/5 - 1/9 = 4/45.
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kDraws));
}

TEST(Random, NormalHasTheMomentsOfTheStandardNormalDistribution) {
  Random random(12);
  double sum = 0, squares = 0, fourths = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
  }
  // Five standard errors: the variances of x, x^2 and x^4 are 1, 2 and 105 - 9.
  EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(1.0 / kDraws));
  EXPECT_NEAR(squares / kDraws, 1, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3, 5 * std::sqrt(96.0 / kDraws));
}

TEST(Random, NeighbouringStreamsAreUncorrelated) {
  double products = 0;
  for (std::uint64_t stream = 0; stream < kDraws; ++stream) {
    const double a = Random(3, stream).uniform() - 0.5;
    const double b = Random(3, stream + 1).uniform() - 0.5;
    products += a * b;
  }
  EXPECT_NEAR(products / kDraws, 0, 5.0 / 12 / std::sqrt(kDraws));
}

TEST(Random, BelowIsBelowAndReachesEveryNumber) {
  Random random(4);
  std::vector<int> counts(7);
  for (int i = 0; i < 7000; ++i) {
    const std::uint64_t drawn = random.below(7);
    ASSERT_LT(drawn, 7u);
    ++counts[drawn];
  }
  // A count is binomial with mean 1000 and variance 1000 * 6/7.
  for (const int count : counts) EXPECT_NEAR(count, 1000, 5 * std::sqrt(6000.0 / 7));
}

TEST(Random, UniformBetweenLimits) {
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-3, -2);
    ASSERT_GE(u, -3);
    ASSERT_LE(u, -2);
  }
}

}  // namespace
}  // namespace burnish
