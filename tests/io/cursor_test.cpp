#include "burnish/io/cursor.h"

#include <gtest/gtest.h>

#include "burnish/base/random.h"

namespace burnish {
namespace {

TEST(Cursor, CountsLinesOfEveryEnding) {
  Cursor cursor("one\ntwo\r\nthree\rfour\n\nsix", "f");
  const std::pair<std::string_view, std::size_t> words[] = {
      {"one", 1}, {"two", 2}, {"three", 3}, {"four", 4}, {"six", 6}};
  for (const auto& [word, line] : words) {
    ASSERT_TRUE(cursor.next_filled_line());
    EXPECT_EQ(cursor.line(), line);
    EXPECT_EQ(cursor.word(), word);
  }
  EXPECT_FALSE(cursor.next_filled_line());
  EXPECT_EQ(cursor.line_error("bad").text(), "f, line 6: bad");
}

TEST(Cursor, KnowsCommentsAndContinuations) {
  Cursor cursor("a # b\\\n# c\n1 \\\r\n 2\\\n3", "f", {.comment = '#', .continuation = '\\'});
  EXPECT_EQ(cursor.word(), "a");
  EXPECT_TRUE(cursor.at_line_end());
  ASSERT_TRUE(cursor.next_filled_line());
  EXPECT_EQ(cursor.line(), 3u);
  for (int expected = 1; expected <= 3; ++expected) {
    int number = 0;
    ASSERT_TRUE(cursor.number(number)) << expected;
    EXPECT_EQ(number, expected);
  }
  EXPECT_TRUE(cursor.at_end());
}

template <class T>
std::optional<T> number(std::string_view text) {
  Cursor cursor(text, {});
  T value{};
  if (!cursor.number(value)) {
    EXPECT_EQ(cursor.offset(), text.find_first_not_of(' ') == std::string_view::npos
                                   ? text.size()
                                   : text.find_first_not_of(' '));
    return std::nullopt;
  }
  return value;
}

TEST(Cursor, ReadsNumbersThatTheirTypeHolds) {
  EXPECT_EQ(number<int>("+7"), 7);
  EXPECT_EQ(number<int>(" 3.0 "), 3);
  EXPECT_EQ(number<int>("1e3"), 1000);
  EXPECT_EQ(number<int>("3.5"), std::nullopt);
  EXPECT_EQ(number<std::uint8_t>("255"), 255);
  EXPECT_EQ(number<std::uint8_t>("256"), std::nullopt);
  EXPECT_EQ(number<std::uint32_t>("-1"), std::nullopt);
  EXPECT_EQ(number<float>("+.5"), .5f);
  EXPECT_EQ(number<float>("1e-60"), 0.f);
  EXPECT_EQ(number<double>("1e-600"), 0.);
  EXPECT_EQ(number<float>("1e60"), std::nullopt);
  EXPECT_EQ(number<double>("1e600"), std::nullopt);
  EXPECT_EQ(number<float>("inf"), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(*number<float>("nan")));
  for (const char* bad : {"", " ", "1,5", "0x10", "1.#INF", "+-1", "--1", "1e", "abc"}) {
    EXPECT_EQ(number<float>(bad), std::nullopt) << bad;
  }
}

TEST(Cursor, NeverReadsBeyondTheEnd) {
  Random random(1);
  const std::string_view alphabet = " \t\n\r\\#+-.19eEinfa\x01\xff";
  for (int i = 0; i < 2000; ++i) {
    std::vector<char> bytes(random.below(12));
    for (char& c : bytes) c = alphabet[random.below(alphabet.size())];
    Cursor cursor({bytes.data(), bytes.size()}, {}, {.comment = '#', .continuation = '\\'});
    for (int step = 0; step < 30; ++step) {
      double value = 0;
      switch (random.below(5)) {
        case 0:
          cursor.number(value);
          break;
        case 1:
          cursor.word();
          break;
        case 2:
          cursor.next_filled_line();
          break;
        case 3:
          cursor.next_line();
          break;
        default:
          cursor.rest_of_line();
      }
      ASSERT_LE(cursor.offset(), bytes.size());
    }
  }
}

TEST(Cursor, ReadsBothByteOrders) {
  Cursor cursor(std::string_view("\x01\x02\x01\x02\x03", 5), "f");
  std::uint16_t value = 0;
  ASSERT_TRUE(cursor.read(value, std::endian::little));
  EXPECT_EQ(value, 0x0201);
  ASSERT_TRUE(cursor.read(value, std::endian::big));
  EXPECT_EQ(value, 0x0102);
  EXPECT_FALSE(cursor.read(value));
  EXPECT_EQ(cursor.take(2), nullptr);
  EXPECT_EQ(cursor.byte_error("bad").text(), "f, byte 4: bad");
}

TEST(Cursor, GoesThroughLinesOfIntegers) {
  Cursor cursor("3 0 12 999999999\n 3\t1 2  4 \r\n3 1 2\n", "f");
  std::array<std::uint32_t, 4> row{};
  ASSERT_TRUE(cursor.line_of_integers(row));
  EXPECT_EQ(row, (std::array<std::uint32_t, 4>{3, 0, 12, 999999999}));
  ASSERT_TRUE(cursor.line_of_integers(row));
  EXPECT_EQ(row, (std::array<std::uint32_t, 4>{3, 1, 2, 4}));
  EXPECT_EQ(cursor.line(), 3u);
  const std::size_t before = cursor.offset();
  EXPECT_FALSE(cursor.line_of_integers(row));
  EXPECT_EQ(cursor.offset(), before);
}

TEST(Cursor, LeavesLinesOfAnythingElse) {
  for (const char* text : {"", "1 2", "1 2 3 4", "1 2 3.0", "-1 2 3", "+1 2 3", "1 2 3x",
                           "1 2 1000000000", "1\n2 3", "1 2 3 #", "\n1 2 3"}) {
    Cursor cursor(text, "f", {.comment = '#'});
    std::array<std::uint32_t, 3> row{};
    EXPECT_FALSE(cursor.line_of_integers(row)) << text;
    EXPECT_EQ(cursor.offset(), 0u) << text;
  }
  Cursor last("1 2 3", "f");
  std::array<std::uint32_t, 3> row{};
  EXPECT_TRUE(last.line_of_integers(row));
  EXPECT_TRUE(last.at_end());
}

}  // namespace
}  // namespace burnish
