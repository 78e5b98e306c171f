#include "burnish/io/zlib_stream.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace burnish {
namespace {

/// Ends zlib's stream however it is left.
struct Stream {
  z_stream state{};
  bool begun = inflateInit(&state) == Z_OK;
  ~Stream() {
    if (begun) inflateEnd(&state);
  }
};

}  // namespace

bool is_zlib(std::span<const std::byte> bytes) {
  if (bytes.size() < 2) return false;
  const unsigned first = std::to_integer<unsigned>(bytes[0]);
  const unsigned second = std::to_integer<unsigned>(bytes[1]);
  return first == 0x78 && (256 * first + second) % 31 == 0;
}

std::optional<std::vector<std::byte>> unpack_zlib(std::span<const std::byte> input,
                                                  std::size_t most) {
  constexpr std::size_t kLargest = std::numeric_limits<uInt>::max();
  Stream stream;
  if (!stream.begun || input.size() > kLargest || most > kLargest / 2) return std::nullopt;
  z_stream& state = stream.state;
  state.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(input.data()));
  state.avail_in = static_cast<uInt>(input.size());
  std::vector<std::byte> output(std::min(most, 4 * input.size() + 64));
  int status = Z_OK;
  while (status == Z_OK) {
    const std::size_t done = state.total_out;
    // One byte more than is allowed shows a stream that is too long.
    if (done == output.size()) output.resize(std::min(most + 1, 2 * output.size() + 1));
    if (done > most) return std::nullopt;
    state.next_out = reinterpret_cast<Bytef*>(output.data() + done);
    state.avail_out = static_cast<uInt>(output.size() - done);
    status = inflate(&state, Z_NO_FLUSH);
    if (status == Z_BUF_ERROR || (status == Z_OK && state.avail_in == 0 && state.avail_out > 0)) {
      return std::nullopt;  // the input ends within the stream
    }
  }
  if (status != Z_STREAM_END || state.avail_in > 0 || state.total_out > most) return std::nullopt;
  output.resize(state.total_out);
  return output;
}

}  // namespace burnish
