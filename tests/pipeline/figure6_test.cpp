#include "burnish/pipeline/figure6.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace burnish {
namespace {

TEST(Figure6, EveryPrintedCoordinateAndDistanceIsReproduced) {
  const Figure6 figure = reproduce_figure6();
  std::size_t triples = 0, distances = 0;
  for (const Figure6Row& row : figure.rows) {
    SCOPED_TRACE(row.quantity + ", phase " + std::to_string(row.phase));
    ASSERT_EQ(row.printed.size(), row.computed.size());
    const bool distance = row.quantity[0] == 'd' && row.quantity != "d_avg";
    EXPECT_LE(row.difference(), distance ? 1e-6 : 2e-6);
    EXPECT_TRUE(row.agrees());
    triples += row.printed.size() == 3;
    distances += distance;
  }
  EXPECT_EQ(triples, 21u);
  EXPECT_EQ(distances, 18u);
  EXPECT_TRUE(figure.agrees());
}

TEST(Figure6, SaysWhereThePaperIsOneRowOff) {
  const Figure6 figure = reproduce_figure6();
  const auto remarks = std::count_if(figure.rows.begin(), figure.rows.end(),
                                     [](const Figure6Row& row) { return !row.remark.empty(); });
  EXPECT_EQ(remarks, 4);
  EXPECT_NE(figure6_explanation().find("one row off"), std::string_view::npos);
}

TEST(Figure6, ADifferenceIsADisagreement) {
  Figure6 figure = reproduce_figure6();
  figure.rows[0].computed[2] += 1e-5;
  EXPECT_FALSE(figure.agrees());
  EXPECT_NEAR(figure.largest_difference("P"), 1e-5, 2e-6);
}

}  // namespace
}  // namespace burnish
