#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "conformance/suite.h"
#include "support/test_data.h"

// What an operation says of itself must be so.
namespace burnish::test {
namespace {

class SchemaOf : public Conformance {};

bool snake_case(std::string_view name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == name.npos;
}

/// Which of `others` change nothing. Of a choice every name must matter; of a number the search
/// ends with the first value that does.
std::string without_effect(const Subject& subject, const FieldInfo& field,
                           const std::vector<Settings>& others) {
  const Companion needed = companion(subject.name(), field.key);
  Workpiece sample = subject.sample;
  if (needed.alter) needed.alter(sample);
  const auto untouched = subject.outcome_of(sample, needed.settings);
  if (!untouched) return untouched.error().text();
  std::string idle;
  for (const Settings& settings : others) {
    const auto outcome = subject.outcome_of(sample, settings);
    const bool changed = outcome && bytes(*outcome) != bytes(*untouched);
    if (changed && field.type != "choice") return {};
    if (!changed) idle += fmt::format("{}={} ", field.key, settings.back().second);
  }
  return idle;
}

TEST_P(SchemaOf, EveryFieldChangesTheOutputOrTheReport) {
  for (const FieldInfo& field : subject().info.fields) {
    const auto others = variations(subject(), field);
    ASSERT_FALSE(others.empty()) << field.key << " has no other value";
    const std::string idle = without_effect(subject(), field, others);
    judge("changed by " + field.key, idle);
  }
}

TEST_P(SchemaOf, DefaultsResolveToThemselves) {
  const auto resolved = subject().resolve({});
  ASSERT_TRUE(resolved);
  ASSERT_EQ(resolved->size(), subject().info.fields.size());
  for (std::size_t i = 0; i < resolved->size(); ++i) {
    EXPECT_EQ((*resolved)[i].first, subject().info.fields[i].key);
    EXPECT_EQ((*resolved)[i].second, subject().info.fields[i].default_value);
  }
  EXPECT_EQ(subject().resolve(*resolved).value(), *resolved);
  EXPECT_TRUE(bytes(expected(*resolved)) == bytes(expected()));
}

TEST_P(SchemaOf, SettingsOutOfRangeAreRefused) {
  for (const FieldInfo& field : subject().info.fields) {
    const char* bad = field.type == "integer" ? "0.5" : "no";
    EXPECT_FALSE(subject().resolve({{field.key, bad}})) << field.key;
    EXPECT_FALSE(subject().resolve({{field.key, "nan"}})) << field.key;
    const auto outcome = subject().outcome({{field.key, bad}});
    ASSERT_FALSE(outcome) << field.key;
    EXPECT_EQ(outcome.error().code, ErrorCode::invalid_argument);
  }
}

TEST_P(SchemaOf, NamesAndTextsAreInOrder) {
  const OperationInfo& info = subject().info;
  EXPECT_TRUE(snake_case(info.name)) << info.name;
  EXPECT_TRUE(info.summary.ends_with('.')) << info.summary;
  std::set<std::string> keys;
  for (const FieldInfo& field : info.fields) {
    EXPECT_TRUE(snake_case(field.key)) << field.key;
    EXPECT_TRUE(keys.insert(field.key).second) << field.key << " is there twice";
    EXPECT_FALSE(field.help.empty()) << field.key;
    EXPECT_FALSE(field.help.ends_with('.')) << field.key;
  }
  std::set<std::string> facts;
  for (const Fact& fact : expected().facts) {
    EXPECT_TRUE(snake_case(fact.key)) << fact.key;
    EXPECT_TRUE(facts.insert(fact.key).second) << fact.key << " is reported twice";
    EXPECT_TRUE(std::isfinite(fact.value)) << fact.key;
  }
}

TEST_P(SchemaOf, ItsPaperIsInTheBibliography) {
  if (subject().info.paper.empty()) return;
  std::ifstream file(source_folder() / "docs/bibliography.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("\n## " + subject().info.paper + "\n"), std::string::npos)
      << subject().info.paper;
}

TEST(Exceptions, NameOperationsThatThereAre) {
  for (const Exception& entry : exceptions()) {
    const auto of_that_name = [&](const Subject& subject) {
      return subject.name() == entry.operation;
    };
    EXPECT_TRUE(std::any_of(subjects().begin(), subjects().end(), of_that_name)) << entry.operation;
    EXPECT_FALSE(entry.reason.empty());
  }
}

TEST(Names, AreUniqueInTheirFamily) {
  std::set<std::string> names;
  for (const Subject& subject : subjects())
    EXPECT_TRUE(names.insert(subject.name()).second) << subject.name();
}

BURNISH_FOR_EVERY_OPERATION(SchemaOf);

}  // namespace
}  // namespace burnish::test
