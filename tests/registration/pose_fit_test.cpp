#include "burnish/registration/pose_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/registration/twist.h"

namespace burnish {
namespace {

Twist random_twist(Random& random, double turn, double shift) {
  Twist twist{};
  for (std::size_t i = 0; i < 3; ++i) twist.rotation[i] = turn * random.normal();
  for (std::size_t i = 0; i < 3; ++i) twist.translation[i] = shift * random.normal();
  return twist;
}

double turn_between(const RigidTransform& a, const RigidTransform& b) {
  return norm(difference(a, b).rotation);
}

double shift_between(const RigidTransform& a, const RigidTransform& b) {
  return norm(a.translation - b.translation);
}

/// Deviations of `turn` (rad) and `shift` (m) in every direction.
Matrix6 information_of(double turn, double shift) {
  Matrix6 information{};
  for (std::size_t i = 0; i < 6; ++i) {
    information[i][i] = i < 3 ? 1 / (turn * turn) : 1 / (shift * shift);
  }
  return information;
}

/// A camera that looks at the middle of a turntable from 0.8 m, turned by `angles`.
std::vector<RigidTransform> turntable_poses(const std::vector<double>& angles) {
  const RigidTransform camera = look_at({0.7, 0.05, 0.4}, {0.02, 0, 0.1}, {0, 0, 1});
  std::vector<RigidTransform> poses;
  for (const double angle : angles) poses.push_back(rotation_by({0, 0, angle}) * camera);
  return poses;
}

std::vector<double> jittered_angles(int views, Random& random) {
  std::vector<double> angles{0};
  for (int i = 1; i < views; ++i) {
    angles.push_back((2 * std::numbers::pi * i + 0.03 * random.normal()) / views);
  }
  return angles;
}

PoseConstraint constraint_between(const std::vector<RigidTransform>& poses, std::uint32_t target,
                                  std::uint32_t source) {
  return {target, source, poses[target].inverse() * poses[source], information_of(1e-3, 1e-3)};
}

/// Every view with the next, around the circle.
std::vector<PoseConstraint> ring_of(const std::vector<RigidTransform>& poses) {
  std::vector<PoseConstraint> ring;
  const auto count = static_cast<std::uint32_t>(poses.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    ring.push_back(constraint_between(poses, i, (i + 1) % count));
  }
  return ring;
}

TEST(Twist, DifferenceMovesOneToTheOther) {
  Random random(1, 0);
  for (int i = 0; i < 100; ++i) {
    const RigidTransform a = moved({}, random_twist(random, 1, 1));
    const RigidTransform b = moved({}, random_twist(random, 1, 1));
    const RigidTransform c = moved(a, difference(a, b));
    EXPECT_LT(turn_between(b, c), 1e-12);
    EXPECT_LT(shift_between(b, c), 1e-12);
  }
}

TEST(Twist, ToldInOtherAxesMovesAlike) {
  Random random(2, 0);
  const RigidTransform T = moved({}, random_twist(random, 1, 1));
  const Twist small = random_twist(random, 1e-5, 1e-5);
  // moved(1, small) seen through T; they differ by the square of the motion.
  const RigidTransform seen = T * moved({}, small) * T.inverse();
  const RigidTransform told = moved({}, in_axes_of(T, small));
  EXPECT_LT(turn_between(seen, told), 1e-9);
  EXPECT_LT(shift_between(seen, told), 1e-9);
}

TEST(FitPoses, FindsPosesThatFitAllConstraints) {
  Random random(3, 0);
  std::vector<RigidTransform> truth;
  for (int i = 0; i < 12; ++i) truth.push_back(moved({}, random_twist(random, 0.8, 1)));
  std::vector<PoseConstraint> constraints = ring_of(truth);
  constraints.push_back(constraint_between(truth, 2, 7));
  std::vector<RigidTransform> guesses = truth;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    guesses[i] = moved(truth[i], random_twist(random, 0.1, 0.1));
  }
  FreePoses poses(guesses);
  const auto fit = fit_poses(poses, constraints, 3);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->converged);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(turn_between(poses.pose(i), truth[i]), 1e-6);
    EXPECT_LT(shift_between(poses.pose(i), truth[i]), 1e-6);
  }
}

TEST(FitPoses, ClosedRingSharesItsErrorByTheInformation) {
  // Three views in a row; the second step is held ten times worse, and takes 100 times the error.
  const Matrix6 good = information_of(1e-3, 1e-3), bad = information_of(1e-2, 1e-2);
  const auto along = [&](double x) {
    RigidTransform T;
    T.translation.x = x;
    return T;
  };
  const std::vector<PoseConstraint> constraints{
      {0, 1, along(1), good}, {1, 2, along(1), bad}, {0, 2, along(2.102), good}};
  FreePoses poses({along(0), along(1), along(2)});
  ASSERT_TRUE(fit_poses(poses, constraints, 1e9));
  EXPECT_NEAR(poses.pose(1).translation.x, 1.001, 1e-9);
  EXPECT_NEAR(poses.pose(2).translation.x, 2.101, 1e-9);
}

TEST(FitPoses, LeavesOutWhatContradictsTheOthers) {
  Random random(4, 0);
  std::vector<RigidTransform> truth;
  for (int i = 0; i < 8; ++i) truth.push_back(moved({}, random_twist(random, 0.8, 1)));
  std::vector<PoseConstraint> constraints = ring_of(truth);
  constraints.push_back(constraint_between(truth, 1, 5));
  constraints.push_back(constraint_between(truth, 3, 7));
  constraints.push_back(constraint_between(truth, 0, 4));
  constraints.back().T_target_source.translation += Vec3d{0.2, 0, 0};
  FreePoses poses(truth);
  const auto fit = fit_poses(poses, constraints, 3);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->contradicted.back());
  EXPECT_EQ(std::count(fit->contradicted.begin(), fit->contradicted.end(), true), 1);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(shift_between(poses.pose(i), truth[i]), 1e-6);
  }
}

TEST(FitPoses, FindsTheAxisAndTheAnglesOfATurntable) {
  Random random(5, 0);
  const std::vector<RigidTransform> truth = turntable_poses(jittered_angles(24, random));
  std::vector<double> nominal(24);
  for (std::size_t i = 0; i < nominal.size(); ++i)
    nominal[i] = 2 * std::numbers::pi * double(i) / 24;
  const RigidTransform off = moved(truth[0], {{0.05, -0.06, 0}, {0.03, -0.04, 0}});
  TurntablePoses poses(off, nominal);
  const auto fit = fit_poses(poses, ring_of(truth), 3);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->converged);
  // What the world is turned by about the axis, and lifted by, nobody can know.
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const RigidTransform a = poses.pose(0).inverse() * poses.pose(i);
    const RigidTransform b = truth[0].inverse() * truth[i];
    EXPECT_LT(turn_between(a, b), 1e-6);
    EXPECT_LT(shift_between(a, b), 1e-6);
  }
}

TEST(FitPoses, ATurntableKnowsMoreThanItsPairs) {
  // Of 24 steps with independent errors the circle leaves the angles, which it closes, and one
  // axis.
  Random random(6, 0);
  const std::vector<RigidTransform> truth = turntable_poses(jittered_angles(24, random));
  std::vector<PoseConstraint> ring = ring_of(truth);
  for (PoseConstraint& c : ring) {
    c.T_target_source = moved(c.T_target_source, random_twist(random, 1e-3, 1e-3));
  }
  std::vector<double> nominal(24);
  for (std::size_t i = 0; i < nominal.size(); ++i)
    nominal[i] = 2 * std::numbers::pi * double(i) / 24;
  TurntablePoses table(truth[0], nominal);
  FreePoses free(truth);
  ASSERT_TRUE(fit_poses(table, ring, 100));
  ASSERT_TRUE(fit_poses(free, ring, 100));
  const auto largest = [&](const PoseModel& poses) {
    double shift = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      shift = std::max(shift, shift_between(poses.pose(0).inverse() * poses.pose(i),
                                            truth[0].inverse() * truth[i]));
    }
    return shift;
  };
  EXPECT_LT(largest(table), largest(free));
}

TEST(FitPoses, RefusesWhatNamesNoView) {
  FreePoses poses({{}, {}});
  EXPECT_EQ(fit_poses(poses, std::vector<PoseConstraint>{{0, 2, {}, {}}}, 3).error().code,
            ErrorCode::invalid_argument);
  EXPECT_EQ(fit_poses(poses, std::vector<PoseConstraint>{{1, 1, {}, {}}}, 3).error().code,
            ErrorCode::invalid_argument);
}

}  // namespace
}  // namespace burnish
