#include "burnish/base/schema.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

enum class Mode { slow, fast };

struct Params {
  int passes = 3;
  double weight = 0.5;
  double reach = 0.004;
  bool closed = false;
  Mode mode = Mode::fast;

  friend bool operator==(const Params&, const Params&) = default;

  static const Schema<Params>& schema() {
    static const auto schema =
        Schema<Params>()
            .integer("passes", &Params::passes, between(0, 10), "number of passes")
            .real("weight", &Params::weight, {.low = 0, .high = 1, .open_low = true},
                  "share of the new position")
            .real("reach", &Params::reach, more_than(0), "how far neighbours are sought",
                  Quantity::length)
            .flag("closed", &Params::closed, "whether holes are filled")
            .choice("mode", &Params::mode, {{"slow", Mode::slow}, {"fast", Mode::fast}},
                    "which way");
    return schema;
  }
};

std::string refusal(const Settings& settings) {
  const auto read = Params::schema().parse(settings);
  if (read) return "accepted";
  EXPECT_EQ(read.error().code, ErrorCode::invalid_argument);
  return read.error().message;
}

TEST(Schema, WithoutSettingsGivesTheStructsDefaults) {
  EXPECT_EQ(Params::schema().parse({}).value(), Params{});
}

TEST(Schema, ReadsEveryKindOfField) {
  const auto read = Params::schema().parse(
      {{"passes", "7"}, {"weight", "1"}, {"reach", "5mm"}, {"closed", "true"}, {"mode", "slow"}});
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (Params{7, 1, 0.005, true, Mode::slow}));
}

TEST(Schema, TheLastOfTwoSettingsCounts) {
  EXPECT_EQ(Params::schema().parse({{"passes", "1"}, {"passes", "2"}})->passes, 2);
}

TEST(Schema, SettingsReadBackAsTheSameParams) {
  const Params params{9, 1.0 / 3, 0.1 + 0.2, true, Mode::slow};
  const Settings settings = Params::schema().settings(params);
  ASSERT_EQ(settings.size(), 5u);
  EXPECT_EQ(Params::schema().parse(settings).value(), params);
}

TEST(Schema, SaysWhatWasWrongWithAText) {
  EXPECT_EQ(refusal({{"passes", "2.5"}}), "passes: '2.5' is not a whole number");
  EXPECT_EQ(refusal({{"passes", "99999999999"}}), "passes: '99999999999' is not a whole number");
  EXPECT_EQ(refusal({{"weight", "half"}}), "weight: 'half' is not a number");
  EXPECT_EQ(refusal({{"reach", "5deg"}}), "reach: '5deg' is not a number in m, cm, mm, um");
  EXPECT_EQ(refusal({{"closed", "yes"}}), "closed: 'yes' is neither true nor false");
  EXPECT_EQ(refusal({{"mode", "medium"}}), "mode: 'medium' is not one of slow | fast");
  EXPECT_EQ(refusal({{"speed", "1"}}),
            "unknown parameter 'speed', known: passes, weight, reach, closed, mode");
}

TEST(Schema, SaysWhichFieldIsOutOfItsRange) {
  EXPECT_EQ(refusal({{"passes", "11"}}), "passes is 11, allowed: [0, 10]");
  EXPECT_EQ(refusal({{"weight", "0"}}), "weight is 0, allowed: (0, 1]");
  EXPECT_EQ(refusal({{"reach", "-1mm"}}), "reach is -0.001, allowed: (0, inf)");
}

TEST(Schema, ChecksStructsThatNoTextWasReadInto) {
  EXPECT_TRUE(Params::schema().check({}));
  EXPECT_FALSE(Params::schema().check({.passes = -1}));
  EXPECT_FALSE(Params::schema().check({.weight = std::nan("")}));
  EXPECT_FALSE(Params::schema().check({.reach = HUGE_VAL}));
  EXPECT_FALSE(Params::schema().check({.mode = static_cast<Mode>(9)}));
}

TEST(Schema, DescribesItsFields) {
  const auto& fields = Params::schema().fields();
  ASSERT_EQ(fields.size(), 5u);
  EXPECT_EQ(fields[0].type, "integer");
  EXPECT_EQ(fields[0].default_value, "3");
  EXPECT_EQ(fields[1].range, "(0, 1]");
  EXPECT_EQ(fields[2].type, "length");
  EXPECT_EQ(fields[2].unit, "m");
  EXPECT_EQ(fields[3].range, "true | false");
  EXPECT_EQ(fields[4].range, "slow | fast");
  EXPECT_EQ(fields[4].default_value, "fast");
}

struct Outer {
  int count = 1;
  Params inner{.passes = 5};

  static const Schema<Outer>& schema() {
    static const auto schema = Schema<Outer>()
                                   .integer("count", &Outer::count, at_least(0), "how many")
                                   .group(&Outer::inner, Params::schema());
    return schema;
  }
};

TEST(Schema, HoldsTheFieldsOfAStructWithin) {
  const auto& schema = Outer::schema();
  ASSERT_EQ(schema.fields().size(), 6u);
  EXPECT_EQ(schema.fields()[1].key, "passes");
  EXPECT_EQ(schema.fields()[1].default_value, "5");
  EXPECT_EQ(schema.parse({{"weight", "0.25"}})->inner.weight, 0.25);
  EXPECT_FALSE(schema.parse({{"passes", "11"}}));
  EXPECT_FALSE(schema.check({1, {.passes = -1}}));
}

TEST(Range, ContainsItsClosedEndsOnly) {
  EXPECT_TRUE(between(0, 1).contains(0));
  EXPECT_TRUE(between(0, 1).contains(1));
  EXPECT_FALSE(more_than(0).contains(0));
  EXPECT_TRUE(more_than(0).contains(1e-300));
  EXPECT_TRUE(at_least(2).contains(2));
  EXPECT_FALSE(at_least(2).contains(std::nan("")));
  EXPECT_EQ(at_least(2).text(), "[2, inf)");
}

}  // namespace
}  // namespace burnish
