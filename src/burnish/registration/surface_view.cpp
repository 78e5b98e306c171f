#include "burnish/registration/surface_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 16;
constexpr float kSteepest = 5.67f;  // tan 80 degrees
constexpr double kLeastCosine = 0.1736;
constexpr float kSlopeChange = 0.5f;  // that a smooth surface has within a window

/// Slopes of w = 1/z along rows and columns, per pixel, with 1 where there is one and 0 where not.
struct Slopes {
  std::size_t width, height;
  std::vector<float> w;      ///< 1/m; 0: missing
  std::vector<float> error;  ///< standard deviation of z, m
  std::vector<float> along_row, has_row, along_column, has_column;

  Slopes(const Camera& camera)
      : width(camera.width),
        height(camera.height),
        w(width * height),
        error(width * height),
        along_row(width * height),
        has_row(width * height),
        along_column(width * height),
        has_column(width * height) {}

  /// The central difference per pixel at i, where i - reach and i + reach lie on one surface with
  /// i; `pitch`: tangent of the angle between i and these.
  bool slope(std::size_t i, std::size_t reach, float steps, float pitch, float& result) const {
    const float a = w[i - reach], b = w[i], c = w[i + reach];
    if (!(a > 0 && b > 0 && c > 0)) return false;
    // Differences of depth are those of w times z^2; the distance across the view is pitch z.
    const float noise = error[i] * b * b, across = pitch * b;
    if (std::abs(a - 2 * b + c) > 6 * noise + kSlopeChange * across) return false;
    if (std::abs(a - c) > 4 * noise + 2 * kSteepest * across) return false;
    result = (c - a) / (2 * steps);
    return true;
  }

  void gather_row(std::size_t row, std::size_t window, const Camera& camera) {
    const float steps = static_cast<float>(window);
    const float pitch_x = steps / static_cast<float>(camera.fx);
    const float pitch_y = steps / static_cast<float>(camera.fy);
    const bool inside = row >= window && row + window < height;
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = row * width + column;
      const bool in_row = column >= window && column + window < width;
      const bool x = in_row && slope(i, window, steps, pitch_x, along_row[i]);
      const bool y = inside && slope(i, window * width, steps, pitch_y, along_column[i]);
      if (!x) along_row[i] = 0;
      if (!y) along_column[i] = 0;
      has_row[i] = x ? 1.0f : 0.0f;
      has_column[i] = y ? 1.0f : 0.0f;
    }
  }
};

/// Sums of one row of the slopes over the windows: of those along rows over the rows beside, of
/// those along columns over the columns beside.
struct WindowSums {
  std::vector<float> x, x_count, y, y_count;

  void gather(const Slopes& slopes, std::size_t row, std::size_t window) {
    const std::size_t width = slopes.width;
    for (auto* sums : {&x, &x_count, &y, &y_count}) sums->assign(width, 0);
    const std::size_t first = row > window ? row - window : 0;
    const std::size_t last = std::min(slopes.height - 1, row + window);
    for (std::size_t r = first; r <= last; ++r) {
      const float* slope = slopes.along_row.data() + r * width;
      const float* has = slopes.has_row.data() + r * width;
      for (std::size_t c = 0; c < width; ++c) x[c] += slope[c];
      for (std::size_t c = 0; c < width; ++c) x_count[c] += has[c];
    }
    if (width <= 2 * window) return;
    const std::size_t inner = width - 2 * window;
    for (std::size_t shift = 0; shift <= 2 * window; ++shift) {
      const float* slope = slopes.along_column.data() + row * width + shift;
      const float* has = slopes.has_column.data() + row * width + shift;
      for (std::size_t c = 0; c < inner; ++c) y[c + window] += slope[c];
      for (std::size_t c = 0; c < inner; ++c) y_count[c + window] += has[c];
    }
  }
};

/// The deviation along the ray of a pixel seen under an angle of cosine `cosine`; the arc cosine
/// only where the noise depends on it.
double axial(const DepthNoise& noise, double z, double cosine, double grazing_cosine) {
  const bool grazing = noise.grazing != 0 && cosine < grazing_cosine;
  return noise.axial(z, grazing ? std::acos(cosine) : 0);
}

double square(double x) {
  return x * x;
}

struct ViewBuilder {
  const DepthFrame& frame;
  const SurfaceViewParams& params;
  Slopes slopes;
  double grazing_cosine;

  ViewBuilder(const DepthFrame& f, const SurfaceViewParams& p)
      : frame(f), params(p), slopes(f.camera), grazing_cosine(std::cos(f.noise.grazing_from)) {}

  void gather_depth(std::size_t i) {
    const DepthNoise& noise = frame.noise;
    const double z = frame.depth[i];
    const bool measured =
        z > 0 && z >= noise.min_depth && (noise.max_depth == 0 || z <= noise.max_depth);
    slopes.w[i] = measured ? static_cast<float>(1 / z) : 0.0f;
    slopes.error[i] =
        measured ? static_cast<float>(frame.sigma_share_of(i) * noise.axial(z, 0)) : 0.0f;
  }

  /// Position, normal and errors of pixel i, whose slopes' sums are at `column` of `sums`.
  SurfacePixel pixel(std::size_t i, std::size_t column, std::size_t row,
                     const WindowSums& sums) const {
    SurfacePixel result;
    if (!(slopes.w[i] > 0)) return result;
    const Camera& camera = frame.camera;
    const double z = frame.depth[i], w = 1 / z;
    const double u = (static_cast<double>(column) - camera.cx) / camera.fx;
    const double v = (static_cast<double>(row) - camera.cy) / camera.fy;
    result.position = {static_cast<float>(u * z), static_cast<float>(v * z), frame.depth[i]};
    if (slopes.has_row[i] == 0 || slopes.has_column[i] == 0) return result;
    // The plane w = a u + b v + c has the normal (a, b, c).
    const double a = camera.fx * sums.x[column] / sums.x_count[column];
    const double b = camera.fy * sums.y[column] / sums.y_count[column];
    const Vec3d normal{-a, -b, a * u + b * v - w};
    const double length = norm(normal);
    const double cosine = std::min(1.0, w / (length * std::sqrt(u * u + v * v + 1)));
    if (cosine < kLeastCosine) return result;
    result.normal = Vec3f(normal / length);
    const double error = axial(frame.noise, z, cosine, grazing_cosine);
    result.sigma = static_cast<float>(frame.sigma_share_of(i) * error * cosine);
    result.bias = static_cast<float>(params.distortion * z * z * cosine);
    return result;
  }
};

}  // namespace

const Schema<SurfaceViewParams>& SurfaceViewParams::schema() {
  using P = SurfaceViewParams;
  static const auto schema = Schema<P>()
                                 .integer("window", &P::window, between(1, 32),
                                          "radius of the window that normals come from, pixels")
                                 .real("distortion", &P::distortion, at_least(0),
                                       "systematic error of one over the depth, 1/m");
  return schema;
}

Result<void> surface_view_into(const DepthFrame& frame, const SurfaceViewParams& params,
                               const Context& context, SurfaceView& view) {
  if (auto valid = SurfaceViewParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(frame); !sound) return sound.error();
  view.camera = frame.camera;
  view.pixels.resize(frame.depth.size());
  view.normal_pixels = 2 * square(2 * params.window + 1);
  ViewBuilder builder(frame, params);
  const std::size_t width = frame.camera.width, height = frame.camera.height;
  const auto window = static_cast<std::size_t>(params.window);
  const auto for_rows = [&](double begin, double end, const auto& body) {
    return parallel_for(context.part(begin, end), height, body, kRowsAtOnce);
  };
  const bool complete =
      for_rows(0, 0.2,
               [&](IndexRange rows) {
                 for (std::size_t i = rows.begin * width; i < rows.end * width; ++i) {
                   builder.gather_depth(i);
                 }
               }) &&
      for_rows(0.2, 0.5,
               [&](IndexRange rows) {
                 for (std::size_t row = rows.begin; row < rows.end; ++row) {
                   builder.slopes.gather_row(row, window, frame.camera);
                 }
               }) &&
      for_rows(0.5, 1, [&](IndexRange rows) {
        WindowSums sums;
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          sums.gather(builder.slopes, row, window);
          for (std::size_t c = 0; c < width; ++c) {
            view.pixels[row * width + c] = builder.pixel(row * width + c, c, row, sums);
          }
        }
      });
  return complete ? Result<void>() : Result<void>(cancelled());
}

Result<SurfaceView> surface_view(const DepthFrame& frame, const SurfaceViewParams& params,
                                 const Context& context) {
  SurfaceView view;
  if (auto made = surface_view_into(frame, params, context, view); !made) return made.error();
  return view;
}

Result<void> check(const SurfaceView& view) {
  if (auto camera = check(view.camera); !camera) {
    return Error{ErrorCode::bad_geometry, camera.error().message, {}};
  }
  if (view.pixels.size() == std::size_t{view.camera.width} * view.camera.height) return {};
  return Error{ErrorCode::bad_geometry,
               fmt::format("{} pixels of a view of {} x {}", view.pixels.size(), view.camera.width,
                           view.camera.height),
               {}};
}

}  // namespace burnish
