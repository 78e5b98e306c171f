#include "burnish/pipeline/grown_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "burnish/core/gather.h"

namespace burnish {
namespace {

struct Numbered {
  std::uint32_t index, place;
};

/// Sorts by index, a digit at a time. O(#items).
void sort_by_index(std::vector<Numbered>& items) {
  constexpr int kBits = 11;
  std::uint32_t highest = 0;
  for (const Numbered& item : items) highest = std::max(highest, item.index);
  std::vector<Numbered> sorted(items.size());
  for (int shift = 0; shift < 32 && highest >> shift > 0; shift += kBits) {
    const auto digit = [&](const Numbered& item) {
      return item.index >> shift & ((1u << kBits) - 1);
    };
    std::array<std::uint32_t, (1u << kBits) + 1> begin{};
    for (const Numbered& item : items) ++begin[digit(item) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Numbered& item : items) sorted[begin[digit(item)]++] = item;
    items.swap(sorted);
  }
}

/// The order in which `indices` rise. Errors: bad_file where two are equal.
Result<std::vector<std::uint32_t>> rising_order(std::vector<std::uint32_t> indices,
                                                const char* what) {
  std::vector<Numbered> items;
  items.reserve(indices.size());
  for (const std::uint32_t index : indices)
    items.push_back({index, static_cast<std::uint32_t>(items.size())});
  sort_by_index(items);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0 && items[i].index == items[i - 1].index) {
      return Error{
          ErrorCode::bad_file, fmt::format("two {} have number {}", what, items[i].index), {}};
    }
    indices[i] = items[i].place;
  }
  return indices;
}

std::vector<Triangle> renamed(const TriangleStars& stars, const std::vector<std::uint32_t>& order,
                              const std::vector<std::uint32_t>& places) {
  std::vector<Triangle> result;
  result.reserve(order.size());
  for (const std::uint32_t t : order) {
    const auto& [a, b, c] = stars.triangle(t);
    result.push_back({places[a], places[b], places[c]});
  }
  return result;
}

}  // namespace

Result<OrderedMesh> in_original_order(GrownMesh grown, bool whole) {
  OrderedMesh result;
  {
    const auto order = rising_order(std::move(grown.mesh.vertex_indices), "vertices");
    if (!order) return order.error();
    result.places.resize(order->size());
    for (std::uint32_t place = 0; place < order->size(); ++place)
      result.places[(*order)[place]] = place;
    grown.columns.select(*order);
    result.mesh.positions = std::move(grown.columns.positions());
    result.mesh.attributes = std::move(grown.columns.attributes());
  }
  const auto order = rising_order(std::move(grown.mesh.triangle_indices), "triangles");
  if (!order) return order.error();
  result.mesh.triangles = renamed(grown.mesh.stars, *order, result.places);
  grown.mesh.stars = {};
  const Selection kept(*order);
  result.mesh.triangle_attributes.origin = kept.of(grown.triangle_origin);
  if (whole) result.mesh.triangle_attributes.owner = kept.of(grown.triangle_owner);
  return result;
}

}  // namespace burnish
