#include "burnish/io/crc32.h"

#include <gtest/gtest.h>

#include <string>

namespace burnish {
namespace {

TEST(Crc32, OfTheUsualCheckStringsIsWhatTheStandardSays) {
  Crc32 none;
  EXPECT_EQ(none.value(), 0u);
  Crc32 digits;
  digits.add("123456789", 9);
  EXPECT_EQ(digits.value(), 0xcbf43926u);
}

TEST(Crc32, DoesNotDependOnHowTheBytesAreCut) {
  const std::string text = "The surface is what the sensor saw.";
  Crc32 whole;
  whole.add(text.data(), text.size());
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Crc32 parts;
    parts.add(text.data(), cut);
    parts.add(text.data() + cut, text.size() - cut);
    EXPECT_EQ(parts.value(), whole.value()) << cut;
  }
}

}  // namespace
}  // namespace burnish
