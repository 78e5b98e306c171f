#include "burnish/triangulation/fuse_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "burnish/triangulation/distance_volume.h"
#include "burnish/triangulation/iso_surface.h"

namespace burnish {
namespace {

constexpr std::size_t kSampled = 61;  // every so-manieth pixel stands for the rest in a median
constexpr int kBins = 32;             // of a histogram, for each power of two

/// Calls `work(frame, share)` for every frame in turn.
template <class Work>
Result<void> for_frames(const FrameSource& frames, const Context& context, Work work) {
  const double count = static_cast<double>(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (context.cancelled()) return cancelled();
    const double done = static_cast<double>(i);
    const Context share = context.part(done / count, (done + 1) / count);
    const Result<DepthFrame> frame = frames.read(i, share.part(0, 0.5));
    if (!frame) return frame.error();
    if (auto worked = work(*frame, share.part(0.5, 1)); !worked) {
      Error error = worked.error();
      if (error.code != ErrorCode::cancelled && error.where.empty()) {
        error.where = fmt::format("frame {}", i);
      }
      return error;
    }
    share.progress(1);
  }
  return {};
}

/// The median over all frames of the distance between neighbouring rays where they meet the
/// surface, m, to a 32nd of a power of two: counted in bins, so that no order of the frames
/// matters.
Result<double> typical_footprint(const FrameSource& frames, const Context& context) {
  std::map<int, std::size_t> bins;
  std::size_t total = 0;
  const auto count = [&](const DepthFrame& frame, const Context&) -> Result<void> {
    if (auto sound = check(frame); !sound) return sound;
    for (std::size_t i = 0; i < frame.depth.size(); i += kSampled) {
      if (!(frame.depth[i] > 0)) continue;
      int exponent = 0;
      const double share = std::frexp(frame.depth[i] / frame.camera.fx, &exponent);
      ++bins[exponent * kBins + static_cast<int>((2 * share - 1) * kBins)];
      ++total;
    }
    return {};
  };
  if (auto counted = for_frames(frames, context, count); !counted) return counted.error();
  std::size_t below = 0;
  for (const auto& [bin, pixels] : bins) {
    below += pixels;
    if (2 * below < total) continue;
    const int exponent = static_cast<int>(std::floor(static_cast<double>(bin) / kBins));
    return std::ldexp(0.5 + 0.5 * (bin - exponent * kBins) / kBins, exponent);
  }
  return Error{ErrorCode::bad_geometry, "no frame has a depth", {}};
}

}  // namespace

const Schema<VolumeParams>& VolumeParams::schema() {
  using P = VolumeParams;
  static const auto schema =
      Schema<P>()
          .real("voxel", &P::voxel, at_least(0),
                "size of a voxel; 0: twice the distance of neighbouring rays", Quantity::length)
          .real("truncation", &P::truncation, between(2, 30),
                "voxels to either side of a surface in which its distance is kept")
          .real("truncation_sigmas", &P::truncation_sigmas, between(0, 30),
                "standard deviations of a pixel that are kept at least, too")
          .integer("min_observations", &P::min_observations, between(1, 65535),
                   "voxels that fewer frames measured count as not seen");
  return schema;
}

Facts VolumeReport::facts() const {
  return {{"frames", static_cast<double>(frames), ""},
          {"voxel", voxel, "m"},
          {"blocks", static_cast<double>(blocks), ""},
          {"vertices", static_cast<double>(vertices), ""},
          {"triangles", static_cast<double>(triangles), ""},
          {"interpolated_vertices", static_cast<double>(interpolated_vertices), ""}};
}

Result<FusedVolume> fuse_volume(const FrameSource& frames, const VolumeParams& params,
                                const Context& context) {
  if (auto valid = VolumeParams::schema().check(params); !valid) return valid.error();
  if (frames.size() == 0) return Error{ErrorCode::invalid_argument, "no frame to fuse", {}};
  FusedVolume fused;
  double voxel = params.voxel;
  if (voxel == 0) {
    const Result<double> footprint = typical_footprint(frames, context.part(0, 0.1));
    if (!footprint) return footprint.error();
    voxel = 2 * *footprint;
  }
  DistanceVolume volume(voxel, {params.truncation, params.truncation_sigmas});
  const auto allocate = [&](const DepthFrame& frame, const Context& share) {
    return volume.allocate(frame, share);
  };
  const auto integrate = [&](const DepthFrame& frame, const Context& share) {
    return volume.integrate(frame, share);
  };
  if (auto done = for_frames(frames, context.part(0.1, 0.4), allocate); !done) return done.error();
  if (auto done = for_frames(frames, context.part(0.4, 0.9), integrate); !done) return done.error();
  Result<TriangleMesh> mesh = iso_surface(volume, params.min_observations, context.part(0.9, 1));
  if (!mesh) return mesh.error();

  fused.mesh = *std::move(mesh);
  const auto& origin = fused.mesh.attributes.origin;
  fused.report = {
      frames.size(),
      voxel,
      volume.blocks().size(),
      fused.mesh.positions.size(),
      fused.mesh.triangles.size(),
      static_cast<std::size_t>(std::count(origin.begin(), origin.end(), Origin::interpolated))};
  return fused;
}

}  // namespace burnish
