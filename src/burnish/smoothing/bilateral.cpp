#include "burnish/smoothing/bilateral.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "burnish/base/parallel.h"
#include "burnish/core/edges.h"
#include "burnish/smoothing/face_neighbours.h"
#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/ring_mesh.h"
#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {
namespace {

/// What stays the same from pass to pass.
struct Neighbourhoods {
  Adjacency around;  ///< of every vertex those within 2 sigma_c, itself among them
  Adjacency faces_of_vertices;
};

Result<Neighbourhoods> find_neighbourhoods(const TriangleMesh& mesh, const FaceSurface& surface,
                                           const BilateralParams& params, const Context& context) {
  std::vector<Quad> points;
  points.reserve(surface.positions.size());
  for (const Vec3d& p : surface.positions) points.emplace_back(Vec3f(p), 0.f);
  const auto radius = static_cast<float>(2 * params.relative_width);
  Neighbourhoods found;
  found.faces_of_vertices = triangles_of_vertices(mesh);
  if (!connected_within(context, radius, points, smoothing_rings(mesh, params.boundary),
                        found.around)) {
    return cancelled();
  }
  return found;
}

/// The area-mean of the faces' normals; 0 where there are none.
Vec3d mean_normal(const FaceNormals& normals, std::span<const std::uint32_t> faces) {
  Vec3d sum;
  for (const std::uint32_t f : faces) {
    sum += static_cast<double>(normals[f].w()) * Vec3d(normals[f].xyz());
  }
  return normalized(sum);
}

/// Of the heights of vertices over the plane through one of them: their standard deviation.
double roughness(const Vec3d& normal, const Vec3d& centre, std::span<const std::uint32_t> around,
                 std::span<const Vec3d> positions) {
  const auto count = static_cast<double>(around.size());
  double mean = 0, variance = 0;
  for (const std::uint32_t q : around) mean += dot(normal, positions[q] - centre) / count;
  for (const std::uint32_t q : around) {
    const double apart = dot(normal, positions[q] - centre) - mean;
    variance += apart * apart / count;
  }
  return std::sqrt(variance);
}

/// The median over all vertices that have neighbours; 0 where there are none.
double median_roughness(const Neighbourhoods& hoods, const FaceNormals& normals,
                        std::span<const Vec3d> positions) {
  std::vector<double> all;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto around = hoods.around.row(v);
    if (around.size() < 2) continue;
    const Vec3d normal = mean_normal(normals, hoods.faces_of_vertices.row(v));
    all.push_back(roughness(normal, positions[v], around, positions));
  }
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

struct Widths {
  double sigma_c, sigma_s;  ///< positive
};

/// How far along `normal` the vertex at `centre` goes.
double height_of_neighbours(const Vec3d& normal, const Vec3d& centre,
                            std::span<const std::uint32_t> around, std::span<const Vec3d> positions,
                            const Widths& widths) {
  const double near = 1 / (2 * widths.sigma_c * widths.sigma_c);
  const double alike = 1 / (2 * widths.sigma_s * widths.sigma_s);
  double sum = 0, weights = 0;
  for (const std::uint32_t q : around) {
    const Vec3d away = positions[q] - centre;
    const double h = dot(normal, away);
    const double weight = std::exp(-near * squared_norm(away) - alike * h * h);
    sum += weight * h;
    weights += weight;
  }
  return sum / weights;  // the vertex itself weighs 1
}

}  // namespace

const Schema<BilateralParams>& BilateralParams::schema() {
  using P = BilateralParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 10000), "number of passes")
          .real("relative_width", &P::relative_width, {.low = 0.1, .high = 5},
                "width of the distance weight in mean edge lengths")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_bilateral(TriangleMesh& mesh, const BilateralParams& params,
                                         const Context& caller) {
  const Context context = for_passes_over(mesh.triangles.size(), caller);
  if (auto valid = BilateralParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();
  const Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  const double edge = mean_edge_length(mesh);
  const FaceSurface surface = face_surface(mesh, edge > 0 ? edge : 1);
  const auto hoods = find_neighbourhoods(mesh, surface, params, context.part(0, 0.2));
  if (!hoods) return hoods.error();
  std::vector<Vec3d> positions = surface.positions, next = positions;
  FaceGeometry faces;
  if (!measure_faces(context.part(0.2, 0.25), mesh.triangles, positions, faces)) return cancelled();
  const Widths widths{.sigma_c = params.relative_width,
                      .sigma_s = median_roughness(*hoods, faces.normals, positions)};

  const auto move = [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      const Vec3d normal = mean_normal(faces.normals, hoods->faces_of_vertices.row(v));
      const double share = follows->empty() ? 1 : (*follows)[v];
      next[v] = positions[v] + share *
                                   height_of_neighbours(normal, positions[v], hoods->around.row(v),
                                                        positions, widths) *
                                   normal;
    }
  };
  // Where most of a mesh is exactly flat there is no noise, and sigma_s is 0: all stays.
  const int passes = widths.sigma_s > 0 ? params.iterations : 0;
  const Context moving = context.part(0.25, 1);
  for (int i = 0; i < passes; ++i) {
    const Context share = moving.part(static_cast<double>(i) / passes, (i + 1.0) / passes);
    if (!measure_faces(share.part(0, 0.2), mesh.triangles, positions, faces) ||
        !parallel_for(share.part(0.2, 1), positions.size(), move)) {
      return cancelled();
    }
    std::swap(positions, next);
  }
  context.progress(1);
  return finish_face_work(mesh, surface, positions, params.iterations);
}

}  // namespace burnish
