#pragma once

#include <array>
#include <cstddef>

#include "burnish/base/result.h"
#include "burnish/registration/normal_equations.h"
#include "burnish/registration/pair.h"

namespace burnish {

/// What speaks for a pose and against it, counted over one of the two in the view of the other.
struct Evidence {
  std::size_t points = 0;        ///< looked at
  std::size_t compared = 0;      ///< of them, where the other could see something there
  std::size_t matched = 0;       ///< of these, within three deviations and with a like normal
  std::size_t contradicted = 0;  ///< of these, in patches that lie where the other saw through
  double squares = 0;            ///< of the matched's residuals, in units of their deviations
  double patches = 0;            ///< of the matched, so many have normals independent of each other

  // Upper triangles of sums over the matched of rows about a twist, 1 / (shared variance).
  std::array<double, 21> information{};  ///< of the products of both sides' rows
  std::array<double, 21> roughness{};    ///< of half the squares of their differences
  Vec3d sum;                             ///< of the matched points, target coordinates
  double sum_squares = 0;                ///< of their distances from the origin

  /// A matched point: the normals n and m that the two sides saw there, 1 over the variance that
  /// counts it as its share of a patch of common error, the residual in deviations.
  ///
  /// Normals are noisy: the mean of n n^T holds their variance, as if the surface were rough, and
  /// makes a plane look held. The noises of both sides are independent, so that the mean of
  /// (n m^T + m n^T) / 2 holds none, and that of (n - m)(n - m)^T / 2 is the variance.
  void add_match(const Vec3d& x, const Vec3d& n, const Vec3d& m, double weight, double residual);

  Evidence& operator+=(const Evidence& other);
};

/// Fills what a registration says of its pose beyond the pose, `converged` and `iterations`, and
/// judges it. `forward`: of the source in the target; `backward`: of the target in the source.
void judge(const Evidence& forward, const Evidence& backward, const AcceptanceParams& acceptance,
           PairRegistration& pair);

/// Covariance and information of twists about the origin of a frame in which what was the origin is
/// at `origin`.
void move_twists(const Vec3d& origin, PairRegistration& pair);

/// Errors: invalid_argument where it is no rotation and a translation.
Result<void> check_pose(const RigidTransform& T);

/// Systematic errors of depth cameras vary over about a tenth of the image: this share of it has
/// one.
inline constexpr double kBiasPatch = 0.01;

/// The number of pixels that count as one measurement of a depth camera: by how far neighbours
/// share their random error (core/noise_correlation.h), and their systematic one in an image of
/// `width`.
double shared_noise();
double shared_bias(double width);

}  // namespace burnish
