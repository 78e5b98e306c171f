#include "implicit_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/base/tangent_frame.h"
#include "burnish/core/edges.h"
#include "burnish/triangulation/global.h"

namespace burnish::training {

Vec3d random_direction(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return normalized(Vec3d{x, y, z});
}

namespace {

constexpr double kNoCrease = 1e9;

Vec3d random_point(Random& random, double reach) {
  const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

struct HalfSpace : Solid {
  HalfSpace(const Vec3d& normal_in, double offset_in) : normal(normal_in), offset(offset_in) {}
  Value at(const Vec3d& p) const override { return {dot(normal, p) - offset, kNoCrease}; }
  Vec3d normal;
  double offset;
};

struct Sphere : Solid {
  Sphere(const Vec3d& centre_in, double radius_in) : centre(centre_in), radius(radius_in) {}
  Value at(const Vec3d& p) const override { return {norm(p - centre) - radius, kNoCrease}; }
  Vec3d centre;
  double radius;
};

/// Infinite, of a radius that changes along the axis: a cylinder, a cone, or a turned profile.
struct Round : Solid {
  Round(const Vec3d& centre_in, const Vec3d& axis_in, double radius_in, double taper_in,
        double wave_in)
      : centre(centre_in), axis(axis_in), radius(radius_in), taper(taper_in), wave(wave_in) {}
  Value at(const Vec3d& p) const override {
    const double along = dot(p - centre, axis);
    const double r = radius + taper * along + wave * std::sin(6 * along);
    return {norm(p - centre - along * axis) - r, kNoCrease};
  }
  Vec3d centre, axis;
  double radius, taper, wave;
};

struct Torus : Solid {
  Torus(const Vec3d& centre_in, const Vec3d& axis_in, double major_in, double minor_in)
      : centre(centre_in), axis(axis_in), major(major_in), minor(minor_in) {}
  Value at(const Vec3d& p) const override {
    const double along = dot(p - centre, axis);
    const double across = norm(p - centre - along * axis) - major;
    return {std::sqrt(along * along + across * across) - minor, kNoCrease};
  }
  Vec3d centre, axis;
  double major, minor;
};

/// Waves on the surface of another solid.
struct Wavy : Solid {
  Wavy(SolidPtr solid_in, double height_in, const Vec3d& wave_in)
      : solid(solid_in), height(height_in), wave(wave_in) {}
  Value at(const Vec3d& p) const override {
    Value v = solid->at(p);
    v.f += height * std::sin(wave.x * p.x) * std::sin(wave.y * p.y) * std::sin(wave.z * p.z);
    return v;
  }
  SolidPtr solid;
  double height;
  Vec3d wave;
};

/// What is in both; with `blend` > 0 their edge is rounded.
struct Both : Solid {
  Both(SolidPtr a_in, SolidPtr b_in, double blend_in) : a(a_in), b(b_in), blend(blend_in) {}
  Value at(const Vec3d& p) const override {
    const Value u = a->at(p), v = b->at(p);
    const double apart = std::abs(u.f - v.f);
    const Value& larger = u.f > v.f ? u : v;
    if (blend <= 0) return {larger.f, std::min(larger.crease, apart)};
    const double h = std::max(0.0, blend - apart);
    return {larger.f + h * h / (4 * blend), larger.crease};
  }
  SolidPtr a, b;
  double blend;
};

struct Outside : Solid {
  explicit Outside(SolidPtr solid_in) : solid(solid_in) {}
  Value at(const Vec3d& p) const override {
    const Value v = solid->at(p);
    return {-v.f, v.crease};
  }
  SolidPtr solid;
};

SolidPtr outside(SolidPtr a) {
  return std::make_shared<Outside>(a);
}
SolidPtr both(SolidPtr a, SolidPtr b, double blend) {
  return std::make_shared<Both>(a, b, blend);
}
SolidPtr either(SolidPtr a, SolidPtr b, double blend) {
  return outside(both(outside(a), outside(b), blend));
}

SolidPtr prism(Random& random) {
  const Vec3d centre = random_point(random, 0.3);
  const TangentFrame frame(random_direction(random));
  const int sides = 3 + static_cast<int>(random.below(6));
  const double turn = random.uniform(0, 6);
  SolidPtr solid = std::make_shared<HalfSpace>(
      frame.normal, dot(frame.normal, centre) + random.uniform(0.2, 0.7));
  solid = both(solid,
               std::make_shared<HalfSpace>(-frame.normal,
                                           -dot(frame.normal, centre) + random.uniform(0.2, 0.7)),
               0);
  for (int i = 0; i < sides; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / sides;
    const Vec3d side = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const double out = random.uniform(0.3, 0.7);
    solid = both(solid, std::make_shared<HalfSpace>(side, dot(side, centre) + out), 0);
  }
  return solid;
}

SolidPtr round_bar(Random& random) {
  const Vec3d centre = random_point(random, 0.3), axis = random_direction(random);
  const double radius = random.uniform(0.15, 0.55), taper = random.uniform(-0.4, 0.4);
  const double wave = random.below(3) == 0 ? random.uniform(0.02, 0.08) : 0;
  SolidPtr solid = std::make_shared<Round>(centre, axis, radius, taper, wave);
  const double blend = random.below(2) == 0 ? 0 : 0.1;
  const double above = random.uniform(0.2, 0.8), below = random.uniform(0.2, 0.8);
  solid = both(solid, std::make_shared<HalfSpace>(axis, dot(axis, centre) + above), blend);
  return both(solid, std::make_shared<HalfSpace>(-axis, -dot(axis, centre) + below), blend);
}

SolidPtr simple_solid(Random& random) {
  switch (random.below(5)) {
    case 0:
    case 1:
      return prism(random);
    case 2:
      return round_bar(random);
    case 3: {
      const Vec3d centre = random_point(random, 0.4);
      return std::make_shared<Sphere>(centre, random.uniform(0.2, 0.6));
    }
    default: {
      const Vec3d centre = random_point(random, 0.3), axis = random_direction(random);
      const double major = random.uniform(0.3, 0.6);
      return std::make_shared<Torus>(centre, axis, major, random.uniform(0.1, 0.25));
    }
  }
}

Vec3d gradient(const Solid& solid, const Vec3d& p, double Solid::Value::*part) {
  constexpr double kStep = 1e-5;
  Vec3d g;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3d low = p, high = p;
    low[axis] -= kStep;
    high[axis] += kStep;
    g[axis] = (solid.at(high).*part - solid.at(low).*part) / (2 * kStep);
  }
  return g;
}

/// Moves `p` onto the surface; false where the gradient gives no direction.
bool descend(const Solid& solid, Vec3d& p) {
  for (int i = 0; i < 12; ++i) {
    const Solid::Value v = solid.at(p);
    const Vec3d g = gradient(solid, p, &Solid::Value::f);
    const double squared = squared_norm(g);
    if (!(squared > 1e-3)) return false;
    if (std::abs(v.f) < 1e-9) break;
    p = p - (v.f / squared) * g;
  }
  return true;
}

/// Moves `p` onto the surface, or, where two surfaces meet within `reach`, onto their edge.
bool project(const Solid& solid, double reach, Vec3d& p, bool& sharp) {
  if (!descend(solid, p)) return false;
  sharp = false;
  if (solid.at(p).crease < reach) {
    const Vec3d flat = p;
    for (int i = 0; i < 12; ++i) {
      const Solid::Value v = solid.at(p);
      const Vec3d g = gradient(solid, p, &Solid::Value::f);
      const Vec3d c = gradient(solid, p, &Solid::Value::crease);
      const double gg = dot(g, g), gc = dot(g, c), cc = dot(c, c), det = gg * cc - gc * gc;
      if (!(det > 0.02 * gg * cc)) break;
      p = p - ((v.f * cc - v.crease * gc) / det) * g - ((v.crease * gg - v.f * gc) / det) * c;
    }
    const Solid::Value v = solid.at(p);
    sharp = std::abs(v.f) < 1e-4 && v.crease < 1e-4 && norm(p - flat) < 3 * reach;
    if (!sharp) p = flat;
  }
  return std::abs(solid.at(p).f) < 1e-4 && norm(p) < 3;
}

/// The mean of the normals around `p`: on a sharp edge it looks to both sides.
Vec3d mean_normal(const Solid& solid, const Vec3d& p, double reach) {
  Vec3d sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double step : {-reach, reach}) {
      Vec3d q = p;
      q[axis] += step;
      sum += normalized(gradient(solid, q, &Solid::Value::f));
    }
  }
  return normalized(sum);
}

/// Keeps points that are at least `apart` from those before them.
class Thinned {
 public:
  explicit Thinned(double cell) : cell_(cell), heads_(1 << 18, kEnd) {}
  bool add(const Vec3d& p, double apart) {
    const std::array<std::int64_t, 3> c = cell_of(p);
    for (std::int64_t x = c[0] - 1; x <= c[0] + 1; ++x) {
      for (std::int64_t y = c[1] - 1; y <= c[1] + 1; ++y) {
        for (std::int64_t z = c[2] - 1; z <= c[2] + 1; ++z) {
          for (std::uint32_t i = heads_[slot({x, y, z})]; i != kEnd; i = next_[i]) {
            if (norm(points[i] - p) < apart) return false;
          }
        }
      }
    }
    std::uint32_t& head = heads_[slot(c)];
    next_.push_back(head);
    head = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
    return true;
  }
  std::vector<Vec3d> points;

 private:
  static constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();
  std::array<std::int64_t, 3> cell_of(const Vec3d& p) const {
    const auto index = [this](double x) {
      return static_cast<std::int64_t>(std::floor(x / cell_));
    };
    return {index(p.x), index(p.y), index(p.z)};
  }
  std::size_t slot(const std::array<std::int64_t, 3>& c) const {
    const auto mixed =
        static_cast<std::uint64_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    return mixed & (heads_.size() - 1);
  }
  double cell_;
  std::vector<std::uint32_t> heads_, next_;
};

}  // namespace

SolidPtr random_solid(Random& random) {
  SolidPtr solid = simple_solid(random);
  const std::uint64_t parts = random.below(4);
  for (std::uint64_t i = 0; i < parts; ++i) {
    const SolidPtr other = simple_solid(random);
    const double blend = random.below(2) == 0 ? 0 : random.uniform(0.05, 0.3);
    solid = random.below(3) == 0 ? both(solid, outside(other), blend) : either(solid, other, blend);
  }
  if (random.below(3) == 0) {
    const double x = random.uniform(3, 9), y = random.uniform(3, 9), z = random.uniform(3, 9);
    solid = std::make_shared<Wavy>(solid, random.uniform(0.01, 0.06), Vec3d{x, y, z});
  }
  return solid;
}

Vec3d nearest_on(const Solid& solid, Vec3d p) {
  descend(solid, p);
  return p;
}

TriangleMesh surface_of(const Solid& solid, double spacing, Random& random) {
  // As many tries as leave no room: the area is not known, so stop when nothing fits any more.
  std::vector<Vec3d> sharp_points, points;
  const auto tries = static_cast<int>(150 / (spacing * spacing));
  for (int i = 0; i < tries; ++i) {
    Vec3d p = random_point(random, 1.4);
    bool sharp = false;
    if (std::abs(solid.at(p).f) > 0.15 || !project(solid, 0.7 * spacing, p, sharp)) continue;
    (sharp ? sharp_points : points).push_back(p);
  }
  Thinned thinned(spacing);
  for (const Vec3d& p : sharp_points) thinned.add(p, 0.5 * spacing);
  for (const Vec3d& p : points) thinned.add(p, 0.75 * spacing);
  PointCloud cloud;
  for (const Vec3d& p : thinned.points) {
    cloud.positions.push_back(Vec3f(p));
    cloud.attributes.normals.push_back(Vec3f(mean_normal(solid, p, 0.15 * spacing)));
  }
  const auto surface = triangulate_global(cloud, {.sheet_angle = 3.1});
  return surface ? surface->mesh : TriangleMesh{};
}

}  // namespace burnish::training
