#include "burnish/sensor/staging_folder.h"

#include <utility>
#include <vector>

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStaged = ".burnish-part";
constexpr const char* kTruth = "truth";

Error failed(const fs::path& path, const std::error_code& reason) {
  return {ErrorCode::io_failure, reason.message(), path.string()};
}

/// Whether only what a run that was killed left behind is in the folder.
bool holds_nothing(const fs::path& folder, std::error_code& reason) {
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end;
       entry.increment(reason)) {
    if (entry->path().filename() != kStaged) return false;
  }
  return true;
}

Result<void> remove_frames(const fs::path& folder) {
  std::error_code reason;
  std::vector<fs::path> frames;
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end;
       entry.increment(reason)) {
    if (entry->path().filename().string().starts_with("frame-")) frames.push_back(entry->path());
  }
  for (const fs::path& frame : frames) {
    if (!reason) fs::remove(frame, reason);
  }
  if (reason) return failed(folder, reason);
  return {};
}

Result<void> move_files(const fs::path& from, const fs::path& to) {
  std::error_code reason;
  fs::create_directories(to, reason);
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(from, reason), end; !reason && entry != end;
       entry.increment(reason)) {
    if (!entry->is_directory()) files.push_back(entry->path());
  }
  for (const fs::path& file : files) {
    if (!reason) fs::rename(file, to / file.filename(), reason);
  }
  if (reason) return failed(to, reason);
  return {};
}

}  // namespace

Result<StagingFolder> StagingFolder::create(const fs::path& folder, const std::string& mark) {
  std::error_code reason;
  StagingFolder staging;
  staging.folder_ = folder;
  const bool exists = fs::exists(folder, reason);
  if (exists && !fs::is_directory(folder, reason)) {
    return Error{ErrorCode::invalid_argument, "it is a file, a folder is expected",
                 folder.string()};
  }
  if (exists && !holds_nothing(folder, reason) && !fs::exists(folder / mark, reason)) {
    return Error{
        ErrorCode::invalid_argument,
        "the folder holds other files (there is no " + mark + " in it): give an empty or a new one",
        folder.string()};
  }
  if (!exists) staging.made_ = fs::create_directories(folder, reason);
  if (!reason) fs::remove_all(folder / kStaged, reason);
  if (!reason) fs::create_directories(folder / kStaged / kTruth, reason);
  if (reason) return failed(folder, reason);
  staging.staged_ = folder / kStaged;
  return staging;
}

StagingFolder::StagingFolder(StagingFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      staged_(std::exchange(other.staged_, {})),
      made_(std::exchange(other.made_, false)) {}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  if (!staged_.empty()) fs::remove_all(staged_, ignored);
  if (made_) fs::remove(folder_, ignored);  // does nothing unless it is empty
}

Result<void> StagingFolder::commit() {
  if (auto removed = remove_frames(folder_); !removed) return removed;
  if (auto moved = move_files(staged_, folder_); !moved) return moved;
  made_ = false;
  return move_files(staged_ / kTruth, folder_ / kTruth);
}

}  // namespace burnish
