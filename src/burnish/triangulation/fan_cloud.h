#pragma once

#include <optional>
#include <set>
#include <utility>

#include "burnish/base/context.h"
#include "burnish/spatial/point_octree.h"
#include "burnish/triangulation/fan_builder.h"
#include "burnish/triangulation/fan_cloud_params.h"
#include "burnish/triangulation/index_lists.h"

namespace burnish {

/// The fan cloud of Linsen and Prautzsch 2001, 2003: around every point a fan of triangles, each on
/// its own. Only abstracts could be read; the details are our own.
///
/// `ring`: the k nearest neighbours (of equally near ones that of the smaller index), projected
/// into the plane of least squares of them and the point (of more where they lie in a narrow
/// strip), sorted by angle. While two in a row are
/// more than `gap_angle` apart, the next nearest that lie in such a gap are taken too, until
/// `cap` * k were looked at. Two in a row make a triangle with the point; a gap that remains stays
/// open: a boundary point. Of neighbours in the same direction the nearest counts.
/// `delaunay`: the Delaunay star of the point among its nearest neighbours in the plane. It begins
/// with 2k; where gaps remain, or a circumscribed circle reaches farther than the known ones, all
/// `cap` * k are taken. Triangles over a gap are left out.
///
/// A point's normal, where it is known, is perpendicular to the plane in place of least squares;
/// neighbours whose normals differ from it by more than `sheet_angle` are on another sheet and are
/// passed over. Where normals are unknown, neighbours steeper than `steep_angle` to the plane are.
///
/// Of several points in one place the one of the smallest index stands for all. A fan depends on
/// nothing but the active points nearby: after every edit the cloud is, bit for bit, what building
/// it from its active points gives.
class FanCloud {
 public:
  /// All points are active, or those that are not 0 in `active`. `normals` have unit length or are
  /// 0; none at all, or one a point. O(#P k log k).
  /// Errors: invalid_argument, bad_geometry (a position that is not finite; arrays of another
  /// length), cancelled.
  static Result<FanCloud> build(std::span<const Vec3f> positions,
                                std::span<const Vec3f> normals = {},
                                const FanCloudParams& params = {}, const Context& context = {},
                                std::span<const std::uint8_t> active = {});

  /// How many points there are, active or not.
  std::size_t size() const { return positions_.size(); }
  std::span<const Vec3f> positions() const { return positions_; }
  /// One a point, or none at all.
  std::span<const Vec3f> normals() const { return normals_; }
  const FanCloudParams& params() const { return params_; }

  bool active(std::uint32_t p) const { return states_[p] >= FanState::duplicate; }
  FanState state(std::uint32_t p) const { return states_[p]; }
  /// The fan's triangles, as Fan::rim has them; empty where the state is neither open nor closed.
  std::span<const std::uint32_t> rim(std::uint32_t p) const { return rims_.row(p); }
  /// Of the fan's plane; its rim is counter-clockwise around it.
  const Vec3f& fan_normal(std::uint32_t p) const { return fan_normals_[p]; }

  /// Edits build anew the fans that hold, or now come to hold, the point: O(k) fans of O(log #P +
  /// k log k) each. The first edit costs O(#P log #P) once.

  /// A new active point; gives its index, that of a removed point where there is one.
  /// Errors: bad_geometry where the position is not finite.
  Result<std::uint32_t> add(const Vec3f& position, const Vec3f& normal = {});
  /// The point goes for good. Errors: invalid_argument where there is no such point.
  Result<void> remove(std::uint32_t p);
  /// Lets a point take part, or not. Errors: invalid_argument where there is no such point.
  Result<void> set_active(std::uint32_t p, bool active);
  /// The points whose fans the last edit built, in no order.
  std::span<const std::uint32_t> renewed() const { return renewed_; }

  /// The active points nearest to a place, of those in one place the first, as PointOctree::nearest
  /// gives them.
  void nearest(const Vec3f& place, std::size_t count, std::vector<Neighbour>& found) {
    octree().nearest(place, count, found);
  }

 private:
  FanCloud() = default;

  Result<void> build_all(const Context& context);
  std::vector<std::uint32_t> first_in_place() const;
  OrientedPoints points() const { return {positions_, normals_}; }
  Result<void> check_index(std::uint32_t p) const;
  PointOctree& octree();
  void activate(std::uint32_t p);
  void deactivate(std::uint32_t p);
  void clear_fan(std::uint32_t p, FanState state);
  void renew_fans_around(const Vec3f& place);
  std::optional<std::uint32_t> first_at(const Vec3f& place);

  using Place = std::array<float, 3>;
  static Place place_of(const Vec3f& p) { return {p.x, p.y, p.z}; }

  FanCloudParams params_;
  std::vector<Vec3f> positions_, normals_, fan_normals_;
  std::vector<FanState> states_;
  std::vector<double> squared_reaches_;
  IndexLists rims_;
  std::set<std::pair<Place, std::uint32_t>> duplicates_;  ///< active, but not the first in place
  std::vector<std::uint32_t> removed_, renewed_;
  std::optional<PointOctree>
      octree_;  ///< of the points that have a fan or might; from the first edit
};

}  // namespace burnish
