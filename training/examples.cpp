#include "examples.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/tangent_frame.h"
#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "implicit_shape.h"

namespace burnish::training {
namespace {

TriangleMesh regular_shape(Random& random) {
  const int size = 20 + static_cast<int>(random.below(30));
  switch (random.below(5)) {
    case 0: {
      const double x = random.uniform(0.5, 1.5), y = random.uniform(0.5, 1.5);
      return make_box({x, y, random.uniform(0.5, 1.5)}, size);
    }
    case 1:
      return make_sphere(1, 5);
    case 2:
      return make_torus(1, random.uniform(0.2, 0.6), 3 * size, size);
    case 3:
      return make_cylinder(random.uniform(0.4, 1), 2, 3 * size, size / 2);
    default:
      return make_uv_sphere(1, 2 * size, size);
  }
}

TriangleMesh clean_shape(Random& random) {
  if (random.below(5) == 0) return regular_shape(random);
  const SolidPtr solid = random_solid(random);
  return surface_of(*solid, random.uniform(0.018, 0.035), random);
}

TriangleMesh with_white_noise(const TriangleMesh& clean, Random& random) {
  TriangleMesh noisy = clean;
  const double sigma = random.uniform(0.05, 0.8) * mean_edge_length(clean);
  const std::vector<Vec3f> normals = vertex_normals(clean);
  const std::uint64_t kind = random.below(4);
  for (std::size_t v = 0; v < clean.positions.size(); ++v) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const double chance = random.uniform();
    Vec3d move = kind == 0 ? 0.7 * Vec3d{x, y, z} : x * Vec3d(normals[v]);
    if (kind == 1) move = chance < 0.3 ? 1.5 * move : 0.1 * move;
    noisy.positions[v] = Vec3f(Vec3d(clean.positions[v]) + sigma * move);
  }
  return noisy;
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

/// What a camera of `width` x `height` pixels sees of the solid; empty where it sees nothing.
Example camera_view(const Solid& solid, Random& random) {
  constexpr int kWidth = 150, kHeight = 130;
  constexpr double kFocal = 170, kDistance = 2.4;
  const double dx = random.normal(), dy = random.normal(), dz = random.normal();
  const TangentFrame camera(normalized(Vec3d{dx, dy, dz}));
  const Vec3d eye = -kDistance * camera.normal;
  std::vector<double> range(kWidth * kHeight, 0);
  std::vector<Vec3d> rays(range.size());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y * kWidth + x);
      rays[pixel] = normalized(camera.normal + ((x - kWidth / 2) / kFocal) * camera.u +
                               ((y - kHeight / 2) / kFocal) * camera.v);
      double t = 0.8;
      for (int i = 0; i < 120 && t < 4; ++i) {
        const double f = solid.at(eye + t * rays[pixel]).f;
        if (std::abs(f) < 1e-6) {
          range[pixel] = t;
          break;
        }
        t += 0.6 * f;
      }
    }
  }
  const auto white = blurred(kWidth, kHeight, 0, random);
  const auto near = blurred(kWidth, kHeight, 1, random);
  const auto wide = blurred(kWidth, kHeight, 5, random);
  const double pixel_size = kDistance / kFocal;
  const double sigma = random.uniform(0.15, 1.3) * pixel_size;
  const double step = random.below(2) == 0 ? 0 : random.uniform(0.2, 0.8) * sigma;
  Example example;
  std::vector<std::uint32_t> index(range.size(), ~0u);
  for (std::size_t i = 0; i < range.size(); ++i) {
    if (range[i] == 0) continue;
    index[i] = static_cast<std::uint32_t>(example.clean.positions.size());
    example.clean.positions.push_back(Vec3f(eye + range[i] * rays[i]));
    double noisy = range[i] + sigma * (0.5 * white[i] + 0.7071 * near[i] + 0.5 * wide[i]);
    if (step > 0) noisy = step * std::round(noisy / step);
    example.noisy.positions.push_back(Vec3f(eye + noisy * rays[i]));
  }
  const double jump = 6 * pixel_size + 3 * sigma;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c}) {
      if (index[i] == ~0u) return;
    }
    const double low = std::min({range[a], range[b], range[c]});
    if (std::max({range[a], range[b], range[c]}) - low > jump) return;
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

}  // namespace

std::vector<Example> white_examples(int count, std::uint64_t seed) {
  std::vector<Example> examples;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    Example example;
    example.clean = clean_shape(random);
    example.noisy = with_white_noise(example.clean, random);
    examples.push_back(std::move(example));
  }
  return examples;
}

std::vector<Example> camera_examples(int count, std::uint64_t seed) {
  std::vector<Example> examples;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const SolidPtr solid = random_solid(random);
    Example example = camera_view(*solid, random);
    if (example.clean.triangles.size() > 500) examples.push_back(std::move(example));
  }
  return examples;
}

}  // namespace burnish::training
