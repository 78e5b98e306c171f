#include "burnish/base/quantity.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

namespace burnish {
namespace {

double length(std::string_view text) {
  return parse_quantity(text, Quantity::length).value_or(-1.0);
}

TEST(Quantity, ReadsLengthsInMetres) {
  EXPECT_EQ(length("1.5"), 1.5);
  EXPECT_EQ(length("1.5m"), 1.5);
  EXPECT_EQ(length("150 cm"), 1.5);
  EXPECT_EQ(length("2e3um"), 0.002);
  EXPECT_EQ(parse_quantity("-4mm", Quantity::length).value_or(0.0), -0.004);
}

TEST(Quantity, AMillimetreIsTheNearestDoubleToAThousandth) {
  // Every whole number of millimetres must read as what the decimal fraction would read as.
  for (int n = 1; n < 5000; ++n) {
    const std::string metres =
        std::to_string(n / 1000) + "." + std::to_string(1000 + n % 1000).substr(1);
    ASSERT_EQ(length(std::to_string(n) + "mm"), std::strtod(metres.c_str(), nullptr)) << n;
  }
}

TEST(Quantity, ReadsAnglesInRadiansAndTimesInSeconds) {
  EXPECT_DOUBLE_EQ(parse_quantity("180deg", Quantity::angle).value_or(0.0), std::numbers::pi);
  EXPECT_EQ(parse_quantity("0.5 rad", Quantity::angle).value_or(0.0), 0.5);
  EXPECT_EQ(parse_quantity("250ms", Quantity::time).value_or(0.0), 0.25);
}

TEST(Quantity, RefusesWhatIsNoNumberOrHasAnotherUnit) {
  for (const char* text :
       {"", "mm", "5 kg", "5deg", "1..2", "5mm ", "5 m m", "nan", "inf", "1e999", "+5", "0x10"}) {
    const auto read = parse_quantity(text, Quantity::length);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::invalid_argument);
    EXPECT_EQ(read.error().message, "'" + std::string(text) + "' is not a number in m, cm, mm, um");
  }
  EXPECT_EQ(parse_quantity("3mm", Quantity::number).error().message, "'3mm' is not a number");
}

TEST(Quantity, UnitsAreSI) {
  EXPECT_EQ(unit_of(Quantity::length), "m");
  EXPECT_EQ(unit_of(Quantity::angle), "rad");
  EXPECT_EQ(unit_of(Quantity::time), "s");
  EXPECT_EQ(unit_of(Quantity::number), "");
}

TEST(Quantity, TextReadsBackAsTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, 12345678.9, std::numbers::pi / 180, 5e-324, 0.0}) {
    for (const Quantity quantity : {Quantity::number, Quantity::length, Quantity::angle}) {
      EXPECT_EQ(parse_quantity(quantity_text(value, quantity), quantity).value_or(-1.0), value);
    }
  }
  EXPECT_EQ(quantity_text(0.1, Quantity::number), "0.1");
}

TEST(Quantity, WholeDegreesAreWrittenAsDegrees) {
  EXPECT_EQ(quantity_text(80 * (std::numbers::pi / 180), Quantity::angle), "80deg");
  EXPECT_EQ(quantity_text(0.5, Quantity::angle), "0.5");
  EXPECT_EQ(quantity_text(0, Quantity::angle), "0");
}

}  // namespace
}  // namespace burnish
