#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/rigid.h"
#include "burnish/core/depth_frame.h"
#include "burnish/triangulation/depth_planes.h"
#include "burnish/triangulation/voxel_blocks.h"

namespace burnish {

/// How far around a surface its distance is kept.
struct Truncation {
  double voxels = 3;  ///< at least so many voxels to either side, at least 2
  double sigmas = 3;  ///< and so many standard deviations of a pixel
};

/// Signed distances to a surface around it, from posed depth frames: the weighted mean of what
/// every frame says (Curless and Levoy 1996), in blocks of 8^3 voxels that are there only where a
/// surface was seen (Niessner et al. 2013). Voxel (i, j, k) is the point (i, j, k) * voxel of the
/// world.
///
/// A frame tells of a voxel by the plane of the pixels that the voxel covers (depth_planes.h): of
/// its distance where that is within the truncation, with the inverse of the sensor's variance as
/// the weight, which falls to zero behind the surface (Bylow et al. 2013), so that the two sides of
/// a thin thing disturb each other less; that it is empty where it lies farther in front; and
/// nothing of what lies farther behind. Where more frames saw a voxel empty than measured it, it is
/// empty: what moved away leaves no ghost.
///
/// All sums are of integers (weights in steps of 1/256 / voxel^2, up to 4096 / voxel^2; distances
/// in steps of a 256th of a voxel), so that the result depends neither on threads nor on the order
/// of pixels. It does not depend on the order of frames where all were allocated before the first
/// is integrated; frames that are integrated as they come cannot testify against blocks that a
/// later one makes.
class DistanceVolume {
 public:
  /// So many blocks there are at most: 0.9 GB of them.
  static constexpr std::size_t kMostBlocks = std::size_t{1} << 17;

  /// What is known of a voxel.
  struct Voxel {
    enum class State : std::uint8_t { unseen, empty, measured };
    State state = State::unseen;
    float distance = 0;              ///< in voxels, positive in front of the surface; measured ones
    float weight = 0;                ///< inverse variance of the distance, 1 / voxel^2
    std::uint32_t observations = 0;  ///< the frames that measured it
  };

  /// Voxels of size `voxel` > 0, m.
  explicit DistanceVolume(double voxel, const Truncation& truncation = {});

  /// Makes the blocks that the frame's measurements reach. Errors: bad_geometry (the frame),
  /// invalid_argument (more than kMostBlocks, or a place too far away for the size of the voxels),
  /// cancelled.
  Result<void> allocate(const DepthFrame& frame, const Context& context = {});

  /// The same, and adds what the frame says of every voxel there is. O(#pixels + #blocks + 512
  /// times the blocks in sight). Errors: as above; after cancellation the volume is of no use.
  Result<void> integrate(const DepthFrame& frame, const Context& context = {});

  double voxel() const { return voxel_; }
  const VoxelBlocks& blocks() const { return blocks_; }

  /// A voxel of a block as min_observations frames make it: with fewer it is not measured.
  static Voxel read(const VoxelBlock& block, std::size_t i, std::uint32_t min_observations);

 private:
  struct Sight;
  Result<void> see(const DepthFrame& frame, const Context& context);
  void gather_cell(const Sight& sight, std::size_t column, std::size_t row,
                   std::vector<BlockPlace>& missing);
  bool in_sight(const Sight& sight, const Vec3d& lowest, int side) const;
  void update(const Sight& sight, const BlockPlace& place, VoxelBlock& block) const;
  template <int side>
  void update_cube(const Sight& sight, const Vec3d& lowest, const Vec3<int>& first,
                   VoxelBlock& block) const;
  void add(const DepthPlane& plane, float distance, std::size_t i, VoxelBlock& block) const;

  double voxel_;
  Truncation truncation_;
  VoxelBlocks blocks_;
  DepthPlanes planes_;
  std::size_t cell_columns_ = 0, cell_rows_ = 0;  ///< of 8 x 8 pixels
  std::vector<float> ends_;  ///< per cell the greatest depth that its pixels tell of, m; 0: none
};

}  // namespace burnish
