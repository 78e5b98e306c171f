#include "burnish/base/rigid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/base/random.h"

namespace burnish {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

RigidTransform random_transform(std::uint64_t seed) {
  Random random(seed);
  double q[7];
  for (double& component : q) component = random.normal();
  return rigid_from_quaternion(q[0], q[1], q[2], q[3], {q[4], q[5], q[6]});
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance) {
  EXPECT_LE(norm(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(RigidTransform, AQuarterTurnAboutZTakesXToY) {
  const double half = std::sqrt(0.5);
  const RigidTransform turn = rigid_from_quaternion(0, 0, half, half, {1, 2, 3});
  expect_near(turn({1, 0, 0}), {1, 3, 3}, 4 * kEpsilon);
  expect_near(turn.rotate({0, 1, 0}), {-1, 0, 0}, 4 * kEpsilon);
}

TEST(RigidTransform, FromAnyQuaternionIsAProperRotation) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_LE(rotation_defect(random_transform(seed)), 16 * kEpsilon);
  }
}

TEST(RigidTransform, ItsInverseUndoesIt) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RigidTransform a = random_transform(seed);
    expect_near(a.inverse()(a({0.3, -1.2, 2})), {0.3, -1.2, 2}, 64 * kEpsilon);
  }
}

TEST(RigidTransform, AProductAppliesTheRightOneFirst) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RigidTransform a = random_transform(seed), b = random_transform(seed + 1000);
    expect_near((a * b)({1, -2, 0.5}), a(b({1, -2, 0.5})), 64 * kEpsilon);
  }
}

TEST(RigidTransform, ItsQuaternionGivesItBack) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RigidTransform a = random_transform(seed);
    const auto q = quaternion(a);
    EXPECT_GE(q[3], 0);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 8 * kEpsilon);
    const RigidTransform b = rigid_from_quaternion(q[0], q[1], q[2], q[3], a.translation);
    for (std::size_t i = 0; i < 3; ++i) expect_near(a.rows[i], b.rows[i], 32 * kEpsilon);
  }
}

TEST(RigidTransform, HalfTurnsHaveAQuaternionToo) {
  // The trace is -1, where the common formula divides by zero.
  const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& axis : axes) {
    const auto q = quaternion(rigid_from_quaternion(axis[0], axis[1], axis[2], 0, {}));
    EXPECT_NEAR(std::abs(q[0] * axis[0] + q[1] * axis[1] + q[2] * axis[2]), 1, 8 * kEpsilon);
    EXPECT_NEAR(q[3], 0, 8 * kEpsilon);
  }
}

TEST(LookAt, PutsTheTargetOnTheOpticalAxisAndUpAtTheTop) {
  const Vec3d eye{1, -2, 0.5}, target{0, 0, 0.2}, up{0, 0, 1};
  const RigidTransform pose = look_at(eye, target, up);
  EXPECT_LE(rotation_defect(pose), 8 * kEpsilon);
  const Vec3d seen = pose.inverse()(target);
  expect_near(seen, {0, 0, norm(target - eye)}, 16 * kEpsilon);
  EXPECT_LT(pose.inverse().rotate(up).y, 0);  // y points down
}

TEST(LookAt, StraightDownIsAProperPoseToo) {
  const RigidTransform pose = look_at({0, 0, 5}, {0, 0, 0}, {0, 0, 1});
  EXPECT_LE(rotation_defect(pose), 8 * kEpsilon);
  expect_near(pose.rotate({0, 0, 1}), {0, 0, -1}, 8 * kEpsilon);
}

TEST(RotationDefect, FindsScalesAndMirrors) {
  RigidTransform scaled, mirrored;
  scaled.rows[1] = {0, 1.5, 0};
  mirrored.rows[2] = {0, 0, -1};
  EXPECT_GE(rotation_defect(scaled), 0.5);
  EXPECT_EQ(rotation_defect(mirrored), 2);
  EXPECT_EQ(rotation_defect({}), 0);
}

}  // namespace
}  // namespace burnish
