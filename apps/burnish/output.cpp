#include <filesystem>

#include "burnish/io/file_format.h"
#include "summary.h"

namespace burnish::app {

Result<void> check_output(const std::string& path) {
  if (auto format = format_to_write(path); !format) return format.error();
  return check_folder_of(path);
}

Result<void> check_folder_of(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code unreadable;
  const fs::path folder = fs::path(path).parent_path();
  if (folder.empty() || fs::is_directory(folder, unreadable)) return {};
  return Error{ErrorCode::not_found, "the folder to write to is not there", path};
}

}  // namespace burnish::app
