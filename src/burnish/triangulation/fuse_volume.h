#pragma once

#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/frame_source.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct VolumeParams {
  double voxel = 0;              ///< m; 0: twice the median distance between neighbouring rays
  double truncation = 3;         ///< in voxels
  double truncation_sigmas = 3;  ///< in standard deviations of a pixel
  int min_observations = 1;      ///< voxels that fewer frames measured count as not seen

  static const Schema<VolumeParams>& schema();
};

/// What came of frames in a volume.
struct VolumeReport {
  std::size_t frames = 0;
  double voxel = 0;        ///< m
  std::size_t blocks = 0;  ///< of 8^3 voxels
  std::size_t vertices = 0, triangles = 0;
  std::size_t interpolated_vertices = 0;  ///< beside voxels that were seen empty and not measured

  Facts facts() const;
};

/// A surface from frames, and how it came about.
struct FusedVolume {
  TriangleMesh mesh;
  VolumeReport report;
};

/// The surface that posed depth frames see together: signed distances in a sparse volume
/// (distance_volume.h) and where they are zero (iso_surface.h). What no frame saw stays open.
///
/// Frames are read one after the other, and more than once: where `voxel` is 0 for its size, then
/// for the blocks, then for what they say. One is held at a time, so that memory depends on the
/// surface seen, about 7 kB a block, and not on the number of frames. The same bytes for any number
/// of threads and any order of the frames. Errors: invalid_argument (no frame; voxels too small for
/// the extent), bad_geometry (a frame, or no depth at all), those of reading, cancelled.
Result<FusedVolume> fuse_volume(const FrameSource& frames, const VolumeParams& params = {},
                                const Context& context = {});

}  // namespace burnish
