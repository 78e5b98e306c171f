#include "burnish/io/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace burnish {

FileBytes::FileBytes(FileBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

FileBytes::~FileBytes() {
  if (data_) ::munmap(const_cast<std::byte*>(data_), size_);
}

namespace {

/// A file descriptor that closes itself.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

Error failure(const std::filesystem::path& path, int reason) {
  const ErrorCode code =
      reason == ENOENT || reason == ENOTDIR ? ErrorCode::not_found : ErrorCode::io_failure;
  return {code, std::string("cannot be read: ") + std::strerror(reason), path.string()};
}

Result<FileBytes> map(const std::filesystem::path& path, int flags) {
  // Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.number < 0) return failure(path, errno);
  struct stat status {};
  if (::fstat(file.number, &status) != 0) return failure(path, errno);
  if (S_ISDIR(status.st_mode)) {
    return Error{ErrorCode::unsupported, "is a folder, a file was expected", path.string()};
  }
  if (!S_ISREG(status.st_mode)) {
    return Error{ErrorCode::unsupported, "is a pipe or a device, a regular file was expected",
                 path.string()};
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return FileBytes{};
  void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | flags, file.number, 0);
  if (data == MAP_FAILED) return failure(path, errno);
  return FileBytes(static_cast<const std::byte*>(data), size);
}

}  // namespace

Result<FileBytes> read_file(const std::filesystem::path& path) {
  // Populating the map in one call costs less than taking a page fault every few pages.
  return map(path, MAP_POPULATE);
}

Result<FileBytes> map_file(const std::filesystem::path& path) {
  return map(path, 0);
}

}  // namespace burnish
