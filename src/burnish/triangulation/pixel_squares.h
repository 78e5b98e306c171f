#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/organized.h"

namespace burnish {

/// What becomes of a square of four neighbouring pixels: a, b to its right, c below it, and d. The
/// sum of the corners that its triangles have (all for two triangles, three for one, or none), and
/// of the diagonal.
using Square = std::uint8_t;
constexpr Square kA = 1, kB = 2, kC = 4, kD = 8;
constexpr Square kAll = kA | kB | kC | kD;
constexpr Square kRising = 16;  ///< cut from c to b, otherwise from a to d

/// Tells for the squares of an image which of their edges are cut (see organized.h). Every edge is
/// judged once. Holds two rows of pixels, which serve one cloud after another; a thread has its
/// own.
class SquareJudge {
 public:
  /// The squares below some rows of pixels; squares[i] begins with pixel i, and the last pixel of a
  /// row has none. Allocates where the cloud is wider than those before. O(#pixels).
  void judge(const PointCloud& cloud, const OrganizedParams& params, IndexRange rows,
             std::span<Square> squares);

 private:
  struct Row {
    std::vector<double> x, y, z;
    std::vector<double> range;  ///< NaN where nothing was measured: comparisons with it fail
    std::vector<double> variance;
    std::vector<std::uint8_t> to_next;  ///< whether a pixel is joined to the one on its right

    void resize(std::size_t width);
    double squared_distance(std::size_t i, const Row& other, std::size_t k) const {
      return squared_norm(Vec3d{x[i], y[i], z[i]} - Vec3d{other.x[k], other.y[k], other.z[k]});
    }
  };

  void prepare(const PointCloud& cloud, const OrganizedParams& params);
  void measure(const PointCloud& cloud, std::size_t number, Row& row);
  void join(const Row& a, std::size_t first_a, const Row& b, std::size_t first_b,
            std::vector<std::uint8_t>& joined);
  void compare_diagonals();
  void combine(std::span<Square> squares) const;

  Vec3d viewpoint_;  ///< in the cloud's frame
  std::size_t width_ = 0;
  double squared_jump_ = 0, squared_sine_ = 0, assumed_noise_ = 0;
  Row upper_, lower_;
  // Between the rows, from pixel i of the upper one: to i below; to i + 1 below; from i + 1 to i
  // below; whether the second is at most as long as the third.
  std::vector<std::uint8_t> down_, falling_, rising_, falling_is_shorter_;
  std::vector<double> difference_;
};

}  // namespace burnish
