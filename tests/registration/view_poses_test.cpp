#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/registration/sequence_views.h"
#include "burnish/registration/turntable_views.h"
#include "burnish/registration/twist.h"
#include "support/registration_pairs.h"

namespace burnish {
namespace {

using namespace test::pairs;

struct Shots {
  std::vector<DepthFrame> frames;
  std::vector<RigidTransform> T_world_camera;

  ViewSource source() const {
    return {frames.size(), [this](std::size_t i, const Context& context) {
              return surface_view(frames[i], {}, context);
            }};
  }
};

Shots photographs(const TriangleMesh& scene, const std::vector<RigidTransform>& poses,
                  std::uint32_t coarseness) {
  Shots shots{{}, poses};
  const Sensor sensor = kinect(coarseness);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    shots.frames.push_back(photograph(scene, sensor, poses[i], i));
  }
  return shots;
}

/// An object that stands beside the axis, which is not upright, turned by uneven steps.
Shots on_turntable(const TriangleMesh& object, int views) {
  Random random(8, 0);
  const RigidTransform camera = look_at({0.55, 0, 0.35}, {0, 0, 0}, {0, 0, 1});
  const RigidTransform axis = turn_about({1, 2, 0}, 4 * kDegree, {0.02, -0.015, 0});
  std::vector<RigidTransform> poses;
  for (int i = 0; i < views; ++i) {
    const double off = i == 0 ? 0 : 2 * kDegree * random.uniform(-1, 1);
    const double angle = 2 * std::numbers::pi * i / views + off;
    poses.push_back(axis * turn_about({0, 0, 1}, angle) * axis.inverse() * camera);
  }
  return photographs(object, poses, 4);
}

TriangleMesh figure() {
  Random random(3, 0);
  return random_figure(random);
}

/// How far what the object's middle is said to be in view `i` is from where it is, m.
double error_at(const ViewPoses& found, const Shots& shots, std::size_t i) {
  const RigidTransform said = found.T_world_view[0]->inverse() * *found.T_world_view[i];
  const RigidTransform true_pose = shots.T_world_camera[0].inverse() * shots.T_world_camera[i];
  const Vec3d middle = shots.T_world_camera[i].inverse()({0, 0, 0});
  return norm(said(middle) - true_pose(middle));
}

TEST(TurntableViews, FindsAxisAndAnglesOfATiltedTableWithUnevenSteps) {
  const Shots shots = on_turntable(figure(), 14);
  const auto found = register_turntable(shots.source());
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->poses.placed(), shots.frames.size());
  for (std::size_t i = 0; i < shots.frames.size(); ++i) {
    // What is said to be one standard deviation, and the rounding of what is known exactly.
    EXPECT_LT(error_at(found->poses, shots, i), 4 * found->poses.deviations[i] + 1e-9) << i;
  }
  // The camera looks down by atan(0.35 / 0.55), the axis leans by up to 4 degrees towards it.
  EXPECT_NEAR(found->axis_elevation, std::atan2(0.35, 0.55), 5 * kDegree);
}

TEST(TurntableViews, RefusesWhatLooksTheSameFromEverywhere) {
  TriangleMesh can;
  append(can, make_cylinder(0.1, 0.3, 96, 8), {.translation = {0.02, -0.015, 0}});
  const Shots shots = on_turntable(can, 12);
  const auto found = register_turntable(shots.source());
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LE(found->poses.placed(), 1u);
  EXPECT_FALSE(found->poses.notes.empty());
}

TEST(TurntableViews, SameBytesForAnyNumberOfThreads) {
  const Shots shots = on_turntable(figure(), 12);
  std::vector<std::vector<std::optional<RigidTransform>>> poses;
  for (const int threads : {1, 2, 3, 8}) {
    Context context;
    context.threads = threads;
    poses.push_back(register_turntable(shots.source(), {}, context)->poses.T_world_view);
    EXPECT_EQ(poses.back(), poses.front()) << threads;
  }
}

/// A camera that looks around in a room and comes back; the last picture is of elsewhere.
Shots look_around() {
  Random random(5, 0);
  const TriangleMesh room = random_room(random);
  const RigidTransform stand = look_at({-0.6, 0.2, 1.5}, {2, 0.6, 0.6}, {0, 0, 1});
  std::vector<RigidTransform> poses;
  for (const double angle : {0, 4, 8, 12, 9, 5, 1, -3, 180}) {
    poses.push_back(turn_about({0, 0, 1}, angle * kDegree, {0.002 * angle, 0, 0}) * stand);
  }
  return photographs(room, poses, 2);
}

TEST(SequenceViews, FollowsACameraAndLeavesOutWhatFitsNowhere) {
  const Shots shots = look_around();
  const auto found = register_sequence(shots.source());
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->placed(), shots.frames.size() - 1);
  EXPECT_FALSE(found->T_world_view.back());
  EXPECT_FALSE(found->notes.empty());
  for (std::size_t i = 0; i + 1 < shots.frames.size(); ++i) {
    EXPECT_LT(error_at(*found, shots, i), 4 * found->deviations[i] + 1e-9) << i;
  }
}

TEST(SequenceViews, StopsWhereItIsCancelledOrAViewCannotBeRead) {
  const Shots shots = look_around();
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  EXPECT_EQ(register_sequence(shots.source(), {}, context).error().code, ErrorCode::cancelled);
  const ViewSource broken{3, [&](std::size_t i, const Context& c) -> Result<SurfaceView> {
                            if (i == 2) return Error{ErrorCode::bad_file, "torn", "frame 2"};
                            return surface_view(shots.frames[i], {}, c);
                          }};
  EXPECT_EQ(register_sequence(broken).error().where, "frame 2");
}

}  // namespace
}  // namespace burnish
