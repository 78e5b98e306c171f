#include "burnish/sensor/staging_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <utility>

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

Result<void> remove_frames(const fs::path& folder, const std::vector<std::string>& lists) {
  std::error_code reason;
  std::vector<fs::path> frames;
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end;
       entry.increment(reason)) {
    if (entry->path().filename().string().starts_with("frame-")) frames.push_back(entry->path());
  }
  for (const fs::path& frame : frames) {
    if (!reason) fs::remove(frame, reason);
  }
  for (const std::string& list : lists) {
    if (!reason) fs::remove(folder / list, reason);
  }
  if (reason) return failed(folder, reason);
  return {};
}

/// Flushes the files of a folder to the disk. Together they take a fraction of the time that each
/// would right after it was written: most are there by then.
Result<void> flush_files(const fs::path& folder) {
  std::error_code reason;
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end;
       entry.increment(reason)) {
    const int file = ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0 || ::fsync(file) != 0) reason.assign(errno, std::generic_category());
    if (file >= 0) ::close(file);
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

Result<StagingFolder> StagingFolder::create(const fs::path& folder, const std::string& mark,
                                            std::vector<std::string> lists) {
  std::error_code reason;
  StagingFolder staging;
  staging.folder_ = folder;
  staging.lists_ = std::move(lists);
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
      lists_(std::move(other.lists_)),
      made_(std::exchange(other.made_, false)) {}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  if (!staged_.empty()) fs::remove_all(staged_, ignored);
  if (made_) fs::remove(folder_, ignored);  // does nothing unless it is empty
}

Result<void> StagingFolder::write(const std::string& name, std::string_view bytes) {
  errno = 0;
  std::ofstream file(staged_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return {};
  return failed(folder_ / name, std::error_code(errno ? errno : EIO, std::generic_category()));
}

Result<void> StagingFolder::commit() {
  if (auto flushed = flush_files(staged_); !flushed) return flushed;
  if (auto removed = remove_frames(folder_, lists_); !removed) return removed;
  if (auto moved = move_files(staged_, folder_); !moved) return moved;
  made_ = false;
  std::error_code ignored;
  if (fs::is_empty(staged_ / kTruth, ignored)) return {};
  return move_files(staged_ / kTruth, folder_ / kTruth);
}

}  // namespace burnish
