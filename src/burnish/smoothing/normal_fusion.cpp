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

/// What a face's neighbours show in its frame.
struct Surroundings {
  /// Means of one candidate's x or y over the neighbours on the sides +x, -x, +y and -y, those
  /// farther to a side counting more.
  std::array<Quad, kFusionSides / 4> sides;
  std::array<float, 4> spread{};  ///< root mean squares of their own x and y, and of a smooth one's
  float mean_area = 0;
};

Surroundings surroundings(const FusionInput& input, std::size_t f, const FusionFrame& frame) {
  constexpr float kNothing = 1e-6f;
  const auto row = input.around->row(f);
  const Quad centre = input.faces->centroids[f];
  Surroundings result;
  Quad squares, shares(kNothing);
  float areas = kNothing;
  for (const std::uint32_t g : row) {
    if (g == f) continue;
    const auto of_g = input.candidates->of(g);
    const Quad& own = of_g[NormalCandidates::kRaw];
    const Quad& smooth = of_g[NormalCandidates::kFourTimes];
    const Quad& narrow = of_g[NormalCandidates::kNarrow];
    const Quad away = input.faces->centroids[g] - centre;
    const float x = dot3(away, frame.x), y = dot3(away, frame.y);
    const float smooth_x = dot3(smooth, frame.x), smooth_y = dot3(smooth, frame.y);
    const Quad across(dot3(own, frame.x), dot3(own, frame.y), smooth_x, smooth_y);
    squares += own.w() * across * across;
    areas += own.w();
    const Quad share = own.w() * larger(Quad(x, -x, y, -y), Quad());
    shares += share;
    result.sides[0] += smooth_x * share;
    result.sides[1] += smooth_y * share;
    result.sides[2] += dot3(narrow, frame.x) * share;
    result.sides[3] += dot3(narrow, frame.y) * share;
  }
  for (Quad& sides : result.sides) sides = Quad(sides.lanes / shares.lanes);
  for (int i = 0; i < 4; ++i) {
    result.spread[static_cast<std::size_t>(i)] = std::sqrt(squares[i] / areas);
  }
  result.mean_area = areas / static_cast<float>(std::max<std::size_t>(row.size(), 2) - 1);
  return result;
}

/// A layer of linear units. A few outputs at a time, so that their sums stay in registers.
template <std::size_t kCount>
void linear_layer(std::span<const float> weights, std::span<const float> in,
                  std::array<float, kCount>& out) {
  constexpr std::size_t kAtOnce = kCount % 32 == 0 ? 8 : 4;
  static_assert(kCount % (4 * kAtOnce) == 0);
  for (std::size_t o = 0; o < kCount; o += 4 * kAtOnce) {
    const float* row = weights.data() + o;
    std::array<Quad, kAtOnce> sums;
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      sums[k] = Quad::load(row + in.size() * kCount + 4 * k);
    }
    for (const float x : in) {
      for (std::size_t k = 0; k < kAtOnce; ++k) sums[k] += x * Quad::load(row + 4 * k);
      row += kCount;
    }
    for (std::size_t k = 0; k < kAtOnce; ++k) sums[k].store(&out[o + 4 * k]);
  }
}

void rectify(std::span<float> values) {
  for (float& v : values) v = std::max(v, 0.f);
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

FusionFrame fusion_features(const FusionInput& input, std::size_t f, FusionFeatures& features) {
  const FusionFrame frame = frame_of(input, f);
  const auto candidates = input.candidates->of(f);
  std::array<Quad, kFusionBlended> blended;
  std::copy(candidates.begin(), candidates.end(), blended.begin());
  if (!input.first.empty()) blended[candidates.size()] = input.first[f];
  if (!input.last.empty()) blended[candidates.size() + 1] = input.last[f];
  float* seen = features.seen.data();
  for (std::size_t i = 0; i < kFusionBlended; ++i) {
    features.x[i] = *seen++ = dot3(blended[i], frame.x);
    features.y[i] = *seen++ = dot3(blended[i], frame.y);
  }
  const Surroundings around = surroundings(input, f, frame);
  for (const Quad& sides : around.sides) {
    sides.store(seen);
    seen += 4;
  }
  for (const float roughness : around.spread) *seen++ = roughness;
  *seen++ = std::sqrt(input.roughness.fine);
  *seen++ = std::sqrt(input.roughness.coarse);
  const Quad& own = candidates[NormalCandidates::kRaw];
  *seen++ = std::min(3.f, own.w() / around.mean_area);
  *seen++ = 1 - dot3(own, frame.z);
  return frame;
}

FusionLayers evaluate(const FusionNetwork& network,
                      std::span<const float, kFusionInputs> features) {
  FusionLayers layers;
  linear_layer(network.first, features, layers.first);
  rectify(layers.first);
  linear_layer(network.second, layers.first, layers.second);
  rectify(layers.second);
  linear_layer(network.last, layers.second, layers.last);
  return layers;
}

std::array<float, 2> blend(const FusionFeatures& features,
                           std::span<const float, kFusionOutputs> output) {
  float x = output[kFusionBlended], y = output[kFusionBlended + 1];
  for (std::size_t i = 0; i < kFusionBlended; ++i) {
    x += output[i] * features.x[i];
    y += output[i] * features.y[i];
  }
  return {x, y};
}

Quad fused_normal(const FusionNetwork& network, const FusionFeatures& features,
                  const FusionFrame& frame) {
  const auto [x, y] = blend(features, evaluate(network, features.seen).last);
  return unit_or(frame.z + x * frame.x + y * frame.y, frame.z);
}

}  // namespace burnish
