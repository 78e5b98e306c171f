#include "burnish/smoothing/normal_filter.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/smoothing/exp_of_negative.h"

namespace burnish {
namespace {

/// Squared distances between `centre` and four points.
Quad squared_distances(const Quad& centre, const Quad& a, const Quad& b, const Quad& c,
                       const Quad& d) {
  const Quad to_a = a - centre, to_b = b - centre, to_c = c - centre, to_d = d - centre;
  return sums3(to_a * to_a, to_b * to_b, to_c * to_c, to_d * to_d);
}

/// Calls `four(k, squares)` for every four entries of a row, with the squared distances between
/// their points and `centre`, and `rest(k, squares)` for those that are left.
template <class Four, class Rest>
void for_squared_distances(std::span<const std::uint32_t> row, std::span<const Quad> points,
                           const Quad& centre, Four four, Rest rest) {
  std::size_t k = 0;
  for (; k + 4 <= row.size(); k += 4) {
    four(k, squared_distances(centre, points[row[k]], points[row[k + 1]], points[row[k + 2]],
                              points[row[k + 3]]));
  }
  if (k == row.size()) return;
  const std::size_t last = row.size() - 1;
  const Quad squares = squared_distances(centre, points[row[k]], points[row[std::min(k + 1, last)]],
                                         points[row[std::min(k + 2, last)]], Quad());
  rest(k, squares);
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
      const auto put = [&](std::size_t k, const Quad& squares) {
        const Quad near = exp_of_negative(scale * squares);
        const std::size_t end = std::min(k + 4, row.size());
        for (std::size_t j = k; j < end; ++j) {
          out[j] = faces.normals[row[j]].w() * near[static_cast<int>(j - k)];
        }
      };
      for_squared_distances(row, faces.centroids, faces.centroids[i], put, put);
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
      const auto add_four = [&](std::size_t k, const Quad& squares) {
        const Quad share = Quad::load(near + k) * exp_of_negative(scale * squares);
        sum += splat<0>(share) * normals[row[k]];
        sum += splat<1>(share) * normals[row[k + 1]];
        sum += splat<2>(share) * normals[row[k + 2]];
        sum += splat<3>(share) * normals[row[k + 3]];
      };
      const auto add_rest = [&](std::size_t k, const Quad& squares) {
        const Quad alike = exp_of_negative(scale * squares);
        for (int lane = 0; k < row.size(); ++k, ++lane) {
          sum += (near[k] * alike[lane]) * normals[row[k]];
        }
      };
      if (guidance.empty()) {
        for (std::size_t k = 0; k < row.size(); ++k) sum += near[k] * normals[row[k]];
      } else {
        for_squared_distances(row, guidance, guidance[i], add_four, add_rest);
      }
      filtered[i] = unit_normal(sum, normals[i]);
    }
  });
}

}  // namespace burnish
