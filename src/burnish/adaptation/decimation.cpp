#include "burnish/adaptation/decimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

// What became of a vertex since the costs were found.
constexpr std::uint8_t kMerged = 1;       ///< its quadric is another: costs of its edges are stale
constexpr std::uint8_t kRingChanged = 2;  ///< what could not collapse may be able to now

constexpr float kAnyCost = std::numeric_limits<float>::max();

/// The weight of a triangle's corners beside that of its plane: keeps triangles compact where
/// planes leave a place open.
constexpr double kCornerWeight = 1e-6;
/// The weight of a plane across the surface along a boundary, of the square of the edge's length.
constexpr double kBoundaryWeight = 10;
/// The share of the planes around a vertex, beside those that it remembers.
constexpr double kPresent = 0.9;
/// The cosine of how far a triangle may turn.
constexpr double kLeastCosine = 0.2;
/// The share of the vertices that go in a round: fewer come closer to the order of their costs,
/// more take fewer rounds.
constexpr double kRound = 0.5;

}  // namespace

Result<void> check_decimated(const TriangleMesh& mesh) {
  constexpr std::size_t kMostTriangles = (HalfEdges::kNone - 2) / 3;
  if (mesh.triangles.size() > kMostTriangles) {
    return Error{ErrorCode::unsupported,
                 fmt::format("{} triangles are more than the {} whose half-edges can be numbered",
                             mesh.triangles.size(), kMostTriangles),
                 {}};
  }
  return check(mesh);
}

Decimation::Decimation(const TriangleMesh& mesh, Placement placement,
                       std::optional<DeviationBound> bound, const Context& context)
    : half_edges_(mesh.positions.size(), mesh.triangles, context),
      placement_(placement),
      bound_(std::move(bound)),
      positions_(mesh.positions.begin(), mesh.positions.end()),
      quadrics_(mesh.positions.size(), Quadric{}),
      costs_(3 * mesh.triangles.size()),
      stale_(3 * mesh.triangles.size(), false),
      state_(mesh.positions.size(), 0),
      numbers_(mesh.triangles.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  if (!mesh.positions.empty() && !context.cancelled()) add_triangle_quadrics(mesh);
}

void Decimation::add_triangle_quadrics(const TriangleMesh& mesh) {
  Vec3d low = place(0), high = low;
  for (const Vec3f& p : positions_) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min<double>(low[i], p[i]);
      high[i] = std::max<double>(high[i], p[i]);
    }
  }
  centre_ = (low + high) * .5;
  diagonal_ = norm(high - low);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d corners[] = {place(a) - centre_, place(b) - centre_, place(c) - centre_};
    const Vec3d twice_area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = norm(twice_area);
    if (length == 0) continue;
    const Vec3d n = twice_area / length;
    const Quadric plane = Quadric::plane(n, dot(n, corners[0]), length / 2);
    for (std::size_t i = 0; i < 3; ++i) {
      quadrics_[mesh.triangles[t][i]] +=
          plane + Quadric::point(corners[i], length / 2 * kCornerWeight);
    }
    for (Index i = 0; i < 3; ++i) {
      if (half_edges_.twin(3 * t + i) != HalfEdges::kNone) continue;
      const Vec3d edge = corners[(i + 1) % 3] - corners[i];
      const Vec3d outwards = normalized(cross(edge, n));
      const Quadric wall =
          Quadric::plane(outwards, dot(outwards, corners[i]), kBoundaryWeight * squared_norm(edge));
      quadrics_[mesh.triangles[t][i]] += wall;
      quadrics_[mesh.triangles[t][(i + 1) % 3]] += wall;
    }
  }
}

bool Decimation::places_freely(Index h) const {
  return placement_ == Placement::optimal &&
         half_edges_.kind(half_edges_.origin(h)) == HalfEdges::Kind::inner &&
         half_edges_.kind(half_edges_.head(h)) == HalfEdges::Kind::inner;
}

/// Which end should rather go, if one may.
Decimation::End Decimation::end_that_goes(Index h) const {
  const Index a = half_edges_.origin(h), b = half_edges_.head(h);
  const HalfEdges::Merge may = half_edges_.ends_that_may_go(h);
  const Quadric q = quadrics_[a] + quadrics_[b];
  End end{std::numeric_limits<double>::infinity(), false};
  if (may.origin_may_go) end = {std::max(0., q(place(b) - centre_)), false};
  if (may.head_may_go) {
    const double cost = std::max(0., q(place(a) - centre_));
    if (cost < end.cost) end = {cost, true};
  }
  return end;
}

float Decimation::cost_of(Index h) const {
  if (!places_freely(h)) return static_cast<float>(end_that_goes(h).cost);
  const Quadric q = quadrics_[half_edges_.origin(h)] + quadrics_[half_edges_.head(h)];
  const double cost = q(q.least());
  return std::isfinite(cost) ? static_cast<float>(std::max(0., cost)) : kNever;
}

/// Of all edges.
bool Decimation::find_costs(const Context& context) {
  return parallel_for(context, costs_.size(), [this](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto h = static_cast<Index>(i);
      const bool stands_for_edge = half_edges_.twin(h) > h;  // kNone is the largest
      costs_[h] = stands_for_edge ? cost_of(h) : kNever;
    }
  });
}

/// A cost that about `count` edges do not exceed: some of them are looked at, chosen by the last
/// bits of their costs, so that it does not matter in what order the edges come.
float Decimation::cost_of_cheapest(std::size_t count) const {
  constexpr std::uint32_t kOneIn = 16;
  // Here and below all are written and few are kept: a branch that cannot be foretold takes longer.
  LargeVector<float> some(costs_.size());
  std::size_t found = 0;
  for (const float cost : costs_) {
    some[found] = cost;
    const bool in_sample = std::bit_cast<std::uint32_t>(cost) % kOneIn == 0;
    found += in_sample & (cost >= 0) & (cost != kNever);
  }
  const std::size_t rank = count / kOneIn;
  if (rank >= found) return kAnyCost;
  const auto at = [&some](std::size_t i) { return some.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(some.begin(), at(rank), at(found));
  return some[rank];
}

/// Finds the costs of `edges` that are not known any more.
bool Decimation::renew_costs(std::span<const Index> edges, const Context& context) {
  return parallel_for(context, edges.size(), [&](IndexRange range) {
    for (const Index h : edges.subspan(range.begin, range.end - range.begin)) {
      const bool hindered = costs_[h] == kHindered;
      if (hindered && !state_[half_edges_.origin(h)] && !state_[half_edges_.head(h)]) continue;
      if (hindered || stale_[h]) costs_[h] = cost_of(h);
      stale_[h] = false;
    }
  });
}

/// The edges that cost no more than `limit`, in order. What an edge cost before one of its ends was
/// merged is hardly ever more than what it costs now: such costs are found anew only once they are
/// among the cheapest.
Result<std::vector<Decimation::Choice>> Decimation::cheapest(float limit, const Context& context) {
  LargeVector<Index> edges(costs_.size());
  std::size_t found = 0;
  for (Index h = 0; h < costs_.size(); ++h) {
    edges[found] = h;
    found += costs_[h] <= limit;
  }
  edges.resize(found);
  if (!renew_costs(edges, context)) return cancelled();
  std::vector<Choice> chosen;
  chosen.reserve(edges.size());
  for (const Index h : edges) {
    if (costs_[h] != kHindered && costs_[h] <= limit) chosen.push_back({costs_[h], h});
  }
  std::sort(chosen.begin(), chosen.end(), [](const Choice& x, const Choice& y) {
    return x.cost != y.cost ? x.cost < y.cost : x.edge < y.edge;
  });
  return chosen;
}

bool Decimation::folds_around(Index v, Index other, const Vec3d& moved_to) const {
  bool folds = false;
  const Vec3d at = place(v);
  half_edges_.for_each_from(v, [&](Index h) {
    const Index x = half_edges_.head(h), y = half_edges_.apex(h);
    if (x == other || y == other || folds) return;
    const Vec3d px = place(x), py = place(y);
    const Vec3d before = cross(px - at, py - at), after = cross(px - moved_to, py - moved_to);
    const double lengths = std::sqrt(squared_norm(before) * squared_norm(after));
    folds = !(dot(before, after) > kLeastCosine * lengths);
  });
  return folds;
}

bool Decimation::folds(const Collapse& collapse) const {
  const Index a = half_edges_.origin(collapse.half_edge), b = half_edges_.head(collapse.half_edge);
  const Vec3d to = static_cast<Vec3d>(collapse.position);
  const bool a_moves = collapse.position != positions_[a];
  const bool b_moves = collapse.position != positions_[b];
  return (a_moves && folds_around(a, b, to)) || (b_moves && folds_around(b, a, to));
}

/// The plane of the triangle of `h` and, with little weight, its centre.
Quadric Decimation::quadric_of(Index h, Vec3d& area, double& volume) const {
  const Vec3d x = place(half_edges_.origin(h)) - centre_;
  const Vec3d y = place(half_edges_.head(h)) - centre_;
  const Vec3d z = place(half_edges_.apex(h)) - centre_;
  const Vec3d twice_area = cross(y - x, z - x);
  area += twice_area;
  volume += dot(twice_area, x);
  const double length = norm(twice_area);
  if (length == 0) return {};
  return Quadric::plane(twice_area / length, dot(twice_area, x) / length, length / 2) +
         Quadric::point((x + y + z) / 3., length / 2 * kCornerWeight);
}

/// Where the ends of an inner edge become one: nearest to the planes of the triangles around them
/// as they are now, of all places that leave the volume under the surface what it is (Lindstrom and
/// Turk 1998, section 4). Planes of triangles that are gone would draw it outwards of what is
/// round.
Decimation::Place Decimation::place_keeping_volume(Index h) const {
  const Index a = half_edges_.origin(h), b = half_edges_.head(h);
  Vec3d area{};
  double volume = 0;
  Quadric around{};
  half_edges_.for_each_from(a, [&](Index from) { around += quadric_of(from, area, volume); });
  half_edges_.for_each_from(b, [&](Index from) {
    if (half_edges_.head(from) == a || half_edges_.apex(from) == a) return;
    around += quadric_of(from, area, volume);
  });
  const Vec3d at = around.least_on(area, volume);
  return {static_cast<Vec3f>(at + centre_), static_cast<float>(around(at))};
}

/// What the two ends of a collapsed edge stood for, and what is around the vertex that they became:
/// the first alone remembers planes where no surface is, the second alone forgets how far it is
/// from where it began.
Quadric Decimation::quadric_after(Index stays, const Quadric& remembered) const {
  if (half_edges_.kind(stays) != HalfEdges::Kind::inner) return remembered;
  Vec3d area{};
  double volume = 0;
  Quadric around{};
  half_edges_.for_each_from(stays, [&](Index h) { around += quadric_of(h, area, volume); });
  return around * kPresent + remembered * (1 - kPresent);
}

/// Whether the planes around are farther from where they would meet, in the mean, than the bound
/// may become for now: there is no need to look closer then.
bool Decimation::is_beyond_step(Index h) const {
  if (step_ == std::numeric_limits<double>::infinity()) return false;
  const Quadric q = quadrics_[half_edges_.origin(h)] + quadrics_[half_edges_.head(h)];
  const double weight = q.xx + q.yy + q.zz;
  return costs_[h] > weight * step_ * step_;
}

/// An edge whose place costs more than `limit` waits with that as its cost. Where a bound is kept
/// an end is a second choice: the surface moves less then.
Decimation::Try Decimation::try_collapse(Index h, float limit) {
  if (is_beyond_step(h) || !half_edges_.keeps_surface(h)) return Try::hindered;
  if (places_freely(h)) {
    const Place place = place_keeping_volume(h);
    if (place.cost > limit) {
      costs_[h] = place.cost;
      return Try::dearer;
    }
    if (make_if_allowed({h, false, place.position})) return Try::made;
    if (!bound_) return Try::hindered;
  }
  const bool head_goes = end_that_goes(h).head_goes;
  const Index stays = head_goes ? half_edges_.origin(h) : half_edges_.head(h);
  return make_if_allowed({h, head_goes, positions_[stays]}) ? Try::made : Try::hindered;
}

bool Decimation::make_if_allowed(const Collapse& collapse) {
  if (folds(collapse)) return false;
  if (bound_ && !bound_->accept(half_edges_, positions_, collapse)) return false;
  make(collapse);
  return true;
}

void Decimation::make(const Collapse& collapse) {
  const Index a = half_edges_.origin(collapse.half_edge), b = half_edges_.head(collapse.half_edge);
  const Index goes = collapse.head_goes ? b : a, stays = collapse.head_goes ? a : b;
  const Vec3d along = place(goes) - place(stays);
  const double length = squared_norm(along);
  const double share =
      length > 0 ? dot(static_cast<Vec3d>(collapse.position) - place(stays), along) / length : 0;
  // 0 says that nothing has moved; a place beside the edge may be beside its very end.
  const bool moved = collapse.position != positions_[stays];
  const float least = moved ? std::numeric_limits<float>::min() : 0.f;
  shares_.push_back(std::clamp(static_cast<float>(share), least, 1.f));
  removals_.push_back({goes, stays, bound_ ? static_cast<float>(bound_->largest()) : 0.f});

  join_costs(collapse.half_edge);
  half_edges_.collapse(collapse.half_edge, collapse.head_goes);
  positions_[stays] = collapse.position;
  quadrics_[stays] = quadric_after(stays, quadrics_[stays] + quadrics_[goes]);
  state_[stays] |= kMerged;
  half_edges_.for_each_from(stays, [&](Index from) {
    state_[half_edges_.head(from)] |= kRingChanged;
    state_[half_edges_.apex(from)] |= kRingChanged;
    stale_[std::min(from, half_edges_.twin(from))] = true;
    const Index into = HalfEdges::previous(from);
    stale_[std::min(into, half_edges_.twin(into))] = true;
  });
}

/// Of two edges that become one the lower cost stays, at the smaller of the half-edges left.
void Decimation::join_costs(Index collapsing) {
  for (const Index side : {collapsing, half_edges_.twin(collapsing)}) {
    if (side == HalfEdges::kNone) continue;
    const Index x = HalfEdges::next(side), y = HalfEdges::previous(side);
    const Index beyond_x = half_edges_.twin(x), beyond_y = half_edges_.twin(y);
    const float cost = std::min(costs_[std::min(x, beyond_x)], costs_[std::min(y, beyond_y)]);
    for (const Index h : {side, x, y}) costs_[h] = kNever;
    costs_[std::min(beyond_x, beyond_y)] = cost;
    if (beyond_x != HalfEdges::kNone && beyond_y != HalfEdges::kNone) {
      costs_[std::max(beyond_x, beyond_y)] = kNever;
    }
  }
}

void Decimation::compact() {
  const LargeVector<Index> kept = half_edges_.compact();
  for (std::size_t t = 0; t < kept.size(); ++t) {
    numbers_[t] = numbers_[kept[t]];
    for (std::size_t i = 0; i < 3; ++i) {
      costs_[3 * t + i] = costs_[3 * std::size_t{kept[t]} + i];
      stale_[3 * t + i] = stale_[3 * std::size_t{kept[t]} + i];
    }
  }
  numbers_.resize(kept.size());
  costs_.resize(3 * kept.size());
  stale_.resize(3 * kept.size());
  if (bound_) bound_->compact(kept);
}

std::vector<Triangle> Decimation::triangles_left() const {
  std::vector<Triangle> left(half_edges_.triangles());
  for (std::size_t t = 0; t < left.size(); ++t) left[t] = half_edges_.triangle(t);
  return left;
}

/// Collapses the edges that were chosen, but for those whose costs an earlier one has changed.
void Decimation::collapse_all(const std::vector<Choice>& chosen, float limit, std::size_t target,
                              const Context& context) {
  constexpr std::size_t kBetweenLooks = 1024;
  for (std::size_t i = 0; i < chosen.size() && triangles() > target; ++i) {
    if (i % kBetweenLooks == 0 && context.cancelled()) return;
    const Index h = chosen[i].edge;
    if (!half_edges_.is_live(h / 3)) continue;
    if ((state_[half_edges_.origin(h)] | state_[half_edges_.head(h)]) & kMerged) continue;
    if (try_collapse(h, limit) == Try::hindered) costs_[h] = kHindered;
  }
}

Result<void> Decimation::run(std::size_t target, const Context& context) {
  const std::size_t before = triangles();
  Context quiet = context;
  quiet.sink = nullptr;
  if (!find_costs(quiet)) return cancelled();
  while (triangles() > target) {
    const auto round = static_cast<std::size_t>(static_cast<double>(triangles()) / 2 * kRound);
    const float limit = cost_of_cheapest(std::clamp<std::size_t>(round, 1, triangles() - target));
    const auto chosen = cheapest(limit, quiet);
    if (!chosen) return chosen.error();
    if (chosen->empty() && limit == kAnyCost) break;
    std::fill(state_.begin(), state_.end(), 0);
    collapse_all(*chosen, limit, target, context);
    if (triangles() < half_edges_.triangles() / 2) compact();
    context.progress(static_cast<double>(before - triangles()) /
                     static_cast<double>(before - target));
    if (context.cancelled()) return cancelled();
  }
  compact();
  return {};
}

Result<void> Decimation::run_by_error(std::size_t target, const Context& context) {
  constexpr double kFirst = 1e-6, kGrowth = 1.5;  // of the diagonal
  const std::size_t before = triangles();
  Context quiet = context;
  quiet.sink = nullptr;
  for (double step = kFirst; triangles() > target; step *= kGrowth) {
    const bool last = step > 1;
    step_ = last ? std::numeric_limits<double>::infinity() : step * diagonal_;
    bound_->set_limits(static_cast<float>(step_));
    if (auto done = run(target, quiet); !done) return done;
    context.progress(static_cast<double>(before - triangles()) /
                     static_cast<double>(before - target));
    if (last) break;
  }
  return {};
}

}  // namespace burnish
