#include "burnish/pipeline/grown_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "burnish/core/gather.h"

namespace burnish {
namespace {

/// The order in which `indices` rise. Errors: bad_file where two are equal.
Result<std::vector<std::uint32_t>> rising_order(std::vector<std::uint32_t> indices,
                                                const char* what) {
  std::vector<std::uint64_t> keys;
  keys.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
    keys.push_back(std::uint64_t{indices[i]} << 32 | i);
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && keys[i] >> 32 == keys[i - 1] >> 32) {
      return Error{
          ErrorCode::bad_file, fmt::format("two {} have number {}", what, keys[i] >> 32), {}};
    }
    indices[i] = static_cast<std::uint32_t>(keys[i]);
  }
  return indices;
}

std::vector<Triangle> renamed(const std::vector<Triangle>& triangles,
                              const std::vector<std::uint32_t>& order,
                              const std::vector<std::uint32_t>& places) {
  std::vector<Triangle> result;
  result.reserve(order.size());
  for (const std::uint32_t t : order) {
    const Triangle& triangle = triangles[t];
    result.push_back({places[triangle[0]], places[triangle[1]], places[triangle[2]]});
  }
  return result;
}

}  // namespace

Result<OrderedMesh> in_original_order(GrownMesh grown, bool whole) {
  GrowingMesh::Parts parts = std::move(grown.mesh).parts();
  OrderedMesh result;
  {
    const auto order = rising_order(std::move(parts.vertex_indices), "vertices");
    if (!order) return order.error();
    result.places.resize(order->size());
    for (std::uint32_t place = 0; place < order->size(); ++place)
      result.places[(*order)[place]] = place;
    grown.columns.select(*order);
    result.mesh.positions = std::move(grown.columns.positions());
    result.mesh.attributes = std::move(grown.columns.attributes());
  }
  const auto order = rising_order(std::move(parts.triangle_indices), "triangles");
  if (!order) return order.error();
  result.mesh.triangles = renamed(parts.triangles, *order, result.places);
  parts.triangles = {};
  const Selection kept(*order);
  result.mesh.triangle_attributes.origin = kept.of(grown.triangle_origin);
  if (whole) result.mesh.triangle_attributes.owner = kept.of(grown.triangle_owner);
  return result;
}

}  // namespace burnish
