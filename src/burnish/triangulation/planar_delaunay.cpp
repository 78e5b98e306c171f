#include "burnish/triangulation/planar_delaunay.h"

#include <algorithm>
#include <bit>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/hull_merge.h"

namespace burnish {
namespace {

/// Parts of at most so many points are triangulated in parallel and merged one after the other.
constexpr std::uint32_t kPartPoints = 8192;
/// A planar graph of n points has less than 3 n edges.
constexpr std::uint32_t kSlotsPerPoint = 3;

/// Where a range of the order is cut in two.
struct Division {
  std::uint32_t middle;
  Cut cut;
};

Division divide(std::span<const Keyed> order, std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t last = order[end - 1].key, differing = order[begin].key ^ last;
  if (differing == 0) return {begin + (end - begin) / 2, Cut::upright};  // one cell, sorted by x
  const int bit = std::bit_width(differing) - 1;
  const std::uint64_t least = last >> bit << bit;  // the least key beyond the cut
  const auto middle = std::partition_point(order.begin() + begin, order.begin() + end,
                                           [least](const Keyed& item) { return item.key < least; });
  return {static_cast<std::uint32_t>(middle - order.begin()),
          bit % 2 == 0 ? Cut::upright : Cut::level};
}

class PlanarDelaunay {
 public:
  PlanarDelaunay(std::span<const Vec2d> points, std::span<const Keyed> order)
      : order_(order), edges_(kSlotsPerPoint * order.size()) {
    points_.reserve(order.size());
    for (const Keyed& item : order) points_.push_back(points[item.index]);
    collect_ranges(0, static_cast<std::uint32_t>(order.size()));
    for (const Range& range : ranges_) {
      slots_.emplace_back(edges_, kSlotsPerPoint * range.begin, kSlotsPerPoint * range.end);
    }
  }

  /// Returns false where cancelled.
  bool build(const Context& context) {
    std::vector<HullPart> parts(ranges_.size());
    const bool complete = parallel_for(
        context, ranges_.size(),
        [&](IndexRange chunk) {
          for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
            HullMerger merger(points_, edges_, std::span(slots_).subspan(i, 1));
            parts[i] = triangulate(ranges_[i].begin, ranges_[i].end, merger);
          }
        },
        1);
    if (!complete) return false;
    HullMerger merger(points_, edges_, slots_);
    const HullPart* next_part = parts.data();
    const auto count = static_cast<std::uint32_t>(order_.size());
    const HullPart whole = join_parts(0, count, next_part, merger, context);
    if (context.cancelled()) return false;
    edges_.mark_outside(whole.hull);
    return true;
  }

  /// Whatever order the edges have: every triangle starts with its smallest index.
  /// Returns false where cancelled.
  bool list_triangles(const Context& context, std::vector<std::vector<Triangle>>& lists) const {
    lists.resize(slots_.size());
    return parallel_for(
        context, slots_.size(),
        [&](IndexRange chunk) {
          for (std::size_t i = chunk.begin; i < chunk.end; ++i) list_part(slots_[i], lists[i]);
        },
        1);
  }

 private:
  struct Range {
    std::uint32_t begin, end;
  };

  void collect_ranges(std::uint32_t begin, std::uint32_t end) {
    if (end - begin <= kPartPoints) {
      ranges_.push_back({begin, end});
      return;
    }
    const std::uint32_t middle = divide(order_, begin, end).middle;
    collect_ranges(begin, middle);
    collect_ranges(middle, end);
  }

  HullPart triangulate(std::uint32_t begin, std::uint32_t end, HullMerger& merger) const {
    if (end - begin == 1) return {begin};
    if (end - begin == 2) return merger.join(begin, begin + 1);
    const Division division = divide(order_, begin, end);
    const HullPart left = triangulate(begin, division.middle, merger);
    const HullPart right = triangulate(division.middle, end, merger);
    return merger.merge(left, right, division.cut);
  }

  /// Puts together what collect_ranges() cut apart; without meaning where cancelled.
  HullPart join_parts(std::uint32_t begin, std::uint32_t end, const HullPart*& next_part,
                      HullMerger& merger, const Context& context) const {
    if (end - begin <= kPartPoints) return *next_part++;
    const Division division = divide(order_, begin, end);
    const HullPart left = join_parts(begin, division.middle, next_part, merger, context);
    const HullPart right = join_parts(division.middle, end, next_part, merger, context);
    return context.cancelled() ? left : merger.merge(left, right, division.cut);
  }

  void list_part(const EdgeSlots& slots, std::vector<Triangle>& triangles) const {
    triangles.reserve((slots.end() - slots.begin()) / 3);
    for (std::uint32_t e = slots.begin(); e < slots.end(); ++e) {
      if (!edges_.is_inside(e)) continue;
      const std::uint32_t a = order_[edges_.origin(e)].index;
      const std::uint32_t b = order_[edges_.destination(e)].index;
      if (b < a) continue;
      const std::uint32_t c = order_[edges_.destination(edges_.left_next(e))].index;
      if (a < c) triangles.push_back({a, b, c});
    }
  }

  std::span<const Keyed> order_;
  std::vector<Vec2d> points_;  ///< in their order
  PlaneSubdivision edges_;
  std::vector<Range> ranges_;
  std::vector<EdgeSlots> slots_;  ///< of each range
};

/// The triangles of all lists by their first index, then by their second.
std::vector<Triangle> sorted(const std::vector<std::vector<Triangle>>& lists, std::size_t points) {
  std::vector<std::uint32_t> ends(points + 1, 0);
  for (const auto& list : lists) {
    for (const Triangle& t : list) ++ends[t[0] + 1];
  }
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<Triangle> triangles(ends.back());
  for (const auto& list : lists) {
    for (const Triangle& t : list) triangles[ends[t[0]]++] = t;
  }
  auto begin = triangles.begin();
  for (std::size_t i = 0; i < points; ++i) {
    const auto end = triangles.begin() + ends[i];
    std::sort(begin, end, [](const Triangle& a, const Triangle& b) { return a[1] < b[1]; });
    begin = end;
  }
  return triangles;
}

}  // namespace

bool planar_delaunay(std::span<const Vec2d> points, std::span<const Keyed> order,
                     const Context& context, std::vector<Triangle>& triangles) {
  triangles.clear();
  if (order.size() < 3) return !context.cancelled();
  PlanarDelaunay delaunay(points, order);
  std::vector<std::vector<Triangle>> lists;
  if (!delaunay.build(context.part(0, 0.8)) ||
      !delaunay.list_triangles(context.part(0.8, 0.9), lists)) {
    return false;
  }
  triangles = sorted(lists, points.size());
  context.progress(1);
  return true;
}

}  // namespace burnish
