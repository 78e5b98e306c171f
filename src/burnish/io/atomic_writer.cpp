#include "burnish/io/atomic_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace burnish {
namespace fs = std::filesystem;

Error AtomicWriter::failure(const char* what) const {
  const int reason = errno;
  return {reason == ENOENT || reason == ENOTDIR ? ErrorCode::not_found : ErrorCode::io_failure,
          std::string(what) + ": " + std::strerror(reason), target_.string()};
}

Result<AtomicWriter> AtomicWriter::create(const fs::path& path) {
  AtomicWriter writer;
  writer.target_ = path;
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) {
    return Error{ErrorCode::unsupported,
                 S_ISDIR(status.st_mode) ? "is a folder, a file was expected"
                                         : "is a pipe or a device, a regular file was expected",
                 path.string()};
  }
  std::error_code ignored;
  if (exists && fs::is_symlink(path, ignored)) {
    const fs::path behind = fs::canonical(path, ignored);
    if (!behind.empty()) writer.target_ = behind;
  }
  static std::atomic<unsigned> count{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    fs::path name = writer.target_;
    // The name is kept short, so that a target with the longest name possible can be written too.
    name.replace_filename(".burnish-" + std::to_string(::getpid()) + "-" + std::to_string(count++) +
                          ".tmp");
    writer.descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (writer.descriptor_ >= 0) {
      writer.temporary_ = std::move(name);
      if (exists) (void)!::fchmod(writer.descriptor_, status.st_mode & 07777);
      return writer;
    }
    if (errno != EEXIST) break;
  }
  return writer.failure("cannot be created");
}

AtomicWriter::AtomicWriter(AtomicWriter&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicWriter& AtomicWriter::operator=(AtomicWriter&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AtomicWriter::~AtomicWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<void> AtomicWriter::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, next, bytes);
    if (written < 0) {
      if (errno == EINTR) continue;
      return failure("cannot be written");
    }
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return {};
}

Result<void> AtomicWriter::commit() {
  if (::fsync(descriptor_) != 0) return failure("cannot be flushed to the disk");
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("cannot be closed");
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return failure("cannot be put in place");
  temporary_.clear();
  const fs::path parent = target_.parent_path();
  const int folder =
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return {};  // a folder that may be written to but not read: nothing to flush by
  // Some file systems cannot flush a folder and say EINVAL; the file is in place all the same.
  const bool flushed = ::fsync(folder) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int reason = errno;
  ::close(folder);
  errno = reason;
  return flushed ? Result<void>{} : failure("its folder cannot be flushed to the disk");
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
  auto writer = AtomicWriter::create(path);
  if (!writer) return writer.error();
  if (auto ok = writer->write(bytes); !ok) return ok;
  return writer->commit();
}

}  // namespace burnish
