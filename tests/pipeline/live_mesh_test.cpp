#include "burnish/pipeline/live_mesh.h"

#include <gtest/gtest.h>

#include "burnish/base/random.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "support/depth_scenes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

/// The operations one after the other.
TriangleMesh chain(const DepthFrame& frame, const LiveMeshParams& params) {
  const auto cloud = unproject(frame, params.unproject);
  EXPECT_TRUE(cloud);
  auto made = triangulate_organized(*cloud, params.triangulate);
  EXPECT_TRUE(made);
  TriangleMesh mesh = std::move(made->mesh);
  mesh.attributes = {};
  EXPECT_TRUE(smooth_nearest_farthest(mesh, params.smooth));
  if (params.normals) mesh.attributes.normals = vertex_normals(mesh);
  return mesh;
}

void expect_the_chain(LiveMesh& live, const DepthFrame& frame, const LiveMeshParams& params) {
  const auto done = live.update(frame);
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_TRUE(live.mesh() == chain(frame, params));
}

/// Noise, missing pixels in specks and patches, depth edges; every frame has others.
DepthFrame random_frame(std::uint64_t seed, std::uint32_t width, std::uint32_t height) {
  DepthFrame frame = test::empty_frame(width, height);
  Random random(seed);
  const double missing = random.uniform(0, 0.2);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const std::size_t column = i % width, row = i / width;
    const double z = (column / 9 + row / 7 + seed) % 3 == 0 ? 1.3 : 1.1 + 0.002 * double(column);
    const double error = 0.002 * random.normal();
    if (random.uniform() > missing) frame.depth[i] = static_cast<float>(z + error);
  }
  return frame;
}

TEST(LiveMesh, IsTheOperationsOneAfterTheOtherToTheBit) {
  LiveMeshParams params;
  params.normals = true;
  LiveMesh live(params);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    // Sizes change: what is kept from the frame before must not show.
    const std::uint32_t width = seed % 4 == 0 ? 31 : 64, height = seed % 3 == 0 ? 40 : 23;
    expect_the_chain(live, random_frame(seed, width, height), params);
  }
}

TEST(LiveMesh, HeedsItsParams) {
  for (const int iterations : {0, 1, 2, 7}) {
    LiveMeshParams params;
    params.smooth = {.iterations = iterations, .damping = 0.3};
    params.triangulate.max_jump = 2;
    params.unproject.max_depth = 1.2;
    LiveMesh live(params);
    expect_the_chain(live, random_frame(5, 50, 40), params);
  }
}

TEST(LiveMesh, SettlesTiesAsTheOperationDoes) {
  // A plane without noise seen straight on is a regular grid: opposite neighbours are equally near.
  DepthFrame frame = test::empty_frame(40, 30);
  frame.depth.assign(frame.depth.size(), 1.f);
  LiveMesh live;
  expect_the_chain(live, frame, {});
}

TEST(LiveMesh, OfFramesWithNextToNothingIsNextToNothing) {
  LiveMesh live;
  DepthFrame frame = test::empty_frame(20, 10);
  ASSERT_TRUE(live.update(frame));
  EXPECT_TRUE(live.mesh().positions.empty());
  frame.depth[5] = frame.depth[6] = frame.depth[25] = 1;
  expect_the_chain(live, frame, {});
  EXPECT_EQ(live.mesh().triangles.size(), 1u);
  expect_the_chain(live, test::empty_frame(1, 1), {});
  expect_the_chain(live, random_frame(1, 1, 30), {});
  expect_the_chain(live, random_frame(1, 30, 1), {});
}

TEST(LiveMesh, RefusesWhatTheOperationsRefuse) {
  DepthFrame frame = random_frame(1, 20, 20);
  LiveMeshParams params;
  params.smooth.boundary = BoundaryRule::free;
  EXPECT_EQ(LiveMesh(params).update(frame).error().code, ErrorCode::invalid_argument);
  frame.depth[7] = -1;
  LiveMesh live;
  EXPECT_EQ(live.update(frame).error().code, ErrorCode::bad_geometry);
  frame.depth[7] = 1;
  expect_the_chain(live, frame, {});
}

TEST(LiveMesh, IsTheChainOnAFrameOfTheVirtualCamera) {
  const auto camera =
      VirtualCamera::create(make_shape("torus").value(), find_sensor("kinect_v1").value());
  ASSERT_TRUE(camera);
  LiveMesh live;
  for (std::uint64_t view = 0; view < 2; ++view) {
    const auto frame =
        camera->capture(look_at({0.5, 0.4, 0.5}, {0, 0, 0}, {0, 0, 1}), {.view = view});
    ASSERT_TRUE(frame);
    expect_the_chain(live, *frame, {});
  }
}

TEST(LiveMeshOfRealFrames, IsTheChain) {
  BURNISH_DATA_OR_SKIP(kitchen, "depth/kinect_v1_kitchen");
  const auto frames = open_frames({kitchen});
  ASSERT_TRUE(frames);
  LiveMesh live;
  for (const std::size_t i : {0, 11, 23}) {
    const auto frame = frames->read(i);
    ASSERT_TRUE(frame);
    expect_the_chain(live, *frame, {});
  }
}

}  // namespace
}  // namespace burnish
