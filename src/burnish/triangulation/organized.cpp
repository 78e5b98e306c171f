#include "burnish/triangulation/organized.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/pixel_squares.h"
#include "burnish/triangulation/square_rings.h"
#include "burnish/triangulation/used_points.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// Judges that are lent to threads and come back. There are as many as have been out at a time.
class Judges {
 public:
  std::unique_ptr<SquareJudge> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<SquareJudge>();
    auto judge = std::move(idle_.back());
    idle_.pop_back();
    return judge;
  }
  void give_back(std::unique_ptr<SquareJudge> judge) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(judge));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<SquareJudge>> idle_;
};

/// Puts the triangles of a square to `out`, which has room for two, counter-clockwise on an image
/// whose rows run down, the one left of the diagonal first. Returns how many.
std::size_t put_triangles(Square square, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::uint32_t d, Triangle* out) {
  const bool rising = (square & kRising) != 0;
  const bool has_left = (square & (rising ? kA : kC)) != 0;
  const bool has_right = (square & (rising ? kD : kB)) != 0;
  out[0] = {a, c, rising ? b : d};
  out[has_left] = {rising ? b : a, rising ? c : d, rising ? d : b};
  return static_cast<std::size_t>(has_left) + has_right;
}

/// Positive where `t` is counter-clockwise seen from the viewpoint.
double side(const PointCloud& cloud, const Triangle& t) {
  const Vec3d viewpoint = cloud.viewpoint.value_or(Vec3d{}) - cloud.frame.origin;
  const Vec3d a = Vec3d(cloud.positions[t[0]]) - viewpoint;
  const Vec3d b = Vec3d(cloud.positions[t[1]]) - viewpoint;
  const Vec3d c = Vec3d(cloud.positions[t[2]]) - viewpoint;
  return -dot(a, cross(b, c));
}

}  // namespace

/// The squares of an image, and what is made of them; square i has pixel i in its corner a.
class OrganizedTriangulator::Workspace {
 public:
  Result<void> run(const PointCloud& cloud, const OrganizedParams& params, const Context& context) {
    if (auto valid = OrganizedParams::schema().check(params); !valid) return valid.error();
    if (auto sound = check(cloud); !sound) return sound.error();
    if (!cloud.grid) {
      return Error{ErrorCode::bad_geometry,
                   "the cloud is not organized: it has no image grid to triangulate",
                   {}};
    }
    size_ = *cloud.grid;
    width_ = size_.width;
    rows_ = cloud.positions.empty() ? 0 : size_.height - 1;
    // After a row of none; the last pixels of rows have none either.
    squares_.assign(cloud.positions.size() + width_ + 1, 0);
    if (!judge(cloud, params, context.part(0, 0.6))) return cancelled();
    number_points(cloud.positions.size());
    if (!list(is_mirror_image(cloud), context.part(0.6, 0.9))) return cancelled();
    return {};
  }

  /// Makes room for all the triangles and points that a cloud of this size can have.
  void reserve(const GridSize& size) {
    const std::size_t pixels = std::size_t{size.width} * size.height;
    triangles.reserve(2 * pixels);
    used.points.reserve(pixels);
  }

  void find_rings(GridRings& rings) const {
    rings.size = size_;
    rings.inner.resize(squares_.size() - width_ - 1);
    for (std::size_t p = 0; p < rings.inner.size(); ++p) {
      const Square* square = &squares_[p + width_ + 1];
      const Square* above = square - width_;
      rings.inner[p] = inner_ring(above[-1], above[0], square[-1], square[0]);
    }
  }

  UsedPoints used;
  std::vector<Triangle> triangles;

 private:
  Square at(std::size_t i) const { return squares_[i + width_ + 1]; }

  /// Returns false where cancelled.
  bool judge(const PointCloud& cloud, const OrganizedParams& params, const Context& context) {
    const std::span<Square> squares = std::span(squares_).subspan(width_ + 1);
    const auto judge_rows = [&](IndexRange rows) {
      auto judge = judges_.take();
      judge->judge(cloud, params, rows, squares);
      judges_.give_back(std::move(judge));
    };
    // By reference: a function object that holds it would have to be allocated.
    const bool complete = parallel_for(context, rows_, std::ref(judge_rows), kRowsAtOnce);
    triangle_count_ = 0;
    for (const Square square : squares_)
      triangle_count_ += (square != 0) + ((square & kAll) == kAll);
    return complete;
  }

  /// The points that are a corner of a triangle.
  void number_points(std::size_t count) {
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
  }

  /// The triangles with their new numbers, all facing the viewpoint. Returns false where cancelled.
  bool list(bool mirrored, const Context& context) {
    const std::vector<std::uint32_t>& number = used.number;
    triangles.clear();
    triangles.reserve(triangle_count_);
    of_row_.resize(2 * width_);
    for (std::size_t row = 0; row < rows_; ++row) {
      Triangle* next = of_row_.data();
      for (std::size_t i = row * width_; i < (row + 1) * width_; ++i) {
        if (at(i) == 0) continue;
        next += put_triangles(at(i), number[i], number[i + 1], number[i + width_],
                              number[i + width_ + 1], next);
      }
      if (mirrored) {
        for (Triangle* t = of_row_.data(); t != next; ++t) std::swap((*t)[1], (*t)[2]);
      }
      triangles.insert(triangles.end(), of_row_.data(), next);
      if (context.cancelled()) return false;
    }
    context.progress(1);
    return true;
  }

  /// The grid may be a mirror image (a flipped recording). One vote, of a thousand squares from
  /// everywhere, decides for all triangles, so that they stay oriented alike.
  bool is_mirror_image(const PointCloud& cloud) const {
    const std::size_t stride = 1 + triangle_count_ / 1024;
    std::int64_t facing = 0;
    std::size_t until_vote = 0;
    for (std::uint32_t i = 0; i < rows_ * width_; ++i) {
      if (at(i) == 0 || until_vote-- > 0) continue;
      until_vote = stride;
      const auto below = i + static_cast<std::uint32_t>(width_);
      std::array<Triangle, 2> corners;
      put_triangles(at(i), i, i + 1, below, below + 1, corners.data());
      facing += side(cloud, corners[0]) >= 0 ? 1 : -1;
    }
    return facing < 0;
  }

  GridSize size_;
  std::size_t width_ = 0;
  std::size_t rows_ = 0;  ///< of squares
  std::vector<Square> squares_;
  std::vector<Triangle> of_row_;
  std::size_t triangle_count_ = 0;
  Judges judges_;
};

OrganizedTriangulator::OrganizedTriangulator() : workspace_(std::make_unique<Workspace>()) {}
OrganizedTriangulator::~OrganizedTriangulator() = default;
OrganizedTriangulator::OrganizedTriangulator(OrganizedTriangulator&&) noexcept = default;
OrganizedTriangulator& OrganizedTriangulator::operator=(OrganizedTriangulator&&) noexcept = default;

Result<void> OrganizedTriangulator::triangulate(const PointCloud& cloud,
                                                const OrganizedParams& params,
                                                const Context& context, TriangleMesh& mesh) {
  // Triangles are made where the mesh holds them, with room for all that there can be.
  std::swap(workspace_->triangles, mesh.triangles);
  if (cloud.grid) workspace_->reserve(*cloud.grid);
  mesh.positions.reserve(cloud.positions.size());
  const auto done = workspace_->run(cloud, params, context);
  std::swap(workspace_->triangles, mesh.triangles);
  if (!done) return done;
  const std::vector<std::uint32_t>& points = workspace_->used.points;
  mesh.positions.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) mesh.positions[v] = cloud.positions[points[v]];
  mesh.frame = cloud.frame;
  if (context.cancelled()) return cancelled();
  context.progress(1);
  return {};
}

const std::vector<std::uint32_t>& OrganizedTriangulator::pixels() const {
  return workspace_->used.points;
}

void OrganizedTriangulator::find_rings(GridRings& rings) const {
  workspace_->find_rings(rings);
}

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
  OrganizedTriangulator::Workspace work;
  if (auto done = work.run(cloud, params, context); !done) return done.error();
  Triangulation result = mesh_of(cloud, work.used, std::move(work.triangles));
  if (context.cancelled()) return cancelled();
  context.progress(1);
  return result;
}

}  // namespace burnish
