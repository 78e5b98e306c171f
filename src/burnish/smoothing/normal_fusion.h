#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/smoothing/normal_candidates.h"

// A small network that makes one normal of several candidates. Not part of the library's interface;
// the training program includes it too.
namespace burnish {

/// A frame at a face in which the network sees its candidates: it turns with the surface, and a
/// mirrored surface gives the mirrored frame, so that nothing depends on where the axes of the
/// world are.
struct FusionFrame {
  Quad x, y, z;
};

/// The normals that are blended: the candidates, the face's as it came, and what the stage before
/// made of it.
inline constexpr std::size_t kFusionBlended = NormalCandidates::kCount + 2;
/// Means of neighbours' normals: two candidates, on four sides of the face, along x and y.
inline constexpr std::size_t kFusionSides = 2 * 4 * 2;
/// Numbers that describe the face and its surroundings besides these.
inline constexpr std::size_t kFusionScalars = 8;
inline constexpr std::size_t kFusionInputs = 2 * kFusionBlended + kFusionSides + kFusionScalars;
inline constexpr std::size_t kFusionHidden = 64;
/// A share of each normal that is blended, and a turn along x and y that the network adds; what is
/// left fills the row.
inline constexpr std::size_t kFusionOutputs = 16;
static_assert(kFusionBlended + 2 <= kFusionOutputs);

/// How rough a mesh is, from the squared differences between the normals of its faces before and
/// after some passes of the candidates' plain mean.
struct Roughness {
  float fine = 0;    ///< median between none and one pass
  float coarse = 0;  ///< median between two and eight passes
  /// Noise that is independent from vertex to vertex is mostly gone after two passes, what a depth
  /// camera makes is not: on the flattest quarter of the faces the differences fall slowly from one
  /// number of passes to the next. (Where they rise, it is the shape that they measure.)
  bool correlated = false;
};

Roughness roughness(const NormalCandidates& candidates);

/// What is the same for all faces, or looked up by face.
struct FusionInput {
  const NormalCandidates* candidates;
  const FaceGeometry* faces;          ///< as they are now
  const Adjacency* around;            ///< vertex_neighbours
  Roughness roughness;                ///< of the mesh as it came
  std::span<const Quad> first, last;  ///< #T: as it came, after the stage before; empty at first
};

/// What the network sees of a face.
struct FusionFeatures {
  std::array<float, kFusionInputs> seen;
  std::array<float, kFusionBlended> x, y;  ///< the normals that are blended, along the frame's axes
};

/// Fills in what the network sees of face `f`; returns its frame.
FusionFrame fusion_features(const FusionInput& input, std::size_t f, FusionFeatures& features);

/// Weights of a network of two hidden layers of rectified linear units and one of linear ones, a
/// layer's row per input and its offsets after them.
struct FusionNetwork {
  std::array<float, (kFusionInputs + 1) * kFusionHidden> first;
  std::array<float, (kFusionHidden + 1) * kFusionHidden> second;
  std::array<float, (kFusionHidden + 1) * kFusionOutputs> last;
};

/// What comes out of each layer.
struct FusionLayers {
  std::array<float, kFusionHidden> first, second;
  std::array<float, kFusionOutputs> last;
};

FusionLayers evaluate(const FusionNetwork& network, std::span<const float, kFusionInputs> features);

/// What the last layer's output says of the normal in its frame: the sum of the shares of the
/// blended normals and the turn that is added.
std::array<float, 2> blend(const FusionFeatures& features,
                           std::span<const float, kFusionOutputs> output);

/// The normal that the network makes of the features: z + blend_x x + blend_y y, of unit length.
Quad fused_normal(const FusionNetwork& network, const FusionFeatures& features,
                  const FusionFrame& frame);

}  // namespace burnish
