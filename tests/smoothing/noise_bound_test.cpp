#include "burnish/smoothing/noise_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/catalogue/operations.h"
#include "burnish/measure/noise_certificate.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

Vec3d any_direction(Random& random) {
  Vec3d d;
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = random.normal();
  return normalized(d);
}

/// Noise of about `size`, up to a thousand times longer than wide or the other way round, now and
/// then round or exact.
PointNoise any_noise(Random& random, double size) {
  const std::uint64_t kind = random.below(20);
  const double along = kind == 0 ? 0 : size * std::pow(10, random.uniform(-1.5, 1.5));
  const double across = kind <= 1 ? along : size * std::pow(10, random.uniform(-1.5, 1.5));
  return {Vec3f(any_direction(random)), static_cast<float>(along), static_cast<float>(across)};
}

/// A random mesh of any size and place whose vertices carry noise, or sigma alone.
TriangleMesh any_measured_mesh(std::uint64_t seed, std::size_t vertices) {
  Random random(seed, 1);
  TriangleMesh mesh = test::random_mesh(vertices, 2 * vertices, seed);
  const double scale = std::pow(10, random.uniform(-3, 2));
  const double size = scale * std::pow(10, random.uniform(-7, 0));
  const Vec3d place = any_direction(random) * scale * random.uniform(0, 3);
  for (Vec3f& p : mesh.positions) p = Vec3f(place + scale * Vec3d(p));
  Attributes& known = mesh.attributes;
  for (std::size_t v = 0; v < vertices; ++v) {
    known.sigma.push_back(static_cast<float>(size * random.uniform(0, 2)));
    if (seed % 3 != 0) known.noise.push_back(any_noise(random, size));
    if (seed % 2 != 0) {
      known.origin.push_back(random.below(10) == 0 ? Origin::invented : Origin::seen);
    }
  }
  return mesh;
}

/// Displacements from nothing to many standard deviations, in any direction.
void displace(TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed, 2);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double length = mesh.attributes.sigma[v] * std::pow(10, random.uniform(-3, 3));
    mesh.positions[v] = Vec3f(Vec3d(mesh.positions[v]) + length * any_direction(random));
  }
}

TEST(NoiseBound, NoRandomDisplacementOfTenThousandMeshesEscapes) {
  std::size_t put_back = 0, at_bound = 0;
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    const TriangleMesh before = any_measured_mesh(seed, 12);
    TriangleMesh after = before;
    displace(after, seed);
    const double c = seed % 5 == 0 ? 1.5 : 2;
    const auto report = bound_to_noise(before, after, {c});
    ASSERT_TRUE(report) << report.error().text();
    const auto certificate = certify_noise_bound(before, after, c);
    ASSERT_TRUE(certificate) << certificate.error().text();
    ASSERT_EQ(certificate->outside, 0u) << seed << ": " << sentences(*certificate).front();
    ASSERT_EQ(certificate->invented, report->free);
    ASSERT_NEAR(certificate->largest_ratio, report->largest_ratio, 1e-9) << seed;
    put_back += report->put_back;
    at_bound += certificate->at_bound;
  }
  EXPECT_GT(put_back, 30000u) << "of 120000 vertices";
  EXPECT_GT(at_bound, put_back / 2) << "they are put back to the bound, not to where they were";
}

TEST(NoiseBound, NoMethodOfTheCatalogueEscapes) {
  for (const SmoothOperation& method : smooth_operations()) {
    SCOPED_TRACE(method.info.name);
    std::size_t put_back = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      TriangleMesh before = seed % 2 == 0 ? any_measured_mesh(seed, 40)
                                          : test::with_noise(make_sphere(1, 2), 0.02, seed);
      if (seed % 2 != 0) {
        Random random(seed);
        for (std::size_t v = 0; v < before.positions.size(); ++v) {
          before.attributes.sigma.push_back(0.01f);
          before.attributes.noise.push_back(any_noise(random, 0.01));
        }
      }
      TriangleMesh after = before;
      ASSERT_TRUE(method.run(after, {}, {}));
      const auto report = bound_to_noise(before, after);
      ASSERT_TRUE(report);
      const auto certificate = certify_noise_bound(before, after, 2);
      ASSERT_TRUE(certificate);
      EXPECT_TRUE(certificate->holds()) << seed << ": " << sentences(*certificate).front();
      put_back += report->put_back;
    }
    EXPECT_GT(put_back, 0u);
  }
}

/// One vertex at `place` in the corner of a triangle.
TriangleMesh one_vertex(const Vec3f& place, const PointNoise& noise) {
  TriangleMesh mesh;
  mesh.positions = {place, {1e3f, 0, 0}, {0, 1e3f, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.attributes.noise = {noise, noise, noise};
  return mesh;
}

/// The ratio by the quadratic form of the inverse covariance, in extended precision.
long double exact_ratio(const Vec3f& before, const Vec3f& after, const PointNoise& noise) {
  long double length = 0, along = 0, axis = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const long double d = static_cast<long double>(after[k]) - before[k];
    length += d * d, along += d * noise.axis[k];
    axis += static_cast<long double>(noise.axis[k]) * noise.axis[k];
  }
  along = along * along / axis;
  const long double a = noise.along, b = noise.across;
  return std::sqrt(along / (a * a) + (length - along) / (b * b));
}

TEST(NoiseCertificate, OneFloatStepBeyondTheBoundIsCaught) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const Vec3f place = Vec3f(any_direction(random));
    PointNoise noise{Vec3f(any_direction(random)), 0, 0};
    noise.along = static_cast<float>(random.uniform(0.001, 0.05));
    noise.across = static_cast<float>(random.uniform(0.001, 0.01));
    const TriangleMesh before = one_vertex(place, noise);
    const std::size_t axis = random.below(3);
    TriangleMesh inside = before, outside = before;
    float &in = inside.positions[0][axis], &out = outside.positions[0][axis];
    out += random.below(2) == 0 ? 1.f : -1.f;
    while (std::nextafter(in, out) != out) {
      const float middle = in + (out - in) / 2;
      Vec3f there = place;
      there[axis] = middle == in || middle == out ? std::nextafter(in, out) : middle;
      (exact_ratio(place, there, noise) <= 2 ? in : out) = there[axis];
    }
    const auto accepted = certify_noise_bound(before, inside, 2);
    const auto refused = certify_noise_bound(before, outside, 2);
    ASSERT_TRUE(accepted && refused);
    EXPECT_TRUE(accepted->holds()) << seed;
    EXPECT_EQ(refused->outside, 1u) << seed;
    EXPECT_EQ(refused->worst, 0u);
    EXPECT_NEAR(refused->worst_displacement, std::abs(double{out} - double{place[axis]}), 1e-15);
    EXPECT_NEAR(refused->worst_displacement / refused->worst_sigma, refused->largest_ratio, 1e-12);
    TriangleMesh put_back = outside;
    ASSERT_TRUE(bound_to_noise(before, put_back));
    EXPECT_NE(put_back.positions[0], outside.positions[0]);
  }
}

TEST(NoiseBound, ReachesFartherAlongTheRayThanAcrossIt) {
  const PointNoise noise{{0, 0, 1}, 0.3f, 0.1f};
  const TriangleMesh before = one_vertex({0, 0, 0}, noise);
  const auto bounded = [&](const Vec3f& to) {
    TriangleMesh after = before;
    after.positions[0] = to;
    EXPECT_TRUE(bound_to_noise(before, after));
    return after.positions[0];
  };
  // Half a float step at 9 is 5e-7: it is held off in every direction, a ray's length included.
  const double rounding = 3 * std::sqrt(3.0) * 5e-7;
  EXPECT_EQ(bounded({0, 0, 0.59f}), (Vec3f{0, 0, 0.59f}));
  EXPECT_NEAR(bounded({0, 0, 5}).z, 0.6, rounding);
  EXPECT_EQ(bounded({0.19f, 0, 0}), (Vec3f{0.19f, 0, 0}));
  EXPECT_NEAR(bounded({-5, 0, 0}).x, -0.2, rounding);
  // Askew: on the way, where (x / 0.2)^2 + (z / 0.6)^2 = 1.
  const Vec3f askew = bounded({3, 0, 9});
  EXPECT_NEAR(askew.x, 0.6 / std::sqrt(18.0), rounding);
  EXPECT_NEAR(askew.z, 3 * askew.x, 1e-6);
}

TEST(NoiseBound, WithoutNoiseTheRegionIsABallOfSigma) {
  TriangleMesh before = one_vertex({0, 0, 0}, {});
  before.attributes.noise.clear();
  before.attributes.sigma = {0.1f, 0.1f, 0.1f};
  TriangleMesh after = before;
  after.positions[0] = {3, -4, 0};
  ASSERT_TRUE(bound_to_noise(before, after));
  EXPECT_NEAR(after.positions[0].x, 0.2 * 0.6, 1e-6);
  EXPECT_NEAR(after.positions[0].y, -0.2 * 0.8, 1e-6);
}

TEST(NoiseBound, LeavesInventedVerticesFreeAndHoldsExactOnes) {
  TriangleMesh before = one_vertex({0, 0, 0}, {{0, 0, 1}, 0.3f, 0.1f});
  before.attributes.origin = {Origin::invented, Origin::interpolated, Origin::seen};
  before.attributes.noise[2] = {};
  TriangleMesh after = before;
  for (Vec3f& p : after.positions) p += Vec3f{7, 0, 0};
  const auto report = bound_to_noise(before, after);
  ASSERT_TRUE(report);
  EXPECT_EQ(after.positions[0], (Vec3f{7, 0, 0}));
  EXPECT_NEAR(after.positions[1].x, 1000.2, 1e-3);
  EXPECT_EQ(after.positions[2], before.positions[2]);
  EXPECT_EQ(report->free, 1u);
  EXPECT_EQ(report->put_back, 2u);
}

TEST(NoiseBound, HoldsWhatIsExactInOneDirection) {
  // Floats cannot keep to the plane or to the line that is left: not even a move within it counts.
  for (const PointNoise& noise : {PointNoise{{0, 0, 1}, 0, 0.1f}, PointNoise{{0, 0, 1}, 0.1f, 0}}) {
    const TriangleMesh before = one_vertex({0, 0, 0}, noise);
    for (const Vec3f& way : {Vec3f{0.01f, 0, 0}, Vec3f{0, 0, 0.01f}, Vec3f{0.01f, 0, 0.01f}}) {
      TriangleMesh after = before;
      after.positions[0] = way;
      const auto moved = certify_noise_bound(before, after, 2);
      ASSERT_TRUE(moved);
      EXPECT_EQ(moved->outside, 1u);
      ASSERT_TRUE(bound_to_noise(before, after));
      EXPECT_EQ(after.positions, before.positions);
    }
  }
}

TEST(NoiseBound, MixesSigmaAndComputesNormalsAnew) {
  TriangleMesh before = make_grid(2, 2);
  before.attributes.sigma.assign(9, 0.1f);
  before.attributes.normals = vertex_normals(before);
  TriangleMesh after = before;
  after.positions[4].z = 0.8f;  // four times as far as it may
  after.attributes.sigma.assign(9, 0.02f);
  ASSERT_TRUE(bound_to_noise(before, after));
  EXPECT_NEAR(after.attributes.sigma[4], 0.75 * 0.1 + 0.25 * 0.02, 1e-6);
  EXPECT_EQ(after.attributes.sigma[0], 0.02f);
  EXPECT_EQ(after.attributes.normals, vertex_normals(after));
}

TEST(NoiseBound, RefusesWhatItCannotBind) {
  const auto refusal = [](const TriangleMesh& before, TriangleMesh after, double c = 2) {
    const TriangleMesh given = after;
    const auto report = bound_to_noise(before, after, {c});
    EXPECT_FALSE(report);
    EXPECT_EQ(after, given);
    return report ? std::string() : report.error().text();
  };
  TriangleMesh mesh = make_grid(2, 2);
  EXPECT_NE(refusal(mesh, mesh).find("give every vertex a 'sigma'"), std::string::npos);
  mesh.attributes.sigma.assign(9, 0.1f);
  EXPECT_NE(refusal(mesh, make_grid(1, 1)).find("9 vertices before and 4 after"),
            std::string::npos);
  EXPECT_NE(refusal(mesh, mesh, -1).find("c"), std::string::npos);
  TriangleMesh broken = mesh;
  broken.attributes.sigma[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal(broken, mesh).find("vertex 3"), std::string::npos);
  broken.attributes.noise.assign(9, {{0, 0, 1}, 0.2f, 0.1f});
  broken.attributes.noise[5].axis = {};
  EXPECT_NE(refusal(broken, mesh).find("vertex 5"), std::string::npos);
  broken = mesh;
  broken.frame.origin.x = 1;
  EXPECT_NE(refusal(mesh, broken).find("frames"), std::string::npos);

  std::stop_source source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  TriangleMesh after = mesh;
  after.positions[4].z = 1;
  EXPECT_FALSE(bound_to_noise(mesh, after, {}, context));
  EXPECT_EQ(after.positions[4].z, 1);
}

TEST(NoiseCertificate, RefusesWhatItCannotCompare) {
  const auto refusal = [](const TriangleMesh& before, const TriangleMesh& after, double c = 2) {
    const auto certificate = certify_noise_bound(before, after, c);
    EXPECT_FALSE(certificate);
    return certificate ? std::string() : certificate.error().text();
  };
  TriangleMesh mesh = make_grid(2, 2);
  EXPECT_NE(refusal(mesh, mesh).find("neither noise nor sigma"), std::string::npos);
  mesh.attributes.sigma.assign(9, 0.1f);
  EXPECT_NE(refusal(mesh, make_grid(1, 1)).find("9 vertices before and 4 after"),
            std::string::npos);
  EXPECT_NE(refusal(mesh, mesh, -1).find("c: "), std::string::npos);
  mesh.attributes.sigma[3] = -1;
  EXPECT_NE(refusal(mesh, mesh).find("vertex 3"), std::string::npos);
}

TEST(NoiseCertificate, ComparesPlacesInTheWorld) {
  TriangleMesh before = make_grid(2, 2);
  before.attributes.sigma.assign(9, 0.1f);
  TriangleMesh after = before;
  after.frame.origin = {0, 0, 100.25};
  for (Vec3f& p : after.positions) p.z -= 100;
  const auto certificate = certify_noise_bound(before, after, 2);
  ASSERT_TRUE(certificate);
  EXPECT_NEAR(certificate->largest_ratio, 2.5, 1e-6);
  EXPECT_EQ(certificate->outside, 9u);
}

}  // namespace
}  // namespace burnish
