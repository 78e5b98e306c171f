#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "burnish/base/tangent_frame.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"
#include "burnish/triangulation/delaunay_star.h"
#include "burnish/triangulation/direction_ring.h"
#include "burnish/triangulation/fan_cloud_params.h"

namespace burnish {

/// What became of a point.
enum class FanState : std::uint8_t {
  removed,    ///< its index is free
  inactive,   ///< it takes no part
  duplicate,  ///< another active point, of a smaller index, is in the same place
  isolated,   ///< fewer than two points lie beside it
  collinear,  ///< no two points beside it make a triangle with it
  open,       ///< a boundary point: its fan has a gap
  closed
};

/// Triangles around a point. The rim is a sequence of neighbours, counter-clockwise around the
/// normal, of which every two in a row make a triangle with the point; the last is followed by the
/// first. kGap in a rim stands where no triangle is.
struct Fan {
  static constexpr std::uint32_t kGap = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> rim;
  Vec3f normal;
  FanState state = FanState::inactive;
  double squared_reach = 0;  ///< points farther away have no influence on the fan
};

/// Positions, and normals of unit length or 0 where they are unknown.
struct OrientedPoints {
  std::span<const Vec3f> positions, normals;
};

/// Answers which points are nearest to one of them, itself among them, in the order of (distance,
/// index). Coincident points are found once.
using NearestQuery =
    std::function<void(std::uint32_t point, std::size_t count, std::vector<Neighbour>& found)>;

/// Builds fan after fan with the same memory. What a fan is, fan_cloud.h says.
class FanBuilder {
 public:
  FanBuilder(const FanCloudParams& params, NearestQuery nearest);

  /// So many neighbours are asked for first, and suffice for most fans.
  static std::size_t first_neighbours(const FanCloudParams& params);

  /// The fan of point `p`, one of those that the query finds; valid until the next is built.
  const Fan& build(std::uint32_t p, const OrientedPoints& points);

 private:
  enum class Plane { none, given, of_nearest, of_all, doubtful };
  bool build_from_neighbours(std::uint32_t p, const OrientedPoints& points);
  Plane find_plane(std::uint32_t p, const OrientedPoints& points);
  bool project(std::uint32_t p, const Neighbour& q, const OrientedPoints& points);
  bool build_ring(std::uint32_t p, const OrientedPoints& points);
  bool build_star(std::uint32_t p, const OrientedPoints& points);
  void write_rim();

  FanCloudParams params_;
  NearestQuery nearest_;
  std::size_t k_;
  double cos_sheet_angle_, steepest_;
  Fan fan_;
  std::vector<Neighbour> neighbours_;  ///< of the point, itself left out
  std::size_t looked_at_ = 0;          ///< so many of them have an influence
  std::vector<std::uint32_t> fitted_;  ///< the point and its neighbours
  TangentFrame frame_;
  std::vector<PlanePoint> plane_;   ///< the neighbours beside the point, in the order of distance
  DirectionRing ring_;              ///< their directions, by their numbers in plane_
  std::vector<std::size_t> place_;  ///< in the ring, of each of them
  std::vector<std::size_t> rim_;    ///< numbers in the ring
  std::vector<bool> gaps_;          ///< after each point of the rim
  DelaunayStar star_;
};

}  // namespace burnish
