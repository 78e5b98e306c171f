#include "burnish/smoothing/normal_filter.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/smoothing/exp_of_negative.h"

namespace burnish {
namespace {

/// Calls `visit(begin, squares)` for every four entries of a row: of these, from `begin` on, the
/// squared distances between `points` and `centre`. After the row's end its last entry repeats.
template <class Visit>
void for_squared_distances(std::span<const std::uint32_t> row, std::span<const Quad> points,
                           const Quad& centre, Visit visit) {
  const std::size_t last = row.empty() ? 0 : row.size() - 1;
  for (std::size_t k = 0; k < row.size(); k += 4) {
    const auto apart = [&](std::size_t i) {
      const Quad difference = points[row[std::min(k + i, last)]] - centre;
      return difference * difference;
    };
    visit(k, sums3(apart(0), apart(1), apart(2), apart(3)));
  }
}

/// Of the unit length of `sum`, with the area of `normal`; `normal` where it has no direction.
Quad unit_normal(const Quad& sum, const Quad& normal) {
  const float length = std::sqrt(dot3(sum, sum));
  Quad result = length > 0 ? (1 / length) * sum : normal;
  result.set_w(normal.w());
  return result;
}

}  // namespace

bool near_weights(const Context& context, const Adjacency& neighbours, const FaceGeometry& faces,
                  float sigma_c, std::vector<float>& weights) {
  weights.resize(neighbours.items().size());
  const Quad scale(1 / (2 * sigma_c * sigma_c));
  return parallel_for(context, neighbours.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto row = neighbours.row(i);
      float* const out = weights.data() + neighbours.offsets()[i];
      for_squared_distances(row, faces.centroids, faces.centroids[i],
                            [&](std::size_t k, const Quad& squares) {
                              const Quad near = exp_of_negative(scale * squares);
                              const std::size_t end = std::min(k + 4, row.size());
                              for (std::size_t j = k; j < end; ++j) {
                                out[j] = faces.normals[row[j]].w() * near[static_cast<int>(j - k)];
                              }
                            });
    }
  });
}

bool filter_normals(const Context& context, const Adjacency& neighbours,
                    std::span<const float> weights, std::span<const Quad> guidance, float sigma_s,
                    const FaceNormals& normals, FaceNormals& filtered) {
  filtered.resize(normals.size());
  const Quad scale(1 / (2 * sigma_s * sigma_s));
  return parallel_for(context, normals.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto row = neighbours.row(i);
      const float* const near = weights.data() + neighbours.offsets()[i];
      Quad sum;
      if (guidance.empty()) {
        for (std::size_t k = 0; k < row.size(); ++k) sum += near[k] * normals[row[k]];
      } else {
        for_squared_distances(row, guidance, guidance[i], [&](std::size_t k, const Quad& squares) {
          const Quad alike = exp_of_negative(scale * squares);
          const std::size_t end = std::min(k + 4, row.size());
          for (std::size_t j = k; j < end; ++j) {
            sum += (near[j] * alike[static_cast<int>(j - k)]) * normals[row[j]];
          }
        });
      }
      filtered[i] = unit_normal(sum, normals[i]);
    }
  });
}

}  // namespace burnish
