// Every file of a corpus, through the reader of every format, whichever it was written for.
#include <gtest/gtest.h>

#include "samples.h"
#include "support/reader_promises.h"

namespace burnish {
namespace {

/// Feeds all files of the folder; gives their number.
int feed(const std::filesystem::path& folder) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().string());
    const std::string bytes = test::slurp(entry.path());
    for (const FileFormat& format : geometry_formats()) test::expect_promises_kept(format, bytes);
    ++files;
  }
  return files;
}

TEST(Corpus, SeedsOfTheFuzzersKeepThePromises) {
  EXPECT_GE(feed(test::source_folder() / "fuzz" / "seeds"), 14);
}

TEST(Corpus, EachSeedIsAValidFileOfItsFormat) {
  for (const FileFormat& format : geometry_formats()) {
    const auto seeds = test::source_folder() / "fuzz" / "seeds" / format.name;
    for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
      const auto file = test::parse(format.name, test::slurp(entry.path()));
      EXPECT_TRUE(file) << entry.path() << ": " << file.error().text();
    }
  }
}

TEST(Corpus, OddFilesKeepThePromisesInTheReadersOfOtherFormatsToo) {
  BURNISH_DATA_OR_SKIP(odd, "odd");
  EXPECT_GT(feed(odd), 100);
}

}  // namespace
}  // namespace burnish
