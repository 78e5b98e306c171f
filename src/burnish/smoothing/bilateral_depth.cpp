#include "burnish/smoothing/bilateral_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/noise_correlation.h"
#include "burnish/smoothing/exp_of_negative.h"

namespace burnish {
namespace {

constexpr std::size_t kLanes = 4;
constexpr std::size_t kRowsAtOnce = 4;
/// Stands for a missing inverse depth: so far from all others that its weight is 0.
constexpr float kNowhere = 1e18f;
/// 1 / (2 s^2) where there is no noise: the least difference then has weight 0, and none has 1.
constexpr float kNoWidth = 1e30f;

/// A number per pixel, with a margin of others around.
struct Image {
  std::size_t width, height, margin, stride;
  std::vector<float> values;

  Image(std::size_t w, std::size_t h, std::size_t m, float outside)
      : width(w), height(h), margin(m), stride(w + 2 * m + kLanes) {
    values.assign(stride * (h + 2 * m), outside);
  }
  /// Pixel `x` of row `y`, both of which may reach into the margin.
  const float* at(std::ptrdiff_t x, std::ptrdiff_t y) const {
    const auto m = static_cast<std::ptrdiff_t>(margin);
    return values.data() + (y + m) * static_cast<std::ptrdiff_t>(stride) + x + m;
  }
  float* row(std::size_t y) { return values.data() + (y + margin) * stride + margin; }
};

/// One of every two opposite places of the window, and the weight of its distance.
struct Offset {
  std::ptrdiff_t dx, dy;
  float weight;
};

std::vector<Offset> half_window(double spatial) {
  const auto radius = static_cast<std::ptrdiff_t>(std::ceil(2 * spatial));
  std::vector<Offset> offsets;
  for (std::ptrdiff_t dy = 0; dy <= radius; ++dy) {
    for (std::ptrdiff_t dx = dy == 0 ? 1 : -radius; dx <= radius; ++dx) {
      const double squared = static_cast<double>(dx * dx + dy * dy);
      if (squared > 4 * spatial * spatial) continue;
      const auto x = static_cast<float>(squared / (2 * spatial * spatial));
      offsets.push_back({dx, dy, exp_of_negative(Quad(x))[0]});
    }
  }
  return offsets;
}

/// What a row of windows adds up to, the pixels themselves left out; a number per pixel each.
struct Sums {
  std::vector<float> weights, squares, moves, variances;

  explicit Sums(std::size_t width)
      : weights(width + kLanes),
        squares(width + kLanes),
        moves(width + kLanes),
        variances(width + kLanes) {}

  void clear() {
    for (auto* sum : {&weights, &squares, &moves, &variances})
      std::fill(sum->begin(), sum->end(), 0.f);
  }
  void add(std::size_t x, const Quad& weight, const Quad& difference, const Quad& variance) {
    const auto add_to = [x](std::vector<float>& sum, const Quad& value) {
      (Quad::load(&sum[x]) + value).store(&sum[x]);
    };
    add_to(weights, weight);
    add_to(squares, weight * weight);
    add_to(moves, weight * difference);
    add_to(variances, weight * variance);
  }
};

/// The filter on an image of inverse depths.
struct Filter {
  std::vector<Offset> offsets;
  Image steepness;  ///< 1 / (2 s^2) of the range width s, m^2
  Image variance;   ///< of the error of each pixel, in shares of the sensor's
  bool symmetric;

  void add_up(const Image& w, std::size_t row, Sums& sums) const {
    const auto y = static_cast<std::ptrdiff_t>(row);
    sums.clear();
    for (const Offset& offset : offsets) {
      const float *centre = w.at(0, y), *factor = steepness.at(0, y);
      const float *a = w.at(offset.dx, y + offset.dy), *b = w.at(-offset.dx, y - offset.dy);
      const float* a_variance = variance.at(offset.dx, y + offset.dy);
      const float* b_variance = variance.at(-offset.dx, y - offset.dy);
      const Quad distance(offset.weight);
      for (std::size_t x = 0; x < w.width; x += kLanes) {
        const Quad own = Quad::load(centre + x), steep = Quad::load(factor + x);
        const Quad da = Quad::load(a + x) - own, db = Quad::load(b + x) - own;
        Quad wa = steep * (da * da), wb = steep * (db * db);
        if (symmetric) {
          wa = wb = distance * exp_of_negative(wa + wb);
        } else {
          wa = distance * exp_of_negative(wa);
          wb = distance * exp_of_negative(wb);
        }
        sums.add(x, wa, da, Quad::load(a_variance + x));
        sums.add(x, wb, db, Quad::load(b_variance + x));
      }
    }
  }
};

/// The part of the variance of a depth camera's noise that a mean of n pixels leaves.
double left_of_variance(double n) {
  const auto left = [n](double share, double blur) {
    return share / (1 + (n - 1) / (4 * std::numbers::pi * blur * blur));
  };
  return kWhiteShare / n + left(kFineShare, kFineBlur) + left(kCoarseShare, kCoarseBlur);
}

/// Runs `body` over the rows of the image.
template <class Body>
bool for_rows(const Context& context, const Image& image, const Body& body) {
  return parallel_for(
      context, image.height,
      [&](IndexRange rows) {
        Sums sums(image.width);
        for (std::size_t y = rows.begin; y < rows.end; ++y) body(y, sums);
      },
      kRowsAtOnce);
}

BilateralDepthReport report_of(const std::vector<float>& before, const DepthFrame& after,
                               int iterations) {
  BilateralDepthReport report{.iterations = iterations};
  double squares = 0, shares = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(before[i] > 0)) continue;
    const double move = std::abs(double{after.depth[i]} - before[i]);
    ++report.pixels;
    squares += move * move;
    shares += after.sigma_share_of(i);
    report.max_move = std::max(report.max_move, move);
  }
  if (report.pixels == 0) return report;
  report.rms_move = std::sqrt(squares / static_cast<double>(report.pixels));
  report.mean_share = shares / static_cast<double>(report.pixels);
  return report;
}

}  // namespace

const Schema<BilateralDepthParams>& BilateralDepthParams::schema() {
  using P = BilateralDepthParams;
  static const auto schema =
      Schema<P>()
          .real("spatial", &P::spatial, between(0.5, 50), "width of the window's Gaussian, pixels")
          .real("range", &P::range, {.low = 0, .high = 1000, .open_low = true},
                "width over depth in standard deviations of the sensor's noise")
          .integer("iterations", &P::iterations, between(0, 1000), "number of passes")
          .flag("symmetric", &P::symmetric,
                "opposite pixels count together, so that tilted surfaces keep their rims");
  return schema;
}

Facts BilateralDepthReport::facts() const {
  return {{"pixels", static_cast<double>(pixels), ""},
          {"rms_move", rms_move, "m"},
          {"max_move", max_move, "m"},
          {"mean_share", mean_share, ""}};
}

Result<BilateralDepthReport> smooth_bilateral_depth(DepthFrame& frame,
                                                    const BilateralDepthParams& params,
                                                    const Context& context) {
  if (auto valid = BilateralDepthParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(frame); !sound) return sound.error();
  if (context.cancelled()) return cancelled();
  const std::size_t width = frame.camera.width, height = frame.camera.height;
  const auto margin = static_cast<std::size_t>(std::ceil(2 * params.spatial));
  Image w(width, height, margin, kNowhere);
  Filter filter{half_window(params.spatial), Image(width, height, margin, 0),
                Image(width, height, margin, 0), params.symmetric};
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double z = frame.depth[i];
    if (!(z > 0)) continue;
    const std::size_t x = i % width, y = i / width;
    const double share = frame.sigma_share_of(i);
    const double s = params.range * frame.noise_share_of(i) * frame.noise.axial(z, 0) / (z * z);
    w.row(y)[x] = static_cast<float>(1 / z);
    filter.variance.row(y)[x] = static_cast<float>(share * share);
    filter.steepness.row(y)[x] = static_cast<float>(std::min<double>(1 / (2 * s * s), kNoWidth));
  }

  Image next = w;
  std::vector<float> sigma_share(frame.depth.size());
  const double own = 1 / (1 + params.range * params.range);
  for (int pass = 0; pass < params.iterations; ++pass) {
    const Context share = context.part(static_cast<double>(pass) / params.iterations,
                                       (pass + 1.0) / params.iterations);
    const bool complete = for_rows(share, w, [&](std::size_t y, Sums& sums) {
      filter.add_up(w, y, sums);
      const float* centre = w.at(0, static_cast<std::ptrdiff_t>(y));
      const float* variance = filter.variance.at(0, static_cast<std::ptrdiff_t>(y));
      for (std::size_t x = 0; x < width; ++x) {
        if (centre[x] == kNowhere) continue;
        const double total = 1 + double{sums.weights[x]};
        next.row(y)[x] = static_cast<float>(centre[x] + sums.moves[x] / total);
        if (pass > 0) continue;
        const double n = total * total / (1 + double{sums.squares[x]});
        const double before = std::sqrt((variance[x] + double{sums.variances[x]}) / total);
        sigma_share[y * width + x] =
            static_cast<float>(before * (own + (1 - own) * std::sqrt(left_of_variance(n))));
      }
    });
    if (!complete) return cancelled();
    std::swap(w, next);
  }

  std::vector<float> before = frame.depth;
  if (params.iterations > 0) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const float now = w.row(i / width)[i % width];
      if (before[i] > 0 && now != static_cast<float>(1 / double{before[i]})) {
        frame.depth[i] = static_cast<float>(1 / double{now});
      }
    }
    frame.sigma_share = std::move(sigma_share);
  }
  context.progress(1);
  return report_of(before, frame, params.iterations);
}

}  // namespace burnish
