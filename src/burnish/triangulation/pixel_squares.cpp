#include "burnish/triangulation/pixel_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace burnish {

void SquareJudge::Row::resize(std::size_t width) {
  for (auto* values : {&x, &y, &z, &range, &variance}) values->resize(width);
  to_next.resize(width);
}

void SquareJudge::prepare(const PointCloud& cloud, const OrganizedParams& params) {
  viewpoint_ = cloud.viewpoint.value_or(Vec3d{}) - cloud.frame.origin;
  width_ = cloud.grid->width;
  squared_jump_ = params.max_jump * params.max_jump;
  squared_sine_ = std::pow(std::sin(params.max_angle), 2);
  assumed_noise_ = params.assumed_noise;
  upper_.resize(width_);
  lower_.resize(width_);
  for (auto* joined : {&down_, &falling_, &rising_, &falling_is_shorter_}) joined->resize(width_);
  difference_.resize(width_);
}

void SquareJudge::judge(const PointCloud& cloud, const OrganizedParams& params, IndexRange rows,
                        std::span<Square> squares) {
  prepare(cloud, params);
  measure(cloud, rows.begin, lower_);
  for (std::size_t number = rows.begin; number < rows.end; ++number) {
    std::swap(upper_, lower_);
    measure(cloud, number + 1, lower_);
    join(upper_, 0, lower_, 0, down_);
    join(upper_, 0, lower_, 1, falling_);
    join(upper_, 1, lower_, 0, rising_);
    compare_diagonals();
    combine(squares.subspan(number * width_, width_));
  }
}

void SquareJudge::measure(const PointCloud& cloud, std::size_t number, Row& row) {
  const Vec3d viewpoint = viewpoint_;
  const Vec3f* position = cloud.positions.data() + number * width_;
  const std::vector<float>& sigmas = cloud.attributes.sigma;
  const float* sigma = sigmas.empty() ? nullptr : sigmas.data() + number * width_;
  double *x = row.x.data(), *y = row.y.data(), *z = row.z.data();
  double *range = row.range.data(), *variance = row.variance.data();
  for (std::size_t i = 0; i < width_; ++i) {
    x[i] = double{position[i].x};
    y[i] = double{position[i].y};
    z[i] = double{position[i].z};
  }
  for (std::size_t i = 0; i < width_; ++i) {
    const double distance = norm(Vec3d{x[i], y[i], z[i]} - viewpoint);
    range[i] = distance < HUGE_VAL ? distance : std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t i = 0; i < width_; ++i) {
    const double deviation = sigma ? double{sigma[i]} : assumed_noise_ * range[i] * range[i];
    variance[i] = deviation * deviation;
  }
  join(row, 0, row, 1, row.to_next);
}

/// Whether pixels first_a + i of `a` and first_b + i of `b` are joined. Most steps are within the
/// noise, which takes a loop for vector instructions.
void SquareJudge::join(const Row& a, std::size_t first_a, const Row& b, std::size_t first_b,
                       std::vector<std::uint8_t>& joined) {
  const std::size_t count = width_ - std::max(first_a, first_b);
  const double *range_a = a.range.data() + first_a, *range_b = b.range.data() + first_b;
  const double *variance_a = a.variance.data() + first_a, *variance_b = b.variance.data() + first_b;
  double* excess = difference_.data();
  std::uint8_t* is_joined = joined.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double step = range_a[i] - range_b[i];
    excess[i] = step * step - squared_jump_ * (variance_a[i] + variance_b[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    is_joined[i] = excess[i] <= 0;
    if (excess[i] <= 0) continue;
    const double step = range_a[i] - range_b[i];
    is_joined[i] = step * step <= squared_sine_ * a.squared_distance(first_a + i, b, first_b + i);
  }
}

void SquareJudge::compare_diagonals() {
  double* difference = difference_.data();
  for (std::size_t i = 0; i + 1 < width_; ++i) {
    difference[i] =
        upper_.squared_distance(i, lower_, i + 1) - upper_.squared_distance(i + 1, lower_, i);
  }
  std::uint8_t* is_shorter = falling_is_shorter_.data();
  for (std::size_t i = 0; i + 1 < width_; ++i) is_shorter[i] = difference[i] <= 0;
}

/// Which triangles the squares have: bit by bit, without a branch, for many squares at once.
void SquareJudge::combine(std::span<Square> squares) const {
  const std::uint8_t *down = down_.data(), *above = upper_.to_next.data();
  const std::uint8_t *below = lower_.to_next.data(), *shorter = falling_is_shorter_.data();
  const std::uint8_t *falling = falling_.data(), *rising = rising_.data();
  Square* square = squares.data();
  const std::size_t count = width_ - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t ac = down[i], cd = below[i], db = down[i + 1], ba = above[i];
    const std::uint8_t acd = ac & cd, adb = db & ba, acb = ba & ac, cdb = cd & db;
    const std::uint8_t can_rise = rising[i] & (acb | cdb);
    const std::uint8_t falls = falling[i] & (acd | adb) & (shorter[i] | (can_rise ^ 1));
    const std::uint8_t rises = can_rise & (falls ^ 1);
    const std::uint8_t a = falls | (rises & acb), b = rises | (falls & adb);
    const std::uint8_t c = rises | (falls & acd), d = falls | (rises & cdb);
    square[i] = static_cast<Square>(a | b << 1 | c << 2 | d << 3 | rises << 4);
  }
}

}  // namespace burnish
