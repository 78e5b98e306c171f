#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "burnish/smoothing/quad.h"

// Not part of the library's interface.
namespace burnish {

/// exp(-x) of four numbers at once, x >= 0, to (3 + x) 1e-7 of the value; 0 from x = 87 on. The
/// same bits on every machine, which the standard library's need not be.
inline Quad exp_of_negative(const Quad& x) {
  typedef std::uint32_t Whole __attribute__((vector_size(16)));
  constexpr float kLog2E = 1.44269504f;
  // Added and taken away again, it rounds to whole numbers; its last bits then hold that number.
  constexpr float kRounder = 12582912.f;  // 1.5 * 2^23
  const Quad power = Quad(-kLog2E) * x;
  const Quad shifted = power + Quad(kRounder);
  const Quad rest = power - (shifted - Quad(kRounder));  // within 1/2
  // 2^rest as its series; the last term is 2e-8.
  Quad sum(1.5403530e-4f);
  for (const float factor :
       {1.3333558e-3f, 9.6181291e-3f, 5.5504109e-2f, 2.4022651e-1f, 6.9314718e-1f, 1.f}) {
    sum = sum * rest + Quad(factor);
  }
  const Whole exponent =
      (std::bit_cast<Whole>(shifted.lanes) << 23) + std::bit_cast<Whole>(sum.lanes);
  const auto within = std::bit_cast<Whole>(x.lanes < Quad(87.f).lanes);
  return Quad(std::bit_cast<Quad::Lanes>(exponent & within));
}

}  // namespace burnish
