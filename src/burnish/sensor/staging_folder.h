#pragma once

#include <filesystem>
#include <string>

#include "burnish/base/result.h"

namespace burnish {

/// Lets the frames of a recording appear in a folder all at once: they are written to a hidden
/// subfolder, and commit() moves them up. Without a commit the folder is left as it was.
class StagingFolder {
 public:
  /// Makes `folder` where there is none. One that is not empty must hold a file `mark`, which says
  /// that its frames were written by the same program and may be replaced. Errors:
  /// invalid_argument, io_failure; they name the folder.
  static Result<StagingFolder> create(const std::filesystem::path& folder, const std::string& mark);

  StagingFolder(StagingFolder&& other) noexcept;
  StagingFolder& operator=(StagingFolder&&) = delete;
  ~StagingFolder();

  /// Where to write; has a subfolder `truth`.
  const std::filesystem::path& path() const { return staged_; }

  /// Removes the frames of an earlier recording (frame-*), moves the new files up. Files of other
  /// names stay or are replaced by their namesakes.
  Result<void> commit();

 private:
  StagingFolder() = default;

  std::filesystem::path folder_;
  std::filesystem::path staged_;  ///< empty once committed or moved from
  bool made_ = false;             ///< whether create() made the folder
};

}  // namespace burnish
