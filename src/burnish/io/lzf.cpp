#include "burnish/io/lzf.h"

#include <cstdint>
#include <cstring>

namespace burnish {

bool unpack_lzf(std::span<const std::byte> input, std::span<std::byte> output) {
  std::size_t in = 0;
  std::size_t out = 0;
  const auto next = [&] { return std::to_integer<std::size_t>(input[in++]); };
  while (in < input.size()) {
    const std::size_t control = next();
    if (control < 32) {  // so many bytes and one as they are
      const std::size_t count = control + 1;
      if (count > input.size() - in || count > output.size() - out) return false;
      std::memcpy(output.data() + out, input.data() + in, count);
      in += count;
      out += count;
      continue;
    }
    // Bytes that were there before: three bits of length (7: more follow), 13 bits of distance.
    std::size_t count = (control >> 5) + 2;
    if (count == 9) {
      if (in == input.size()) return false;
      count += next();
    }
    if (in == input.size()) return false;
    const std::size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > out || count > output.size() - out) return false;
    for (; count > 0; --count, ++out) output[out] = output[out - distance];  // may overlap
  }
  return out == output.size();
}

}  // namespace burnish
