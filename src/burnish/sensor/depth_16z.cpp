#include "burnish/sensor/depth_16z.h"

namespace burnish {
namespace {

constexpr unsigned kZero = 6;        ///< the nibble of two equal values
constexpr unsigned kNothing = 0xD;   ///< the nibble after the last value
constexpr unsigned kEscape = 0xF;    ///< the nibble before a wide difference or a whole value
constexpr unsigned kRuns = 0xE0;     ///< and up: so many times two values equal to the last
constexpr unsigned kWide = 0x80;     ///< bit of a byte that is a difference
constexpr unsigned kWideZero = 192;  ///< the byte of two equal values

class Unpacker {
 public:
  Unpacker(std::span<const std::byte> input, std::size_t count) : input_(input), count_(count) {}

  std::optional<std::vector<std::uint16_t>> unpack(bool table) {
    if ((table && !read_table()) || !read_16(last_)) return std::nullopt;
    has_table_ = table;
    values_.reserve(count_);
    bool sound = emit();
    while (sound && !input_.empty()) sound = read_code();
    if (!sound || values_.size() != count_) return std::nullopt;
    return std::move(values_);
  }

 private:
  bool read_8(unsigned& value) {
    if (input_.empty()) return false;
    value = std::to_integer<unsigned>(input_[0]);
    input_ = input_.subspan(1);
    return true;
  }

  bool read_16(std::uint16_t& value) {
    unsigned low = 0, high = 0;
    if (!read_8(low) || !read_8(high)) return false;
    value = static_cast<std::uint16_t>(high << 8 | low);
    return true;
  }

  bool read_table() {
    std::uint16_t size = 0;
    if (!read_16(size) || 2 * std::size_t{size} > input_.size()) return false;
    table_.resize(size);
    for (std::uint16_t& value : table_) read_16(value);
    return true;
  }

  bool emit() {
    if (values_.size() == count_ || (has_table_ && last_ >= table_.size())) return false;
    values_.push_back(has_table_ ? table_[last_] : last_);
    return true;
  }

  bool step(unsigned code, unsigned zero) {
    last_ = static_cast<std::uint16_t>(last_ + zero - code);
    return emit();
  }

  bool read_escaped() {
    unsigned first = 0, second = 0;
    if (!read_8(first)) return false;
    if (first & kWide) return step(first, kWideZero);
    if (!read_8(second)) return false;
    last_ = static_cast<std::uint16_t>(first << 8 | second);
    return emit();
  }

  bool read_code() {
    unsigned code = 0;
    read_8(code);
    if (code == 0xFF) return read_escaped();
    if (code >= kRuns) {
      for (unsigned pair = kRuns; pair < code; ++pair) {
        if (!emit() || !emit()) return false;
      }
      return true;
    }
    if (!step(code >> 4, kZero)) return false;
    const unsigned second = code & 0xF;
    if (second == kEscape) return read_escaped();
    return second == kNothing || step(second, kZero);
  }

  std::span<const std::byte> input_;
  std::size_t count_;
  std::vector<std::uint16_t> table_, values_;
  bool has_table_ = false;
  std::uint16_t last_ = 0;
};

}  // namespace

std::optional<std::vector<std::uint16_t>> unpack_16z(std::span<const std::byte> input, bool table,
                                                     std::size_t count) {
  return Unpacker(input, count).unpack(table);
}

}  // namespace burnish
