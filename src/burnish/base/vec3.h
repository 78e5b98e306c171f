#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace burnish {

/// A point or a direction; three numbers in a row, so that a vector of them is an (N,3) block.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  template <class U>
  constexpr explicit operator Vec3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
  constexpr T& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const T& operator[](std::size_t axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }

  constexpr Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(T s) { return x *= s, y *= s, z *= s, *this; }

  friend constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return a *= s; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a *= s; }
  friend constexpr Vec3 operator/(const Vec3& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
constexpr T squared_norm(const Vec3<T>& a) {
  return dot(a, a);
}

template <class T>
T norm(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// `a` at length 1; the zero vector where `a` has no direction.
template <class T>
Vec3<T> normalized(const Vec3<T>& a) {
  const T length = norm(a);
  return length > T(0) ? a / length : Vec3<T>{};
}

template <class T>
bool is_finite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace burnish
