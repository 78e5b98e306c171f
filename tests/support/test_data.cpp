#include "support/test_data.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>

namespace burnish::test {
namespace fs = std::filesystem;

fs::path source_folder() {
  return BURNISH_SOURCE_DIR;
}

std::optional<fs::path> data_folder() {
  if (const char* given = std::getenv("BURNISH_TEST_DATA")) {
    return fs::is_directory(given) ? std::optional<fs::path>(given) : std::nullopt;
  }
  const fs::path beside = source_folder().parent_path() / "shared" / "data";
  return fs::is_directory(beside) ? std::optional<fs::path>(beside) : std::nullopt;
}

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count{0};
  path_ = fs::temp_directory_path() /
          ("burnish-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace burnish::test
