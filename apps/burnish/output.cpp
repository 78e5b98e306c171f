#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "burnish/io/file_format.h"
#include "summary.h"

namespace burnish::app {

Result<void> check_output(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path file(path);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::string known;
  bool writable = false;
  for (const FileFormat& format : geometry_formats()) {
    if (!format.write) continue;
    for (const std::string_view extension : format.extensions) {
      known += fmt::format("{}{}", known.empty() ? "" : ", ", extension);
      writable |= extension == ending;
    }
  }
  if (!writable) {
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is no format to write, known: {}", ending, known), path};
  }
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
