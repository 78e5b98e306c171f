#include "burnish/report/numbers.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace burnish {
namespace {

const std::string kThin = "\u202f";

TEST(QuantityText, ChoosesAUnitThatReadsWell) {
  EXPECT_EQ(quantity_text(0.00125, "m"), "1.25" + kThin + "mm");
  EXPECT_EQ(quantity_text(0.000265, "m"), "0.265" + kThin + "mm");
  EXPECT_EQ(quantity_text(0.0000123, "m"), "12.3" + kThin + "µm");
  EXPECT_EQ(quantity_text(0.32, "m"), "32" + kThin + "cm");
  EXPECT_EQ(quantity_text(2.5, "m"), "2.5" + kThin + "m");
  EXPECT_EQ(quantity_text(0.001, "m"), "1" + kThin + "mm");
  EXPECT_EQ(quantity_text(0.012345, "m2"), "123" + kThin + "cm²");
  EXPECT_EQ(quantity_text(0.0035, "m3"), "3.5" + kThin + "l");
  EXPECT_EQ(quantity_text(0.0123, "s"), "12.3" + kThin + "ms");
  EXPECT_EQ(quantity_text(150, "s"), "2.5" + kThin + "min");
  EXPECT_EQ(quantity_text(std::numbers::pi / 4, "rad"), "45°");
  EXPECT_EQ(quantity_text(69451, ""), "69" + kThin + "451");
  EXPECT_EQ(quantity_text(3, "furlong"), "3" + kThin + "furlong");
}

TEST(NumberText, KeepsThreeSignificantDigitsAndWholeNumbers) {
  EXPECT_EQ(number_text(0.123456), "0.123");
  EXPECT_EQ(number_text(12.3456), "12.3");
  EXPECT_EQ(number_text(1234.56), "1235");
  EXPECT_EQ(number_text(123456.7), "123" + kThin + "457");
  EXPECT_EQ(number_text(1234567), "1" + kThin + "234" + kThin + "567");
  EXPECT_EQ(number_text(-2), "\u22122");
  EXPECT_EQ(number_text(-123456), "\u2212123" + kThin + "456");
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(number_text(1e-7), "1e-07");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(number_text(1e300), "1e+300");
}

TEST(RowTexts, GivesAllCellsTheSameDecimals) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(row_texts({0.6, 0.243, 0.265}), (Texts{"0.600", "0.243", "0.265"}));
  EXPECT_EQ(row_texts({2.72, 0.03, 0}), (Texts{"2.72", "0.03", "0"}));
  EXPECT_EQ(row_texts({173.9, 0.5}), (Texts{"173.9", "0.5"}));
  EXPECT_EQ(row_texts({20122, 7}), (Texts{"20" + kThin + "122", "7"}));
}

TEST(WordsOf, WritesKeysAsPeopleDo) {
  EXPECT_EQ(words_of("rms_move"), "RMS move");
  EXPECT_EQ(words_of("moved_vertices"), "Moved vertices");
  EXPECT_EQ(words_of(""), "");
}

}  // namespace
}  // namespace burnish
