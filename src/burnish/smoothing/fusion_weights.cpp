#include "burnish/smoothing/fusion_weights.h"

#include <array>

namespace burnish {
namespace {

#include "burnish/smoothing/fusion_weights_camera.inc"
#include "burnish/smoothing/fusion_weights_white.inc"

}  // namespace

const FusionNetwork& fusion_network(Noise noise, std::size_t stage) {
  return noise == Noise::camera ? kCameraStages[stage] : kWhiteStages[stage];
}

}  // namespace burnish
