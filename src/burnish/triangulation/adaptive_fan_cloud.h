#pragma once

#include <functional>
#include <limits>

#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/fan_cloud.h"
#include "burnish/triangulation/point_detail.h"
#include "burnish/triangulation/point_information.h"

namespace burnish {

struct AdaptiveFanCloudParams {
  FanCloudParams fans{};
  InformationWeights weights{};
};

/// Which points are meant, by their numbers. Asked once a call of each, from one thread.
using PointSelection = std::function<bool(std::uint32_t)>;

/// How points that are away follow an edit of those that are there.
enum class WayBack {
  exact,  ///< they do not: they come back where they were, bit for bit
  detail  ///< they keep their place in the frame of the points that were around them
};

/// A fan cloud whose points go and come back, everywhere or in a part, for ever (Linsen and
/// Prautzsch 2003; what is said in fan_cloud.h and point_information.h holds here).
///
/// Reduction takes the point away that carries least information (of equal ones that of the smaller
/// number), builds the fans that held it anew, asks these again, and so on; every removal is added
/// to the log. Refinement brings back what was removed last, first, and takes it out of the log.
/// Any set of active points is possible. Fans depend on it alone, not on the way to it: they are,
/// bit for bit, those of FanCloud::build, and a way down and back up ends where it began.
///
/// A removal, or a return of few points: O(k) fans of O(log #P + k log k) each. A return of many
/// builds all fans anew, in parallel. Every call costs O(#P) besides. About 400 bytes a point,
/// half as many again while all fans are built anew. A call that is cancelled stops at a level
/// between.
class AdaptiveFanCloud {
 public:
  struct Removal {
    std::uint32_t point;
    double information;  ///< when it went
  };

  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  /// All points are active. Missing pixels are left out: point i is the i-th that there is. Points
  /// without a normal take their fan's, here and now. O(#P k log k).
  /// Errors: invalid_argument, bad_geometry, cancelled.
  static Result<AdaptiveFanCloud> build(PointCloud cloud, const AdaptiveFanCloudParams& params = {},
                                        const Context& context = {});

  /// How many points there are, active or not; how many are active.
  std::size_t size() const { return fans_.size(); }
  std::size_t active_count() const { return size() - log_.size(); }
  /// Fans, states and positions, of inactive points those with which they will come back.
  const FanCloud& fans() const { return fans_; }
  /// The points that are away, in the order in which they went.
  std::span<const Removal> log() const { return log_; }
  /// The active points with their attributes, in the order of their numbers.
  PointCloud active_cloud() const;

  // Errors of all of them: cancelled.

  /// Reduces or refines to `count` active points, all where there are fewer.
  Result<void> to_points(std::size_t count, const Context& context = {});
  /// Removes points of the selection until at most `count` of it are active.
  Result<void> reduce(const PointSelection& selection, std::size_t count,
                      const Context& context = {});
  /// Brings points of the selection back until `count` of it, or all, are active.
  Result<void> refine(const PointSelection& selection, std::size_t count = kAll,
                      const Context& context = {});
  /// Brings all points back.
  Result<void> restore(const Context& context = {}) { return to_points(size(), context); }

  /// Moves the active points, in the order of active_cloud(); with new normals, or with none where
  /// they keep theirs. What is away follows by `way`: in reverse order of removal, each point takes
  /// the place that it had in the frame of its neighbours when it went (point_detail.h). O(#P k log
  /// k). Errors: invalid_argument (other lengths; normals of a cloud that has none), bad_geometry,
  /// cancelled; nothing is changed then.
  Result<void> set_positions(std::span<const Vec3f> positions, WayBack way,
                             std::span<const Vec3f> normals = {}, const Context& context = {});

 private:
  AdaptiveFanCloud(FanCloud fans) : fans_(std::move(fans)) {}

  PointInformation information() const;
  std::vector<std::uint32_t> active_points() const;
  Result<void> reduce_among(std::vector<std::uint32_t> candidates, std::size_t count,
                            const Context& context);
  void remove(std::uint32_t p, double information);
  Result<void> bring_back(const std::vector<std::uint32_t>& points, const Context& context);
  Result<FanCloud> rebuilt(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                           const std::vector<std::uint32_t>& returning,
                           const Context& context) const;
  void take_normals_of_fans();

  AdaptiveFanCloudParams params_;
  FanCloud fans_;
  PointCloud rest_;             ///< attributes but normals, frame and viewpoint; no positions
  std::vector<Vec3f> normals_;  ///< per point, that by which information is measured
  double usual_edge_ = 1;
  std::vector<Removal> log_;
  IndexLists around_;                 ///< of removed points those in whose frame details_ is
  std::vector<PointDetail> details_;  ///< per point, of meaning while it is away
  std::vector<std::uint32_t> ring_;   ///< memory of remove()
  std::vector<Neighbour> nearest_;    ///< the same
};

}  // namespace burnish
