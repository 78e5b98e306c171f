#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/registration/pose_fit.h"
#include "burnish/registration/surface_view.h"

namespace burnish {

/// Views that are read when they are needed, and maybe again later.
struct ViewSource {
  std::size_t count = 0;
  std::function<Result<SurfaceView>(std::size_t, const Context&)> read;
};

/// Two views that were laid on each other, and what came of it.
struct RegisteredPair {
  std::uint32_t target, source;
  PairRegistration registration;
};

/// Where several views were taken from.
struct ViewPoses {
  /// Per view; none for one of which the pairs do not say where it is.
  std::vector<std::optional<RigidTransform>> T_world_view;
  /// Per view one standard deviation of where what it sees is, as the first view that has a pose
  /// sees it, in the direction in which it is largest, m; infinite without a pose.
  std::vector<double> deviations;
  std::vector<RegisteredPair> pairs;  ///< all that were judged, accepted or refused
  PoseFit fit;                        ///< by those that count (counts_for_poses), in their order
  std::vector<std::string> notes;     ///< what was refused and why, one sentence each

  std::size_t placed() const;
  Facts facts() const;
};

/// A few views that were read last, so that what is needed again soon is not read again.
class ViewCache {
 public:
  ViewCache(const ViewSource& source, std::size_t capacity)
      : source_(source), capacity_(capacity) {}

  /// Stays valid while fewer than `capacity` others are asked for.
  Result<const SurfaceView*> at(std::size_t view, const Context& context);

 private:
  struct Entry {
    std::size_t view;
    SurfaceView pixels;
  };

  const ViewSource& source_;
  std::size_t capacity_;
  std::vector<std::unique_ptr<Entry>> entries_;  ///< the one asked for last comes last
};

/// What makes a view's pose one to rely on.
struct PlacementLimits {
  double max_deviation = 4;  ///< of a pair from what the others say, in its deviations
  /// Of where what a view sees is, one standard deviation, m. A long walk adds up many small ones.
  double max_uncertainty = std::numeric_limits<double>::infinity();
  /// Whether pairs count that were refused for nothing but that they leave some direction open.
  /// What they say of the others holds, and their information has next to nothing of that one;
  /// together they may leave none open, which max_uncertainty is to see to.
  bool open_directions = false;
};

/// Whether a pair says something of the poses of its views.
bool counts_for_poses(const PairRegistration& pair, const PlacementLimits& limits);

/// Fits the poses to the pairs that count, and gives them to those views of the largest set that
/// pairs join which are known well enough; says of the others why they have none.
Result<void> place_views(PoseModel& model, const PlacementLimits& limits, ViewPoses& poses,
                         const Context& context);

}  // namespace burnish
