#include "burnish/core/depth_frame.h"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>
#include <numbers>

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const Camera kCamera{4, 3, 5, 6, 1.5, 1};

TEST(Camera, ProjectsWhereItUnprojectedFrom) {
  const Vec3d point = kCamera.unproject(3, 2, 2.5);
  EXPECT_EQ(point.z, 2.5);
  EXPECT_GT(point.x, 0);  // right of the centre
  EXPECT_GT(point.y, 0);  // below it
  const Vec3d seen = kCamera.project(point);
  EXPECT_DOUBLE_EQ(seen.x, 3);
  EXPECT_DOUBLE_EQ(seen.y, 2);
  EXPECT_DOUBLE_EQ(seen.z, 2.5);
}

TEST(Camera, OfASizeOrFocalLengthThatCannotBeIsRefused) {
  EXPECT_TRUE(check(kCamera));
  for (const Camera bad : {Camera{0, 3, 5, 6, 1.5, 1}, Camera{4, 3, 0, 6, 1.5, 1},
                           Camera{4, 3, 5, -6, 1.5, 1}, Camera{4, 3, std::nan(""), 6, 1.5, 1},
                           Camera{4, 3, 5, 6, 100, 1}, Camera{4, 3, 5, 6, 1.5, std::nan("")}}) {
    const auto sound = check(bad);
    ASSERT_FALSE(sound);
    EXPECT_EQ(sound.error().code, ErrorCode::invalid_argument);
  }
}

/// Nguyen, Izadi and Lovell 2012, equations 3 and 4.
const DepthNoise kNguyen{.z0 = 0.4,
                         .c0 = 0.0012,
                         .c2 = 0.0019,
                         .grazing = 0.0001,
                         .power = -0.5,
                         .grazing_from = 60 * kDegree,
                         .pixels = 0.8,
                         .pixels_grazing = 0.035};

TEST(DepthNoise, GrowsWithTheSquareOfTheDepth) {
  EXPECT_DOUBLE_EQ(kNguyen.axial(0.4, 0), 0.0012);
  EXPECT_DOUBLE_EQ(kNguyen.axial(2.4, 0.5), 0.0012 + 0.0019 * 4);
}

TEST(DepthNoise, GrowsTowardsGrazingIncidenceButStaysFinite) {
  const double theta = 75 * kDegree, ratio = 75.0 / 15;
  EXPECT_NEAR(kNguyen.axial(1, theta), 0.0012 + 0.0019 * 0.36 + 0.0001 * ratio * ratio, 1e-15);
  EXPECT_EQ(kNguyen.axial(1, 85 * kDegree), kNguyen.axial(1, 90 * kDegree));
  EXPECT_TRUE(std::isfinite(kNguyen.lateral(1, 90 * kDegree, 585)));
}

TEST(DepthNoise, SidewaysIsAShareOfAPixel) {
  EXPECT_DOUBLE_EQ(kNguyen.lateral(2, 0, 585), 0.8 * 2 / 585);
  EXPECT_NEAR(kNguyen.lateral(2, 45 * kDegree, 585), (0.8 + 0.035) * 2 / 585, 1e-15);
}

DepthFrame frame() {
  DepthFrame result;
  result.camera = kCamera;
  result.depth.assign(12, 1.f);
  return result;
}

std::string refusal(const DepthFrame& bad) {
  const auto sound = check(bad);
  return sound ? "accepted" : sound.error().message;
}

TEST(CheckFrame, NamesWhatIsWrong) {
  EXPECT_EQ(refusal(frame()), "accepted");
  DepthFrame bad = frame();
  bad.depth.pop_back();
  EXPECT_EQ(refusal(bad), "11 depths for 4 x 3 pixels");
  bad = frame();
  bad.depth[7] = -0.5f;
  EXPECT_EQ(refusal(bad), "depth of pixel 7 is -0.5");
  bad = frame();
  bad.noise_share.assign(11, 1.f);
  EXPECT_EQ(refusal(bad), "11 noise shares for 4 x 3 pixels");
  bad.noise_share.assign(12, 1.f);
  bad.sigma_share.assign(12, 0.5f);
  bad.sigma_share[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(bad), "sigma share of pixel 3 is nan");
  bad = frame();
  bad.observations.assign(13, 1);
  EXPECT_EQ(refusal(bad), "13 observations for 4 x 3 pixels");
  bad = frame();
  bad.T_world_camera.rows[0].x = -1;
  EXPECT_EQ(refusal(bad), "the pose is not a rotation and a translation");
}

}  // namespace
}  // namespace burnish
