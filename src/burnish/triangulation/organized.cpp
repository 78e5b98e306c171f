#include "burnish/triangulation/organized.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/used_points.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 8;

/// What the cutting of edges needs of a pixel. `range` is NaN where nothing was measured, so that
/// every comparison with it fails.
struct Pixel {
  double range, variance;
};

class Squares {
 public:
  Squares(const PointCloud& cloud, const OrganizedParams& params)
      : positions_(cloud.positions),
        sigma_(cloud.attributes.sigma),
        viewpoint_(cloud.viewpoint.value_or(Vec3d{}) - cloud.frame.origin),
        width_(cloud.grid->width),
        squared_jump_(params.max_jump * params.max_jump),
        squared_sine_(std::pow(std::sin(params.max_angle), 2)),
        assumed_noise_(params.assumed_noise),
        pixels_(cloud.positions.size()) {}

  void measure_row(std::size_t row) {
    for (std::size_t i = row * width_; i < (row + 1) * width_; ++i) {
      const double range = norm(Vec3d(positions_[i]) - viewpoint_);
      const double sigma = sigma_.empty() ? assumed_noise_ * range * range : double{sigma_[i]};
      pixels_[i] = {is_finite(positions_[i]) ? range : std::numeric_limits<double>::quiet_NaN(),
                    sigma * sigma};
    }
  }

  /// The triangles between `row` and the next one, counter-clockwise on an image whose rows run
  /// down.
  void triangulate_row(std::size_t row, std::vector<Triangle>& triangles) const {
    for (std::size_t column = 0; column + 1 < width_; ++column) {
      const auto a = static_cast<std::uint32_t>(row * width_ + column);
      const auto c = static_cast<std::uint32_t>(a + width_);
      const std::uint32_t b = a + 1, d = c + 1;
      // Corners in a ring: a above c, b above d.
      const bool ac = joined(a, c), cd = joined(c, d), db = joined(d, b), ba = joined(b, a);
      const bool ad_wanted = (ac && cd) || (db && ba), bc_wanted = (ba && ac) || (cd && db);
      const bool ad = ad_wanted && joined(a, d), bc = bc_wanted && joined(b, c);
      if (ad && (!bc || squared_length(a, d) <= squared_length(b, c))) {
        if (ac && cd) triangles.push_back({a, c, d});
        if (db && ba) triangles.push_back({a, d, b});
      } else if (bc) {
        if (ba && ac) triangles.push_back({a, c, b});
        if (cd && db) triangles.push_back({b, c, d});
      }
    }
  }

  /// Positive where `t` is counter-clockwise seen from the viewpoint.
  double side(const Triangle& t) const {
    const Vec3d a = Vec3d(positions_[t[0]]) - viewpoint_;
    const Vec3d b = Vec3d(positions_[t[1]]) - viewpoint_;
    const Vec3d c = Vec3d(positions_[t[2]]) - viewpoint_;
    return -dot(a, cross(b, c));
  }

 private:
  double squared_length(std::uint32_t a, std::uint32_t b) const {
    return squared_norm(Vec3d(positions_[a]) - Vec3d(positions_[b]));
  }

  bool joined(std::uint32_t a, std::uint32_t b) const {
    const double step = pixels_[a].range - pixels_[b].range;
    if (step * step <= squared_jump_ * (pixels_[a].variance + pixels_[b].variance)) return true;
    return step * step <= squared_sine_ * squared_length(a, b);
  }

  const std::vector<Vec3f>& positions_;
  const std::vector<float>& sigma_;
  Vec3d viewpoint_;
  std::size_t width_;
  double squared_jump_, squared_sine_, assumed_noise_;
  std::vector<Pixel> pixels_;
};

/// The grid may be a mirror image (a flipped recording); one vote decides for all triangles, so
/// that they stay oriented alike.
void face_the_viewpoint(std::vector<Triangle>& triangles, const Squares& squares) {
  std::int64_t facing = 0;
  for (const Triangle& t : triangles) facing += squares.side(t) >= 0 ? 1 : -1;
  if (facing >= 0) return;
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

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
  const std::size_t height = cloud.grid->height;
  Squares squares(cloud, params);
  const bool measured = parallel_for(
      context.part(0, 0.2), height,
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) squares.measure_row(row);
      },
      kRowsAtOnce);
  if (!measured) return cancelled();

  std::vector<std::vector<Triangle>> of_row(height > 0 ? height - 1 : 0);
  const bool complete = parallel_for(
      context.part(0.2, 0.8), of_row.size(),
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          of_row[row].reserve(2 * cloud.grid->width);
          squares.triangulate_row(row, of_row[row]);
        }
      },
      kRowsAtOnce);
  if (!complete) return cancelled();

  std::size_t count = 0;
  for (const auto& row : of_row) count += row.size();
  std::vector<Triangle> triangles;
  triangles.reserve(count);
  for (const auto& row : of_row) triangles.insert(triangles.end(), row.begin(), row.end());
  face_the_viewpoint(triangles, squares);
  Triangulation result = mesh_of_used_points(cloud, std::move(triangles));
  context.progress(1);
  return result;
}

}  // namespace burnish
