#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/io/geometry_file.h"
#include "burnish/registration/global_start.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/spatial/neighbour_grid.h"
#include "support/test_data.h"

namespace burnish {
namespace {

constexpr double kDegree = 0.017453292519943295;

struct Difference {
  double way, turn;  ///< m, rad
};

Difference difference(const RigidTransform& a, const RigidTransform& b) {
  const RigidTransform d = a.inverse() * b;
  const auto [qx, qy, qz, qw] = quaternion(d);
  return {norm(d.translation), 2 * std::asin(std::min(1.0, std::hypot(qx, qy, qz)))};
}

struct Views {
  std::vector<SurfaceView> views;
  std::vector<RigidTransform> poses;

  Views(const FrameSequence& frames, const std::vector<std::size_t>& which) {
    for (const std::size_t i : which) {
      const DepthFrame frame = frames.read(i).value();
      views.push_back(surface_view(frame).value());
      poses.push_back(frame.T_world_camera);
    }
  }
  RigidTransform given(std::size_t target, std::size_t source) const {
    return poses[target].inverse() * poses[source];
  }
};

TEST(RealData, KitchenFramesAreFoundFromNoGuess) {
  BURNISH_DATA_OR_SKIP(folder, "depth/kinect_v1_kitchen");
  const Views kitchen(open_frames({folder}).value(), {0, 1, 2, 20, 21, 22});
  for (const std::size_t i : {0u, 1u, 3u, 4u}) {
    const PairRegistration pair =
        register_projective(kitchen.views[i + 1], kitchen.views[i]).value();
    EXPECT_TRUE(pair.accepted()) << pair.reason;
    const Difference d = difference(pair.T_target_source, kitchen.given(i, i + 1));
    EXPECT_LT(d.way, 0.015);
    EXPECT_LT(d.turn, 1 * kDegree);
  }
}

/// Between frames 12 and 13 the given trajectory is off by 33 mm: at its poses a fifth of what both
/// see contradicts, at ours nothing, and ours agree with what comes by the frame after.
TEST(RealData, WhereTheGivenPoseIsWrongTheDataSaySo) {
  BURNISH_DATA_OR_SKIP(folder, "depth/kinect_v1_kitchen");
  const Views kitchen(open_frames({folder}).value(), {12, 13, 14});
  const auto found = [&](std::size_t target, std::size_t source) {
    return register_projective(kitchen.views[source], kitchen.views[target]).value();
  };
  const PairRegistration first = found(0, 1), second = found(1, 2), both = found(0, 2);
  EXPECT_TRUE(first.accepted() && second.accepted() && both.accepted());
  const Difference closure =
      difference(first.T_target_source * second.T_target_source, both.T_target_source);
  EXPECT_LT(closure.way, 0.005);
  EXPECT_LT(closure.turn, 0.3 * kDegree);
  const PairRegistration given =
      assess_projective(kitchen.views[1], kitchen.views[0], kitchen.given(0, 1)).value();
  EXPECT_FALSE(given.accepted());
  EXPECT_GT(given.contradiction, 0.1);
  EXPECT_GT(given.inlier_rmse, 1.5 * first.inlier_rmse);
}

TEST(RealData, PosedFramesFarApartAreFoundOrRefused) {
  BURNISH_DATA_OR_SKIP(folder, "depth/kinect_five_posed");
  const FrameOptions options{.poses = folder / "pose.txt",
                             .camera = Camera{0, 0, 518, 519, 325.5, 253.5}};
  const Views frames(open_frames({folder / "depth"}, options).value(), {0, 1, 2, 3, 4});
  const GlobalStartParams start{.draws = 50000};
  for (std::size_t i = 1; i < 4; ++i) {
    const PairRegistration pair =
        register_views_globally(frames.views[i + 1], frames.views[i], start).value();
    EXPECT_TRUE(pair.accepted()) << i + 1 << ": " << pair.reason;
    // The given poses agree with the depth to 13 to 23 mm only, and at 2 m a degree is 35 mm.
    const Difference d = difference(pair.T_target_source, frames.given(i, i + 1));
    EXPECT_LT(d.way, 0.07);
    EXPECT_LT(d.turn, 1.5 * kDegree);
  }
  const PairRegistration first =
      register_views_globally(frames.views[1], frames.views[0], start).value();
  EXPECT_FALSE(first.accepted());
}

TEST(RealData, BunnyScansMeetWithoutAGuess) {
  BURNISH_DATA_OR_SKIP(folder, "stanford/rangescans");
  const PointCloud target = cloud_of(read_geometry(folder / "bun000.ply").value());
  const PointCloud source = cloud_of(read_geometry(folder / "bun045.ply").value());
  const PairRegistration pair = register_clouds_globally(source, target, {.draws = 50000}).value();
  EXPECT_TRUE(pair.accepted()) << pair.reason;
  const RigidTransform checked = rigid_from_quaternion(-0.00548449, 0.294635, 0.0038555, 0.955586,
                                                       {-0.0520211, -0.000383981, -0.0109223});
  const Vec3d middle = checked.inverse()(pair.centre);
  EXPECT_LT(norm(pair.T_target_source(middle) - checked(middle)), 0.0002);
  const NeighbourGrid grid(target.positions);
  std::vector<double> distances;
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < source.positions.size(); i += 7) {
    grid.nearest(Vec3f(pair.T_target_source(Vec3d(source.positions[i]))), 1, found);
    distances.push_back(std::sqrt(found.front().squared_distance));
  }
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.00035);
}

}  // namespace
}  // namespace burnish
