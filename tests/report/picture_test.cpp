#include "burnish/report/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

/// Looks along +y from (0, -distance, 0); z is up.
View view_from(double distance, double half_height = 0.25) {
  return {"test", look_at({0, -distance, 0}, {0, 0, 0}, {0, 0, 1}), half_height};
}

PictureOptions small() {
  return {.width = 160, .height = 120};
}

std::size_t painted(const Image& image, const PictureOptions& options = {}) {
  return static_cast<std::size_t>(
      std::count_if(image.pixels.begin(), image.pixels.end(),
                    [&](const Color& pixel) { return pixel != options.background; }));
}

/// Any sample of a pixel paints it. Pixels that lie within the outline of the inscribed mesh are
/// all counted, pixels that the outline of the sphere does not touch are not: the radius of a disc
/// of that many pixels is right to a pixel's diagonal and the mesh's sag.
TEST(Picture, ShowsASphereInItsSize) {
  constexpr int kSubdivisions = 5;
  const double radius = 0.7, distance = 4;
  const TriangleMesh sphere = make_sphere(radius, kSubdivisions);
  const PictureOptions options{.width = 500, .height = 400};
  const auto image = render(sphere, view_from(distance), options);
  ASSERT_TRUE(image);
  const double pixel = 2 * 0.25 / options.height;
  const double seen = radius / std::sqrt(distance * distance - radius * radius) / pixel;
  // An edge of the icosahedron spans 63.4 degrees; the middle of a triangle that spans `angle` lies
  // at most angle^2 / 6 below the sphere, in radii.
  const double angle = 63.4 * std::numbers::pi / 180 / (1 << kSubdivisions);
  const double sag = seen * angle * angle / 6;
  const double found = std::sqrt(static_cast<double>(painted(*image)) / std::numbers::pi);
  EXPECT_LE(found, seen + std::numbers::sqrt2);
  EXPECT_GE(found, seen - sag - std::numbers::sqrt2);
}

TEST(Picture, LooksTheSameAtAnySizeAndPlace) {
  const Vec3d centre{4.0e6, -2.5e6, 100};
  const auto near = render(make_sphere(1, 3), view_from(4), small());
  TriangleMesh far = make_sphere(1, 3);
  far.frame.origin = centre;
  View view = view_from(4);
  view.T_world_camera.translation += centre;
  const auto moved = render(far, view, small());
  TriangleMesh large = make_sphere(0x1p100, 3);
  const auto scaled = render(large, view_from(4 * 0x1p100), small());
  ASSERT_TRUE(near && moved && scaled);
  EXPECT_EQ(*scaled, *near) << "powers of two scale without rounding";
  std::size_t different = 0;
  for (std::size_t i = 0; i < near->pixels.size(); ++i)
    different += near->pixels[i] != moved->pixels[i];
  EXPECT_LE(different, near->pixels.size() / 100);
}

TEST(Picture, PaintsAFlippedPatchInTheColourOfInnerSides) {
  TriangleMesh sphere = make_sphere(1, 3);
  const auto before = render(sphere, view_from(4), small());
  for (Triangle& t : sphere.triangles) {
    const Vec3f& p = sphere.positions[t[0]];
    if (p.y < -0.9f) std::swap(t[1], t[2]);
  }
  const auto after = render(sphere, view_from(4), small());
  ASSERT_TRUE(before && after);
  const auto redness = [](const Color& c) { return c[0] - c[1]; };
  EXPECT_LT(redness(before->at(80, 60)), 20);
  EXPECT_GT(redness(after->at(80, 60)), 50);
  EXPECT_EQ(after->at(80, 10), before->at(80, 10)) << "the rest stays as it was";
}

TEST(Picture, TintsInventedVertices) {
  TriangleMesh sphere = make_sphere(1, 3);
  sphere.attributes.origin.assign(sphere.positions.size(), Origin::seen);
  const auto seen = render(sphere, view_from(4), small());
  sphere.attributes.origin.assign(sphere.positions.size(), Origin::invented);
  const auto invented = render(sphere, view_from(4), small());
  ASSERT_TRUE(seen && invented);
  const auto yellowness = [](const Color& c) { return c[1] - c[2]; };
  EXPECT_LT(yellowness(seen->at(80, 60)), 30);
  EXPECT_GT(yellowness(invented->at(80, 60)), 50);
}

TEST(Picture, TintsInventedTrianglesAndNoOthers) {
  TriangleMesh square;
  square.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const View view{"from above", look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 0.25};
  PictureOptions options = small();
  const auto plain = render(square, view, options);
  square.triangle_attributes.origin = {Origin::seen, Origin::invented};
  const auto tinted = render(square, view, options);
  options.origin = false;
  const auto untinted = render(square, view, options);
  ASSERT_TRUE(plain && tinted && untinted);
  EXPECT_EQ(*untinted, *plain);
  const std::size_t count = plain->pixels.size();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < count; ++i) changed += plain->pixels[i] != tinted->pixels[i];
  // The diagonal of the square goes through the middle: half of the picture, give or take the
  // pixels on it.
  EXPECT_NEAR(static_cast<double>(changed), static_cast<double>(count) / 2,
              plain->width + plain->height);
}

TEST(Picture, PaintsNumbersAndLeavesUnknownOnesInTheSurfaceColour) {
  const TriangleMesh sphere = make_sphere(1, 3);
  std::vector<float> numbers(sphere.positions.size(), 0.f);
  PictureOptions options = small();
  options.scalars = numbers;
  const auto low = render(sphere, view_from(4), options);
  std::fill(numbers.begin(), numbers.end(), std::nanf(""));
  const auto unknown = render(sphere, view_from(4), options);
  ASSERT_TRUE(low && unknown);
  const Color l = low->at(80, 60), u = unknown->at(80, 60);
  EXPECT_GT(l[2], l[0] + 40) << "the low end is blue";
  EXPECT_LT(std::abs(u[2] - u[0]), 30);
}

TEST(Picture, DrawsEdgesDarkerThanTheSurface) {
  const TriangleMesh box = make_box({2, 2, 2}, 1);
  PictureOptions options = small();
  const auto plain = render(box, view_from(6), options);
  options.edges = true;
  const auto lined = render(box, view_from(6), options);
  ASSERT_TRUE(plain && lined);
  const auto sum = [](const Image& image) {
    std::int64_t total = 0;
    for (const Color& c : image.pixels) total += c[0];
    return total;
  };
  EXPECT_LT(sum(*lined), sum(*plain));
  // The diagonal of the front side runs through the middle of the picture.
  const auto darkest = std::min(
      {lined->at(79, 59)[0], lined->at(79, 60)[0], lined->at(80, 59)[0], lined->at(80, 60)[0]});
  EXPECT_LT(darkest, plain->at(80, 60)[0] * 2 / 3);
}

TEST(Picture, OfNothingIsBackground) {
  TriangleMesh points;
  points.positions = {{0, 0, 0}, {1, 0, 0}};
  for (const TriangleMesh& mesh : {TriangleMesh{}, points}) {
    const auto image =
        render(mesh, framing_view("all", mesh, {0, 1, 0}, {0, 0, 1}, 4.0 / 3), small());
    ASSERT_TRUE(image);
    EXPECT_EQ(painted(*image), 0u);
  }
}

TEST(Picture, OfASingleTriangleFillsAViewThatFramesIt) {
  TriangleMesh mesh;
  mesh.positions = {{0, 5, 0}, {3, 5, 0}, {0, 5, 2}};
  mesh.triangles = {{0, 1, 2}};
  const auto image =
      render(mesh, framing_view("all", mesh, {0, 1, 0}, {0, 0, 1}, 4.0 / 3), small());
  ASSERT_TRUE(image);
  // Half of a 3 x 2 box that spans 1 / 1.06 of the width, 160 pixels, give or take a pixel around.
  const double width = 160 / 1.06, height = width * 2 / 3;
  EXPECT_NEAR(static_cast<double>(painted(*image)), width * height / 2, width + 2 * height);
}

TEST(Picture, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh torus = make_torus();
  PictureOptions options = small();
  options.edges = true;
  const View view = framing_view("all", torus, {0.3, 1, -0.6}, {0, 0, 1}, 4.0 / 3);
  Context context;
  context.threads = 1;
  const auto first = render(torus, view, options, context);
  ASSERT_TRUE(first);
  for (const int threads : {2, 3, 8}) {
    context.threads = threads;
    const auto again = render(torus, view, options, context);
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, *first) << threads << " threads";
  }
}

TEST(Picture, RefusesWhatCannotBe) {
  TriangleMesh mesh = make_sphere(1, 1);
  const std::vector<float> few(3);
  const auto code = [&](PictureOptions options, View view = view_from(4)) {
    const auto image = render(mesh, view, options);
    return image ? ErrorCode::io_failure : image.error().code;
  };
  EXPECT_EQ(code({.width = 0}), ErrorCode::invalid_argument);
  EXPECT_EQ(code({.height = 20000}), ErrorCode::invalid_argument);
  EXPECT_EQ(code({.width = 8, .height = 8, .scalars = few}), ErrorCode::invalid_argument);
  EXPECT_EQ(code({.width = 8, .height = 8, .low = 1, .high = 1}), ErrorCode::invalid_argument);
  EXPECT_EQ(code(small(), view_from(4, 0)), ErrorCode::invalid_argument);
  mesh.triangles.push_back({0, 1, 999});
  EXPECT_EQ(code(small()), ErrorCode::bad_geometry);
}

TEST(Picture, StopsWhenCancelled) {
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  const auto image = render(make_sphere(1, 2), view_from(4), small(), context);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace burnish
