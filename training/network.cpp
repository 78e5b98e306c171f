#include "network.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/base/random.h"

namespace burnish::training {
namespace {

constexpr std::size_t kBatch = 512, kChunk = 128;
constexpr float kRounding = 1e-5f;  // of the loss near 0
constexpr std::size_t kWeights = sizeof(FusionNetwork) / sizeof(float);

float* weights_of(FusionNetwork& network) {
  return reinterpret_cast<float*>(&network);
}

void initialize(FusionNetwork& network, Random& random) {
  const auto fill = [&](std::span<float> weights, std::size_t in, std::size_t out, double gain) {
    const double size = gain * std::sqrt(2.0 / static_cast<double>(in));
    for (std::size_t i = 0; i < in * out; ++i) {
      weights[i] = static_cast<float>(size * random.normal());
    }
    std::fill(weights.begin() + static_cast<std::ptrdiff_t>(in * out), weights.end(), 0.f);
  };
  fill(network.first, kFusionInputs, kFusionHidden, 1);
  fill(network.second, kFusionHidden, kFusionHidden, 1);
  fill(network.last, kFusionHidden, kFusionOutputs, 0.1);
}

/// Adds the gradient of one sample's loss.
void backpropagate(const FusionNetwork& network, const FusionFeatures& features, const Vec3f& truth,
                   FusionNetwork& gradient) {
  constexpr std::size_t H = kFusionHidden, N = kFusionInputs, O = kFusionOutputs;
  const auto [first, second, last] = evaluate(network, features.seen);
  const auto [turn_x, turn_y] = blend(features, last);
  std::array<float, H> by_first{}, by_second{};
  std::array<float, O> by_last{};
  const float squared = 1 + turn_x * turn_x + turn_y * turn_y, length = std::sqrt(squared);
  const float cosine = (turn_x * truth.x + turn_y * truth.y + truth.z) / length;
  const float loss = std::sqrt(std::max(0.f, 2 - 2 * cosine) + kRounding);
  const float by_x = -(truth.x / length - cosine * turn_x / squared) / loss;
  const float by_y = -(truth.y / length - cosine * turn_y / squared) / loss;
  for (std::size_t k = 0; k < kFusionBlended; ++k) {
    by_last[k] = by_x * features.x[k] + by_y * features.y[k];
  }
  by_last[kFusionBlended] = by_x;
  by_last[kFusionBlended + 1] = by_y;
  for (std::size_t i = 0; i < H; ++i) {
    const float x = second[i];
    if (!(x > 0)) continue;
    const float* const row = network.last.data() + i * O;
    float* const to = gradient.last.data() + i * O;
    float sum = 0;
    for (std::size_t o = 0; o < O; ++o) {
      to[o] += x * by_last[o];
      sum += by_last[o] * row[o];
    }
    by_second[i] = sum;
  }
  for (std::size_t o = 0; o < O; ++o) gradient.last[H * O + o] += by_last[o];
  for (std::size_t i = 0; i < H; ++i) {
    const float x = first[i];
    if (!(x > 0)) continue;
    const float* const row = network.second.data() + i * H;
    float* const to = gradient.second.data() + i * H;
    float sum[4]{};
    for (std::size_t o = 0; o < H; o += 4) {
      for (std::size_t k = 0; k < 4; ++k) {
        sum[k] += by_second[o + k] * row[o + k];
        to[o + k] += x * by_second[o + k];
      }
    }
    by_first[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
  for (std::size_t o = 0; o < H; ++o) gradient.second[H * H + o] += by_second[o];
  for (std::size_t i = 0; i < N; ++i) {
    const float x = features.seen[i];
    float* const to = gradient.first.data() + i * H;
    for (std::size_t o = 0; o < H; ++o) to[o] += x * by_first[o];
  }
  for (std::size_t o = 0; o < H; ++o) gradient.first[N * H + o] += by_first[o];
}

}  // namespace

FusionNetwork train(const Samples& samples, const TrainingParams& params, const Context& context) {
  Random random(params.seed);
  FusionNetwork network;
  initialize(network, random);
  std::vector<double> mean(kWeights, 0), square(kWeights, 0);
  std::vector<std::uint32_t> order(samples.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t batches = samples.size() / kBatch;
  const double steps = static_cast<double>(batches) * params.epochs;
  std::vector<FusionNetwork> gradients(kBatch / kChunk);
  double mean_fade = 1, square_fade = 1, step = 0;
  for (int epoch = 0; epoch < params.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (std::size_t batch = 0; batch < batches; ++batch, ++step) {
      (void)parallel_for(
          context, gradients.size(),
          [&](IndexRange range) {
            for (std::size_t chunk = range.begin; chunk < range.end; ++chunk) {
              std::fill_n(weights_of(gradients[chunk]), kWeights, 0.f);
              for (std::size_t i = 0; i < kChunk; ++i) {
                const std::size_t s = order[batch * kBatch + chunk * kChunk + i];
                backpropagate(network, samples.features[s], samples.truth[s], gradients[chunk]);
              }
            }
          },
          1);
      const double rate = params.rate * 0.5 * (1 + std::cos(std::numbers::pi * step / steps));
      mean_fade *= 0.9;
      square_fade *= 0.999;
      for (std::size_t w = 0; w < kWeights; ++w) {
        double g = 0;
        for (FusionNetwork& part : gradients) g += static_cast<double>(weights_of(part)[w]);
        g /= kBatch;
        mean[w] = 0.9 * mean[w] + 0.1 * g;
        square[w] = 0.999 * square[w] + 0.001 * g * g;
        const double m = mean[w] / (1 - mean_fade), v = square[w] / (1 - square_fade);
        weights_of(network)[w] -= static_cast<float>(rate * m / (std::sqrt(v) + 1e-8));
      }
    }
  }
  return network;
}

double mean_error(const FusionNetwork& network, const Samples& samples) {
  double sum = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const FusionFrame frame{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    const Vec3d n(fused_normal(network, samples.features[s], frame).xyz());
    sum += std::acos(std::clamp(dot(n, Vec3d(samples.truth[s])), -1.0, 1.0));
  }
  return sum / static_cast<double>(std::max<std::size_t>(samples.size(), 1)) * 180 /
         std::numbers::pi;
}

}  // namespace burnish::training
