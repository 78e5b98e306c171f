#include "burnish/points/remove_flying_pixels.h"

#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/core/disjoint_sets.h"
#include "burnish/points/missing.h"
#include "burnish/points/organized_normals.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// The grid and what is known to be wrong with it.
struct Pixels {
  const ProjectiveGrid& grid;
  const std::vector<float>& noise;
  std::vector<std::uint8_t>& removed;

  bool there(std::size_t i) const { return grid.pixels[i].w > 0 && !removed[i]; }
  bool joined(std::size_t i, std::size_t j) const {
    return same_surface(grid.pixels[i], grid.pixels[j], std::max(noise[i], noise[j]));
  }
  /// -1: j lies nearer than i by a jump, 1: farther, 0: neither or missing.
  int jump(std::size_t i, std::size_t j) const {
    if (!(grid.pixels[j].w > 0) || joined(i, j)) return 0;
    return grid.pixels[j].w > grid.pixels[i].w ? -1 : 1;
  }
};

/// Whether pixel i, at (column, row), lies between two surfaces.
bool between(const Pixels& pixels, std::size_t i, std::size_t column, std::size_t row) {
  const std::size_t width = pixels.grid.size.width;
  const bool inner_column = column > 0 && column + 1 < width;
  const bool inner_row = row > 0 && row + 1 < pixels.grid.size.height;
  const auto across = [&](std::size_t step) {
    return pixels.jump(i, i - step) * pixels.jump(i, i + step) < 0;
  };
  return (inner_column && across(1)) || (inner_row && across(width)) ||
         (inner_column && inner_row && (across(width - 1) || across(width + 1)));
}

/// Whether point i is seen at an angle whose cosine is below `least`.
bool grazing(const PointCloud& cloud, const Vec3d& eye, std::size_t i, double least) {
  const Vec3d n(cloud.attributes.normals[i]);
  const Vec3d ray = Vec3d(cloud.positions[i]) - eye;
  return squared_norm(n) > 0 && std::abs(dot(n, ray)) < least * norm(ray) * norm(n);
}

/// Marks the patches of fewer than `least` pixels.
void mark_small_patches(Pixels& pixels, int least) {
  const std::size_t count = pixels.grid.pixels.size(), width = pixels.grid.size.width;
  DisjointSets patches(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!pixels.there(i)) continue;
    const auto unite = [&](std::size_t j) {
      if (pixels.there(j) && pixels.joined(i, j)) {
        patches.unite(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      }
    };
    if ((i + 1) % width != 0) unite(i + 1);
    if (i + width < count) unite(i + width);
  }
  std::vector<int> sizes(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (pixels.there(i)) ++sizes[patches.find(static_cast<std::uint32_t>(i))];
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (pixels.there(i) && sizes[patches.find(static_cast<std::uint32_t>(i))] < least) {
      pixels.removed[i] = 1;
    }
  }
}

}  // namespace

const Schema<FlyingPixelParams>& FlyingPixelParams::schema() {
  using P = FlyingPixelParams;
  static const auto schema = Schema<P>()
                                 .real("max_angle", &P::max_angle, between(0, std::numbers::pi / 2),
                                       "largest angle between ray and normal", Quantity::angle)
                                 .integer("min_patch", &P::min_patch, between(0, 1000000000),
                                          "pixels of the smallest patch that stays");
  return schema;
}

Result<CleaningReport> remove_flying_pixels(PointCloud& cloud, const FlyingPixelParams& params,
                                            const Context& context) {
  if (auto valid = FlyingPixelParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();
  if (!cloud.grid) {
    return Error{ErrorCode::bad_geometry,
                 "the cloud is not organized: it has no image grid to find flying pixels in",
                 {}};
  }
  const ProjectiveGrid grid = project_grid(cloud);
  const std::vector<float> noise = depth_noise(grid, cloud.attributes.sigma);
  const bool has_normals = !cloud.attributes.normals.empty();
  const double least_cosine = std::cos(params.max_angle);
  const Vec3d eye = viewpoint_or_origin(cloud);

  std::vector<std::uint8_t> removed(cloud.positions.size());
  Pixels pixels{grid, noise, removed};
  const bool complete = parallel_for(
      context.part(0, 0.8), grid.size.height,
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          for (std::size_t column = 0; column < grid.size.width; ++column) {
            const std::size_t i = row * grid.size.width + column;
            if (!(grid.pixels[i].w > 0)) continue;
            removed[i] = between(pixels, i, column, row) ||
                         (has_normals && grazing(cloud, eye, i, least_cosine));
          }
        }
      },
      kRowsAtOnce);
  if (!complete) return cancelled();
  mark_small_patches(pixels, params.min_patch);
  if (context.cancelled()) return cancelled();
  context.progress(1);
  return take_out(cloud, removed);
}

}  // namespace burnish
