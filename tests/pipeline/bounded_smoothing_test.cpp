// --bound noise as the pipeline applies it: what a scan keeps under it and what it loses.
#include <gtest/gtest.h>

#include <cmath>

#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"
#include "burnish/points/unproject.h"
#include "burnish/triangulation/organized.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

constexpr double kNear = 1;            // depth of the nearer half of the scene, m
constexpr std::uint32_t kEdge = 80;    // the first column of the farther half
constexpr std::uint32_t kBorder = 20;  // rows along the border, which stays, are left out

/// Two planes across the view, `height` standard deviations apart, with the sensor's noise, as one
/// surface of all pixels: vertex = pixel.
TriangleMesh scanned_step(double height) {
  DepthFrame frame = empty_frame();
  const double sigma = frame.noise.axial(kNear, 0);
  fill(
      frame,
      [&](const Vec3d& direction) {
        const double column = direction.x * frame.camera.fx + frame.camera.cx;
        return kNear + (column > kEdge - 0.5 ? height * sigma : 0);
      },
      1, 11);
  const auto cloud = unproject(frame);
  EXPECT_TRUE(cloud);
  auto mesh = triangulate_organized(*cloud, {.max_jump = 1000});
  EXPECT_TRUE(mesh);
  EXPECT_EQ(mesh->mesh.positions.size(), frame.depth.size());
  return mesh->mesh;
}

/// The step from the last near column to the first far one, in standard deviations: mean over rows.
double step_at_edge(const TriangleMesh& mesh) {
  const double sigma = empty_frame().noise.axial(kNear, 0);
  double sum = 0;
  for (std::uint32_t row = kBorder; row < 120 - kBorder; ++row) {
    sum += mesh.positions[row * 160 + kEdge].z - mesh.positions[row * 160 + kEdge - 1].z;
  }
  return sum / (120 - 2 * kBorder) / sigma;
}

/// What is left of the step after sixty passes.
double step_left(TriangleMesh mesh, const std::optional<NoiseBoundParams>& bound) {
  Record record;
  const auto done = smooth_in_phases(mesh, {{"one_ring_mean", {{"iterations", "60"}}}}, {{}, bound},
                                     false, record, {});
  EXPECT_TRUE(done);
  return step_at_edge(mesh);
}

TEST(BoundedSmoothing, AStepOfFiveSigmaStaysAndOfOneGoes) {
  const NoiseBoundParams two{2};
  // Both sides of the edge stay within two deviations of where they were measured, so that one of
  // five is left whatever the method; nothing keeps a step of one. Sixty passes blur a step with a
  // Gaussian of about five columns: unbounded, 0.08 of it is between two columns.
  EXPECT_GT(step_left(scanned_step(5), two), 1);
  EXPECT_LT(step_left(scanned_step(5), {}), 0.5);
  EXPECT_LT(step_left(scanned_step(1), two), 0.2);
}

TEST(BoundedSmoothing, HoldsOverAllPhasesAgainstTheFirst) {
  const TriangleMesh before = scanned_step(5);
  TriangleMesh mesh = before;
  Record record;
  const std::vector<Method> phases(4, {"one_ring_mean", {{"iterations", "5"}}});
  ASSERT_TRUE(smooth_in_phases(mesh, phases, {{}, NoiseBoundParams{1.5}}, true, record, {}));
  ASSERT_TRUE(record.certificate);
  EXPECT_TRUE(record.certificate->holds());
  EXPECT_EQ(record.certificate->c, 1.5);
  EXPECT_GT(record.certificate->at_bound, 100u);
  ASSERT_EQ(record.phases.size(), 5u);
  for (const Phase& phase : record.phases) {
    const auto certificate = certify_noise_bound(before, phase.mesh, 1.5);
    ASSERT_TRUE(certificate);
    EXPECT_TRUE(certificate->holds()) << phase.name;
  }
  ASSERT_EQ(record.steps.size(), 8u);
  EXPECT_EQ(record.steps[1].verb, "bound");
  EXPECT_EQ(record.steps[1].method, "noise");
  EXPECT_EQ(record.steps[1].settings, (Settings{{"c", "1.5"}}));
  EXPECT_EQ(mesh.attributes.noise, before.attributes.noise) << "that of the measurements";
}

TEST(BoundedSmoothing, NeedsToKnowTheNoiseBeforeItBegins) {
  TriangleMesh mesh = scanned_step(1);
  mesh.attributes.noise.clear();
  mesh.attributes.sigma.clear();
  const TriangleMesh given = mesh;
  Record record;
  const auto done =
      smooth_in_phases(mesh, {{"one_ring_mean", {}}}, {{}, NoiseBoundParams{}}, true, record, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(done.error().where, "bound noise");
  EXPECT_EQ(mesh, given);
  EXPECT_TRUE(record.steps.empty());
}

TEST(ParseBound, ReadsNoiseAndItsC) {
  EXPECT_EQ(parse_bound("noise")->c, 2);
  EXPECT_EQ(parse_bound("noise:c=0.5")->c, 0.5);
  for (const char* text : {"", "nois", "noise:", "noise:c=-1", "noise:c=many", "noise:d=1"}) {
    const auto bound = parse_bound(text);
    ASSERT_FALSE(bound) << text;
    EXPECT_EQ(bound.error().code, ErrorCode::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace burnish
