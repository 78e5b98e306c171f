#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"
#include "burnish/shapes/teapot.h"
#include "support/adaptive_promises.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

// What the fuzz target asks, of byte strings that come by chance.
TEST(AdaptiveMesh, KeepsItsPromisesForVerticesOfALattice) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
    test::expect_adaptive_mesh_keeps_promises(test::lattice_mesh(bytes), seed, 20);
  }
}

TEST(AdaptiveMesh, KeepsItsPromisesForShapesOfEveryKind) {
  for (const TriangleMesh& mesh : {make_sphere(1, 2), make_torus(1, 0.4, 12, 5), make_grid(9, 7),
                                   make_box({1, 2, 3}, 3), make_sphere(1, 0)}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      test::expect_adaptive_mesh_keeps_promises(mesh, seed, 20);
    }
  }
}

// Triangles between vertices by chance: most edges have one triangle or three.
TEST(AdaptiveMesh, TakesMeshesThatAreNoSurface) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    test::expect_adaptive_mesh_keeps_promises(test::random_mesh(30, 10 + seed, seed), seed, 10);
  }
}

}  // namespace
}  // namespace burnish
