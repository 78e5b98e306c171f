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

/// Numbers that describe the face and its surroundings besides the candidates.
inline constexpr std::size_t kFusionScalars = 10;
/// The normals that the second stage sees too: as it came, and what the first stage made of it.
inline constexpr std::size_t kFusionExtra = 2;
inline constexpr std::size_t kFusionInputs =
    2 * (NormalCandidates::kCount + kFusionExtra) + kFusionScalars;
inline constexpr std::size_t kFusionHidden = 64;

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
  const Adjacency* around;            ///< vertex_neighbours
  Roughness roughness;                ///< of the mesh as it came
  std::span<const Quad> first, last;  ///< #T: as it came, after the stage before; empty at first
};

/// Writes what the network sees of face `f`; returns its frame.
FusionFrame fusion_features(const FusionInput& input, std::size_t f,
                            std::span<float, kFusionInputs> features);

/// Weights of a network of two hidden layers of rectified linear units and two outputs, a layer's
/// row per input and its offsets after them.
struct FusionNetwork {
  std::array<float, (kFusionInputs + 1) * kFusionHidden> first;
  std::array<float, (kFusionHidden + 1) * kFusionHidden> second;
  std::array<float, (kFusionHidden + 1) * 2> last;
};

/// What comes out of each layer.
struct FusionLayers {
  std::array<float, kFusionHidden> first, second;
  std::array<float, 2> turn;  ///< o_x, o_y
};

FusionLayers evaluate(const FusionNetwork& network, std::span<const float, kFusionInputs> features);

/// The normal that the network sees in the features: z + o_x x + o_y y, of unit length.
Quad fused_normal(const FusionNetwork& network, std::span<const float, kFusionInputs> features,
                  const FusionFrame& frame);

}  // namespace burnish
