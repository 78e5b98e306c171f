#pragma once

#include <cstddef>

#include "burnish/smoothing/normal_fusion.h"

// What training/train_fusion found. Not part of the library's interface.
namespace burnish {

/// Independent from vertex to vertex; or correlated between neighbours, as depth cameras make it.
enum class Noise { white, camera };

inline constexpr std::size_t kFusionStages = 3;
/// Passes over the vertices after each stage.
inline constexpr int kFusionVertexPasses = 15;

/// The network of a stage, 0 to kFusionStages - 1.
const FusionNetwork& fusion_network(Noise noise, std::size_t stage);

}  // namespace burnish
