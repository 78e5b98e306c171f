#include "burnish/triangulation/fan_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "burnish/triangulation/least_squares_plane.h"

namespace burnish {
namespace {

/// What is seen more steeply, squared sine (84 degrees), has no direction in the plane.
constexpr double kVertical = 0.99;

}  // namespace

FanBuilder::FanBuilder(const FanCloudParams& params, NearestQuery nearest)
    : params_(params),
      nearest_(std::move(nearest)),
      k_(static_cast<std::size_t>(params.k)),
      cos_sheet_angle_(std::cos(params.sheet_angle)),
      steepest_(std::min(kVertical, std::pow(std::sin(params.steep_angle), 2))),
      ring_(params.gap_angle) {}

const Fan& FanBuilder::build(std::uint32_t p, const OrientedPoints& points) {
  const std::size_t most = k_ * static_cast<std::size_t>(params_.cap);
  // So many suffice for most fans.
  const std::size_t first = params_.variant == FanVariant::ring ? k_ + k_ / 2 : 2 * k_;
  std::size_t count = std::min(first, most);
  for (;; count = most) {
    nearest_(points.positions[p], count + 1, neighbours_);
    std::erase_if(neighbours_, [p](const Neighbour& q) { return q.index == p; });
    const bool all_there_are = neighbours_.size() < count;
    if (build_from_neighbours(p, points) || all_there_are || count == most) break;
  }
  // A fan that looked at all there are and wanted more depends on points however far.
  const bool wanted_more = looked_at_ == neighbours_.size() && looked_at_ < count;
  fan_.squared_reach = wanted_more ? std::numeric_limits<double>::infinity()
                                   : neighbours_[looked_at_ - 1].squared_distance;
  write_rim();
  fan_.normal = Vec3f(frame_.normal);
  const std::size_t beside = frame_.normal == Vec3d{} ? neighbours_.size() : plane_.size();
  if (!fan_.rim.empty()) {
    const bool gap = std::find(fan_.rim.begin(), fan_.rim.end(), Fan::kGap) != fan_.rim.end();
    fan_.state = gap ? FanState::open : FanState::closed;
  } else {
    fan_.state = beside < 2 ? FanState::isolated : FanState::collinear;
  }
  return fan_;
}

/// Returns whether farther neighbours would change nothing.
bool FanBuilder::build_from_neighbours(std::uint32_t p, const OrientedPoints& points) {
  looked_at_ = neighbours_.size();
  plane_.clear();
  ring_.clear();
  rim_.clear();
  frame_ = {};
  const Plane plane = find_plane(p, points);
  if (plane == Plane::none) return false;
  if (params_.variant == FanVariant::delaunay) return build_star(p, points);
  const bool complete = build_ring(p, points);
  if (plane == Plane::of_all) looked_at_ = neighbours_.size();
  return complete;
}

/// Perpendicular to the point's normal; or the plane of least squares of its k nearest neighbours;
/// or, should these be in a line, of all that are known.
FanBuilder::Plane FanBuilder::find_plane(std::uint32_t p, const OrientedPoints& points) {
  const Vec3d given = points.normals.empty() ? Vec3d{} : Vec3d(points.normals[p]);
  if (given != Vec3d{}) {
    frame_ = TangentFrame(given);
    return Plane::given;
  }
  const std::span<const Neighbour> all = neighbours_;
  const auto nearest = all.first(std::min(k_, all.size()));
  Vec3d normal = least_squares_normal(points.positions, p, nearest);
  const bool found = normal != Vec3d{};
  if (!found) normal = least_squares_normal(points.positions, p, all);
  if (normal == Vec3d{}) return Plane::none;
  frame_ = TangentFrame(normal);
  return found ? Plane::of_nearest : Plane::of_all;
}

/// Adds a neighbour to the plane where it lies beside the point, on the same sheet.
bool FanBuilder::project(std::uint32_t p, const Neighbour& q, const OrientedPoints& points) {
  const Vec3d to = Vec3d(points.positions[q.index]) - Vec3d(points.positions[p]);
  const double height = dot(frame_.normal, to);
  double steepest = steepest_;
  if (!points.normals.empty()) {
    const Vec3d here(points.normals[p]), there(points.normals[q.index]);
    if (here != Vec3d{} && there != Vec3d{}) {
      if (dot(here, there) <= cos_sheet_angle_) return false;
      steepest = kVertical;
    }
  }
  if (height * height > steepest * q.squared_distance) return false;
  plane_.push_back({dot(frame_.u, to), dot(frame_.v, to), q.index});
  return true;
}

/// The k nearest, and of the next ones those that lie in a gap.
bool FanBuilder::build_ring(std::uint32_t p, const OrientedPoints& points) {
  bool complete = false;
  for (std::size_t i = 0; i < neighbours_.size() && !complete; ++i) {
    if (!project(p, neighbours_[i], points)) continue;
    const PlanePoint& q = plane_.back();
    if (ring_.size() >= k_ && !ring_.in_gap(q.x, q.y)) continue;
    ring_.insert(q.x, q.y, static_cast<std::uint32_t>(plane_.size() - 1));
    complete = ring_.size() >= k_ && !ring_.any_gap();
    if (complete) looked_at_ = i + 1;
  }
  for (std::size_t i = 0; i < ring_.size(); ++i) rim_.push_back(i);
  return complete;
}

/// The Delaunay star of all the neighbours.
bool FanBuilder::build_star(std::uint32_t p, const OrientedPoints& points) {
  for (const Neighbour& neighbour : neighbours_) {
    if (!project(p, neighbour, points)) continue;
    const PlanePoint& q = plane_.back();
    ring_.insert(q.x, q.y, static_cast<std::uint32_t>(plane_.size() - 1));
  }
  star_.build(plane_, p);
  place_.assign(plane_.size(), ring_.size());
  for (std::size_t i = 0; i < ring_.size(); ++i) place_[ring_.point(i)] = i;
  for (const std::uint32_t point : star_.rim()) {
    if (place_[point] < ring_.size()) rim_.push_back(place_[point]);
  }
  return star_.closed() && ring_.size() >= k_ && !ring_.any_gap() &&
         star_.squared_diameter() <= neighbours_.back().squared_distance;
}

/// The rim with its gaps; neighbours between two gaps are in no triangle. It begins with the
/// nearest neighbour, or after a gap.
void FanBuilder::write_rim() {
  fan_.rim.clear();
  const std::size_t count = rim_.size();
  gaps_.resize(count);
  std::size_t start = 0;
  for (std::size_t i = 0; i < count; ++i) {
    gaps_[i] = ring_.gap_between(rim_[i], rim_[i + 1 < count ? i + 1 : 0]);
    if (ring_.point(rim_[i]) < ring_.point(rim_[start])) start = i;
  }
  const auto gap = std::find(gaps_.begin(), gaps_.end(), true);
  if (gap != gaps_.end()) start = static_cast<std::size_t>(gap - gaps_.begin()) + 1;
  bool after_gap = gap != gaps_.end();
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t i = (start + j) % count;
    if (!after_gap || !gaps_[i]) fan_.rim.push_back(plane_[ring_.point(rim_[i])].index);
    if (!after_gap && gaps_[i]) fan_.rim.push_back(Fan::kGap);
    after_gap = gaps_[i];
  }
}

}  // namespace burnish
