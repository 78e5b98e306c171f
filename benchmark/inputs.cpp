#include <algorithm>
#include <cmath>
#include <cstdio>

#include <numbers>
#include <string>
#include <unordered_map>

#include "burnish/base/random.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"
#include "burnish/pipeline/scans.h"
#include "burnish/points/unproject.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "burnish/spatial/neighbour_grid.h"

// burnish_benchmark_inputs MODE ... POINTS TRUTH: points to triangulate, and the surface that they
// lie on. Prints the spacing of the points, m.
//   points MESH|SHAPE               the vertices of a mesh
//   sample MESH|SHAPE COUNT NOISE   points spread over it; NOISE is the standard deviation of each
//                                   coordinate in spacings, sqrt(area / COUNT)
//   plane COUNT                     random points of the unit square
//   frame                           one Kinect frame of a torus in a room, POINTS a PCD
//   merge FOLDER                    depth frames with poses, cleaned and merged; TRUTH is all that
//                                   every frame sees by itself, one surface upon the other
namespace burnish {
namespace {

[[noreturn]] void fail(const Error& error) {
  std::fprintf(stderr, "%s: %s\n", error.where.c_str(), error.message.c_str());
  std::exit(1);
}

template <class T>
T required(Result<T> result) {
  if (!result) fail(result.error());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// A mesh by its file or by the name of its shape; only what a surface is made of.
TriangleMesh surface_called(const std::string& name) {
  Result<TriangleMesh> shape = make_shape(name);
  TriangleMesh mesh = shape ? *std::move(shape) : required(read_mesh(name));
  mesh.attributes = {};
  return mesh;
}

double spacing_of(const TriangleMesh& truth, std::size_t count) {
  return std::sqrt(surface_area(truth) / static_cast<double>(count));
}

/// The cells, `width` wide, around a point, as one number each.
template <class Visit>
void visit_cells_around(const Vec3d& p, double width, Visit visit) {
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width)); };
  for (std::int64_t z = cell(p.z) - 1; z <= cell(p.z) + 1; ++z) {
    for (std::int64_t y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y) {
      for (std::int64_t x = cell(p.x) - 1; x <= cell(p.x) + 1; ++x) {
        visit((z * 2097152 + y) * 2097152 + x);
      }
    }
  }
}

/// `count` points spread over the surface such that none is nearer to another than 0.7 spacings
/// (by throwing darts, Cook 1986), as scans and merged scans are; in the order of its triangles,
/// which is as local as that of a scan.
std::vector<Vec3d> spread_over(const TriangleMesh& surface, std::size_t count) {
  std::vector<SurfaceSample> darts = surface_samples(surface, 6 * count);
  Random random(2);
  for (std::size_t i = darts.size(); i > 1; --i) std::swap(darts[i - 1], darts[random.below(i)]);
  const double apart = 0.7 * spacing_of(surface, count);
  std::unordered_map<std::int64_t, std::vector<Vec3d>> cells;
  std::vector<SurfaceSample> kept;
  for (const SurfaceSample& dart : darts) {
    if (kept.size() == count) break;
    bool free = true;
    std::int64_t own = 0, visited = 0;
    visit_cells_around(dart.point, apart, [&](std::int64_t cell) {
      if (visited++ == 13) own = cell;  // the middle one of 27
      const auto found = cells.find(cell);
      if (found == cells.end()) return;
      for (const Vec3d& q : found->second) free &= squared_norm(q - dart.point) >= apart * apart;
    });
    if (!free) continue;
    cells[own].push_back(dart.point);
    kept.push_back(dart);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  std::vector<Vec3d> points;
  for (const SurfaceSample& sample : kept) points.push_back(sample.point);
  return points;
}

/// The surfaces that every organized cloud sees by itself, as one mesh.
void append(TriangleMesh& all, const TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  const Vec3d shift = mesh.frame.origin - all.frame.origin;
  for (const Vec3f& p : mesh.positions) all.positions.push_back(Vec3f(Vec3d(p) + shift));
  for (const auto& [a, b, c] : mesh.triangles) {
    all.triangles.push_back({a + first, b + first, c + first});
  }
}

/// Every second pixel of every second row.
PointCloud halved(const PointCloud& cloud) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t row = 0; row + 1 < cloud.grid->height; row += 2) {
    for (std::uint32_t column = 0; column + 1 < cloud.grid->width; column += 2) {
      kept.push_back(row * cloud.grid->width + column);
    }
  }
  PointCloud half = select(cloud, kept);
  half.grid = GridSize{cloud.grid->width / 2, cloud.grid->height / 2};
  half.viewpoint = cloud.viewpoint;
  return half;
}

/// The spacing where no area is known: the median of what each point's eighth neighbour says of how
/// many points share how much of a plane.
double spacing_of(const PointCloud& cloud) {
  constexpr std::size_t kNeighbours = 8;
  const NeighbourGrid grid(cloud.positions);
  std::vector<double> squared;
  std::vector<Neighbour> found;
  for (const Vec3f& p : cloud.positions) {
    grid.nearest(p, kNeighbours + 1, found);
    squared.push_back(found.back().squared_distance);
  }
  std::nth_element(squared.begin(), squared.begin() + squared.size() / 2, squared.end());
  return std::sqrt(std::numbers::pi / kNeighbours * squared[squared.size() / 2]);
}

struct Input {
  PointCloud points;
  TriangleMesh truth;
  double spacing = 0;
};

Input vertices(const std::string& name) {
  TriangleMesh truth = surface_called(name);
  PointCloud cloud;
  cloud.positions = truth.positions;
  cloud.frame = truth.frame;
  const double spacing = spacing_of(truth, cloud.positions.size());
  return {std::move(cloud), std::move(truth), spacing};
}

Input sampled(const std::string& name, std::size_t count, double noise) {
  TriangleMesh truth = surface_called(name);
  PointCloud cloud;
  cloud.frame = truth.frame;
  const double spacing = spacing_of(truth, count), sigma = noise * spacing;
  const std::vector<Vec3d> points = spread_over(truth, count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Random random(3, i);
    Vec3d p = points[i];
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += sigma * random.normal();
    cloud.positions.push_back(Vec3f(p));
  }
  return {std::move(cloud), std::move(truth), spacing};
}

Input plane(std::size_t count) {
  Input input{{}, make_grid(1, 1), 0};
  for (std::size_t i = 0; i < count; ++i) {
    Random random(4, i);
    const double x = random.uniform(), y = random.uniform();
    input.points.positions.push_back(Vec3f(Vec3d{x, y, 0}));
  }
  input.spacing = spacing_of(input.truth, count);
  return input;
}

/// Every pixel sees something: the camera stands in a room, before a torus.
Input frame() {
  Input input;
  append(input.truth, make_box({4, 4, 3}, 8));
  append(input.truth, make_torus(0.5, 0.2, 128, 64));
  const VirtualCamera camera =
      required(VirtualCamera::create(input.truth, required(find_sensor("kinect_v1"))));
  const DepthFrame depth =
      required(camera.capture(look_at({0.3, -1.7, 1.1}, {0, 0.2, 0}, {0, 0, 1})));
  input.points = required(unproject(depth));
  input.spacing = spacing_of(without_missing(input.points));
  return input;
}

/// What `burnish reconstruct` triangulates. What single frames see lies beside it by the errors of
/// depth and poses: nothing nearer than that can be called missing or invented.
Input merged(const std::string& folder) {
  ScanInputs inputs;
  inputs.paths = {folder};
  const std::unique_ptr<Scans> scans = required(open_scans(inputs));
  const Recipe recipe;
  Record record;
  std::vector<PointCloud> clouds;
  Input input;
  for (std::size_t i = 0; i < scans->size(); ++i) {
    PointCloud cloud = required(scans->read(i, {})).cloud;
    required(clean_cloud(cloud, recipe.clean_scan, record, {}));
    append(input.truth, required(triangulate_cloud(halved(cloud), {"organized", {}}, record, {})));
    clouds.push_back(std::move(cloud));
  }
  input.points = required(merge_clouds(clouds, recipe.merge, record, {}));
  required(clean_cloud(input.points, recipe.clean_merged, record, {}));
  constexpr double kFramesAgree = 0.025;  // m: 14 mm of noise at 3 m, poses to 11 to 13 mm
  input.spacing = std::max(kFramesAgree, spacing_of(input.points));
  return input;
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  const std::vector<std::string> words(argv + 1, argv + argc);
  Input input;
  if (words.size() == 4 && words[0] == "points") {
    input = vertices(words[1]);
  } else if (words.size() == 6 && words[0] == "sample") {
    input = sampled(words[1], std::stoul(words[2]), std::stod(words[3]));
  } else if (words.size() == 4 && words[0] == "plane") {
    input = plane(std::stoul(words[1]));
  } else if (words.size() == 3 && words[0] == "frame") {
    input = frame();
  } else if (words.size() == 4 && words[0] == "merge") {
    input = merged(words[1]);
  } else {
    std::fprintf(stderr, "usage: see the head of the source\n");
    return 2;
  }
  required(write_cloud(words[words.size() - 2], input.points));
  required(write_mesh(words.back(), input.truth));
  std::printf("%.9g\n", input.spacing);
}
