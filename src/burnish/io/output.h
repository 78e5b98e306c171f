#pragma once

#include <array>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "burnish/base/context.h"
#include "burnish/io/atomic_writer.h"

namespace burnish {

/// Gathers the small pieces that a writer makes into large writes, counts rows for the progress and
/// keeps the first error, so that writers need not look at every step: they stop where !ok().
class Output {
 public:
  /// `rows`: how many times advance() will count up to in all.
  Output(AtomicWriter& writer, std::size_t rows, const Context& context)
      : writer_(writer), rows_(rows), context_(context) {
    buffer_.reserve(kFull + 4096);
  }

  bool ok() const { return error_.has_value(); }
  void fail(Error error) {
    if (ok()) error_ = std::move(error);
  }

  Output& text(std::string_view text) {
    append(text.data(), text.size());
    return *this;
  }
  Output& character(char c) {
    append(&c, 1);
    return *this;
  }
  /// The shortest decimal that reads back as the same number.
  template <class T>
  Output& number(T value) {
    std::array<char, 40> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    append(digits.data(), static_cast<std::size_t>(end - digits.data()));
    return *this;
  }
  /// The bytes of a number, little endian (as all machines that burnish runs on).
  template <class T>
  Output& raw(const T& value) {
    append(&value, sizeof(value));
    return *this;
  }
  /// Room for that many bytes, to be filled before the next call.
  char* room(std::size_t bytes) {
    const std::size_t old = buffer_.size();
    buffer_.resize(old + bytes);
    return buffer_.data() + old;
  }
  Output& bytes(const void* data, std::size_t count) {
    append(data, count);
    return *this;
  }

  /// `rows` more rows are done: writes what has gathered, tells the progress, looks for
  /// cancellation.
  bool advance(std::size_t rows);

  /// Writes the rest; the first error of all.
  Result<void> finish();

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 20;

  void append(const void* data, std::size_t count) {
    if (buffer_.size() + count > kFull) flush();
    if (count > kFull) {
      if (ok()) error_ = writer_.write(data, count);
      return;
    }
    buffer_.append(static_cast<const char*>(data), count);
  }
  void flush();

  AtomicWriter& writer_;
  std::string buffer_;
  std::size_t rows_, done_ = 0;
  const Context& context_;
  Result<void> error_;
};

/// Calls `write(first, count)` for runs of at most 4096 of `total` rows while the output is sound.
template <class Write>
void write_rows(Output& out, std::size_t total, Write write) {
  constexpr std::size_t kRows = 4096;
  for (std::size_t first = 0; first < total && out.ok(); first += kRows) {
    const std::size_t count = total - first < kRows ? total - first : kRows;
    write(first, count);
    out.advance(count);
  }
}

}  // namespace burnish
