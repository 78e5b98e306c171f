#include "burnish/points/organized_normals.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

using Pixel = ProjectiveGrid::Pixel;

constexpr std::size_t kRowsAtOnce = 8;
constexpr int kLargestRadius = 8;
constexpr double kSlopeDeviation = 0.052;  // 3 degrees

/// Sums over a set of pixels from which the plane through them follows.
struct Moments {
  double n = 0, u = 0, v = 0, w = 0, uu = 0, uv = 0, vv = 0, uw = 0, vw = 0;

  void add(const Pixel& p) {
    n += 1, u += p.u, v += p.v, w += p.w;
    uu += p.u * p.u, uv += p.u * p.v, vv += p.v * p.v, uw += p.u * p.w, vw += p.v * p.w;
  }
  Moments& operator+=(const Moments& b) {
    n += b.n, u += b.u, v += b.v, w += b.w;
    uu += b.uu, uv += b.uv, vv += b.vv, uw += b.uw, vw += b.vw;
    return *this;
  }
  friend Moments operator-(const Moments& a, const Moments& b) {
    return {a.n - b.n,   a.u - b.u,   a.v - b.v,   a.w - b.w,  a.uu - b.uu,
            a.uv - b.uv, a.vv - b.vv, a.uw - b.uw, a.vw - b.vw};
  }
};

/// The normal towards the viewpoint of the plane w = a u + b v + c through the pixels, in view
/// axes.
Vec3d plane_normal(const Moments& m) {
  if (m.n < 2.5) return {};
  const double u = m.u / m.n, v = m.v / m.n, w = m.w / m.n;
  const double uu = m.uu / m.n - u * u, uv = m.uv / m.n - u * v, vv = m.vv / m.n - v * v;
  const double uw = m.uw / m.n - u * w, vw = m.vw / m.n - v * w;
  const double determinant = uu * vv - uv * uv;
  // A line of pixels has no second direction; what rounding leaves of it is 1e-6 of the first.
  if (!(determinant > 1e-4 * (uu + vv) * (uu + vv))) return {};
  const double a = (uw * vv - vw * uv) / determinant;
  const double b = (vw * uu - uw * uv) / determinant;
  return normalized(Vec3d{-a, -b, -(w - a * u - b * v)});
}

/// The smallest window whose plane has a slope known to kSlopeDeviation, for a pixel of pitch
/// `pitch` (m) and depth noise `noise` (m): slope variance = noise^2 / (pitch^2 sum of squares).
int radius_for(double noise, double pitch) {
  const double needed = noise / (pitch * kSlopeDeviation);
  for (int r = 1; r < kLargestRadius; ++r) {
    const double side = 2 * r + 1;
    if (side * side * r * (r + 1) / 3 >= needed * needed) return r;
  }
  return kLargestRadius;
}

/// What the windows of one grid are made of.
struct Windows {
  const ProjectiveGrid& grid;
  std::span<const float> noise;
  std::vector<std::uint8_t> radius;  ///< per pixel
  std::vector<Moments> rows;         ///< per pixel, over its own row's part of the window

  bool joined(std::size_t i, std::size_t j) const {
    return same_surface(grid.pixels[i], grid.pixels[j], std::max(noise[i], noise[j]));
  }

  /// `rows` for one row of the grid.
  void gather_row(std::size_t row) {
    const std::size_t width = grid.size.width, begin = row * width;
    std::vector<Moments> prefix(width + 1);
    std::vector<std::uint32_t> first(width), last(width);  // of the run without a jump
    for (std::size_t c = 0; c < width; ++c) {
      prefix[c + 1] = prefix[c];
      if (grid.pixels[begin + c].w > 0) prefix[c + 1].add(grid.pixels[begin + c]);
      const bool runs_on = c > 0 && joined(begin + c - 1, begin + c);
      first[c] = runs_on ? first[c - 1] : static_cast<std::uint32_t>(c);
    }
    for (std::size_t c = width; c-- > 0;) {
      const bool runs_on = c + 1 < width && first[c + 1] != c + 1;
      last[c] = runs_on ? last[c + 1] : static_cast<std::uint32_t>(c);
    }
    for (std::size_t c = 0; c < width; ++c) {
      if (!(grid.pixels[begin + c].w > 0)) continue;
      const std::size_t r = radius[begin + c];
      const std::size_t from = std::max<std::size_t>(first[c], c > r ? c - r : 0);
      const std::size_t to = std::min<std::size_t>(last[c], c + r);
      rows[begin + c] = prefix[to + 1] - prefix[from];
    }
  }

  /// Over the whole window of pixel i.
  Moments gather_window(std::size_t i) const {
    const std::size_t width = grid.size.width, count = grid.pixels.size();
    Moments sum = rows[i];
    std::size_t at = i;
    for (int step = 0; step < radius[i] && at >= width && joined(at, at - width); ++step) {
      sum += rows[at -= width];
    }
    at = i;
    for (int step = 0; step < radius[i] && at + width < count && joined(at, at + width); ++step) {
      sum += rows[at += width];
    }
    return sum;
  }
};

}  // namespace

Vec3d viewpoint_or_origin(const PointCloud& cloud) {
  return cloud.viewpoint.value_or(Vec3d{}) - cloud.frame.origin;
}

ProjectiveGrid project_grid(const PointCloud& cloud) {
  ProjectiveGrid grid;
  grid.size = *cloud.grid;
  const Vec3d eye = viewpoint_or_origin(cloud);
  Vec3d forward;
  for (const Vec3f& p : cloud.positions) {
    if (is_finite(p)) forward += normalized(Vec3d(p) - eye);
  }
  if (squared_norm(forward) > 0) {
    const Vec3d up = std::abs(forward.y) < 0.9 * norm(forward) ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    grid.T_cloud_view = look_at(eye, eye + normalized(forward), up);
  }
  const RigidTransform T_view_cloud = grid.T_cloud_view.inverse();
  grid.pixels.resize(cloud.positions.size());
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (!is_finite(cloud.positions[i])) continue;
    const Vec3d p = T_view_cloud(Vec3d(cloud.positions[i]));
    if (p.z > 0) grid.pixels[i] = {p.x / p.z, p.y / p.z, 1 / p.z};
  }
  return grid;
}

double pixel_pitch(const ProjectiveGrid& grid) {
  std::vector<double> pitches;
  for (std::size_t i = 0; i + 1 < grid.pixels.size(); ++i) {
    const Pixel &a = grid.pixels[i], &b = grid.pixels[i + 1];
    if ((i + 1) % grid.size.width == 0 || !(a.w > 0 && b.w > 0)) continue;
    const Vec3d d{a.u, a.v, 1}, e{b.u, b.v, 1};
    pitches.push_back(norm(cross(d, e)) / (norm(d) * norm(e)));
  }
  if (pitches.empty()) return 0;
  const auto middle = pitches.begin() + static_cast<std::ptrdiff_t>(pitches.size() / 2);
  std::nth_element(pitches.begin(), middle, pitches.end());
  return *middle;
}

std::vector<float> depth_noise(const ProjectiveGrid& grid, std::span<const float> sigma) {
  if (!sigma.empty()) return {sigma.begin(), sigma.end()};
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < grid.pixels.size(); ++i) {
    const Pixel &a = grid.pixels[i - 1], &b = grid.pixels[i], &c = grid.pixels[i + 1];
    const std::size_t column = i % grid.size.width;
    if (column == 0 || column + 1 == grid.size.width || !(a.w > 0 && b.w > 0 && c.w > 0)) continue;
    bends.push_back(std::abs(a.w - 2 * b.w + c.w));
  }
  std::vector<float> noise(grid.pixels.size());
  if (bends.empty()) return noise;
  // The 68 % quantile is one standard deviation of a normal distribution and, other than the
  // median, not 0 where most depths are quantised to the same step. A second difference of white
  // noise has six times its variance; neighbouring pixels of real cameras share about half of
  // theirs.
  const auto place = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() * 68 / 100);
  std::nth_element(bends.begin(), place, bends.end());
  const double noise_w = *place / std::sqrt(6 * 0.5);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double w = grid.pixels[i].w;
    if (w > 0) noise[i] = static_cast<float>(noise_w / (w * w));
  }
  return noise;
}

bool organized_normals(const ProjectiveGrid& grid, std::span<const float> noise, int radius,
                       const Context& context, std::vector<Vec3f>& normals) {
  const std::size_t count = grid.pixels.size(), width = grid.size.width;
  Windows windows{grid, noise, std::vector<std::uint8_t>(count), std::vector<Moments>(count)};
  const double pitch = pixel_pitch(grid);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(grid.pixels[i].w > 0)) continue;
    windows.radius[i] = static_cast<std::uint8_t>(
        radius > 0 ? radius : radius_for(noise[i], pitch / grid.pixels[i].w));
  }
  normals.assign(count, Vec3f{});
  const auto for_rows = [&](const Context& part, const auto& body) {
    return parallel_for(
        part, grid.size.height,
        [&](IndexRange range) {
          for (std::size_t row = range.begin; row < range.end; ++row) body(row);
        },
        kRowsAtOnce);
  };
  return for_rows(context.part(0, 0.5), [&](std::size_t row) { windows.gather_row(row); }) &&
         for_rows(context.part(0.5, 1), [&](std::size_t row) {
           for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
             if (!(grid.pixels[i].w > 0)) continue;
             const Vec3d normal = plane_normal(windows.gather_window(i));
             normals[i] = Vec3f(grid.T_cloud_view.rotate(normal));
           }
         });
}

}  // namespace burnish
