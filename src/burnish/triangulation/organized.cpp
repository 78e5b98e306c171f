#include "burnish/triangulation/organized.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/pixel_squares.h"
#include "burnish/triangulation/used_points.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// The squares of an image; square i has pixel i in its corner a.
class SquareMesh {
 public:
  explicit SquareMesh(const PointCloud& cloud)
      : cloud_(cloud),
        width_(cloud.grid->width),
        rows_(cloud.positions.empty() ? 0 : cloud.grid->height - 1),
        squares_(cloud.positions.size() + width_ + 1) {}

  /// Returns false where cancelled.
  bool judge(const OrganizedParams& params, const Context& context) {
    const std::span<Square> squares = std::span(squares_).subspan(width_ + 1);
    const bool complete = parallel_for(
        context, rows_, [&](IndexRange rows) { SquareJudge(cloud_, params).judge(rows, squares); },
        kRowsAtOnce);
    for (const Square square : squares_)
      triangle_count_ += (square != 0) + ((square & kAll) == kAll);
    return complete;
  }

  /// The points that are a corner of a triangle.
  UsedPoints number_points() const {
    const std::size_t count = cloud_.positions.size();
    UsedPoints used;
    used.number.resize(count);
    used.points.resize(count);
    std::uint32_t next = 0;
    for (std::uint32_t p = 0; p < count; ++p) {
      const Square* square = &squares_[p + width_ + 1];
      const Square* above = square - width_;
      const bool is_used =
          ((square[0] & kA) | (square[-1] & kB) | (above[0] & kC) | (above[-1] & kD)) != 0;
      used.number[p] = next;
      used.points[next] = p;
      next += is_used;
    }
    used.points.resize(next);
    return used;
  }

  /// The triangles with their new numbers, all facing the viewpoint. Returns false where cancelled.
  bool list(const std::vector<std::uint32_t>& number, const Context& context,
            std::vector<Triangle>& triangles) const {
    const bool mirrored = is_mirror_image();
    triangles.reserve(triangle_count_);
    std::vector<Triangle> of_row(2 * width_);
    for (std::size_t row = 0; row < rows_; ++row) {
      Triangle* next = of_row.data();
      for (std::size_t i = row * width_; i < (row + 1) * width_; ++i) {
        if (at(i) == 0) continue;
        next += put_triangles(at(i), number[i], number[i + 1], number[i + width_],
                              number[i + width_ + 1], next);
      }
      if (mirrored) {
        for (Triangle* t = of_row.data(); t != next; ++t) std::swap((*t)[1], (*t)[2]);
      }
      triangles.insert(triangles.end(), of_row.data(), next);
      if (context.cancelled()) return false;
    }
    context.progress(1);
    return true;
  }

 private:
  /// Puts the triangles of a square to `out`, which has room for two, counter-clockwise on an image
  /// whose rows run down, the one left of the diagonal first. Returns how many.
  static std::size_t put_triangles(Square square, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                   std::uint32_t d, Triangle* out) {
    const bool rising = (square & kRising) != 0;
    const bool has_left = (square & (rising ? kA : kC)) != 0;
    const bool has_right = (square & (rising ? kD : kB)) != 0;
    out[0] = {a, c, rising ? b : d};
    out[has_left] = {rising ? b : a, rising ? c : d, rising ? d : b};
    return static_cast<std::size_t>(has_left) + has_right;
  }

  Square at(std::size_t i) const { return squares_[i + width_ + 1]; }

  /// Positive where `t` is counter-clockwise seen from the viewpoint.
  double side(const Triangle& t) const {
    const Vec3d viewpoint = cloud_.viewpoint.value_or(Vec3d{}) - cloud_.frame.origin;
    const Vec3d a = Vec3d(cloud_.positions[t[0]]) - viewpoint;
    const Vec3d b = Vec3d(cloud_.positions[t[1]]) - viewpoint;
    const Vec3d c = Vec3d(cloud_.positions[t[2]]) - viewpoint;
    return -dot(a, cross(b, c));
  }

  /// The grid may be a mirror image (a flipped recording). One vote, of a thousand squares from
  /// everywhere, decides for all triangles, so that they stay oriented alike.
  bool is_mirror_image() const {
    const std::size_t stride = 1 + triangle_count_ / 1024;
    std::int64_t facing = 0;
    std::size_t until_vote = 0;
    for (std::uint32_t i = 0; i < rows_ * width_; ++i) {
      if (at(i) == 0 || until_vote-- > 0) continue;
      until_vote = stride;
      const auto below = i + static_cast<std::uint32_t>(width_);
      std::array<Triangle, 2> triangles;
      put_triangles(at(i), i, i + 1, below, below + 1, triangles.data());
      facing += side(triangles[0]) >= 0 ? 1 : -1;
    }
    return facing < 0;
  }

  const PointCloud& cloud_;
  std::size_t width_;
  std::size_t rows_;             ///< of squares
  std::vector<Square> squares_;  ///< after a row of none; the last pixels of rows have none either
  std::size_t triangle_count_ = 0;
};

}  // namespace

const Schema<OrganizedParams>& OrganizedParams::schema() {
  using P = OrganizedParams;
  static const auto schema =
      Schema<P>()
          .real("max_jump", &P::max_jump, at_least(0),
                "cut edges whose range step is more standard deviations of the noise")
          .real("max_angle", &P::max_angle, between(0, std::numbers::pi / 2),
                "and is steeper than a surface seen under this angle to its normal",
                Quantity::angle)
          .real("assumed_noise", &P::assumed_noise, at_least(0),
                "sigma / range^2 (1/m) of points that carry no sigma");
  return schema;
}

Result<Triangulation> triangulate_organized(const PointCloud& cloud, const OrganizedParams& params,
                                            const Context& context) {
  if (auto valid = OrganizedParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();
  if (!cloud.grid) {
    return Error{ErrorCode::bad_geometry,
                 "the cloud is not organized: it has no image grid to triangulate",
                 {}};
  }
  SquareMesh mesh(cloud);
  if (!mesh.judge(params, context.part(0, 0.6))) return cancelled();
  const UsedPoints used = mesh.number_points();
  std::vector<Triangle> triangles;
  if (!mesh.list(used.number, context.part(0.6, 0.9), triangles)) return cancelled();
  Triangulation result = mesh_of(cloud, used, std::move(triangles));
  if (context.cancelled()) return cancelled();
  context.progress(1);
  return result;
}

}  // namespace burnish
