#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "allocation/counted_allocations.h"
#include "burnish/base/random.h"
#include "burnish/pipeline/live_mesh.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

/// A wall of which a share is missing, with noise; depths are whole millimetres, as cameras have
/// them, so that there are ties.
DepthFrame frame_with(double missing, std::uint64_t seed) {
  DepthFrame frame = test::empty_frame(160, 120);
  Random random(seed);
  for (float& depth : frame.depth) {
    const double z = std::round(1000 * (1.2 + 0.002 * random.normal())) / 1000;
    if (random.uniform() >= missing) depth = static_cast<float>(z);
  }
  return frame;
}

TEST(Allocations, AreCounted) {
  const std::size_t before = test::allocations();
  // Called by name: what new and vectors ask for a compiler may leave out.
  ::operator delete(::operator new(40));
  EXPECT_EQ(test::allocations(), before + 1);
}

TEST(LiveMesh, AllocatesNothingAfterTheFirstFrame) {
  std::vector<DepthFrame> frames{frame_with(0.9, 1)};  // the fewest pixels first
  for (const double missing : {0.5, 0.0, 1.0, 0.2, 0.05, 0.0}) {
    frames.push_back(frame_with(missing, frames.size() + 1));
  }
  frames.push_back(test::empty_frame(160, 120));
  frames.back().depth.assign(frames.back().depth.size(), 1.f);  // a regular grid: all are tied
  frames.back().T_world_camera = look_at({1000, 0, 0}, {0, 0, 0}, {0, 0, 1});
  Context context;
  context.threads = 1;
  for (const bool normals : {false, true}) {
    LiveMeshParams params;
    params.normals = normals;
    LiveMesh live(params);
    ASSERT_TRUE(live.update(frames.front(), context));
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const std::size_t before = test::allocations();
      const auto done = live.update(frames[i], context);
      const std::size_t now = test::allocations();
      ASSERT_TRUE(done) << done.error().text();
      EXPECT_EQ(now, before) << "frame " << i;
    }
    EXPECT_EQ(live.mesh().triangles.size(), 2u * 159 * 119);
  }
}

}  // namespace
}  // namespace burnish
