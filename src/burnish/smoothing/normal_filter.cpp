#include "burnish/smoothing/normal_filter.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/smoothing/exp_of_negative.h"

namespace burnish {
namespace {

std::size_t longest(const Adjacency& rows) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) length = std::max(length, rows.row(i).size());
  return length;
}

}  // namespace

bool filter_normals(const Context& context, const Adjacency& neighbours,
                    const std::vector<Quad>& centroids, std::span<const Quad> guidance,
                    const NormalKernel& kernel, const FaceNormals& normals, FaceNormals& filtered) {
  filtered.resize(normals.size());
  const Quad near(1 / (2 * kernel.sigma_c * kernel.sigma_c));
  const Quad alike(1 / (2 * kernel.sigma_s * kernel.sigma_s));
  const std::size_t room = (longest(neighbours) + 3) / 4 * 4;
  return parallel_for(context, normals.size(), [&](IndexRange range) {
    // Exponents first and sums afterwards: four exponentials at once between them.
    std::vector<float> weights(room);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto row = neighbours.row(i);
      const Quad centre = centroids[i];
      if (guidance.empty()) {
        for (std::size_t k = 0; k < row.size(); ++k) {
          const Quad away = centroids[row[k]] - centre;
          weights[k] = sum3(near * away * away);
        }
      } else {
        const Quad own = guidance[i];
        for (std::size_t k = 0; k < row.size(); ++k) {
          const Quad away = centroids[row[k]] - centre, apart = guidance[row[k]] - own;
          weights[k] = sum3(near * away * away + alike * apart * apart);
        }
      }
      for (std::size_t k = 0; k < row.size(); k += 4) {
        exp_of_negative(Quad::load(&weights[k])).store(&weights[k]);
      }
      Quad sum;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const Quad& normal = normals[row[k]];
        sum += (weights[k] * normal.w()) * normal;
      }
      const float length = std::sqrt(dot3(sum, sum));
      Quad result = length > 0 ? (1 / length) * sum : normals[i];
      result.set_w(normals[i].w());
      filtered[i] = result;
    }
  });
}

}  // namespace burnish
