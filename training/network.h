#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/smoothing/normal_fusion.h"

namespace burnish::training {

/// Faces as the network sees them, and what it should answer.
struct Samples {
  std::vector<FusionFeatures> features;
  std::vector<Vec3f> truth;  ///< the true normal in the frame of the features

  std::size_t size() const { return truth.size(); }
};

struct TrainingParams {
  int epochs = 12;
  double rate = 2e-3;  ///< falls to 0 along half a cosine
  std::uint64_t seed = 1;
};

/// Adam (Kingma and Ba 2015) on sqrt(|n - n*|^2 + 1e-3), batch by batch in a random order. The same
/// bytes for any number of threads.
FusionNetwork train(const Samples& samples, const TrainingParams& params, const Context& context);

/// Mean angle between answers and truth, degrees.
double mean_error(const FusionNetwork& network, const Samples& samples);

}  // namespace burnish::training
