#include "burnish/pipeline/grown_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace burnish {
namespace {

/// The order in which `indices` rise, found a digit at a time. Errors: bad_file where two are
/// equal. O(#indices).
Result<std::vector<std::uint32_t>> rising_order(std::vector<std::uint32_t> indices,
                                                const char* what) {
  constexpr int kBits = 11;
  std::uint32_t highest = 0;
  for (const std::uint32_t index : indices) highest = std::max(highest, index);
  std::vector<std::uint32_t> order(indices.size());
  std::vector<std::uint32_t> sorted(indices.size());
  std::iota(order.begin(), order.end(), 0);
  for (int shift = 0; shift < 32 && highest >> shift > 0; shift += kBits) {
    const auto digit = [&](std::uint32_t i) { return indices[i] >> shift & ((1u << kBits) - 1); };
    std::array<std::uint32_t, (1u << kBits) + 1> begin{};
    for (const std::uint32_t i : order) ++begin[digit(i) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const std::uint32_t i : order) sorted[begin[digit(i)]++] = i;
    order.swap(sorted);
  }
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (indices[order[i]] != indices[order[i - 1]]) continue;
    return Error{
        ErrorCode::bad_file, fmt::format("two {} have number {}", what, indices[order[i]]), {}};
  }
  return order;
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
    grown.columns.reorder(*order);
    result.mesh.positions = std::move(grown.columns.positions());
    result.mesh.attributes = std::move(grown.columns.attributes());
  }
  const auto order = rising_order(std::move(grown.mesh.triangle_indices), "triangles");
  if (!order) return order.error();
  result.mesh.triangles = renamed(grown.mesh.stars, *order, result.places);
  grown.mesh.stars = {};
  result.mesh.triangle_attributes.origin = reordered(grown.triangle_origin, *order);
  if (whole) result.mesh.triangle_attributes.owner = reordered(grown.triangle_owner, *order);
  return result;
}

}  // namespace burnish
