#include "burnish/adaptation/deviation_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                         : nearest;
}

/// The other neighbour along the boundary of `v`, which lies on one that leads to `one`.
HalfEdges::Index other_along_boundary(const HalfEdges& half_edges, HalfEdges::Index v,
                                      HalfEdges::Index one) {
  HalfEdges::Index first = HalfEdges::kNone, last = HalfEdges::kNone;
  half_edges.for_each_from(v, [&](HalfEdges::Index h) {
    if (first == HalfEdges::kNone) first = half_edges.head(h);
    last = half_edges.apex(h);
  });
  return first == one ? last : first;
}

/// The triangle next to the only one that the vertex `v` has.
HalfEdges::Index beyond_ear(const HalfEdges& half_edges, HalfEdges::Index v) {
  HalfEdges::Index beyond = HalfEdges::kNone;
  half_edges.for_each_from(
      v, [&](HalfEdges::Index h) { beyond = half_edges.twin(HalfEdges::next(h)) / 3; });
  return beyond;
}

}  // namespace

std::uint32_t DeviationBound::point_of(Index v, const LargeVector<Vec3f>& positions) {
  const auto found = std::find(vertices_.begin(), vertices_.end(), v);
  const auto index = static_cast<std::uint32_t>(found - vertices_.begin());
  if (found == vertices_.end()) {
    vertices_.push_back(v);
    patch_.points.push_back(static_cast<Vec3d>(positions[v]));
  }
  return index;
}

/// The triangles around `v`, but for those that `beside`, whose star is there already, has too.
void DeviationBound::take_star(const HalfEdges& half_edges, const LargeVector<Vec3f>& positions,
                               Index v, Index beside) {
  half_edges.for_each_from(v, [&](Index h) {
    const Index x = half_edges.head(h), y = half_edges.apex(h);
    if (x == beside || y == beside) return;
    old_triangles_.push_back(h / 3);
    patch_.before.triangles.push_back(
        {point_of(v, positions), point_of(x, positions), point_of(y, positions)});
    patch_.errors_before.push_back(errors_[h / 3]);
  });
}

bool DeviationBound::accept(const HalfEdges& half_edges, const LargeVector<Vec3f>& positions,
                            const Collapse& collapse) {
  const Index h = collapse.half_edge;
  const Index goes = collapse.head_goes ? half_edges.head(h) : half_edges.origin(h);
  const Index stays = collapse.head_goes ? half_edges.origin(h) : half_edges.head(h);
  const bool moves = collapse.position != positions[stays];
  vertices_.clear();
  old_triangles_.clear();
  new_triangles_.clear();
  patch_.points.clear();
  patch_.errors_before.clear();
  for (PatchDeviation::Patch* patch : {&patch_.before, &patch_.after}) {
    patch->triangles.clear();
    patch->inner.clear();
  }

  const std::uint32_t from = point_of(goes, positions), to = point_of(stays, positions);
  take_star(half_edges, positions, goes, HalfEdges::kNone);
  patch_.before.inner.push_back(from);
  if (moves) {
    take_star(half_edges, positions, stays, goes);
    patch_.before.inner.push_back(to);
  } else if (half_edges.kind(goes) == HalfEdges::Kind::boundary) {
    // The surface is pulled onto the new boundary first; what lies inside is compared then.
    const Vec3d pulled = closest_on_segment(
        patch_.points[from], patch_.points[to],
        static_cast<Vec3d>(positions[other_along_boundary(half_edges, goes, stays)]));
    const double distance = norm(pulled - patch_.points[from]);
    for (double& error : patch_.errors_before) error += distance;
    patch_.points[from] = pulled;
  }

  const auto merged = static_cast<std::uint32_t>(patch_.points.size());
  if (moves) {
    patch_.points.push_back(static_cast<Vec3d>(collapse.position));
    patch_.after.inner.push_back(merged);
  }
  for (std::size_t i = 0; i < old_triangles_.size(); ++i) {
    PatchDeviation::Corners corners = patch_.before.triangles[i];
    const auto holds = [&corners](std::uint32_t p) {
      return std::find(corners.begin(), corners.end(), p) != corners.end();
    };
    if (holds(from) && holds(to)) continue;
    for (std::uint32_t& corner : corners) {
      if (corner == from || (moves && corner == to)) corner = moves ? merged : to;
    }
    patch_.after.triangles.push_back(corners);
    new_triangles_.push_back(old_triangles_[i]);
  }

  // An ear goes without leaving a triangle: the one beyond its inner edge stands for it then.
  std::span<const double> errors;
  double ear = 0;
  if (new_triangles_.empty()) {
    const Index beyond = beyond_ear(half_edges, goes);
    old_triangles_.push_back(beyond);
    new_triangles_.push_back(beyond);
    ear = std::max<double>(errors_[beyond], patch_.errors_before.front());
    errors = {&ear, 1};
  } else {
    errors = patch_.errors_after();
  }
  float limit = std::numeric_limits<float>::infinity();
  for (const Index t : old_triangles_) limit = std::min(limit, limits_[t]);
  for (const double error : errors) {
    if (!(rounded_up(error) <= limit)) return false;
  }
  for (std::size_t j = 0; j < errors.size(); ++j) {
    errors_[new_triangles_[j]] = rounded_up(errors[j]);
    limits_[new_triangles_[j]] = limit;
    largest_ = std::max<double>(largest_, errors_[new_triangles_[j]]);
  }
  return true;
}

void DeviationBound::compact(const LargeVector<HalfEdges::Index>& kept) {
  for (std::size_t t = 0; t < kept.size(); ++t) {
    errors_[t] = errors_[kept[t]];
    limits_[t] = limits_[kept[t]];
  }
  errors_.resize(kept.size());
  limits_.resize(kept.size());
}

}  // namespace burnish
