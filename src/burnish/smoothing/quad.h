#pragma once

#include <cstring>

#include "burnish/base/vec3.h"

// Not part of the library's interface.
namespace burnish {

/// Four floats that are added and multiplied lane by lane, in one instruction each where the
/// machine has one, and with the same result where it has none: a point or a direction x, y, z with
/// a number w beside it.
struct Quad {
  typedef float Lanes __attribute__((vector_size(16)));
  Lanes lanes{};

  Quad() = default;
  explicit Quad(Lanes values) : lanes(values) {}
  explicit Quad(float all) : lanes{all, all, all, all} {}
  Quad(float x, float y, float z, float w) : lanes{x, y, z, w} {}
  Quad(const Vec3f& v, float w) : lanes{v.x, v.y, v.z, w} {}

  static Quad load(const float* values) {
    Quad result;
    std::memcpy(&result.lanes, values, sizeof result.lanes);
    return result;
  }
  void store(float* values) const { std::memcpy(values, &lanes, sizeof lanes); }

  float operator[](int lane) const { return lanes[lane]; }
  float w() const { return lanes[3]; }
  void set_w(float w) { lanes[3] = w; }
  Vec3f xyz() const { return {lanes[0], lanes[1], lanes[2]}; }

  Quad& operator+=(const Quad& b) { return lanes += b.lanes, *this; }
  Quad& operator-=(const Quad& b) { return lanes -= b.lanes, *this; }
  Quad& operator*=(const Quad& b) { return lanes *= b.lanes, *this; }
  friend Quad operator+(Quad a, const Quad& b) { return a += b; }
  friend Quad operator-(Quad a, const Quad& b) { return a -= b; }
  friend Quad operator*(Quad a, const Quad& b) { return a *= b; }
  friend Quad operator*(float a, const Quad& b) { return Quad(a) * b; }
};

/// Of every lane the larger one.
inline Quad larger(const Quad& a, const Quad& b) {
  return Quad(a.lanes > b.lanes ? a.lanes : b.lanes);
}

/// x, y and z together.
inline float sum3(const Quad& a) {
  return a[0] + a[1] + a[2];
}
inline float dot3(const Quad& a, const Quad& b) {
  return sum3(a * b);
}

/// sum3 of each of four.
inline Quad sums3(const Quad& a, const Quad& b, const Quad& c, const Quad& d) {
  const Quad xy_ab(__builtin_shufflevector(a.lanes, b.lanes, 0, 1, 4, 5));
  const Quad xy_cd(__builtin_shufflevector(c.lanes, d.lanes, 0, 1, 4, 5));
  const Quad z_ab(__builtin_shufflevector(a.lanes, b.lanes, 2, 2, 6, 6));
  const Quad z_cd(__builtin_shufflevector(c.lanes, d.lanes, 2, 2, 6, 6));
  const Quad x(__builtin_shufflevector(xy_ab.lanes, xy_cd.lanes, 0, 2, 4, 6));
  const Quad y(__builtin_shufflevector(xy_ab.lanes, xy_cd.lanes, 1, 3, 5, 7));
  const Quad z(__builtin_shufflevector(z_ab.lanes, z_cd.lanes, 0, 2, 4, 6));
  return x + y + z;
}

/// The lane in all four.
template <int lane>
Quad splat(const Quad& a) {
  return Quad(a[lane]);
}

}  // namespace burnish
