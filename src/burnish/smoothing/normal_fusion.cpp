#include "burnish/smoothing/normal_fusion.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace burnish {
namespace {

/// Between what 30 examples of either kind that were trained with show: white noise 0.25 to 0.52
/// (0.72 where it is so weak that the shape decides), cameras 0.62 to 0.89.
constexpr float kSlowFall = 0.57f;

Quad cross3(const Quad& a, const Quad& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}

Quad unit_or(const Quad& v, const Quad& otherwise) {
  const float squared = dot3(v, v);
  return squared > 1e-12f ? (1 / std::sqrt(squared)) * v : otherwise;
}

/// Some direction across `z`.
Quad across(const Quad& z) {
  const Quad axis = std::abs(z[0]) < 0.6f ? Quad(1, 0, 0, 0) : Quad(0, 1, 0, 0);
  return unit_or(cross3(z, axis), {0, 0, 1, 0});
}

/// z is the mean of the candidates; x the axis along which these and the surroundings' normals
/// spread most, both axes turned to the side to which the candidates lean.
FusionFrame frame_of(const FusionInput& input, std::size_t f) {
  const auto candidates = input.candidates->of(f);
  Quad mean;
  for (const Quad& c : candidates) mean += c;
  mean.set_w(0);
  FusionFrame frame;
  frame.z = unit_or(mean, {0, 0, 1, 0});
  const Quad u = across(frame.z), v = cross3(frame.z, u);
  float uu = 0, uv = 0, vv = 0, lean_u = 0, lean_v = 0, rank = 0;
  const auto add = [&](const Quad& n) {
    const float a = dot3(n, u), b = dot3(n, v);
    uu += a * a;
    uv += a * b;
    vv += b * b;
  };
  for (const Quad& c : candidates) {
    add(c);
    // Across their mean the candidates add up to 0: the later ones count more.
    rank += 1;
    lean_u += rank * dot3(c, u);
    lean_v += rank * dot3(c, v);
  }
  for (const std::uint32_t g : input.around->row(f)) {
    if (g != f) add(input.candidates->of(g)[NormalCandidates::kTwice]);
  }
  // The axis of the larger variance, by half angles: no arc functions.
  const float difference = uu - vv, length = std::sqrt(difference * difference + 4 * uv * uv);
  float cosine = 1, sine = 0;
  if (length > 1e-12f) {
    cosine = std::sqrt(std::max(0.f, (1 + difference / length) / 2));
    sine = std::copysign(std::sqrt(std::max(0.f, (1 - difference / length) / 2)), uv);
  }
  frame.x = cosine * u + sine * v;
  frame.y = cosine * v - sine * u;
  if (cosine * lean_u + sine * lean_v < 0) frame.x *= Quad(-1);
  if (cosine * lean_v - sine * lean_u < 0) frame.y *= Quad(-1);
  return frame;
}

}  // namespace

Roughness roughness(const NormalCandidates& candidates) {
  using C = NormalCandidates;
  const std::size_t count = candidates.faces();
  if (count == 0) return {};
  std::vector<float> differences(count);
  const auto quantile = [&](std::size_t before, std::size_t after, std::size_t rank) {
    for (std::size_t f = 0; f < count; ++f) {
      const auto of_f = candidates.of(f);
      differences[f] = std::max(0.f, 2 - 2 * dot3(of_f[before], of_f[after]));
    }
    const auto place = differences.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(differences.begin(), place, differences.end());
    return *place;
  };
  const float twice = quantile(C::kOnce, C::kTwice, count / 4);
  const float four_times = quantile(C::kTwice, C::kFourTimes, count / 4);
  const float eight_times = quantile(C::kFourTimes, C::kEightTimes, count / 4);
  return {.fine = quantile(C::kRaw, C::kOnce, count / 2),
          .coarse = quantile(C::kTwice, C::kEightTimes, count / 2),
          .correlated = four_times > kSlowFall * twice && eight_times < four_times};
}

FusionFrame fusion_features(const FusionInput& input, std::size_t f,
                            std::span<float, kFusionInputs> features) {
  const FusionFrame frame = frame_of(input, f);
  std::size_t at = 0;
  const auto add = [&](const Quad& n) {
    features[at++] = dot3(n, frame.x);
    features[at++] = dot3(n, frame.y);
  };
  for (const Quad& c : input.candidates->of(f)) add(c);
  add(input.first.empty() ? Quad() : input.first[f]);
  add(input.last.empty() ? Quad() : input.last[f]);

  const auto row = input.around->row(f);
  float weights = 1e-6f;
  std::array<float, 2> raw{}, smooth{}, lean{};  // mean squares of neighbours along x and y
  for (const std::uint32_t g : row) {
    if (g == f) continue;
    const auto of_g = input.candidates->of(g);
    const Quad& own = of_g[NormalCandidates::kRaw];
    const Quad& mean = of_g[NormalCandidates::kFourTimes];
    const float w = own.w();
    const float rx = dot3(own, frame.x), ry = dot3(own, frame.y);
    const float sx = dot3(mean, frame.x), sy = dot3(mean, frame.y);
    weights += w;
    raw[0] += w * rx * rx;
    raw[1] += w * ry * ry;
    smooth[0] += w * sx * sx;
    smooth[1] += w * sy * sy;
    lean[0] += w * sx;
    lean[1] += w * sy;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    features[at++] = std::sqrt(raw[axis] / weights);
    features[at++] = std::sqrt(smooth[axis] / weights);
    features[at++] = lean[axis] / weights;
  }
  features[at++] = std::sqrt(input.roughness.fine);
  features[at++] = std::sqrt(input.roughness.coarse);
  const Quad& own = input.candidates->of(f)[NormalCandidates::kRaw];
  const float mean_area = weights / static_cast<float>(std::max<std::size_t>(row.size(), 2) - 1);
  features[at++] = std::min(3.f, own.w() / mean_area);
  features[at++] = 1 - dot3(own, frame.z);
  return frame;
}

FusionLayers evaluate(const FusionNetwork& network,
                      std::span<const float, kFusionInputs> features) {
  FusionLayers layers;
  const auto layer = [](std::span<const float> weights, std::span<const float> in,
                        std::span<float> out) {
    std::copy_n(weights.data() + in.size() * out.size(), out.size(), out.data());
    for (std::size_t i = 0; i < in.size(); ++i) {
      const float x = in[i];
      const float* const row = weights.data() + i * out.size();
      for (std::size_t o = 0; o < out.size(); ++o) out[o] += x * row[o];
    }
  };
  const auto rectify = [](std::span<float> values) {
    for (float& v : values) v = std::max(v, 0.f);
  };
  layer(network.first, features, layers.first);
  rectify(layers.first);
  layer(network.second, layers.first, layers.second);
  rectify(layers.second);
  layer(network.last, layers.second, layers.turn);
  return layers;
}

Quad fused_normal(const FusionNetwork& network, std::span<const float, kFusionInputs> features,
                  const FusionFrame& frame) {
  const auto turn = evaluate(network, features).turn;
  return unit_or(frame.z + turn[0] * frame.x + turn[1] * frame.y, frame.z);
}

}  // namespace burnish
