#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "burnish/base/result.h"

namespace burnish {

/// The bytes of a file, mapped read-only into memory until the object goes. Movable, not copyable.
class FileBytes {
 public:
  FileBytes() = default;
  FileBytes(const std::byte* data, std::size_t size) : data_(data), size_(size) {}
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) noexcept;
  ~FileBytes();

  std::span<const std::byte> bytes() const { return {data_, size_}; }
  std::string_view text() const { return {reinterpret_cast<const char*>(data_), size_}; }
  std::size_t size() const { return size_; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Maps a regular file; an empty file gives no bytes.
/// Errors: not_found; unsupported for folders, pipes and devices; io_failure with the system's
/// reason.
Result<FileBytes> read_file(const std::filesystem::path& path);

/// The same for a file of which only the front may be wanted: bytes come from the disk as they are
/// looked at.
Result<FileBytes> map_file(const std::filesystem::path& path);

}  // namespace burnish
