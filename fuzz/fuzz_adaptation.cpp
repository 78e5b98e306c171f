// Chains of random operations on adaptive meshes over a lattice, many of them degenerate.
#include "support/adaptive_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint64_t seed = size > 1 ? data[size - 2] << 8 | data[size - 1] : 0;
  burnish::test::expect_adaptive_mesh_keeps_promises(burnish::test::lattice_mesh({data, size}),
                                                     seed, 8);
  return 0;
}
