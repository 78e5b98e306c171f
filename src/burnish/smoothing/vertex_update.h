#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/smoothing/face_geometry.h"
#include "burnish/smoothing/smoothing.h"

// Not part of the library's interface.
namespace burnish {

struct VertexUpdateRules {
  BoundaryRule boundary = BoundaryRule::fixed;
  /// Which share of the way to a place amid its neighbours a vertex makes, where triangles are bad.
  double equalizing = 0.3;
};

/// Moves vertices until the faces have given normals, by passes (Jacobi) of
///     p_i += 1 / (sum A_f) sum_f A_f n_f <n_f, c_f - p_i>
/// over the faces f of vertex i (Sun, Rosin, Martin, Langbein 2007, eq. 9, with the areas A_f at
/// the beginning as weights, so that slivers do not pull). Where one of its triangles is bad at the
/// beginning (its normal and the wanted one differ by more than 37 degrees, or its quality
/// 4 sqrt(3) A / (sum of squared sides) is below 0.35) each pass also adds
///     equalizing * exp(-max_f (1 - <n_f, n_i>) / 0.03) * (sum_j |e_ij| e_ij / sum_j
///     |e_ij|)_tangential
/// with edges e_ij = p_j - p_i and n_i = normalised sum_f A_f n_f: in the tangent plane the vertex
/// goes amid its neighbours, far ones counting more, but not where it lies on a crease. This is the
/// continuous form of "the farthest counts twice" (Ozbay and Cinar, Eq. 1).
///
/// Vertices on an open boundary (on a non-manifold edge) are never equalized, which would pull them
/// inwards. By the rule
///  - fixed: they stay;
///  - free: they follow the normals like all others. Normals pull nothing inwards, so that
///    boundaries do not creep; their outline within the surface remains as noisy as it was;
///  - along_boundary: as free, but at the beginning of each call they also move once to the mean of
///    themselves and their neighbours along the boundary, which smooths the outline and rounds its
///    corners. (Once in every pass would be far too much: some methods make hundreds.)
class VertexUpdate {
 public:
  /// `mesh` and `faces_of_vertices` must outlive this. `follows`: the share of each move that a
  /// vertex makes (smoothing_weights.h); empty: all move fully.
  VertexUpdate(const TriangleMesh& mesh, const Adjacency& faces_of_vertices,
               const VertexUpdateRules& rules, std::span<const float> follows);

  /// `positions` in units of FaceSurface; `wanted`: of every face the normal that it is to have,
  /// and its area now. No allocation. O(passes * #T). False where cancelled: `positions` are then
  /// of no use.
  [[nodiscard]] bool run(const Context& context, const FaceNormals& wanted, int passes,
                         std::vector<Vec3d>& positions);

 private:
  /// What a vertex does in every pass: move' = move + start + scale * sum_f pull_f - rows * move.
  struct Step {
    Quad columns[3];  ///< scale * sum A n n^T
    Quad start;       ///< scale * sum A n <n, c - p>; w: scale, the share of the move / sum A
  };

  void step_along_boundary(std::vector<Vec3d>& positions) const;
  [[nodiscard]] bool prepare_faces(const Context& context, const FaceNormals& wanted,
                                   const std::vector<Vec3d>& positions);
  [[nodiscard]] bool prepare_vertices(const Context& context, const FaceNormals& wanted,
                                      const std::vector<Vec3d>& positions);
  [[nodiscard]] bool pass(const Context& context, const std::vector<Vec3d>& positions);
  Quad way_amid(std::size_t v, const std::vector<Vec3d>& positions) const;

  const TriangleMesh& mesh_;
  const Adjacency& faces_of_vertices_;
  double equalizing_;
  Adjacency rings_;             ///< where equalizing
  std::vector<float> follows_;  ///< of every vertex its share of each move
  std::vector<bool> on_boundary_, stays_;
  Adjacency along_boundary_;  ///< the neighbours there, under that rule only

  std::vector<Quad> pulls_;      ///< of every face sqrt(A) n; w: times the mean move of its corners
  std::vector<double> offsets_;  ///< of every face sqrt(A) <n, c>
  std::vector<std::uint8_t> bad_;
  std::vector<Step> steps_;
  std::vector<Quad> equalizers_;          ///< of every vertex n_i; w: its share of the way
  std::vector<Quad> moves_, next_moves_;  ///< since the call began
};

}  // namespace burnish
