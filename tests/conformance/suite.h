#pragma once

#include <gtest/gtest.h>

#include "conformance/exceptions.h"
#include "conformance/subject.h"

namespace burnish::test {

/// One test for every operation of the catalogue.
class Conformance : public testing::TestWithParam<SubjectRef> {
 protected:
  const Subject& subject() const { return *GetParam().subject; }

  /// What becomes of the sample; the test ends where that is an error.
  Outcome expected(const Settings& settings = {}, const Context& context = {}) const {
    auto outcome = subject().outcome(settings, context);
    if (!outcome) throw std::runtime_error(subject().name() + ": " + outcome.error().text());
    return std::move(outcome).value();
  }

  /// `violation` must be empty, unless the table of exceptions has the property; then it must not.
  void judge(std::string_view property, const std::string& violation) const {
    const auto reason = exception(subject().name(), property);
    if (reason.empty()) {
      EXPECT_EQ(violation, "") << subject().name() << " is not " << property;
    } else {
      EXPECT_NE(violation, "") << "the exception is not needed: " << reason;
    }
  }
};

inline std::string test_name(const testing::TestParamInfo<SubjectRef>& info) {
  return info.param.subject->family + "_" + info.param.subject->info.name;
}

}  // namespace burnish::test

#define BURNISH_FOR_EVERY_OPERATION(suite)                                                     \
  INSTANTIATE_TEST_SUITE_P(Catalogue, suite, testing::ValuesIn(burnish::test::subject_refs()), \
                           burnish::test::test_name)
