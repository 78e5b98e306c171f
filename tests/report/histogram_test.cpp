#include "burnish/report/histogram.h"

#include <gtest/gtest.h>

#include <numeric>

#include "report/well_formed.h"

namespace burnish {
namespace {

TEST(Shares, AddToOneWithinTheAxis) {
  const std::vector<float> values{0, 0.1f, 0.5f, 0.99f, 0.25f};
  Axis axis{"", ""};
  axis.bins = 4;
  const auto found = shares(values, axis);
  EXPECT_EQ(found, (std::vector<double>{0.4, 0.2, 0.2, 0.2}));
}

TEST(Shares, CountValuesOutsideInTheWholeOnly) {
  const std::vector<float> values{-1, 0.5f, 1, 7};
  Axis axis{"", ""};
  axis.bins = 2;
  EXPECT_EQ(shares(values, axis), (std::vector<double>{0, 0.25}));
}

TEST(NiceStep, IsRoundAndNotTooSmall) {
  for (const double extent : {1e-5, 0.3, 1.0, 6.9, 180.0, 12345.0}) {
    for (const int steps : {3, 5, 9}) {
      const double step = nice_step(extent, steps);
      EXPECT_LE(extent / step, steps * (1 + 1e-9));
      EXPECT_GE(extent / step, steps / 2.5 * (1 - 1e-9)) << "1, 2, 5 are at most 2.5 apart";
    }
  }
  EXPECT_EQ(nice_step(180, 9), 20);
}

TEST(SeriesClass, TellsFirstAndLastFromAllOthers) {
  EXPECT_EQ(series_class(0, 1), "s0");
  for (std::size_t count = 2; count < 12; ++count) {
    EXPECT_EQ(series_class(0, count), "s0");
    EXPECT_EQ(series_class(count - 1, count), "s5");
    for (std::size_t i = 1; i + 1 < count; ++i) EXPECT_NE(series_class(i, count), "s5");
  }
}

TEST(Histogram, IsWellFormedWithAndWithoutValues) {
  const std::vector<float> values{0.2f, 0.4f};
  HtmlWriter html;
  html.verbatim("<!DOCTYPE html>");
  write_histogram(html, "a", {"Angles <", "°"}, {{"first & last", values}, {"none", {}}});
  const std::string page = html.finish();
  EXPECT_EQ(test::malformed(page), "");
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_EQ(page.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace burnish
