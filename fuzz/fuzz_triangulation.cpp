// Feeds points of a lattice, many of them degenerate, to every triangulation.
#include "support/triangulation_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const burnish::PointCloud cloud = burnish::test::lattice_cloud({data, size});
  burnish::test::expect_triangulations_keep_promises(cloud);
  burnish::test::expect_edits_equal_rebuild(cloud);
  return 0;
}
