#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/base/tangent_frame.h"
#include "burnish/points/merge_cells.h"
#include "burnish/points/organized_normals.h"
#include "burnish/triangulation/global.h"
#include "examples.h"
#include "implicit_shape.h"

namespace burnish::training {
namespace {

constexpr int kWidth = 150, kHeight = 130;
constexpr double kFocal = 170, kDistance = 2.4, kPixel = kDistance / kFocal;

/// A camera's noise along its rays.
struct RayNoise {
  double sigma = 0;
  double step = 0;  ///< to which it rounds; 0: not
};

RayNoise random_noise(Random& random) {
  RayNoise noise;
  noise.sigma = kPixel * 0.12 * std::pow(12, random.uniform());
  switch (random.below(4)) {
    case 0:
      noise.step = random.uniform(0.2, 0.8) * noise.sigma;
      break;
    case 1:  // far away a step is longer than the noise
      noise.step = random.uniform(0.8, 3) * noise.sigma;
      break;
    default:
      break;
  }
  return noise;
}

/// Independent numbers blurred over a grid of pixels, of unit variance.
std::vector<double> blurred(int width, int height, double blur, Random& random) {
  const int reach = static_cast<int>(std::ceil(2.5 * blur));
  std::vector<double> kernel;
  double squares = 0;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(blur > 0 ? std::exp(-i * i / (2 * blur * blur)) : 1);
    squares += kernel.back() * kernel.back();
  }
  std::vector<double> white(static_cast<std::size_t>(width * height)), rows(white), out(white);
  for (double& w : white) w = random.normal();
  const auto convolve = [&](const std::vector<double>& from, std::vector<double>& to, int dx,
                            int dy) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int i = -reach; i <= reach; ++i) {
          const int u = std::clamp(x + i * dx, 0, width - 1),
                    v = std::clamp(y + i * dy, 0, height - 1);
          sum += kernel[static_cast<std::size_t>(i + reach)] *
                 from[static_cast<std::size_t>(v * width + u)];
        }
        to[static_cast<std::size_t>(y * width + x)] = sum / std::sqrt(squares);
      }
    }
  };
  convolve(white, rows, 1, 0);
  convolve(rows, out, 0, 1);
  return out;
}

/// What one camera sees of a solid, pixel by pixel.
struct View {
  Vec3d eye;
  std::vector<Vec3d> rays;
  std::vector<double> range, noisy;  ///< along the ray; 0: nothing
};

View look_at(const Solid& solid, const Vec3d& direction, const RayNoise& noise, Random& random) {
  const TangentFrame camera(direction);
  constexpr std::size_t kPixels = kWidth * kHeight;
  View view{-kDistance * camera.normal, std::vector<Vec3d>(kPixels), {}, {}};
  view.range.resize(kPixels, 0);
  view.noisy.resize(kPixels, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto pixel = static_cast<std::size_t>(y * kWidth + x);
      view.rays[pixel] = normalized(camera.normal + ((x - kWidth / 2) / kFocal) * camera.u +
                                    ((y - kHeight / 2) / kFocal) * camera.v);
      double t = 0.8;
      for (int i = 0; i < 120 && t < 4; ++i) {
        const double f = solid.at(view.eye + t * view.rays[pixel]).f;
        if (std::abs(f) < 1e-6) {
          view.range[pixel] = t;
          break;
        }
        t += 0.6 * f;
      }
    }
  }
  const auto white = blurred(kWidth, kHeight, 0, random);
  const auto near = blurred(kWidth, kHeight, 1, random);
  const auto wide = blurred(kWidth, kHeight, 5, random);
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (view.range[i] == 0) continue;
    double t = view.range[i] + noise.sigma * (0.5 * white[i] + 0.7071 * near[i] + 0.5 * wide[i]);
    if (noise.step > 0) t = noise.step * std::round(t / noise.step);
    view.noisy[i] = t;
  }
  return view;
}

/// One picture, its pixels joined where there is no jump between them.
Example one_view(const Solid& solid, Random& random) {
  const RayNoise noise = random_noise(random);
  const View view = look_at(solid, random_direction(random), noise, random);
  Example example;
  std::vector<std::uint32_t> index(view.range.size(), ~0u);
  for (std::size_t i = 0; i < view.range.size(); ++i) {
    if (view.range[i] == 0) continue;
    index[i] = static_cast<std::uint32_t>(example.clean.positions.size());
    example.clean.positions.push_back(Vec3f(view.eye + view.range[i] * view.rays[i]));
    example.noisy.positions.push_back(Vec3f(view.eye + view.noisy[i] * view.rays[i]));
  }
  const double jump = 6 * kPixel + 3 * noise.sigma + noise.step;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c}) {
      if (index[i] == ~0u) return;
    }
    const auto [low, high] = std::minmax({view.range[a], view.range[b], view.range[c]});
    if (high - low > jump) return;
    example.clean.triangles.push_back({index[a], index[b], index[c]});
  };
  for (std::size_t y = 0; y + 1 < kHeight; ++y) {
    for (std::size_t x = 0; x + 1 < kWidth; ++x) {
      const std::size_t i = y * kWidth + x;
      if ((x + y) % 2 == 0) {
        add(i, i + kWidth, i + 1);
        add(i + 1, i + kWidth, i + kWidth + 1);
      } else {
        add(i, i + kWidth, i + kWidth + 1);
        add(i, i + kWidth + 1, i + 1);
      }
    }
  }
  example.noisy.triangles = example.clean.triangles;
  return example;
}

PointCloud cloud_of(const View& view, const RayNoise& noise) {
  PointCloud cloud;
  cloud.grid = GridSize{kWidth, kHeight};
  cloud.viewpoint = view.eye;
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < view.range.size(); ++i) {
    cloud.positions.push_back(view.range[i] == 0 ? Vec3f{kMissing, kMissing, kMissing}
                                                 : Vec3f(view.eye + view.noisy[i] * view.rays[i]));
  }
  const auto sigma = static_cast<float>(std::hypot(noise.sigma, 0.29 * noise.step));
  cloud.attributes.sigma.assign(view.range.size(), sigma);
  const ProjectiveGrid grid = project_grid(cloud);
  (void)organized_normals(grid, depth_noise(grid, cloud.attributes.sigma), 0, {},
                          cloud.attributes.normals);
  return cloud;
}

/// Several pictures from around, merged; empty where that fails.
Example several_views(const Solid& solid, Random& random) {
  const RayNoise noise = random_noise(random);
  const std::uint64_t count = 6 + random.below(10);
  std::vector<PointCloud> clouds;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3d direction = random_direction(random);
    clouds.push_back(cloud_of(look_at(solid, direction, noise, random), noise));
  }
  const auto merged = merge_cells(clouds);
  if (!merged) return {};
  const auto surface = triangulate_global(merged->cloud);
  if (!surface) return {};
  Example example{surface->mesh, surface->mesh};
  for (Vec3f& p : example.clean.positions) p = Vec3f(nearest_on(solid, Vec3d(p)));
  example.noisy.attributes = {};
  example.clean.attributes = {};
  return example;
}

}  // namespace

std::vector<Example> camera_examples(int count, std::uint64_t seed) {
  std::vector<Example> examples;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const SolidPtr solid = random_solid(random);
    Example example =
        random.below(3) == 0 ? several_views(*solid, random) : one_view(*solid, random);
    if (example.clean.triangles.size() > 500) examples.push_back(std::move(example));
  }
  return examples;
}

}  // namespace burnish::training
