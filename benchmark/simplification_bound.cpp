#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "burnish/adaptation/point_removal.h"
#include "burnish/adaptation/quadric_collapse.h"
#include "burnish/base/random.h"
#include "burnish/io/geometry_file.h"
#include "judged_shapes.h"
#include "two_sided_distance.h"

// burnish_benchmark_bound DATA [PART OF_PARTS]: simplifies 50 meshes under five bounds each, by
// both methods, and measures how far original and result are from each other: by points spread over
// both surfaces, their vertices and the middles of their edges, with burnish's own tree; and by
// vertices, middles of edges and centres of triangles with CGAL's. Prints a line for each run, with
// the greater of both in units of the bound, and histograms of it and of what burnish says it is
// below. Ends with status 1 where a bound did not hold. With PART every OF_PARTS-th mesh alone is
// run.
namespace burnish {
namespace {

constexpr std::array kBounds{1e-4, 3e-4, 1e-3, 3e-3, 1e-2};  // of the diagonal of the box
constexpr const char* kFiles[] = {
    "denoise/guided_denoising/Fandisk0.3/Noisy.obj",
    "denoise/guided_denoising/Fandisk0.3/Original.obj",
    "denoise/guided_denoising/Fandisk0.7/Noisy.obj",
    "denoise/meshtgv/Kinect/Pyramid/groundtruth.obj",
    "denoise/meshtgv/Kinect/Pyramid/noisy.obj",
    "denoise/meshtgv/Kinect/Pyramid/tgv_result_mesh.obj",
    "denoise/resgem_cnr_synthetic_derived/fertility_gt.obj",
    "denoise/resgem_cnr_synthetic_derived/fertility_n2.obj",
    "denoise/resgem_cnr_synthetic_derived/sphere_gt.obj",
    "denoise/resgem_cnr_synthetic_derived/sphere_n1.obj",
    "denoise/resgem_cnr_synthetic_derived/sphere_n2.obj",
    "denoise/resgem_cnr_synthetic_derived/sphere_n3.obj",
    "denoise/resgem_cnr_synthetic_derived/trim-star_gt.obj",
    "denoise/resgem_cnr_synthetic_derived/trim-star_n1.obj",
    "denoise/resgem_cnr_synthetic_derived/trim-star_n2.obj",
    "denoise/resgem_cnr_synthetic_derived/trim-star_n3.obj",
    "human/makehuman_body_tri.obj",
    "stanford/buddha_photon.obj",
    "stanford/bun_zipper.ply",
    "stanford/bunny_3485v.off",
};

struct Model {
  std::string name;
  TriangleMesh mesh;
};

template <class T>
T required(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "%s: %s\n", result.error().where.c_str(), result.error().message.c_str());
  std::exit(1);
}

struct Box {
  Vec3f low, high;

  explicit Box(const TriangleMesh& mesh) : low(mesh.positions.front()), high(low) {
    for (const Vec3f& p : mesh.positions) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  double diagonal() const { return norm(Vec3d(high) - Vec3d(low)); }
};

void add_noise(TriangleMesh& mesh, double sigma) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Random random(5, v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.positions[v][axis] += static_cast<float>(sigma * random.normal());
    }
  }
}

/// So that many triangles have no area, and many vertices the same place.
void snap_to_grid(TriangleMesh& mesh, double cells) {
  const Box box(mesh);
  const auto step = static_cast<float>(box.diagonal() / cells);
  for (Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = step * std::round(p[axis] / step);
  }
}

/// Files first; then every judged shape as it is, and with noise of a hundredth of its size, the
/// teapot and, to make 50, some of the shapes upon a grid of 100 cells.
std::vector<Model> models(const std::string& data) {
  std::vector<Model> models;
  for (const char* file : kFiles) models.push_back({file, required(read_mesh(data + "/" + file))});
  for (const std::string_view name : judged_shapes()) {
    models.push_back({std::string(name), required(judged_shape(std::string(name)))});
    Model noisy = models.back();
    noisy.name += " with noise";
    add_noise(noisy.mesh, 0.002 * Box(noisy.mesh).diagonal());
    models.push_back(std::move(noisy));
  }
  models.push_back({"teapot", required(judged_shape("teapot"))});
  for (std::size_t i = std::size(kFiles); models.size() < 50; i += 4) {
    Model snapped = models[i];
    snapped.name += " on a grid";
    snap_to_grid(snapped.mesh, 100);
    models.push_back(std::move(snapped));
  }
  for (Model& model : models) model.mesh.attributes = {};
  return models;
}

// ---------------------------------------------------------------- CGAL's distance

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Triangles triangles_of(const TriangleMesh& mesh) {
  const auto place = [&](std::uint32_t v) {
    const Vec3f& p = mesh.positions[v];
    return Kernel::Point_3(p.x, p.y, p.z);
  };
  Triangles triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.emplace_back(place(a), place(b), place(c));
  }
  return triangles;
}

/// From corners, middles of edges and centres. CGAL's tree takes no triangles without area: their
/// corners and edges are those of others where there are any.
double one_way(const Triangles& from, Triangles to) {
  std::erase_if(to, [](const auto& t) { return t.is_degenerate(); });
  const Tree tree(to.begin(), to.end());
  double largest = 0;
  for (const auto& t : from) {
    const auto ask = [&](const Kernel::Point_3& p) {
      largest = std::max(largest, tree.squared_distance(p));
    };
    for (int i = 0; i < 3; ++i) {
      ask(t[i]);
      ask(CGAL::midpoint(t[i], t[i + 1]));
    }
    ask(CGAL::centroid(t));
  }
  return std::sqrt(largest);
}

// ---------------------------------------------------------------- what is printed

class Histogram {
 public:
  void add(double share) { ++counts_[static_cast<std::size_t>(std::clamp(10 * share, 0.0, 10.0))]; }
  void print(const char* title) const {
    std::printf("| %s |", title);
    for (const int count : counts_) std::printf(" %d |", count);
    std::printf("\n");
  }

 private:
  std::array<int, 11> counts_{};  ///< 0 to 0.1, ... 0.9 to 1, and 1 or more
};

struct Tally {
  Histogram measured, said;
  int runs = 0, broken = 0;
};

void run(const Model& model, bool quadric, double bound, Tally& tally) {
  const MeasuredSurface original(model.mesh);
  const double limit = bound * Box(original.mesh).diagonal();
  TriangleMesh mesh = original.mesh;
  const SimplifyParams params{.max_error = limit};
  const SimplifyReport report =
      required(quadric ? simplify_quadric(mesh, params) : simplify_point_removal(mesh, params));
  const MeasuredSurface result(std::move(mesh));
  const std::size_t samples = std::max<std::size_t>(50'000, 3 * original.mesh.triangles.size());
  const double sampled = two_sided_distance(original, result, samples).hausdorff();
  const Triangles before = triangles_of(original.mesh), after = triangles_of(result.mesh);
  const double independent = std::max(one_way(before, after), one_way(after, before));
  const double measured = std::max(sampled, independent) / limit;
  const double said = report.error_bound.value() / limit;
  // What is computed of floats agrees to their rounding.
  const double rounding = 1e-7 / bound;
  const bool holds = measured <= said + rounding && said <= 1;
  tally.measured.add(measured);
  tally.said.add(said);
  ++tally.runs;
  tally.broken += !holds;
  std::printf("%s, %s, %g: %zu of %zu triangles, said %.3f, sampled %.3f, by CGAL %.3f%s\n",
              model.name.c_str(), quadric ? "quadric" : "point_removal", bound,
              result.mesh.triangles.size(), original.mesh.triangles.size(), said, sampled / limit,
              independent / limit, holds ? "" : " BROKEN");
  std::fflush(stdout);
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 2 && argc != 4) return 2;
  const std::size_t part = argc == 4 ? std::stoul(argv[2]) : 0;
  const std::size_t parts = argc == 4 ? std::stoul(argv[3]) : 1;
  const std::vector<Model> all = models(argv[1]);
  std::array<Tally, 2> tallies;
  for (std::size_t i = part; i < all.size(); i += parts) {
    for (const bool quadric : {true, false}) {
      for (const double bound : kBounds) run(all[i], quadric, bound, tallies[quadric]);
    }
  }
  std::printf(
      "\n| share of the bound | 0 to 0.1 | 0.1 | 0.2 | 0.3 | 0.4 | 0.5 | 0.6 | 0.7 | 0.8 | 0.9 | "
      "1 or more |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  tallies[1].measured.print("quadric, measured");
  tallies[1].said.print("quadric, said");
  tallies[0].measured.print("point_removal, measured");
  tallies[0].said.print("point_removal, said");
  std::printf("\n%d meshes and bounds by each method; %d broken\n", tallies[0].runs,
              tallies[0].broken + tallies[1].broken);
  return tallies[0].broken + tallies[1].broken == 0 ? 0 : 1;
}
