#include "burnish/adaptation/patch_deviation.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/tangent_frame.h"

namespace burnish {
namespace {

/// What a triangle must at least keep of its area along the direction of sight.
constexpr double kLeastCosine = 1e-3;
/// How far beyond the end of an edge a crossing counts, as a share of its length, and how much
/// farther where two edges are nearly parallel, so that rounding moves it: what is counted once too
/// often can only make the bound larger.
constexpr double kReach = 1e-9, kRounding = 1e-14;

bool has(const PatchDeviation::Corners& corners, std::uint32_t point) {
  return corners[0] == point || corners[1] == point || corners[2] == point;
}

}  // namespace

bool PatchDeviation::project() {
  const auto area = [this](const Corners& c) {
    return cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
  };
  Vec3d sum{};
  for (const Corners& c : after.triangles) sum += area(c);
  const Vec3d up = normalized(sum);
  for (const Patch* patch : {&before, &after}) {
    for (const Corners& c : patch->triangles) {
      const Vec3d a = area(c);
      if (!(dot(a, up) > kLeastCosine * norm(a))) return false;
    }
  }
  const TangentFrame frame(up);
  flat_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d p = points[i] - points[0];
    flat_[i] = {dot(p, frame.u), dot(p, frame.v), dot(p, up)};
  }
  return goes_round_once(before) && goes_round_once(after);
}

/// Triangles that are all seen from one side may still go around a point more than once.
bool PatchDeviation::goes_round_once(const Patch& patch) const {
  for (const std::uint32_t p : patch.inner) {
    int rounds = 0;
    for (const Corners& c : patch.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (c[i] != p) continue;
        const double y = flat_[p].y;
        rounds += flat_[c[(i + 1) % 3]].y < y && flat_[c[(i + 2) % 3]].y >= y;
      }
    }
    if (rounds > 1) return false;
  }
  return true;
}

void PatchDeviation::find_inner_edges(const Patch& patch, std::vector<InnerEdge>& edges) const {
  edges.clear();
  for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = patch.triangles[t][i], to = patch.triangles[t][(i + 1) % 3];
      for (std::uint32_t u = t + 1; u < patch.triangles.size(); ++u) {
        if (has(patch.triangles[u], from) && has(patch.triangles[u], to)) {
          edges.push_back({from, to, {t, u}});
        }
      }
    }
  }
}

void PatchDeviation::meet(std::uint32_t triangle_after, std::uint32_t triangle_before,
                          double distance) {
  double& inherited = inherited_[triangle_after];
  inherited = std::max(inherited, errors_before[triangle_before]);
  distances_[triangle_after] = std::max(distances_[triangle_after], distance);
}

void PatchDeviation::meet_along_outline() {
  for (std::uint32_t j = 0; j < after.triangles.size(); ++j) {
    for (std::uint32_t i = 0; i < before.triangles.size(); ++i) {
      const Corners& c = after.triangles[j];
      const int shared = has(before.triangles[i], c[0]) + has(before.triangles[i], c[1]) +
                         has(before.triangles[i], c[2]);
      if (shared >= 2) meet(j, i, 0);
    }
  }
}

void PatchDeviation::meet_at_crossings() {
  for (const InnerEdge& e : edges_before_) {
    const Point &a = flat_[e.from], &b = flat_[e.to];
    for (const InnerEdge& f : edges_after_) {
      if (e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to) continue;
      const Point &c = flat_[f.from], &d = flat_[f.to];
      const double ux = b.x - a.x, uy = b.y - a.y, vx = d.x - c.x, vy = d.y - c.y;
      const double denominator = ux * vy - uy * vx;
      if (denominator == 0) continue;
      const double wx = c.x - a.x, wy = c.y - a.y;
      const double s = (wx * vy - wy * vx) / denominator, t = (wx * uy - wy * ux) / denominator;
      const double lengths = std::sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy));
      const double reach = kReach + kRounding * lengths / std::abs(denominator);
      if (s < -reach || s > 1 + reach || t < -reach || t > 1 + reach) continue;
      const double distance =
          std::abs(a.height + s * (b.height - a.height) - (c.height + t * (d.height - c.height)));
      for (const std::uint32_t j : f.triangles) {
        for (const std::uint32_t i : e.triangles) meet(j, i, distance);
      }
    }
  }
}

bool PatchDeviation::meet_at_inner_points() {
  /// The triangle of `patch` over or under `p` and how far it is.
  struct Found {
    std::uint32_t triangle = 0;
    double inside = -1e300, distance = 0;
  };
  const auto find = [this](const Patch& patch, const Point& p) {
    Found found;
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
      const Corners& corners = patch.triangles[t];
      const Point &a = flat_[corners[0]], &b = flat_[corners[1]], &c = flat_[corners[2]];
      const auto twice_area = [](const Point& q, const Point& r, const Point& s) {
        return (r.x - q.x) * (s.y - q.y) - (r.y - q.y) * (s.x - q.x);
      };
      const double all = twice_area(a, b, c);
      const double u = twice_area(p, b, c) / all, v = twice_area(a, p, c) / all;
      const double inside = std::min({u, v, 1 - u - v});
      if (inside > found.inside) {
        const double height = u * a.height + v * b.height + (1 - u - v) * c.height;
        found = {t, inside, std::abs(p.height - height)};
      }
    }
    return found;
  };
  constexpr double kLeastInside = -1e-6;
  for (const std::uint32_t p : before.inner) {
    const Found found = find(after, flat_[p]);
    if (found.inside < kLeastInside) return false;
    for (std::uint32_t i = 0; i < before.triangles.size(); ++i) {
      if (has(before.triangles[i], p)) meet(found.triangle, i, found.distance);
    }
  }
  for (const std::uint32_t p : after.inner) {
    const Found found = find(before, flat_[p]);
    if (found.inside < kLeastInside) return false;
    for (std::uint32_t j = 0; j < after.triangles.size(); ++j) {
      if (has(after.triangles[j], p)) meet(j, found.triangle, found.distance);
    }
  }
  return true;
}

bool PatchDeviation::lay_over() {
  if (!project()) return false;
  inherited_.assign(after.triangles.size(), 0);
  distances_.assign(after.triangles.size(), 0);
  find_inner_edges(before, edges_before_);
  find_inner_edges(after, edges_after_);
  meet_along_outline();
  meet_at_crossings();
  return meet_at_inner_points();
}

double PatchDeviation::longest_edge() const {
  double longest = 0;
  for (const Patch* patch : {&before, &after}) {
    for (const Corners& c : patch->triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        longest = std::max(longest, norm(points[c[i]] - points[c[(i + 1) % 3]]));
      }
    }
  }
  return longest;
}

std::span<const double> PatchDeviation::errors_after() {
  if (lay_over()) {
    sums_.resize(after.triangles.size());
    for (std::size_t j = 0; j < sums_.size(); ++j) sums_[j] = inherited_[j] + distances_[j];
  } else {
    const double largest = *std::max_element(errors_before.begin(), errors_before.end());
    sums_.assign(after.triangles.size(), largest + longest_edge());
  }
  return sums_;
}

}  // namespace burnish
