#include "burnish/pipeline/figure6.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "burnish/measure/one_ring_table.h"
#include "burnish/shapes/teapot.h"
#include "burnish/smoothing/one_ring_mean.h"

namespace burnish {
namespace {

constexpr std::size_t kNeighbours = 6;
constexpr double kDistance = 1e-6;  ///< tolerance for numbers printed with 15 digits
constexpr double kCutOff = 2e-6;    ///< for those printed with six, cut off rather than rounded

struct PrintedPhase {
  std::array<Vec3d, 7> points;                 ///< P0 to P6
  std::array<double, kNeighbours> distances;   ///< d1 to d6
  double mean;                                 ///< d_avg
  std::array<double, kNeighbours> deviations;  ///< |d_avg - d1| to |d_avg - d6|
  bool one_row_off;  ///< the points printed as P5 and P6 are P6 and the one above it
};

/// Figure 6's table as printed (decimal commas and broken digits of the scan mended).
constexpr std::array<PrintedPhase, 3> kPrinted{{
    {{{{1.381370, 0, 2.45469},
       {1.4, 0, 2.4},
       {1.35074, -0.375926, 2.4},
       {1.33276, -0.370922, 2.45469},
       {1.38426, 0, 2.4875},
       {1.33555, 0.371699, 2.4875},
       {1.35376, 0.376765, 2.49844}}},
     {0.608564450021565, 1.01094078081888, 0.9107746246766, 0.484658672431632, 0.9107746246766,
      1.00242835097346},
     0.821356,
     {0.212791, 0.189584, 0.089418, 0.336697, 0.089418, 0.181072},
     true},
    {{{{1.359634, -0.000603, 2.448438},
       {1.363122, 0.0741844, 2.421876},
       {1.335226, -0.291651, 2.421876},
       {1.313011, -0.361698, 2.448438},
       {1.36091, 0.000834, 2.481251},
       {1.314185, 0.362255, 2.481251},
       {1.33028, 0.367708, 2.492188}}},
     {0.703925827264045, 0.926660479802087, 0.903789286264646, 0.50476612608753, 0.903430586657506,
      0.998352724962898},
     0.823487,
     {0.119561, 0.103173, 0.080302, 0.318720, 0.079943, 0.174865},
     true},
    {{{{1.337057, 0.020553, 2.450224},
       {1.333855, 0.114904, 2.432501},
       {1.317554, -0.242121, 2.432501},
       {1.296903, -0.333603, 2.450224},
       {1.338637, 0.001381, 2.475001},
       {1.286589, 0.37278, 2.450224},
       {1.292975, 0.354719, 2.475001}}},
     {0.704900314929089, 0.886171936604949, 0.891905800368812, 0.579329762936723, 0.904509708493443,
      0.97233450506312},
     0.823192,
     {0.118291, 0.062979, 0.068713, 0.243862, 0.081317, 0.149142},
     false},
}};

/// Where P0 to P6 lie on the model, and the vertex one row above P6.
constexpr std::array<Vec3d, 8> kPlaces{{{1.38137, 0, 2.45469},
                                        {1.4, 0, 2.4},
                                        {1.35074, -0.375926, 2.4},
                                        {1.33276, -0.370922, 2.45469},
                                        {1.38426, 0, 2.4875},
                                        {1.33276, 0.370922, 2.45469},
                                        {1.33555, 0.371699, 2.4875},
                                        {1.35376, 0.376765, 2.49844}}};

/// To six significant digits, halves to the even digit. A half is what is one within 1e-4 of the
/// last digit: the teapot's coordinates are short fractions, and 1.403125 must not depend on the
/// last bit.
double rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, 5 - std::floor(std::log10(std::abs(value))));
  return std::nearbyint(std::round(value * unit * 1e4) / 1e4) / unit;
}

/// The teapot, measured from P0: floats are finest around their origin, and the printed distances,
/// square roots of square roots of differences, need that.
TriangleMesh papers_teapot() {
  TriangleMesh mesh = make_teapot(6);
  mesh.frame.origin = kPlaces[0];
  std::vector<Vec3d> points = teapot_points(6);
  std::transform(points.begin(), points.end(), mesh.positions.begin(), [&](const Vec3d& p) {
    return Vec3f(Vec3d{rounded(p.x), rounded(p.y), rounded(p.z)} - mesh.frame.origin);
  });
  return mesh;
}

std::uint32_t vertex_at(const TriangleMesh& mesh, const Vec3d& place) {
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const double distance = norm(Vec3d(mesh.positions[v]) + mesh.frame.origin - place);
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

std::vector<double> numbers(const Vec3d& p) {
  return {p.x, p.y, p.z};
}

void add_points(Figure6& figure, int phase, const PrintedPhase& printed, const TriangleMesh& mesh,
                const std::array<std::uint32_t, 8>& vertices) {
  for (std::size_t i = 0; i < printed.points.size(); ++i) {
    const bool off = printed.one_row_off && i >= 5;
    const Vec3d p = Vec3d(mesh.positions[vertices[off ? i + 1 : i]]) + mesh.frame.origin;
    std::string remark;
    if (off) remark = i == 5 ? "printed one row off: these are P6's" : "printed one row off";
    figure.rows.push_back({"P" + std::to_string(i), phase, numbers(printed.points[i]), numbers(p),
                           kCutOff, std::move(remark)});
  }
}

void add_distances(Figure6& figure, int phase, const PrintedPhase& printed,
                   const TriangleMesh& mesh, const std::array<std::uint32_t, 8>& vertices) {
  const Result<OneRingTable> table = one_ring_table(mesh, vertices[0]);
  std::array<const OneRingTable::Neighbour*, kNeighbours> ring{};
  for (const OneRingTable::Neighbour& neighbour : table->neighbours) {
    const auto found = std::find(vertices.begin() + 1, vertices.begin() + 7, neighbour.vertex);
    ring[static_cast<std::size_t>(found - vertices.begin()) - 1] = &neighbour;
  }
  for (std::size_t i = 0; i < kNeighbours; ++i) {
    figure.rows.push_back({"d" + std::to_string(i + 1),
                           phase,
                           {printed.distances[i]},
                           {ring[i]->printed_distance},
                           kDistance,
                           ""});
  }
  figure.rows.push_back(
      {"d_avg", phase, {printed.mean}, {table->mean_printed_distance}, kCutOff, ""});
  for (std::size_t i = 0; i < kNeighbours; ++i) {
    figure.rows.push_back({"|d_avg - d" + std::to_string(i + 1) + "|",
                           phase,
                           {printed.deviations[i]},
                           {ring[i]->printed_deviation},
                           kCutOff,
                           ""});
  }
}

}  // namespace

double Figure6Row::difference() const {
  double largest = 0;
  for (std::size_t i = 0; i < printed.size(); ++i) {
    largest = std::max(largest, std::abs(printed[i] - computed[i]));
  }
  return largest;
}

bool Figure6::agrees() const {
  return std::all_of(rows.begin(), rows.end(), [](const Figure6Row& row) { return row.agrees(); });
}

double Figure6::largest_difference(std::string_view prefix) const {
  double largest = 0;
  for (const Figure6Row& row : rows) {
    if (row.quantity.starts_with(prefix)) largest = std::max(largest, row.difference());
  }
  return largest;
}

Figure6 reproduce_figure6() {
  const TriangleMesh original = papers_teapot();
  std::array<std::uint32_t, 8> vertices{};
  std::transform(kPlaces.begin(), kPlaces.end(), vertices.begin(),
                 [&](const Vec3d& place) { return vertex_at(original, place); });
  Figure6 figure;
  for (int phase = 0; phase < 3; ++phase) {
    TriangleMesh mesh = original;
    // The rim's inner edge is an open boundary that the paper smoothed like all the rest.
    const auto smoothed =
        smooth_one_ring_mean(mesh, {.iterations = phase, .boundary = BoundaryRule::free});
    if (!smoothed) return figure;  // it cannot fail on a sound mesh
    const PrintedPhase& printed = kPrinted[static_cast<std::size_t>(phase)];
    add_points(figure, phase, printed, mesh, vertices);
    add_distances(figure, phase, printed, mesh, vertices);
  }
  return figure;
}

std::string_view figure6_explanation() {
  return "The table is not what the text says it is. Its phases are not Eq. 1: every printed "
         "coordinate is that of the plain one-ring mean with the vertex itself included, "
         "sum / (n + 1), applied once and twice, all positions of a pass computed from the old "
         "ones, open boundaries moving freely (here one_ring_mean:boundary=free; Eq. 1 is "
         "nearest_farthest). The distances called Euclidean are "
         "sqrt(sqrt|dx| + sqrt|dy| + sqrt|dz|), right to every printed digit. The coordinates of "
         "P5 and P6 are printed one row off in the original and in phase 1, while their distances, "
         "and all of phase 2, are those of the right vertices. The model's coordinates were "
         "rounded to six significant digits first; means, deviations and the coordinates of the "
         "phases are printed cut off rather than rounded. The printed angles follow from neither "
         "kind of distance and are left out.";
}

}  // namespace burnish
