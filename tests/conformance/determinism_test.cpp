#include <cstdlib>

#include "conformance/suite.h"

// The same bytes whatever the number of threads, and however the chunks are cut and ordered. That
// builds agree with each other is checked from outside, by comparing what conformance_bytes prints.
namespace burnish::test {
namespace {

class Determinism : public Conformance {};

TEST_P(Determinism, GivesTheSameBytesForEveryNumberOfThreads) {
  Context context;
  context.threads = 1;
  const std::string alone = bytes(expected({}, context));
  for (const int threads : {2, 3, 8}) {
    context.threads = threads;
    EXPECT_TRUE(bytes(expected({}, context)) == alone) << threads << " threads";
  }
}

TEST_P(Determinism, GivesTheSameBytesForEveryNumberOfThreadsWithOtherSettings) {
  for (const FieldInfo& field : subject().info.fields) {
    const auto others = variations(subject(), field);
    if (others.empty()) continue;
    Context context;
    context.threads = 1;
    const auto alone = subject().outcome(others.front(), context);
    ASSERT_TRUE(alone) << alone.error().text();
    context.threads = 3;
    EXPECT_TRUE(bytes(expected(others.front(), context)) == bytes(*alone)) << field.key;
  }
}

TEST_P(Determinism, IsThereInASecondRun) {
  EXPECT_TRUE(bytes(expected()) == bytes(expected()));
}

#ifdef BURNISH_SHUFFLE
TEST_P(Determinism, GivesTheSameBytesForEveryOrderOfTheChunks) {
  ::setenv("BURNISH_SHUFFLE_SEED", "1", 1);
  const std::string first = bytes(expected());
  for (const char* seed : {"2", "3", "4", "5"}) {
    ::setenv("BURNISH_SHUFFLE_SEED", seed, 1);
    EXPECT_TRUE(bytes(expected()) == first) << "seed " << seed;
  }
  ::unsetenv("BURNISH_SHUFFLE_SEED");
}
#endif

BURNISH_FOR_EVERY_OPERATION(Determinism);

}  // namespace
}  // namespace burnish::test
