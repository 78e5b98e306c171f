#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "burnish/base/result.h"

namespace burnish {

/// Writes a file that appears whole or not at all: the bytes go to a hidden temporary file in the
/// target's folder, which commit() puts in the target's place. A writer that goes without a commit
/// (an error, a cancellation) removes the temporary and leaves the target as it was. Movable.
class AtomicWriter {
 public:
  /// A link is followed; an existing file keeps its permissions. Errors: not_found where the folder
  /// does not exist; unsupported where the target is a folder, a pipe or a device; io_failure.
  static Result<AtomicWriter> create(const std::filesystem::path& path);

  AtomicWriter(AtomicWriter&& other) noexcept;
  AtomicWriter& operator=(AtomicWriter&& other) noexcept;
  ~AtomicWriter();

  /// Appends, unbuffered: hand over large pieces. Errors: io_failure (for example a full disk).
  Result<void> write(const void* data, std::size_t bytes);
  Result<void> write(std::string_view bytes) { return write(bytes.data(), bytes.size()); }

  /// Flushes to the disk, renames, flushes the folder. Nothing may be written afterwards.
  Result<void> commit();

 private:
  AtomicWriter() = default;
  Error failure(const char* what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed or moved from
  int descriptor_ = -1;
};

/// The whole of a small file in one call.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace burnish
