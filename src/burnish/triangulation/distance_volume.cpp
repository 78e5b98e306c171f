#include "burnish/triangulation/distance_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr int kSide = VoxelBlock::kSide;
constexpr int kCellPixels = 8;
constexpr float kWeightSteps = 256, kDistanceSteps = 256;
constexpr double kMostReach = 60;  // voxels: the sums hold 64
constexpr double kMargin = 1.0;    // voxels around what a pixel tells of that are to be there, too
constexpr std::uint32_t kMostFrames = 0xffff;
constexpr double kFarthestBlock = 1 << 30;

/// std::floor without a call, for numbers that fit.
std::int32_t floor_of(double x) {
  const auto whole = static_cast<std::int32_t>(x);
  return whole - (x < whole);
}

/// How far from the world's origin something in the frame may lie at most, m.
double farthest_point(const DepthFrame& frame) {
  const Camera& camera = frame.camera;
  const double deepest = *std::max_element(frame.depth.begin(), frame.depth.end());
  const double wide = (camera.width + std::abs(camera.cx)) / camera.fx;
  const double high = (camera.height + std::abs(camera.cy)) / camera.fy;
  return norm(frame.T_world_camera.translation) + deepest * (1 + wide + high);
}

/// What was asked for last: neighbouring pixels ask for the same blocks.
class RecentPlaces {
 public:
  /// Whether the place is among them; it is from now on.
  bool holds(const BlockPlace& place) {
    const auto mixed = static_cast<std::uint32_t>(place.x) +
                       3 * static_cast<std::uint32_t>(place.y) +
                       9 * static_cast<std::uint32_t>(place.z);
    Entry& entry = entries_[mixed % entries_.size()];
    if (entry.used && entry.place == place) return true;
    entry = {place, true};
    return false;
  }

 private:
  struct Entry {
    BlockPlace place;
    bool used = false;
  };
  std::array<Entry, 64> entries_{};
};

}  // namespace

/// Where a frame was taken from.
struct DistanceVolume::Sight {
  const Camera& camera;
  const RigidTransform& T_world_camera;
  RigidTransform T_camera_world;
};

DistanceVolume::DistanceVolume(double voxel, const Truncation& truncation)
    : voxel_(voxel), truncation_(truncation) {}

Result<void> DistanceVolume::allocate(const DepthFrame& frame, const Context& context) {
  return see(frame, context);
}

/// Builds the planes of a frame, and the blocks that they reach.
Result<void> DistanceVolume::see(const DepthFrame& frame, const Context& context) {
  if (auto sound = check(frame); !sound) return sound;
  const DepthPlanes::Measure measure{voxel_, truncation_.voxels * voxel_, truncation_.sigmas,
                                     kMostReach * voxel_};
  if (!planes_.build(frame, measure, context.part(0, 0.5))) return cancelled();

  const Camera& camera = frame.camera;
  if (!(farthest_point(frame) < kFarthestBlock * kSide * voxel_)) {
    return Error{
        ErrorCode::invalid_argument,
        fmt::format("voxels of {} m are too small for points as far from the origin as {} m",
                    voxel_, farthest_point(frame)),
        {}};
  }
  const Sight sight{camera, frame.T_world_camera, frame.T_world_camera.inverse()};
  cell_columns_ = (camera.width + kCellPixels - 1) / kCellPixels;
  cell_rows_ = (camera.height + kCellPixels - 1) / kCellPixels;
  ends_.assign(cell_columns_ * cell_rows_, 0);
  std::vector<std::vector<BlockPlace>> missing(cell_rows_);
  const bool complete = parallel_for(
      context.part(0.5, 1), cell_rows_,
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          for (std::size_t column = 0; column < cell_columns_; ++column) {
            gather_cell(sight, column, row, missing[row]);
          }
        }
      },
      4);
  if (!complete) return cancelled();
  for (const std::vector<BlockPlace>& places : missing) {
    for (const BlockPlace& place : places) {
      blocks_.find_or_add(place);
      if (blocks_.size() > kMostBlocks) {
        return Error{ErrorCode::invalid_argument,
                     fmt::format("voxels of {} m are too small for what the frames saw: they need "
                                 "more than {} blocks",
                                 voxel_, kMostBlocks),
                     {}};
      }
    }
  }
  return {};
}

/// Finds the blocks that a cell of 8 x 8 pixels reaches and that are not there yet, and how deep it
/// tells of anything.
void DistanceVolume::gather_cell(const Sight& sight, std::size_t column, std::size_t row,
                                 std::vector<BlockPlace>& missing) {
  const Camera& camera = sight.camera;
  const double size = kSide * voxel_;
  RecentPlaces recent;
  float& end = ends_[row * cell_columns_ + column];
  const auto reach = [&](const DepthPlane& plane, double u, double v, double spacing) {
    const Vec3d ray{(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1};
    const double slant = plane.nx * ray.x + plane.ny * ray.y + plane.nz;
    const double z = plane.h / slant, deep = plane.reach / slant;
    end = std::max(end, static_cast<float>(z + deep));
    const double margin = kMargin * voxel_;
    const double aside = (margin + std::min(spacing * z / camera.fx, 4 * voxel_) / 2) / size;
    const Vec3d direction = sight.T_world_camera.rotate(ray) / size;
    const Vec3d eye = sight.T_world_camera.translation / size;
    const int steps = 1 + static_cast<int>(deep * norm(ray) / margin);
    for (int step = 0; step <= steps; ++step) {
      const Vec3d p = eye + direction * std::max(0.0, z - deep + 2 * deep * step / steps);
      const BlockPlace low{floor_of(p.x - aside), floor_of(p.y - aside), floor_of(p.z - aside)};
      const BlockPlace high{floor_of(p.x + aside), floor_of(p.y + aside), floor_of(p.z + aside)};
      for (BlockPlace at = low; at.z <= high.z; ++at.z) {
        for (at.y = low.y; at.y <= high.y; ++at.y) {
          for (at.x = low.x; at.x <= high.x; ++at.x) {
            if (recent.holds(at) || blocks_.find(at) != VoxelBlocks::kNone) continue;
            missing.push_back(at);
          }
        }
      }
    }
  };
  const auto first_u = static_cast<std::uint32_t>(column * kCellPixels);
  const auto first_v = static_cast<std::uint32_t>(row * kCellPixels);
  for (std::uint32_t v = first_v; v < std::min(first_v + kCellPixels, camera.height); v += 2) {
    for (std::uint32_t u = first_u; u < std::min(first_u + kCellPixels, camera.width); u += 2) {
      bool is_edge = false;
      const DepthPlane patch = planes_.at(1, u, v, is_edge);
      if (!is_edge) {
        // Patches nearer to each other than a voxel reach the same blocks.
        const double footprint = camera.fx * voxel_ / patch.h;
        const std::uint32_t step = 1u << DepthPlanes::level_for(footprint);
        if ((u | v) & (step - 1)) continue;
        reach(patch, u + 0.5, v + 0.5, step);
        continue;
      }
      for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
        const std::uint32_t at_u = u + pixel % 2, at_v = v + pixel / 2;
        if (at_u >= camera.width || at_v >= camera.height) continue;
        const DepthPlane plane = planes_.at(0, at_u, at_v, is_edge);
        if (plane.weight > 0) reach(plane, at_u, at_v, 1);
      }
    }
  }
}

/// Whether the frame may tell something of a cube of side^3 voxels from `lowest` on (in voxels).
bool DistanceVolume::in_sight(const Sight& sight, const Vec3d& lowest, int side) const {
  const Camera& camera = sight.camera;
  const double middle = (side - 1) / 2.0, radius = std::sqrt(3.0) * middle * voxel_;
  const Vec3d centre = sight.T_camera_world((lowest + Vec3d{middle, middle, middle}) * voxel_);
  if (centre.z + radius <= 0) return false;
  const double nearest = centre.z - radius;
  if (nearest <= radius) return true;  // too near for a bound of what it covers
  // Within the block x / z is that of the centre give or take radius (1 + |x / z|) / nearest.
  const auto range = [&](double along, double f, double c, std::uint32_t pixels, std::size_t& first,
                         std::size_t& last) {
    const double slope = along / centre.z, spread = radius * (1 + std::abs(slope)) / nearest;
    const double low = f * (slope - spread) + c - 0.5, high = f * (slope + spread) + c + 0.5;
    if (!(high >= 0 && low < pixels)) return false;
    first = static_cast<std::size_t>(std::max(low, 0.0)) / kCellPixels;
    last = static_cast<std::size_t>(std::min(high, pixels - 1.0)) / kCellPixels;
    return true;
  };
  std::size_t left = 0, right = 0, top = 0, bottom = 0;
  if (!range(centre.x, camera.fx, camera.cx, camera.width, left, right) ||
      !range(centre.y, camera.fy, camera.cy, camera.height, top, bottom)) {
    return false;
  }
  for (std::size_t row = top; row <= bottom; ++row) {
    for (std::size_t column = left; column <= right; ++column) {
      if (ends_[row * cell_columns_ + column] >= nearest) return true;
    }
  }
  return false;
}

Result<void> DistanceVolume::integrate(const DepthFrame& frame, const Context& context) {
  if (auto seen = see(frame, context.part(0, 0.5)); !seen) return seen;
  const Sight sight{frame.camera, frame.T_world_camera, frame.T_world_camera.inverse()};
  std::vector<std::uint8_t> visible(blocks_.size());
  const auto look = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      visible[i] = in_sight(sight, VoxelBlock::lowest(blocks_.places()[i]), kSide);
    }
  };
  if (!parallel_for(context.part(0.5, 0.6), visible.size(), look)) return cancelled();
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < visible.size(); ++i) {
    if (visible[i]) chosen.push_back(i);
  }
  const auto add = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      update(sight, blocks_.places()[chosen[i]], blocks_[chosen[i]]);
    }
  };
  return parallel_for(context.part(0.6, 1), chosen.size(), add, 16) ? Result<void>()
                                                                    : Result<void>(cancelled());
}

/// Adds what the frame says of each voxel of a block, octant by octant: most blocks are cut by the
/// surface, and what lies behind it is the greater part of them.
void DistanceVolume::update(const Sight& sight, const BlockPlace& place, VoxelBlock& block) const {
  constexpr int kHalf = kSide / 2;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3<int> first{kHalf * (octant & 1), kHalf * (octant >> 1 & 1), kHalf * (octant >> 2)};
    const Vec3d lowest = VoxelBlock::lowest(place) + Vec3d(first);
    if (in_sight(sight, lowest, kHalf)) update_cube<kHalf>(sight, lowest, first, block);
  }
}

/// The same for side^3 voxels of the block from `first` on, which lies at `lowest` in voxels.
template <int side>
void DistanceVolume::update_cube(const Sight& sight, const Vec3d& lowest, const Vec3<int>& first,
                                 VoxelBlock& block) const {
  const Camera& camera = sight.camera;
  const Vec3d base = sight.T_camera_world(lowest * voxel_);
  const auto axis = [&](std::size_t column) {
    Vec3d unit;
    unit[column] = voxel_;
    return sight.T_camera_world.rotate(unit);
  };
  const Vec3d dx = axis(0), dy = axis(1), dz = axis(2);
  const Vec3d middle = base + (dx + dy + dz) * ((side - 1) / 2.0);
  const int level =
      middle.z > 0 ? DepthPlanes::level_for(camera.fx * voxel_ / middle.z) : DepthPlanes::kLevels;
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx + 0.5), cy = static_cast<float>(camera.cy + 0.5);
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const Vec3f along(dx);
  for (int row = 0; row < side * side; ++row) {
    const int j = row % side, k = row / side;
    const Vec3f start(base + dy * j + dz * k);
    std::array<float, side> x, y, z, u, v;
    for (int i = 0; i < side; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[at] = start.x + static_cast<float>(i) * along.x;
      y[at] = start.y + static_cast<float>(i) * along.y;
      z[at] = start.z + static_cast<float>(i) * along.z;
      const float inverse = 1 / z[at];
      u[at] = fx * (x[at] * inverse) + cx;
      v[at] = fy * (y[at] * inverse) + cy;
    }
    const auto row_begin =
        static_cast<std::size_t>(((first.z + k) * kSide + first.y + j) * kSide + first.x);
    for (std::size_t i = 0; i < side; ++i) {
      // Without a jump for each, which would be guessed wrongly at every outline.
      const int is_inside =
          int{z[i] > 0} & int{u[i] >= 0} & int{u[i] < width} & int{v[i] >= 0} & int{v[i] < height};
      if (!is_inside) continue;
      bool is_edge = false;
      const DepthPlane& plane = planes_.at(level, static_cast<std::uint32_t>(u[i]),
                                           static_cast<std::uint32_t>(v[i]), is_edge);
      if (!(plane.weight > 0)) continue;
      const float distance = plane.h - (plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i]);
      if (distance < -plane.reach) continue;
      if (distance <= plane.reach) {
        add(plane, distance, row_begin + i, block);
      } else if (!is_edge && block.seen_free[row_begin + i] < kMostFrames) {
        ++block.seen_free[row_begin + i];
      }
    }
  }
}

/// Adds that a voxel lies `distance` in front of a plane.
void DistanceVolume::add(const DepthPlane& plane, float distance, std::size_t i,
                         VoxelBlock& block) const {
  const auto voxel = static_cast<float>(voxel_);
  const float behind = distance < -voxel ? (plane.reach + distance) / (plane.reach - voxel) : 1.0f;
  const auto weight =
      std::max(1u, static_cast<std::uint32_t>(plane.weight * behind * kWeightSteps + 0.5f));
  const bool full =
      weight > 0xffffffff - block.weights[i] || (block.sums[i] & kMostFrames) == kMostFrames;
  if (full) return;
  const float scaled = distance / voxel * kDistanceSteps;
  const auto steps = static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5f : 0.5f));
  block.weights[i] += weight;
  block.sums[i] += steps * weight * (std::int64_t{kMostFrames} + 1) + 1;
}

DistanceVolume::Voxel DistanceVolume::read(const VoxelBlock& block, std::size_t i,
                                           std::uint32_t min_observations) {
  Voxel voxel;
  voxel.observations = static_cast<std::uint32_t>(block.sums[i] & kMostFrames);
  if (voxel.observations >= min_observations && voxel.observations > block.seen_free[i]) {
    const std::int64_t sum = block.sums[i] >> 16;
    voxel.state = Voxel::State::measured;
    voxel.distance =
        static_cast<float>(static_cast<double>(sum) / block.weights[i] / kDistanceSteps);
    voxel.weight = static_cast<float>(block.weights[i]) / kWeightSteps;
  } else if (block.seen_free[i] >= min_observations) {
    voxel.state = Voxel::State::empty;
  }
  return voxel;
}

}  // namespace burnish
