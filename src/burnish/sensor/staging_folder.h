#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/result.h"

namespace burnish {

/// Lets the frames of a recording appear in a folder all at once: they are written to a hidden
/// subfolder, and commit() moves them up. Without a commit the folder is left as it was.
class StagingFolder {
 public:
  /// Makes `folder` where there is none. One that is not empty must hold a file `mark`, which says
  /// that its frames were written by the same program and may be replaced, and with them the files
  /// `lists`, which tell of them. Errors: invalid_argument, io_failure; they name the folder.
  static Result<StagingFolder> create(const std::filesystem::path& folder, const std::string& mark,
                                      std::vector<std::string> lists = {});

  StagingFolder(StagingFolder&& other) noexcept;
  StagingFolder& operator=(StagingFolder&&) = delete;
  ~StagingFolder();

  /// Where to write; has a subfolder `truth`.
  const std::filesystem::path& path() const { return staged_; }

  /// Writes a file there, which is on the disk only once commit() has flushed all of them. Errors:
  /// io_failure.
  Result<void> write(const std::string& name, std::string_view bytes);

  /// Flushes the new files, removes the frames of an earlier recording (frame-*) and its lists,
  /// moves the new files up. Files of other names stay or are replaced by their namesakes.
  Result<void> commit();

 private:
  StagingFolder() = default;

  std::filesystem::path folder_;
  std::filesystem::path staged_;  ///< empty once committed or moved from
  std::vector<std::string> lists_;
  bool made_ = false;  ///< whether create() made the folder
};

}  // namespace burnish
