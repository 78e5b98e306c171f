#include <algorithm>
#include <cmath>
#include <utility>

#include "burnish/spatial/closest_point.h"
#include "burnish/spatial/neighbour_grid.h"
#include "conformance/suite.h"

// What is done to the input must come back as done to the output.
namespace burnish::test {
namespace {

std::vector<Vec3f> points_of(const DepthFrame& frame) {
  std::vector<Vec3f> points;
  const std::size_t width = frame.camera.width;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (!(frame.depth[i] > 0)) continue;
    const Vec3d p = frame.camera.unproject(static_cast<double>(i % width),
                                           static_cast<double>(i / width), frame.depth[i]);
    points.push_back(Vec3f(frame.T_world_camera(p)));
  }
  return points;
}

std::vector<Vec3f> points_of(const Workpiece& workpiece) {
  if (!workpiece.frames.empty()) return points_of(workpiece.frames.front());
  return workpiece.clouds.empty() ? workpiece.mesh.positions
                                  : without_missing(workpiece.clouds.front()).positions;
}

/// From points to the `rank`-th nearest one of others, the median.
double median_distance(const std::vector<Vec3f>& from, const std::vector<Vec3f>& to,
                       std::size_t rank) {
  const NeighbourGrid grid(to);
  std::vector<Neighbour> found;
  std::vector<double> distances;
  for (const Vec3f& p : from) {
    grid.nearest(p, rank, found);
    distances.push_back(std::sqrt(found.back().squared_distance));
  }
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  return distances[distances.size() / 2];
}

class Equivariance : public Conformance {
 protected:
  Outcome outcome_of(Workpiece input, const Settings& settings = {}) const {
    auto outcome = subject().outcome_of(std::move(input), settings);
    if (!outcome) throw std::runtime_error(subject().name() + ": " + outcome.error().text());
    return std::move(outcome).value();
  }

  /// The defaults with every length times `factor`.
  Settings scaled_defaults(double factor) const {
    Settings settings;
    for (const FieldInfo& field : subject().info.fields) {
      if (field.type != "length") continue;
      settings.emplace_back(
          field.key, quantity_text(factor * std::strtod(field.default_value.c_str(), nullptr),
                                   Quantity::length));
    }
    return settings;
  }

  std::string rotation_defect(const std::array<Vec3d, 3>& rows, const Tolerance& tolerance) const {
    Outcome turned = expected();
    turned.output = rotated(turned.output, rows);
    return difference(turned, outcome_of(rotated(subject().sample, rows)), tolerance);
  }
};

TEST_P(Equivariance, ScaledInputGivesScaledOutput) {
  // By powers of two nothing is rounded, so that not a bit of a position may differ. Facts may be
  // logarithms or the like.
  std::string violation;
  for (const double factor : {0.25, 4.0}) {
    Outcome larger = expected();
    larger.output = scaled(larger.output, factor);
    larger.facts = scaled(larger.facts, factor);
    const Outcome actual = outcome_of(scaled(subject().sample, factor), scaled_defaults(factor));
    violation += difference(larger, actual, {.facts = 1e-12});
  }
  judge("scaled", violation);
}

TEST_P(Equivariance, AQuarterTurnOfTheInputTurnsTheOutput) {
  // A quarter turn rounds nothing but exchanges terms of sums: the last bits may differ.
  const std::array<Vec3d, 3> turns[] = {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                        {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}},
                                        {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}};
  std::string violation;
  for (const auto& turn : turns)
    violation += rotation_defect(turn, {.position = 1e-6, .facts = 1e-5});
  judge("turned by a quarter", violation);
}

TEST_P(Equivariance, ARotationOfTheInputRotatesTheOutput) {
  // Rotating rounds every coordinate to a float, 6e-8 of its size.
  const RigidTransform turn = rigid_from_quaternion(0.2, -0.5, 0.3, 0.7, {});
  judge("rotated", rotation_defect(turn.rows, {.position = 5e-6, .facts = 1e-3}));
}

/// From points to the surface of a mesh, the median.
double median_distance(const std::vector<Vec3f>& from, const TriangleMesh& to) {
  const ClosestPoint closest(to);
  std::vector<double> distances;
  for (const Vec3f& p : from) distances.push_back(closest(Vec3d(p)).distance);
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  return distances[distances.size() / 2];
}

// What every operation owes, also where the table of exceptions lets something pass: nearly as many
// points, most of them much nearer to one of the other result than points are to each other, or to
// its surface where vertices are put on it anew.
void expect_same_surface(const Workpiece& expected, const Workpiece& actual, bool is_new) {
  const auto expected_points = points_of(expected), points = points_of(actual);
  EXPECT_NEAR(static_cast<double>(points.size()), static_cast<double>(expected_points.size()),
              0.1 * static_cast<double>(expected_points.size()));
  const double spacing = median_distance(expected_points, expected_points, 2);
  const double apart =
      is_new ? median_distance(points, expected.mesh) : median_distance(points, expected_points, 1);
  EXPECT_LT(apart, 0.5 * spacing);
}

TEST_P(Equivariance, ARotationOfTheInputLeavesTheSurface) {
  const RigidTransform turn = rigid_from_quaternion(0.2, -0.5, 0.3, 0.7, {});
  expect_same_surface(rotated(expected().output, turn.rows),
                      outcome_of(rotated(subject().sample, turn.rows)).output,
                      subject().family == "fuse");
}

TEST_P(Equivariance, TheOrderOfTheInputLeavesTheSurface) {
  const Workpiece plain = unorganized(subject().sample);
  if (const auto straight = subject().outcome_of(plain)) {
    expect_same_surface(straight->output, outcome_of(relabelled(plain, 3)).output, false);
  }
}

TEST_P(Equivariance, TheOrderOfTheInputDoesNotMatter) {
  const Tolerance tolerance{.position = 1e-6, .facts = 1e-5};
  if (subject().family == "smooth") {  // which keeps every vertex
    std::vector<std::uint32_t> new_index;
    const Workpiece other = relabelled(subject().sample, 3, &new_index);
    Outcome straight = expected(), renamed = outcome_of(other);
    const Workpiece back = std::exchange(renamed.output, {});
    for (const std::uint32_t v : new_index) {
      renamed.output.mesh.positions.push_back(back.mesh.positions[v]);
    }
    renamed.output.mesh.attributes = gather(back.mesh.attributes, new_index);
    straight.output.mesh.triangles.clear();
    judge("relabelled", difference(straight, renamed, tolerance));
    return;
  }
  const Workpiece plain = unorganized(subject().sample);
  const auto straight = subject().outcome_of(plain);
  if (!straight) {
    // It works on the grid, whose order means something.
    EXPECT_EQ(straight.error().code, ErrorCode::bad_geometry);
    EXPECT_NE(straight.error().message.find("organized"), std::string::npos)
        << straight.error().text();
    return;
  }
  judge("relabelled", unordered_difference(*straight, outcome_of(relabelled(plain, 3)), tolerance));
}

TEST_P(Equivariance, ZeroIterationsIsTheIdentity) {
  for (const FieldInfo& field : subject().info.fields) {
    if (field.key != "iterations") continue;
    const Outcome outcome = expected({{"iterations", "0"}});
    EXPECT_TRUE(bytes(outcome.output) == bytes(subject().sample));
    EXPECT_FALSE(bytes(expected({{"iterations", "1"}}).output) == bytes(subject().sample));
  }
}

BURNISH_FOR_EVERY_OPERATION(Equivariance);

}  // namespace
}  // namespace burnish::test
