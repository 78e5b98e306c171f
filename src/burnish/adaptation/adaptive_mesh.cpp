#include "burnish/adaptation/adaptive_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "burnish/adaptation/star_frame.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// The triangles of a star that are there without its vertex: those that changed a corner, or the
/// one beyond an ear.
std::span<const std::uint32_t> left_of(const Star& star) {
  return star.triangles.subspan(lost_triangles(star.shape));
}

void rename_corner(Triangle& triangle, std::uint32_t from, std::uint32_t to) {
  std::replace(triangle.begin(), triangle.end(), from, to);
}

}  // namespace

Result<AdaptiveMesh> AdaptiveMesh::make(TriangleMesh original, std::span<const Removal> log,
                                        const Context& context) {
  if (auto sound = check(original); !sound) return std::move(sound).error();
  Result<RemovalOrder> order = RemovalOrder::make(original, log, context);
  if (!order) return std::move(order).error();
  AdaptiveMesh result;
  result.order_ = *std::move(order);
  result.log_.assign(log.begin(), log.end());
  result.states_.assign(log.size(), State::open);
  result.gone_.assign(original.triangles.size(), false);
  result.triangle_count_ = original.triangles.size();
  result.original_ = std::move(original);
  return result;
}

void AdaptiveMesh::make_removal(std::uint32_t removal) {
  const auto [vertex, into, error] = log_[removal];
  const Star star = order_.star(removal);
  const auto left = left_of(star);
  if (star.shape != StarShape::ear) {
    for (const std::uint32_t t : left) rename_corner(original_.triangles[t], vertex, into);
  }
  const std::size_t lost = lost_triangles(star.shape);
  for (const std::uint32_t t : star.triangles.first(lost)) gone_[t] = true;
  triangle_count_ -= lost;
  ++removed_count_;
  states_[removal] = State::made;
  if (!details_.empty()) {
    const auto& p = original_.positions;
    const StarFrame frame = star_frame(p, original_.triangles, left, into);
    details_[removal] = frame.into(Vec3d(p[vertex]) - Vec3d(p[into]));
  }
}

void AdaptiveMesh::undo_removal(std::uint32_t removal) {
  const auto [vertex, into, error] = log_[removal];
  const Star star = order_.star(removal);
  const auto left = left_of(star);
  if (!details_.empty()) {
    auto& p = original_.positions;
    const StarFrame frame = star_frame(p, original_.triangles, left, into);
    p[vertex] = Vec3f(Vec3d(p[into]) + frame.out_of(details_[removal]));
  }
  if (star.shape != StarShape::ear) {
    for (const std::uint32_t t : left) rename_corner(original_.triangles[t], into, vertex);
  }
  const std::size_t lost = lost_triangles(star.shape);
  for (const std::uint32_t t : star.triangles.first(lost)) gone_[t] = false;
  triangle_count_ += lost;
  --removed_count_;
  states_[removal] = State::open;
}

bool AdaptiveMesh::can_be_made(std::uint32_t removal) const {
  const auto below = order_.below(removal);
  return std::all_of(below.begin(), below.end(),
                     [&](std::uint32_t b) { return states_[b] == State::made; });
}

/// Undoes the removals that are wanted back, each after those above it.
template <class Wanted>
void AdaptiveMesh::undo_with_above(Wanted wanted) {
  std::vector<std::uint32_t> found;
  const auto find = [&](std::uint32_t removal) {
    if (states_[removal] != State::made) return;
    states_[removal] = State::to_undo;
    found.push_back(removal);
  };
  for (std::uint32_t k = 0; k < log_.size(); ++k) {
    if (states_[k] == State::made && wanted(log_[k])) find(k);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const std::uint32_t a : order_.above(found[i])) find(a);
  }
  std::sort(found.begin(), found.end(), std::greater());
  for (const std::uint32_t k : found) undo_removal(k);
}

/// Makes the removals that are wanted, as far as those below them are made: along the log, in which
/// they come earlier.
template <class Wanted>
void AdaptiveMesh::make_where(Wanted wanted) {
  for (std::uint32_t k = 0; k < log_.size(); ++k) {
    if (states_[k] == State::open && wanted(log_[k]) && can_be_made(k)) make_removal(k);
  }
}

void AdaptiveMesh::to_removals(std::size_t count) {
  const auto end = static_cast<std::uint32_t>(std::min(count, log_.size()));
  for (auto k = static_cast<std::uint32_t>(log_.size()); k-- > end;) {
    if (states_[k] == State::made) undo_removal(k);
  }
  for (std::uint32_t k = 0; k < end; ++k) {
    if (states_[k] == State::open) make_removal(k);
  }
}

void AdaptiveMesh::to_error(double error) {
  const auto end = std::find_if(log_.begin(), log_.end(), [&](const Removal& r) {
    return !(static_cast<double>(r.error) <= error);
  });
  to_removals(static_cast<std::size_t>(end - log_.begin()));
}

void AdaptiveMesh::to_triangles(std::size_t count) {
  std::size_t left = gone_.size();
  std::uint32_t removals = 0;
  while (left > count && removals < log_.size()) {
    left -= lost_triangles(order_.star(removals++).shape);
  }
  to_removals(removals);
}

Result<AdaptiveMesh::Mask> AdaptiveMesh::mask(const PointTest& where,
                                              const Context& context) const {
  Mask inside(original_.positions.size());
  const bool complete = parallel_for(context, inside.size(), [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      inside[v] = where(original_.frame.origin + Vec3d(original_.positions[v]));
    }
  });
  if (!complete) return cancelled();
  return inside;
}

Result<void> AdaptiveMesh::refine(const PointTest& where, const Context& context) {
  return refine_to_error(where, -1, context);
}

Result<void> AdaptiveMesh::refine_to_error(const PointTest& where, double error,
                                           const Context& context) {
  const Result<Mask> inside = mask(where, context);
  if (!inside) return inside.error();
  undo_with_above([&](const Removal& r) {
    return (*inside)[r.vertex] && static_cast<double>(r.error) > error;
  });
  return {};
}

Result<void> AdaptiveMesh::reduce(const PointTest& where, const Context& context) {
  return reduce_to_error(where, std::numeric_limits<double>::infinity(), context);
}

Result<void> AdaptiveMesh::reduce_to_error(const PointTest& where, double error,
                                           const Context& context) {
  const Result<Mask> inside = mask(where, context);
  if (!inside) return inside.error();
  make_where([&](const Removal& r) {
    return (*inside)[r.vertex] && static_cast<double>(r.error) <= error;
  });
  return {};
}

Result<void> AdaptiveMesh::focus(const PointTest& where, const Focus& focus,
                                 const Context& context) {
  const Result<Mask> inside = mask(where, context);
  if (!inside) return inside.error();
  restore();
  const auto is_outside = [&](std::uint32_t t) {
    const auto [a, b, c] = original_.triangles[t];
    return !gone_[t] && !(*inside)[a] && !(*inside)[b] && !(*inside)[c];
  };
  const auto outside_of = [&](std::span<const std::uint32_t> triangles) {
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), is_outside));
  };
  std::size_t outside = 0;
  for (std::uint32_t t = 0; t < gone_.size(); ++t) outside += is_outside(t);
  for (std::uint32_t k = 0; k < log_.size(); ++k) {
    const auto error = static_cast<double>(log_[k].error);
    const bool allowed = (*inside)[log_[k].vertex]
                             ? focus.inside_error && error <= *focus.inside_error
                             : error <= focus.outside_error && outside > focus.outside_triangles;
    if (!allowed || !can_be_made(k)) continue;
    const auto star = order_.star(k).triangles;
    outside -= outside_of(star);
    make_removal(k);
    outside += outside_of(star);
  }
  return {};
}

double AdaptiveMesh::error() const {
  for (std::size_t k = log_.size(); k-- > 0;) {
    if (states_[k] == State::made) return static_cast<double>(log_[k].error);
  }
  return 0;
}

std::vector<std::uint32_t> AdaptiveMesh::vertices() const {
  std::vector<bool> there(original_.positions.size(), true);
  for (std::uint32_t k = 0; k < log_.size(); ++k) {
    if (states_[k] == State::made) there[log_[k].vertex] = false;
  }
  std::vector<std::uint32_t> result;
  result.reserve(vertex_count());
  for (std::uint32_t v = 0; v < there.size(); ++v) {
    if (there[v]) result.push_back(v);
  }
  return result;
}

/// Per vertex of the original the one that it has become.
std::vector<std::uint32_t> AdaptiveMesh::representatives() const {
  std::vector<std::uint32_t> result(original_.positions.size());
  for (std::uint32_t v = 0; v < result.size(); ++v) result[v] = v;
  // What a vertex went into was removed later, if at all.
  for (std::size_t k = log_.size(); k-- > 0;) {
    if (states_[k] == State::made) result[log_[k].vertex] = result[log_[k].into];
  }
  return result;
}

TriangleMesh AdaptiveMesh::mesh() const {
  const std::vector<std::uint32_t> kept = vertices();
  std::vector<std::uint32_t> renamed(original_.positions.size());
  for (std::uint32_t v = 0; v < kept.size(); ++v) renamed[kept[v]] = v;
  std::vector<std::uint32_t> left;
  left.reserve(triangle_count_);
  for (std::uint32_t t = 0; t < gone_.size(); ++t) {
    if (!gone_[t]) left.push_back(t);
  }
  TriangleMesh result{gather(original_.positions, kept),
                      gather(original_.triangles, left),
                      gather(original_.attributes, kept),
                      original_.frame,
                      {gather(original_.triangle_attributes.origin, left),
                       gather(original_.triangle_attributes.owner, left)}};
  for (Triangle& t : result.triangles) {
    for (std::uint32_t& v : t) v = renamed[v];
  }
  if (!result.triangle_attributes.owner.empty()) {
    const std::vector<std::uint32_t> become = representatives();
    for (std::uint32_t& v : result.triangle_attributes.owner) v = renamed[become[v]];
  }
  if (edited_ && !result.attributes.normals.empty()) {
    result.attributes.normals = vertex_normals(result);
  }
  return result;
}

void AdaptiveMesh::remember_detail() {
  if (!details_.empty()) return;
  const std::vector<State> before = states_;
  restore();
  details_.resize(log_.size());
  for (std::uint32_t k = 0; k < log_.size(); ++k) {
    if (before[k] == State::made) make_removal(k);
  }
}

void AdaptiveMesh::forget_detail() {
  details_ = {};
}

Result<void> AdaptiveMesh::set_positions(std::span<const Vec3f> positions) {
  if (positions.size() != vertex_count()) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} positions for {} vertices", positions.size(), vertex_count()),
                 {}};
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (is_finite(positions[v])) continue;
    return Error{ErrorCode::bad_geometry, fmt::format("position {} is not finite", v), {}};
  }
  const std::vector<std::uint32_t> kept = vertices();
  for (std::size_t v = 0; v < kept.size(); ++v) original_.positions[kept[v]] = positions[v];
  edited_ = true;
  return {};
}

}  // namespace burnish
