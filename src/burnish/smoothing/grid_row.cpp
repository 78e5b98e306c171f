#include "burnish/smoothing/grid_row.h"

#include <limits>

namespace burnish {
namespace {

/// The places around a pixel in the order of GridRings: pixels away from it.
std::array<std::ptrdiff_t, 8> places(const Planes& planes) {
  const auto row = static_cast<std::ptrdiff_t>(planes.stride());
  return {-row - 1, -row, -row + 1, -1, 1, row - 1, row, row + 1};
}

/// What a mask says: how many neighbours there are, and at which places the first of them are.
struct Ring {
  std::uint8_t count = 0;
  std::array<std::uint8_t, 8> places{};
};
constexpr std::array<Ring, 256> kRings = [] {
  std::array<Ring, 256> rings{};
  for (std::size_t mask = 0; mask < 256; ++mask) {
    Ring& ring = rings[mask];
    for (std::uint8_t k = 0; k < 8; ++k) {
      if ((mask >> k & 1) != 0) ring.places[ring.count++] = k;
    }
  }
  return rings;
}();

/// One vertex, by the operation's own arithmetic.
void move_one(const Planes& now, Planes& next, std::uint8_t mask, std::size_t y, std::size_t x,
              const Equation1& weigh, double hold) {
  static constexpr std::array<std::uint32_t, 8> kNumbers{0, 1, 2, 3, 4, 5, 6, 7};
  const double *px = now.row(0, y) + x, *py = now.row(1, y) + x, *pz = now.row(2, y) + x;
  const auto around = places(now);
  const Ring& ring = kRings[mask];
  std::array<Vec3d, 9> positions;
  for (std::size_t i = 0; i < 8; ++i) {  // all: how many there are cannot be foretold
    const std::ptrdiff_t place = around[ring.places[i]];
    positions[i] = {px[place], py[place], pz[place]};
  }
  const Vec3d centre = positions[8] = {*px, *py, *pz};
  const WeightedSum all = weigh.sum(positions.data(), 8, {kNumbers.data(), ring.count});
  const Vec3d moved = (1 - hold) * (all.sum / all.weight) + hold * centre;
  for (std::size_t axis = 0; axis < 3; ++axis) next.row(axis, y)[x] = moved[axis];
}

}  // namespace

void move_one_by_one(const Planes& now, Planes& next, const std::uint8_t* masks, std::size_t y,
                     std::size_t width, const Equation1& weigh, double hold) {
  for (std::size_t x = 0; x < width; ++x) {
    if (masks[x] != 0) {
      move_one(now, next, masks[x], y, x, weigh, hold);
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis) next.row(axis, y)[x] = now.row(axis, y)[x];
    }
  }
}

}  // namespace burnish

#if defined(__x86_64__)
// Four pixels at a time, all eight places around them whether they are neighbours or not: nothing
// that cannot be foretold decides about a branch. The arithmetic of each lane is Equation1's; lanes
// that may have a tie to settle are done by themselves.
#define BURNISH_AVX2 __attribute__((target("avx2")))

namespace burnish {
namespace {

static_assert(Planes::kLanes == 4);
typedef double Lanes __attribute__((vector_size(32)));
typedef double Unaligned __attribute__((vector_size(32), aligned(8), may_alias));
typedef std::int64_t Masks __attribute__((vector_size(32)));  ///< a lane is all ones, or 0

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Who only asks whether there may be a tie asks for a little more than Equation1, which sums up in
/// another order.
constexpr double kMore = 1.001;

/// What Eq. 1 divides by, by mask.
constexpr std::array<double, 256> kWeights = [] {
  std::array<double, 256> weights{};
  for (std::size_t mask = 0; mask < 256; ++mask) weights[mask] = 2 + kRings[mask].count;
  return weights;
}();

BURNISH_AVX2 inline Lanes load(const double* from) {
  return *reinterpret_cast<const Unaligned*>(from);
}
BURNISH_AVX2 inline Lanes absolute(const Lanes& a) {
  return a < 0 ? -a : a;
}
BURNISH_AVX2 inline bool any(const Masks& a) {
  return (a[0] | a[1] | a[2] | a[3]) != 0;
}

struct Points {
  Lanes x, y, z;
};

BURNISH_AVX2 inline Points choose(const Masks& which, const Points& a, const Points& b) {
  return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}
BURNISH_AVX2 inline Lanes bound(const Points& a, const Points& b) {
  return absolute(a.x - b.x) + absolute(a.y - b.y) + absolute(a.z - b.z);
}

/// Pixels of an image side by side, and who of those around them are neighbours.
struct Group {
  const double *x, *y, *z;
  const std::array<std::ptrdiff_t, 8>& around;
  Masks masks;

  BURNISH_AVX2 Points at(std::ptrdiff_t place) const {
    return {load(x + place), load(y + place), load(z + place)};
  }
  BURNISH_AVX2 Masks is_neighbour(std::size_t k) const {
    const Masks bit = Masks{} + (std::int64_t{1} << k);
    return (masks & bit) == bit;
  }
  /// Where `a` has a neighbour opposite to it.
  BURNISH_AVX2 Masks has_opposite(const Points& a, const Points& centre, double rounding) const {
    const Lanes ax = a.x - 2 * centre.x, ay = a.y - 2 * centre.y, az = a.z - 2 * centre.z;
    Masks found{};
    for (std::size_t k = 0; k < 8; ++k) {
      const Points p = at(around[k]);
      found |= is_neighbour(k) & (absolute(ax + p.x) <= rounding) &
               (absolute(ay + p.y) <= rounding) & (absolute(az + p.z) <= rounding);
    }
    return found;
  }
};

/// Returns where there may be a tie: the results there do not count.
BURNISH_AVX2 Masks move_group(const Group& group, const Lanes& weights, const Equation1& weigh,
                              double hold, std::array<double*, 3> to) {
  const Points centre = group.at(0);
  Points sum{}, nearest = centre, farthest = centre;
  Lanes least = Lanes{} + kFar, second_least = least;
  Lanes greatest = Lanes{} - 1, second_greatest = greatest;
  for (std::size_t k = 0; k < 8; ++k) {
    const Points p = group.at(group.around[k]);
    const Masks in = group.is_neighbour(k);
    const Lanes dx = p.x - centre.x, dy = p.y - centre.y, dz = p.z - centre.z;
    const Lanes distance = dx * dx + dy * dy + dz * dz;
    const Lanes near = in ? distance : Lanes{} + kFar, far = in ? distance : Lanes{} - 1;
    const Masks nearer = near<least, farther = far> greatest;
    const Lanes loser = nearer ? least : near, winner = farther ? greatest : far;
    second_least = loser < second_least ? loser : second_least;
    second_greatest = winner > second_greatest ? winner : second_greatest;
    least = nearer ? near : least;
    greatest = farther ? far : greatest;
    nearest = choose(nearer, p, nearest);
    farthest = choose(farther, p, farthest);
    sum.x += in ? p.x : Lanes{};
    sum.y += in ? p.y : Lanes{};
    sum.z += in ? p.z : Lanes{};
  }
  const Masks moves = group.masks != 0;
  const auto put = [&](double* place, const Lanes& from, const Lanes& all) BURNISH_AVX2 {
    const Lanes moved = (1 - hold) * (all / weights) + hold * from;
    *reinterpret_cast<Unaligned*>(place) = moves ? moved : from;
  };
  put(to[0], centre.x, sum.x + nearest.x + farthest.x);
  put(to[1], centre.y, sum.y + nearest.y + farthest.y);
  put(to[2], centre.z, sum.z + nearest.z + farthest.z);

  Masks tied = (second_least - least <= Equation1::kTie * least) |
               (greatest - second_greatest <= Equation1::kTie * greatest);
  // The sum of the coordinates stands for the distance, which is less: it takes no root.
  const double rounding = kMore * weigh.rounding();
  const Lanes near_reach = 4 * rounding * (bound(nearest, centre) + rounding);
  const Lanes far_reach = 4 * rounding * (bound(farthest, centre) + rounding);
  const Masks close =
      (second_least - least <= kMore * (Equation1::kTie * least + near_reach)) |
      (greatest - second_greatest <= kMore * (Equation1::kTie * greatest + far_reach));
  if (any(close & moves)) {
    const Masks far_has = group.has_opposite(farthest, centre, rounding);
    if (any(far_has)) tied |= far_has & group.has_opposite(nearest, centre, rounding);
  }
  return tied & moves;
}

BURNISH_AVX2 void move_in_groups(const Planes& now, Planes& next, const std::uint8_t* masks,
                                 std::size_t y, std::size_t width, const Equation1& weigh,
                                 double hold) {
  const auto around = places(now);
  for (std::size_t x = 0; x < width; x += Planes::kLanes) {
    const std::uint8_t* m = masks + x;
    const Group group{now.row(0, y) + x, now.row(1, y) + x, now.row(2, y) + x, around,
                      Masks{m[0], m[1], m[2], m[3]}};
    const Lanes weights{kWeights[m[0]], kWeights[m[1]], kWeights[m[2]], kWeights[m[3]]};
    const Masks tied = move_group(group, weights, weigh, hold,
                                  {next.row(0, y) + x, next.row(1, y) + x, next.row(2, y) + x});
    if (!any(tied)) continue;
    for (std::size_t lane = 0; lane < Planes::kLanes; ++lane) {
      if (tied[lane] != 0) move_one(now, next, m[lane], y, x + lane, weigh, hold);
    }
  }
}

}  // namespace

void move_row(const Planes& now, Planes& next, const std::uint8_t* masks, std::size_t y,
              std::size_t width, const Equation1& weigh, double hold) {
  static const bool wide = __builtin_cpu_supports("avx2") != 0;
  (wide ? move_in_groups : move_one_by_one)(now, next, masks, y, width, weigh, hold);
}

}  // namespace burnish

#else

void burnish::move_row(const Planes& now, Planes& next, const std::uint8_t* masks, std::size_t y,
                       std::size_t width, const Equation1& weigh, double hold) {
  move_one_by_one(now, next, masks, y, width, weigh, hold);
}

#endif
