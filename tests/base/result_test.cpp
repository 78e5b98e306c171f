#include "burnish/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace burnish {
namespace {

Result<int> half(int n) {
  if (n % 2 != 0) return Error{ErrorCode::invalid_argument, "number is odd", "line 3"};
  return n / 2;
}

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = half(8), bad = half(7);
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(*good, 4);
  EXPECT_EQ(good.value_or(-1), 4);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(bad.value_or(-1), -1);
}

TEST(Result, GivesAwayAValueThatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
  EXPECT_EQ(result->get(), nullptr);
}

TEST(Result, OfNothingIsSuccessUnlessItHoldsAnError) {
  const Result<void> success, failure = cancelled();
  EXPECT_TRUE(success);
  ASSERT_FALSE(failure);
  EXPECT_EQ(failure.error().code, ErrorCode::cancelled);
}

TEST(Error, TextPutsThePlaceFirst) {
  EXPECT_EQ(half(1).error().text(), "line 3: number is odd");
  EXPECT_EQ(cancelled().text(), "cancelled");
}

TEST(Error, EveryCodeHasItsOwnName) {
  const std::pair<ErrorCode, const char*> names[] = {
      {ErrorCode::invalid_argument, "invalid_argument"},
      {ErrorCode::not_found, "not_found"},
      {ErrorCode::bad_file, "bad_file"},
      {ErrorCode::unsupported, "unsupported"},
      {ErrorCode::bad_geometry, "bad_geometry"},
      {ErrorCode::io_failure, "io_failure"},
      {ErrorCode::out_of_memory, "out_of_memory"},
      {ErrorCode::refuted, "refuted"},
      {ErrorCode::cancelled, "cancelled"}};
  for (const auto& [code, name] : names) EXPECT_EQ(to_string(code), name);
}

}  // namespace
}  // namespace burnish
