#include "burnish/adaptation/decimation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// What became of a vertex since the costs were found.
constexpr std::uint8_t kMerged = 1;       ///< its quadric is another: costs of its edges are stale
constexpr std::uint8_t kRingChanged = 2;  ///< what could not collapse may be able to now

/// The weight of a triangle's corners beside that of its plane: keeps triangles compact where
/// planes leave a place open.
constexpr double kCornerWeight = 1e-6;
/// The weight of a plane across the surface along a boundary, of the square of the edge's length.
constexpr double kBoundaryWeight = 10;
/// The cosine of how far a triangle may turn.
constexpr double kLeastCosine = 0.2;
/// The share of the vertices that go in a round: fewer come closer to the order of their costs,
/// more take fewer rounds.
constexpr double kRound = 0.3;

}  // namespace

Decimation::Decimation(const TriangleMesh& mesh, Placement placement,
                       std::optional<DeviationBound> bound)
    : half_edges_(mesh.positions.size(), mesh.triangles),
      placement_(placement),
      bound_(std::move(bound)),
      positions_(mesh.positions.begin(), mesh.positions.end()),
      quadrics_(mesh.positions.size(), Quadric{}),
      costs_(3 * mesh.triangles.size(), 0.f),
      state_(mesh.positions.size(), kMerged),
      numbers_(mesh.triangles.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  if (!mesh.positions.empty()) add_triangle_quadrics(mesh);
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

Decimation::Candidate Decimation::best(Index h) const {
  const Index a = half_edges_.origin(h), b = half_edges_.head(h);
  const HalfEdges::Merge may = half_edges_.ends_that_may_go(h);
  Candidate best{std::numeric_limits<double>::infinity(), {}, false};
  if (!may.possible()) return best;
  const Quadric q = quadrics_[a] + quadrics_[b];
  const bool inner = half_edges_.kind(a) == HalfEdges::Kind::inner &&
                     half_edges_.kind(b) == HalfEdges::Kind::inner;
  if (placement_ == Placement::optimal && inner) {
    const Vec3d at = q.least();
    best = {std::max(0., q(at)), static_cast<Vec3f>(at + centre_), false};
    if (is_finite(best.position)) return best;
    best.cost = std::numeric_limits<double>::infinity();
  }
  if (may.origin_may_go) {
    best = {std::max(0., q(place(b) - centre_)), positions_[b], false};
  }
  if (may.head_may_go) {
    const double cost = std::max(0., q(place(a) - centre_));
    if (cost < best.cost) best = {cost, positions_[a], true};
  }
  return best;
}

/// Of every edge whose ends have changed.
bool Decimation::find_costs(const Context& context) {
  return parallel_for(context, half_edges_.triangles(), [this](IndexRange range) {
    for (std::size_t t = range.begin; t < range.end; ++t) {
      if (!half_edges_.is_live(t)) continue;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index twin = half_edges_.twin(h);
        if (twin < h) continue;  // kNone is the largest
        const std::uint8_t changed = state_[half_edges_.origin(h)] | state_[half_edges_.head(h)];
        if ((changed & kMerged) || (changed && costs_[h] == kNever)) {
          costs_[h] = static_cast<float>(best(h).cost);
        }
      }
    }
  });
}

/// At least the `count` cheapest edges, in order; fewer only where there are no more.
std::vector<Decimation::Choice> Decimation::cheapest(std::size_t count) {
  // Positive floats are ordered as their bits are.
  const auto drawer_of = [](float cost) { return std::bit_cast<std::uint32_t>(cost) >> 18; };
  std::vector<std::uint32_t> drawers(drawer_of(kNever) + 1, 0);
  const auto visit = [this](auto use) {
    for (std::size_t t = 0; t < half_edges_.triangles(); ++t) {
      if (!half_edges_.is_live(t)) continue;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (half_edges_.twin(h) > h && costs_[h] != kNever) use(h);
      }
    }
  };
  visit([&](Index h) { ++drawers[drawer_of(costs_[h])]; });
  std::uint32_t last = 0;
  for (std::size_t sum = 0; last + 1 < drawers.size() && (sum += drawers[last]) < count;) ++last;
  std::vector<Choice> chosen;
  visit([&](Index h) {
    if (drawer_of(costs_[h]) <= last) chosen.push_back({costs_[h], h});
  });
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

bool Decimation::folds(Index h, const Candidate& candidate) const {
  const Index a = half_edges_.origin(h), b = half_edges_.head(h);
  const Vec3d to = static_cast<Vec3d>(candidate.position);
  const bool a_moves = candidate.position != positions_[a];
  const bool b_moves = candidate.position != positions_[b];
  return (a_moves && folds_around(a, b, to)) || (b_moves && folds_around(b, a, to));
}

bool Decimation::try_collapse(Index h) {
  const Candidate candidate = best(h);
  if (!half_edges_.keeps_surface(h) || folds(h, candidate)) return false;
  const Collapse collapse{h, candidate.head_goes, candidate.position};
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
  shares_.push_back(static_cast<float>(std::clamp(share, 0., 1.)));
  removals_.push_back({goes, stays, bound_ ? static_cast<float>(bound_->largest()) : 0.f});

  half_edges_.collapse(collapse.half_edge, collapse.head_goes);
  positions_[stays] = collapse.position;
  quadrics_[stays] += quadrics_[goes];
  state_[stays] |= kMerged;
  half_edges_.for_each_from(stays, [&](Index from) {
    state_[half_edges_.head(from)] |= kRingChanged;
    state_[half_edges_.apex(from)] |= kRingChanged;
  });
}

void Decimation::compact() {
  const LargeVector<Index> kept = half_edges_.compact();
  for (std::size_t t = 0; t < kept.size(); ++t) {
    numbers_[t] = numbers_[kept[t]];
    for (std::size_t i = 0; i < 3; ++i) costs_[3 * t + i] = costs_[3 * std::size_t{kept[t]} + i];
  }
  numbers_.resize(kept.size());
  costs_.resize(3 * kept.size());
  if (bound_) bound_->compact(kept);
}

std::vector<Triangle> Decimation::triangles_left() const {
  std::vector<Triangle> left(half_edges_.triangles());
  for (std::size_t t = 0; t < left.size(); ++t) left[t] = half_edges_.triangle(t);
  return left;
}

Result<void> Decimation::run(std::size_t target, const Context& context) {
  const std::size_t before = triangles();
  Context quiet = context;
  quiet.sink = nullptr;
  while (triangles() > target) {
    if (!find_costs(quiet)) return cancelled();
    std::fill(state_.begin(), state_.end(), 0);
    const std::size_t wanted = std::min<std::size_t>(
        std::max<std::size_t>(1, static_cast<std::size_t>(triangles() / 2. * kRound)),
        triangles() - target);
    const std::size_t start = triangles();
    for (const Choice& choice : cheapest(wanted)) {
      const Index h = choice.edge;
      if (!half_edges_.is_live(h / 3)) continue;
      if ((state_[half_edges_.origin(h)] | state_[half_edges_.head(h)]) & kMerged) continue;
      if (!try_collapse(h)) costs_[h] = kNever;
      if (triangles() <= target) break;
    }
    if (triangles() == start) break;
    if (triangles() < half_edges_.triangles() / 2) compact();
    context.progress(static_cast<double>(before - triangles()) /
                     static_cast<double>(before - target));
    if (context.cancelled()) return cancelled();
  }
  compact();
  return {};
}

}  // namespace burnish
