#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace burnish {

/// A number as a sum of doubles that do not overlap, the smallest first (Shewchuk 1997): what sums,
/// differences and products of doubles are exactly. Zeros are left out, so that numbers of few bits
/// stay short and cheap. Exact as long as nothing overflows or falls below the smallest double.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() {}
  Expansion(const Expansion& other) { *this = other; }
  Expansion& operator=(const Expansion& other) {
    std::copy_n(other.terms_.begin(), other.size_, terms_.begin());
    size_ = other.size_;
    return *this;
  }

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return terms_[i]; }
  void append(double term) {
    if (term != 0) terms_[size_++] = term;
  }

  /// -1, 0 or 1: the largest term outweighs all the others.
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, Capacity> terms_;  // not set beyond size_
  std::size_t size_ = 0;
};

/// What an operation on two doubles gives, and by how much that is off.
struct Rounded {
  double value, error;
};

/// a + b (Knuth 1969).
inline Rounded two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a * b; a fused multiply-add rounds once, on every machine.
inline Rounded two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// a - b.
inline Expansion<2> difference(double a, double b) {
  const Rounded rounded = two_sum(a, -b);
  Expansion<2> result;
  result.append(rounded.error);
  result.append(rounded.value);
  return result;
}

/// a + sign * b into `sum`, which has room for both (Shewchuk 1997, figure 9).
template <std::size_t A, std::size_t B, std::size_t C>
void add(const Expansion<A>& a, const Expansion<B>& b, double sign, Expansion<C>& sum) {
  double carry = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool from_a = j == b.size() || (i < a.size() && std::abs(a[i]) < std::abs(b[j]));
    const Rounded rounded = two_sum(carry, from_a ? a[i++] : sign * b[j++]);
    sum.append(rounded.error);
    carry = rounded.value;
  }
  sum.append(carry);
}

template <std::size_t A, std::size_t B>
Expansion<A + B> operator+(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> sum;
  add(a, b, 1, sum);
  return sum;
}

template <std::size_t A, std::size_t B>
Expansion<A + B> operator-(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> sum;
  add(a, b, -1, sum);
  return sum;
}

/// Shewchuk 1997, figure 13.
template <std::size_t A>
Expansion<2 * A> operator*(const Expansion<A>& a, double b) {
  Expansion<2 * A> product;
  double carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rounded term = two_product(a[i], b);
    const Rounded low = two_sum(carry, term.error);
    const Rounded high = two_sum(term.value, low.value);
    product.append(low.error);
    product.append(high.error);
    carry = high.value;
  }
  product.append(carry);
  return product;
}

template <std::size_t A, std::size_t B>
Expansion<2 * A * B> operator*(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<2 * A * B> product;
  for (std::size_t i = 0; i < b.size(); ++i) {
    Expansion<2 * A * B> sum;
    add(product, a * b[i], 1, sum);
    product = sum;
  }
  return product;
}

}  // namespace burnish
