#pragma once

#include <cstddef>
#include <cstdint>

namespace burnish {

/// The CRC-32 of PNG, zip and Ethernet (ISO 3309), of bytes as they come.
class Crc32 {
 public:
  void add(const void* bytes, std::size_t count);

  /// Of all bytes so far.
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = ~0u;
};

}  // namespace burnish
