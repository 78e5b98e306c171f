#include "burnish/registration/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/core/transform.h"
#include "burnish/registration/global_start.h"
#include "support/clouds_of_shapes.h"
#include "support/threads.h"

namespace burnish {
namespace {

using test::scan_of;

const RigidTransform kAway = rigid_from_quaternion(0.1, 0.05, -0.08, 1, {0.012, -0.008, 0.01});

/// How far T puts the points of a thing 0.3 m across from where they should be, at most about, m.
double error_of(const PairRegistration& pair, const RigidTransform& truth) {
  double worst = 0;
  for (const Vec3d& p : {Vec3d{0.15, 0, 0}, Vec3d{0, 0.15, 0}, Vec3d{0, 0, 0.15}}) {
    worst = std::max(worst, norm(pair.T_target_source(p) - truth(p)));
  }
  return worst;
}

double squared_error(const Matrix6& information, const Twist& twist) {
  const Vec3d &r = twist.rotation, &t = twist.translation;
  const std::array<double, 6> e{r.x, r.y, r.z, t.x, t.y, t.z};
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) sum += e[i] * information[i][j] * e[j];
  }
  return sum;
}

TEST(Clouds, BothErrorsFindThePose) {
  const PointCloud target = scan_of(test::figure(), 4000, 0.0005, 1);
  const PointCloud source = transformed(scan_of(test::figure(), 4000, 0.0005, 2), kAway.inverse());
  for (const CloudError error : {CloudError::point_to_plane, CloudError::generalized}) {
    const PairRegistration pair = register_clouds(source, target, {}, {.error = error}).value();
    EXPECT_TRUE(pair.accepted()) << pair.reason;
    EXPECT_LT(error_of(pair, kAway), 0.001);
    EXPECT_GT(pair.overlap, 0.9);
  }
}

TEST(Clouds, WhatTurnsIntoItselfIsNotHeld) {
  for (const TriangleMesh& mesh : {make_sphere(0.15, 4), make_cylinder(0.1, 0.3, 200, 8)}) {
    const PairRegistration pair =
        register_clouds(scan_of(mesh, 4000, 0.0005, 1), scan_of(mesh, 4000, 0.0005, 2)).value();
    ASSERT_FALSE(pair.accepted());
    EXPECT_EQ(pair.refusals.back(), Refusal::not_held) << pair.reason;
  }
}

TEST(Clouds, PosesAreBetweenWorlds) {
  // The same clouds a kilometre away: only the frames' origins differ.
  PointCloud target = scan_of(test::figure(), 3000, 0.0005, 1);
  PointCloud source = transformed(scan_of(test::figure(), 3000, 0.0005, 2), kAway.inverse());
  const PairRegistration near = register_clouds(source, target).value();
  source.frame.origin = {1000, 0, 0};
  target.frame.origin = {0, -500, 20};
  const RigidTransform there{.translation = source.frame.origin};
  const RigidTransform here{.translation = target.frame.origin};
  const PairRegistration far = register_clouds(source, target, here * there.inverse()).value();
  const RigidTransform back = here.inverse() * far.T_target_source * there;
  EXPECT_LT(error_of(near, back), 1e-9);
  EXPECT_NEAR(far.weakest.deviation, near.weakest.deviation, 1e-9);
  // A turn about the far world's origin is one about the near world's and a way besides.
  const Vec3d turn{0.3, -0.5, 0.2}, way = cross(turn, target.frame.origin);
  const double expected = squared_error(near.information, {turn, way});
  EXPECT_NEAR(squared_error(far.information, {turn, {}}), expected, 1e-6 * expected);
}

TEST(Clouds, FoundWithoutAGuess) {
  const RigidTransform turned = rigid_from_quaternion(0.5, -0.7, 0.3, 0.2, {0.4, 0.3, -0.2});
  const PointCloud target = scan_of(test::figure(), 4000, 0.0005, 1);
  const PointCloud source = transformed(scan_of(test::figure(), 4000, 0.0005, 2), turned.inverse());
  const PairRegistration pair = register_clouds_globally(source, target, {.draws = 20000}).value();
  EXPECT_TRUE(pair.accepted()) << pair.reason;
  EXPECT_LT(error_of(pair, turned), 0.001);
  const PairRegistration again =
      register_clouds_globally(source, target, {.draws = 20000}, {}, test::with_threads(3)).value();
  EXPECT_EQ(again.T_target_source, pair.T_target_source);
  EXPECT_EQ(again.information, pair.information);
}

TEST(Clouds, ThatWhichFitsTwiceIsAmbiguous) {
  // A plain box lies in a box in four ways.
  const TriangleMesh box = make_box({0.3, 0.2, 0.12}, 8);
  const PairRegistration pair =
      register_clouds_globally(scan_of(box, 4000, 0.0005, 1), scan_of(box, 4000, 0.0005, 2))
          .value();
  ASSERT_FALSE(pair.accepted());
  EXPECT_EQ(pair.refusals.back(), Refusal::ambiguous) << pair.reason;
}

TEST(Clouds, RefusesWhatCannotBe) {
  const PointCloud cloud = scan_of(make_sphere(0.15, 3), 1000, 0.0005, 1);
  PointCloud few;
  few.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(register_clouds(few, cloud).error().where, "source");
  EXPECT_EQ(register_clouds(cloud, few).error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(register_clouds(cloud, cloud, {.rows = {}}).error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(register_clouds(cloud, cloud, {}, {.samples = 0}).error().code,
            ErrorCode::invalid_argument);
}

}  // namespace
}  // namespace burnish
