#include "burnish/io/decimal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <string>

#include "burnish/base/random.h"

namespace burnish {
namespace {

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

/// Whether the text is one that is read the fast way; what is read must be what from_chars reads.
template <class T>
bool reads_like_from_chars(const std::string& text) {
  const char *first = text.data(), *last = first + text.size();
  T ours = -7, theirs = -7;
  const char* end = read_plain_decimal(first, last, ours);
  if (!end) {
    EXPECT_EQ(ours, T(-7)) << text;
    return false;
  }
  const auto [stop, status] = std::from_chars(first, last, theirs);
  EXPECT_EQ(status, std::errc{}) << text;
  EXPECT_EQ(end - first, stop - first) << text;
  EXPECT_EQ(bits(ours), bits(theirs)) << text;
  return true;
}

bool both_read(const std::string& text) {
  const bool wide = reads_like_from_chars<double>(text);
  return reads_like_from_chars<float>(text) && wide;
}

TEST(Decimal, ReadsWhatFilesHold) {
  for (const char* text : {"0",
                           "-0",
                           "-0.0",
                           "7",
                           "-12.5",
                           ".5",
                           "5.",
                           "-.25e1",
                           "1e5",
                           "1E-5",
                           "1e+05",
                           "-0.0378297",
                           "0.850855 1",
                           "3 next",
                           "1,2",
                           "00012",
                           "9007199254740992",
                           "1e22",
                           "1e-22",
                           "0x10",
                           "0000000000000000001",
                           "1.5abc"}) {
    EXPECT_TRUE(both_read(text)) << text;
  }
}

TEST(Decimal, LeavesTheRest) {
  for (const char* text : {"",
                           "-",
                           ".",
                           "-.",
                           "e5",
                           "nan",
                           "inf",
                           "-inf",
                           "+1",
                           " 1",
                           "--1",
                           "1e",
                           "1e+",
                           "1ex",
                           "1e0000",
                           "1e23",
                           "1e-23",
                           "9007199254740993",
                           "12345678901234567890",
                           "0.00000000000000000001",
                           "18446744073709551616",
                           "99999999999999999999999999"}) {
    EXPECT_FALSE(both_read(text)) << text;
  }
}

TEST(Decimal, EndsWithTheText) {
  const std::string text = "1.25e-3";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const std::string part = text.substr(0, length);  // sanitizers see a byte too far
    reads_like_from_chars<double>(part);
    reads_like_from_chars<float>(part);
  }
}

TEST(Decimal, RoundsLikeFromChars) {
  Random random(5);
  int fast = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double size = std::exp2(40 * random.uniform() - 30);
    const double value = (2 * random.uniform() - 1) * size;
    const int digits = 1 + static_cast<int>(17 * random.uniform());
    fast += both_read(fmt::format("{:.{}g}", value, digits));
    both_read(fmt::format("{:.{}f}", value, digits));
  }
  EXPECT_GT(fast, kCount / 2);
}

TEST(Decimal, RoundsToFloatsFromNearTheMiddleBetweenTwo) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const auto low = static_cast<float>(1 + random.uniform());
    const double middle = (double{low} + double{std::nextafter(low, 4.f)}) / 2;
    for (const int digits : {7, 8, 12, 15, 16}) both_read(fmt::format("{:.{}g}", middle, digits));
    // Its sixteen digits lie beside the middle, but are the middle once rounded to a double.
    both_read(fmt::format("{:.16g}", middle));
    both_read(fmt::format("{:.15f}", middle));
  }
}

}  // namespace
}  // namespace burnish
