#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace burnish::test {

/// The root of the checkout that these tests were built from.
std::filesystem::path source_folder();

/// The folder of real scans that tests may read: $BURNISH_TEST_DATA, or shared/data beside the
/// checkout; none where there is neither.
std::optional<std::filesystem::path> data_folder();

/// A new empty folder for this test, removed when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace burnish::test

/// The path of a data file, or the end of the test with a plain message where there is no data.
#define BURNISH_DATA_OR_SKIP(name, relative)                                                \
  if (!burnish::test::data_folder())                                                        \
    GTEST_SKIP() << "no test data: set BURNISH_TEST_DATA to a folder that holds " relative; \
  const std::filesystem::path name = *burnish::test::data_folder() / relative
