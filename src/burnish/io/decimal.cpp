#include "burnish/io/decimal.h"

#include <bit>
#include <cstdint>
#include <cstdlib>

namespace burnish {
namespace {

constexpr int kMostDigits = 19;       // always fit 64 bits
constexpr int kLargestExponent = 22;  // 10^22 is the last power of ten that a double holds exactly
constexpr std::uint64_t kLargestMantissa = std::uint64_t{1} << 53;
constexpr double kPowersOfTen[kLargestExponent + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Appends the digits at `at` to `number` and goes behind them; what overflows is for the caller to
/// find out from their count.
template <class Integer>
const char* read_digits(const char* at, const char* last, Integer& number) {
  for (; at != last; ++at) {
    const unsigned digit = static_cast<unsigned char>(*at) - unsigned{'0'};
    if (digit > 9) break;
    number = number * 10 + static_cast<Integer>(digit);
  }
  return at;
}

/// At an 'e': adds the exponent; null where no exponent of at most three digits follows.
const char* read_exponent(const char* at, const char* last, int& exponent) {
  ++at;
  const bool negative = at != last && *at == '-';
  if (at != last && (*at == '-' || *at == '+')) ++at;
  unsigned size = 0;
  const char* end = read_digits(at, last, size);
  if (end == at || end - at > 3) return nullptr;
  exponent += negative ? -static_cast<int>(size) : static_cast<int>(size);
  return end;
}

}  // namespace

const char* read_plain_decimal(const char* first, const char* last, double& value) {
  const bool negative = first != last && *first == '-';
  if (negative) ++first;
  std::uint64_t mantissa = 0;
  const char* at = read_digits(first, last, mantissa);
  auto digits = at - first;
  int exponent = 0;
  if (at != last && *at == '.') {
    const char* end = read_digits(at + 1, last, mantissa);
    const auto decimals = end - (at + 1);
    digits += decimals;
    // More digits than may be are refused below; till then the exponent must not overflow.
    exponent = decimals > kMostDigits ? 0 : -static_cast<int>(decimals);
    at = end;
  }
  if (digits == 0 || digits > kMostDigits) return nullptr;
  if (at != last && (*at == 'e' || *at == 'E')) {
    at = read_exponent(at, last, exponent);
    if (!at) return nullptr;
  }
  if (mantissa > kLargestMantissa || std::abs(exponent) > kLargestExponent) return nullptr;
  // Both operands are exact, so that the one rounding is the right one.
  const auto whole = static_cast<double>(mantissa);
  const double size =
      exponent < 0 ? whole / kPowersOfTen[-exponent] : whole * kPowersOfTen[exponent];
  value = negative ? -size : size;
  return at;
}

const char* read_plain_decimal(const char* first, const char* last, float& value) {
  double wide = 0;
  const char* end = read_plain_decimal(first, last, wide);
  if (!end) return nullptr;
  // Rounding twice goes wrong only where the first rounding ends just in the middle between two
  // floats. A double has 29 bits more; all that comes from above is 0 or a normal float.
  constexpr std::uint64_t kBehindFloat = (std::uint64_t{1} << 29) - 1, kMiddle = 1u << 28;
  if ((std::bit_cast<std::uint64_t>(wide) & kBehindFloat) == kMiddle) return nullptr;
  value = static_cast<float>(wide);
  return end;
}

}  // namespace burnish
