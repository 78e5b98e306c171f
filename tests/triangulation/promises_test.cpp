#include <gtest/gtest.h>

#include "burnish/base/random.h"
#include "support/triangulation_promises.h"

namespace burnish {
namespace {

// What the fuzz target asks, of byte strings that come by chance: points in one place, on a line,
// in a plane, of lattices of 10^3 and 1000^3, with and without normals.
TEST(Triangulations, KeepTheirPromisesForPointsOfALattice) {
  for (std::uint64_t seed = 0; seed < 160; ++seed) {
    Random random(seed);
    std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(seed % 16)};
    const std::size_t count = seed < 64 ? seed / 16 : 4 + random.below(200);
    for (std::size_t i = 0; i < 6 * count; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(random.below(256)));
    }
    const PointCloud cloud = test::lattice_cloud(bytes);
    ASSERT_EQ(cloud.positions.size(), count);
    test::expect_triangulations_keep_promises(cloud);
    test::expect_edits_equal_rebuild(cloud);
  }
}

}  // namespace
}  // namespace burnish
