#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/face_geometry.h"

// Not part of the library's interface.
namespace burnish {

/// The guidance normals of Zhang, Deng, Zhang, Bouaziz, Liu 2015 (section 3.2). A patch is a face
/// with its vertex-neighbours. How much it is not of one piece is
///     H = Phi R,   Phi = max |n_a - n_b| over its faces,   R = max phi_e / (1e-9 + sum phi_e)
/// over its inner edges e (shared by two of its faces), phi_e = |n_1 - n_2| across the edge. The
/// guidance of a face is the area-mean normal of that patch, of all that contain the face, whose H
/// is least (ties: the one around the face with the smaller number). Faces without area count
/// nowhere; where more than two faces share an edge, every two of them count as an edge.
class PatchGuidance {
 public:
  /// The neighbours (face_neighbours.h) must outlive this. O(entries of `vertex_neighbours`). False
  /// where cancelled.
  [[nodiscard]] bool prepare(const Context& context, const Adjacency& edge_neighbours,
                             const Adjacency& vertex_neighbours);

  /// Unit normals; 0 where the patch's normals cancel. `guidance` is made as long as `normals`.
  /// O(sum over the faces of vertex-neighbours squared). False where cancelled.
  [[nodiscard]] bool find(const Context& context, const FaceNormals& normals,
                          std::vector<Quad>& guidance);

  /// Of the latest call, per face: H of its patch.
  const std::vector<float>& inconsistencies() const { return inconsistencies_; }

 private:
  const Adjacency* members_ = nullptr;
  std::vector<std::array<std::uint32_t, 2>> pairs_;  ///< faces that share an edge
  Adjacency inner_edges_;                            ///< per patch which of the pairs
  std::vector<float> differences_;                   ///< phi of every pair
  std::vector<Quad> patches_;                        ///< the area-mean normal of each
  std::vector<float> inconsistencies_;               ///< H of each
  std::size_t most_members_ = 0;
};

}  // namespace burnish
