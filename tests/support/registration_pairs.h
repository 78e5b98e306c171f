#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "burnish/base/random.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"

// Pairs of depth frames as a virtual Kinect takes them: some that a registration must find, some
// that it must refuse. Number i of a kind is always the same pair.
namespace burnish::test {

/// Two frames, where the source's camera stood in the target's in truth, and what a caller would
/// know of it before.
struct FramePair {
  std::string kind;
  DepthFrame source, target;
  RigidTransform T_target_source, guess;
  double reach = 0.3;  ///< m, how far off the guess may put the surfaces
};

namespace pairs {

constexpr double kDegree = std::numbers::pi / 180;

inline RigidTransform turn_about(const Vec3d& axis, double angle, const Vec3d& translation = {}) {
  const Vec3d a = normalized(axis) * std::sin(angle / 2);
  return rigid_from_quaternion(a.x, a.y, a.z, std::cos(angle / 2), translation);
}

inline Vec3d random_direction(Random& random) {
  const double z = random.uniform(-1, 1);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

inline RigidTransform random_motion(Random& random, double largest_angle, double largest_shift) {
  const Vec3d axis = random_direction(random);
  const double angle = largest_angle * random.uniform(0.3, 1);
  const Vec3d way = random_direction(random);
  const double shift = largest_shift * random.uniform(0.3, 1);
  return turn_about(axis, angle, way * shift);
}

inline void append(TriangleMesh& scene, const TriangleMesh& mesh, const RigidTransform& T) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const Vec3f& p : mesh.positions) scene.positions.push_back(Vec3f(T(Vec3d(p))));
  for (const auto& t : mesh.triangles) {
    scene.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

/// Something that stands on z = 0, about `size` across.
inline TriangleMesh random_thing(Random& random, double size) {
  TriangleMesh thing;
  const std::uint64_t kind = random.below(4);
  const double a = size * random.uniform(0.5, 1), b = size * random.uniform(0.5, 1);
  const double h = size * random.uniform(0.5, 1.5);
  if (kind == 0) append(thing, make_box({a, b, h}), {.translation = {0, 0, h / 2}});
  if (kind == 1) append(thing, make_cylinder(a / 2, h, 48, 4), {.translation = {0, 0, h / 2}});
  if (kind == 2) append(thing, make_sphere(a / 2, 4), {.translation = {0, 0, a / 2}});
  if (kind == 3) {
    append(thing, make_box({a, b, h / 2}), {.translation = {0, 0, h / 4}});
    append(thing, make_box({a / 3, b / 2, h / 2}), {.translation = {a / 4, 0, 3 * h / 4}});
  }
  TriangleMesh turned;
  append(turned, thing, turn_about({0, 0, 1}, random.uniform(0, 6)));
  return turned;
}

/// A room with things along its walls and in it.
inline TriangleMesh random_room(Random& random) {
  TriangleMesh room;
  append(room, make_box({5, 4, 2.6}), {.translation = {0, 0, 1.3}});
  for (int i = 0; i < 22; ++i) {
    const double around = 2 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / 22;
    const double away = random.uniform(1.2, 1.9);
    const TriangleMesh thing = random_thing(random, random.uniform(0.25, 0.9));
    append(room, thing,
           {.translation = {1.2 * away * std::cos(around), away * std::sin(around), 0}});
  }
  for (int i = 0; i < 16; ++i) {  // shelves and pictures on the walls
    const double around = 2 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / 16;
    const double x = std::clamp(4 * std::cos(around), -2.45, 2.45);
    const double y = std::clamp(4 * std::sin(around), -1.95, 1.95);
    const Vec3d size{random.uniform(0.2, 0.6), random.uniform(0.2, 0.6), random.uniform(0.1, 0.6)};
    append(room, make_box(size), {.translation = {x, y, random.uniform(1.0, 2.2)}});
  }
  return room;
}

inline RigidTransform random_stand(Random& random) {
  const Vec3d eye{random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), random.uniform(1.1, 1.6)};
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const double down = random.uniform(0.15, 0.55);
  return look_at(eye, eye + Vec3d{std::cos(azimuth), std::sin(azimuth), -down}, {0, 0, 1});
}

/// A Kinect with 1 / `coarseness` of its pixels a side.
inline Sensor kinect(std::uint32_t coarseness) {
  Sensor sensor = find_sensor("kinect_v1").value();
  Camera& c = sensor.camera;
  c = {c.width / coarseness, c.height / coarseness,           c.fx / coarseness,
       c.fy / coarseness,    (c.cx + 0.5) / coarseness - 0.5, (c.cy + 0.5) / coarseness - 0.5};
  return sensor;
}

inline DepthFrame photograph(const TriangleMesh& scene, const Sensor& sensor,
                             const RigidTransform& pose, std::uint64_t view) {
  return VirtualCamera::create(scene, sensor)->capture(pose, {.seed = 7, .view = view}).value();
}

inline FramePair pair_of(std::string kind, const TriangleMesh& before, const TriangleMesh& after,
                         const Sensor& sensor, const RigidTransform& T_world_target,
                         const RigidTransform& T_target_source, const RigidTransform& guess,
                         std::uint64_t view) {
  return {std::move(kind),
          photograph(after, sensor, T_world_target * T_target_source, 2 * view + 1),
          photograph(before, sensor, T_world_target, 2 * view), T_target_source, guess};
}

/// A camera that looks at the origin from `distance`.
inline RigidTransform look_at_origin(Random& random, double distance, double least_height,
                                     double largest_height) {
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const double height = random.uniform(least_height, largest_height);
  const Vec3d direction = normalized(Vec3d{std::cos(azimuth), std::sin(azimuth), height});
  return look_at(direction * distance, {}, {0, 0, 1});
}

/// The camera moves around the world's z axis by `angle` as seen from the first.
inline RigidTransform around_axis(const RigidTransform& T_world_target, double angle) {
  return T_world_target.inverse() * turn_about({0, 0, 1}, angle) * T_world_target;
}

inline TriangleMesh centred_teapot() {
  TriangleMesh mesh;
  append(mesh, make_shape("teapot").value(), {.translation = {0, 0, -0.08}});
  return mesh;
}

/// Several things grown together, about 0.3 m across, around the origin.
inline TriangleMesh random_figure(Random& random) {
  TriangleMesh figure;
  for (int i = 0; i < 5; ++i) {
    const Vec3d place = random_direction(random) * 0.09;
    const Vec3d axis = random_direction(random);
    const RigidTransform lying = turn_about(axis, random.uniform(0.2, 1), place);
    append(figure, random_thing(random, random.uniform(0.08, 0.16)), lying);
  }
  return figure;
}

}  // namespace pairs

/// Pairs that a registration should find: a camera carried through a room by up to 6 degrees and
/// 12 cm (half of them), an object on a turntable whose steps are known to 2 degrees.
inline FramePair good_pair(std::uint64_t i, std::uint32_t coarseness = 1) {
  using namespace pairs;
  Random random(11, i);
  const Sensor sensor = kinect(coarseness);
  if (i % 2 == 0) {
    const TriangleMesh room = random_room(random);
    const RigidTransform stand = random_stand(random);
    const RigidTransform motion = random_motion(random, 6 * kDegree, 0.12);
    return pair_of("room", room, room, sensor, stand, motion, {}, i);
  }
  const TriangleMesh object = i % 4 == 1 ? centred_teapot() : random_figure(random);
  const RigidTransform stand = look_at_origin(random, random.uniform(0.65, 0.9), 0.2, 0.8);
  const double step = random.uniform(10, 30) * kDegree;
  const double error = random.uniform(-2, 2) * kDegree;
  FramePair pair = pair_of(i % 4 == 1 ? "turned teapot" : "turned figure", object, object, sensor,
                           stand, around_axis(stand, step), around_axis(stand, step + error), i);
  pair.reach = 0.05;
  return pair;
}

/// Pairs that a registration should refuse.
inline FramePair bad_pair(std::uint64_t i, std::uint32_t coarseness = 1) {
  using namespace pairs;
  Random random(12, i);
  const Sensor sensor = kinect(coarseness);
  const std::uint64_t view = 1000 + i;
  switch (i % 7) {
    case 0: {  // looks elsewhere
      const TriangleMesh room = random_room(random);
      const RigidTransform stand = random_stand(random);
      const double angle = random.uniform(90, 270) * kDegree;
      const RigidTransform motion =
          stand.inverse() * turn_about({0, 0, 1}, angle, {0.3, 0.2, 0}) * stand;
      return pair_of("no overlap", room, room, sensor, stand, motion, {}, view);
    }
    case 1: {  // a plate slid along itself
      const double size = random.uniform(0.3, 3);
      const double distance = random.uniform(0.8, 1.6);
      const TriangleMesh plate = make_box({size, size, 0.02}, 4);
      const RigidTransform stand = look_at_origin(random, distance, 1.2, 8);
      const RigidTransform motion =
          stand.inverse() *
          RigidTransform{.translation = {0.08 * random.normal(), 0.08 * random.normal(), 0}} *
          stand;
      return pair_of("plate", plate, plate, sensor, stand, motion, {}, view);
    }
    case 2: {  // a cylinder turned about its axis
      const TriangleMesh cylinder =
          make_cylinder(random.uniform(0.08, 0.3), random.uniform(0.3, 0.6), 256, 4);
      const RigidTransform stand = look_at_origin(random, random.uniform(0.8, 1.3), 0.1, 1);
      return pair_of("cylinder", cylinder, cylinder, sensor, stand,
                     around_axis(stand, random.uniform(10, 60) * kDegree), {}, view);
    }
    case 3: {  // a ball turned about its centre
      const TriangleMesh ball = make_sphere(random.uniform(0.1, 0.35), 6);
      const RigidTransform stand = look_at_origin(random, random.uniform(0.8, 1.3), 0.1, 1);
      return pair_of("sphere", ball, ball, sensor, stand,
                     around_axis(stand, random.uniform(10, 60) * kDegree), {}, view);
    }
    case 4: {  // one image's last columns are the other's first
      const TriangleMesh room = random_room(random);
      const RigidTransform stand = random_stand(random);
      const RigidTransform motion = turn_about({0, 1, 0}, random.uniform(52, 55) * kDegree);
      return pair_of("5 % overlap", room, room, sensor, stand, motion,
                     random.below(2) == 0 ? motion : RigidTransform{}, view);
    }
    case 5: {  // something large is taken to another place
      const TriangleMesh room = random_room(random);
      const RigidTransform stand = random_stand(random);
      const TriangleMesh thing = random_thing(random, 0.5);
      const Vec3d ahead = stand.rotate({0, 0, 1});
      const Vec3d side = stand.rotate({random.below(2) == 0 ? 1.0 : -1.0, 0, 0});
      const Vec3d place =
          Vec3d{stand.translation.x, stand.translation.y, stand.translation.z - 0.2} + ahead * 0.9;
      TriangleMesh before = room, after = room;
      append(before, thing, {.translation = place});
      append(after, thing, {.translation = place + side * random.uniform(0.15, 0.4)});
      return pair_of("moved object", before, after, sensor, stand,
                     random_motion(random, 5 * kDegree, 0.1), {}, view);
    }
    default: {  // the frames' camera is not what they say
      const TriangleMesh room = random_room(random);
      const RigidTransform stand = random_stand(random);
      const RigidTransform motion = turn_about({0, 1, 0}, random.uniform(12, 20) * kDegree,
                                               {0.1, 0, random.uniform(-0.1, 0.1)});
      FramePair pair = pair_of("wrong intrinsics", room, room, sensor, stand, motion, {}, view);
      const double wrong =
          random.below(2) == 0 ? random.uniform(0.7, 0.85) : random.uniform(1.2, 1.4);
      for (DepthFrame* frame : {&pair.source, &pair.target}) {
        frame->camera.fx *= wrong;
        frame->camera.fy *= wrong;
      }
      return pair;
    }
  }
}

}  // namespace burnish::test
