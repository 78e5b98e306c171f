#include "burnish/smoothing/bilateral.h"

#include <cmath>
#include <span>
#include <utility>

#include "burnish/base/parallel.h"
#include "burnish/core/edges.h"
#include "burnish/smoothing/face_neighbours.h"
#include "burnish/smoothing/face_work.h"
#include "burnish/smoothing/ring_filter.h"
#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {
namespace {

/// How far along `normal` the vertex at `centre` goes. `heights` is scratch.
double move_along(const Vec3d& normal, const Vec3d& centre, std::span<const std::uint32_t> around,
                  std::span<const Vec3d> positions, double sigma_c, std::vector<double>& heights) {
  heights.clear();
  double mean = 0, variance = 0;
  const auto count = static_cast<double>(around.size());
  for (const std::uint32_t q : around) {
    heights.push_back(dot(normal, positions[q] - centre));
    mean += heights.back() / count;
  }
  for (const double h : heights) variance += (h - mean) * (h - mean) / count;
  // Where all heights are the same any sigma_s gives them the same weight.
  const double alike = variance > 0 ? 1 / (2 * variance) : 0;
  const double near = 1 / (2 * sigma_c * sigma_c);
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const double h = heights[k];
    const double weight =
        std::exp(-near * squared_norm(positions[around[k]] - centre) - alike * h * h);
    sum += weight * h;
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

/// The vertices that each is moved with, itself left out.
bool neighbourhoods(const Context& context, const TriangleMesh& mesh, const FaceSurface& surface,
                    BoundaryRule boundary, double sigma_c, Adjacency& around) {
  std::vector<Quad> points;
  points.reserve(surface.positions.size());
  for (const Vec3d& p : surface.positions) points.emplace_back(Vec3f(p), 0.f);
  return connected_within(context, static_cast<float>(2 * sigma_c), points,
                          smoothing_rings(mesh, boundary), around);
}

}  // namespace

const Schema<BilateralParams>& BilateralParams::schema() {
  using P = BilateralParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 10000), "number of passes")
          .real("relative_width", &P::relative_width, {.low = 0.1, .high = 10},
                "width of the distance weight in mean edge lengths")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_bilateral(TriangleMesh& mesh, const BilateralParams& params,
                                         const Context& context) {
  if (auto valid = BilateralParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();
  const Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  const double edge = mean_edge_length(mesh);
  const FaceSurface surface = face_surface(mesh, edge > 0 ? edge : 1);
  const Adjacency faces_of_vertices = triangles_of_vertices(mesh);
  Adjacency around;
  if (!neighbourhoods(context.part(0, 0.2), mesh, surface, params.boundary, params.relative_width,
                      around)) {
    return cancelled();
  }
  std::vector<Vec3d> positions = surface.positions, next = positions;
  FaceGeometry faces;
  const auto move = [&](IndexRange range) {
    std::vector<double> heights;
    for (std::size_t v = range.begin; v < range.end; ++v) {
      Vec3d normal;
      for (const std::uint32_t f : faces_of_vertices.row(v)) {
        normal += static_cast<double>(faces.normals[f].w()) * Vec3d(faces.normals[f].xyz());
      }
      normal = normalized(normal);
      const double share = follows->empty() ? 1 : (*follows)[v];
      next[v] = positions[v] + share *
                                   move_along(normal, positions[v], around.row(v), positions,
                                              params.relative_width, heights) *
                                   normal;
    }
  };
  const Context passes = context.part(0.2, 1);
  for (int i = 0; i < params.iterations; ++i) {
    const Context share =
        passes.part(static_cast<double>(i) / params.iterations, (i + 1.0) / params.iterations);
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
