#include "burnish/registration/evidence.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/core/noise_correlation.h"

namespace burnish {
namespace {

using Matrix = Eigen::Matrix<double, 6, 6>;
using Vector = Eigen::Matrix<double, 6, 1>;

constexpr double kLeastInformation = 1e-9;  // of the largest eigenvalue: what inverts

Matrix symmetric(const std::array<double, 21>& upper) {
  Matrix matrix;
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = i; j < 6; ++j) matrix(i, j) = matrix(j, i) = upper[k++];
  }
  return matrix;
}

Matrix6 plain(const Matrix& matrix) {
  Matrix6 result;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      result[i][j] = (matrix(a, b) + matrix(b, a)) / 2;
    }
  }
  return result;
}

/// Twists about the origin from those about `centre` whose rotations are scaled by `radius`:
/// rotation = r / radius, translation = t - rotation x centre.
Matrix from_centre(const Vec3d& centre, double radius) {
  Matrix result = Matrix::Identity();
  result.topLeftCorner<3, 3>() /= radius;
  Eigen::Matrix3d turned;  // r -> -r x centre = centre x r
  turned << 0, -centre.z, centre.y, centre.z, 0, -centre.x, -centre.y, centre.x, 0;
  result.bottomLeftCorner<3, 3>() = turned / radius;
  return result;
}

/// `chance`: what the estimate of the eigenvalue would scatter by where it were 0.
WeakDirection weak_direction(double eigenvalue, double chance, const Vector& v) {
  const Vec3d turn{v[0], v[1], v[2]}, move{v[3], v[4], v[5]};
  const bool is_turn = squared_norm(turn) > squared_norm(move);
  return {normalized(is_turn ? turn : move), is_turn, eigenvalue,
          eigenvalue > 0 ? 1 / std::sqrt(eigenvalue) : std::numeric_limits<double>::infinity(),
          eigenvalue / std::max(chance, 1e-300)};
}

void add_information(const Evidence& evidence, PairRegistration& pair) {
  pair.weakest = {{0, 0, 1}, false, 0, std::numeric_limits<double>::infinity(), 0};
  if (evidence.matched == 0) return;
  const double count = static_cast<double>(evidence.matched);
  pair.centre = evidence.sum / count;
  pair.radius =
      std::sqrt(std::max(evidence.sum_squares / count - squared_norm(pair.centre), 1e-12));
  const Matrix change = from_centre(pair.centre, pair.radius);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(change.transpose() *
                                                     symmetric(evidence.information) * change);
  const Vector weakest = solver.eigenvectors().col(0);
  const double rough =
      weakest.dot(change.transpose() * symmetric(evidence.roughness) * change * weakest);
  const double independent = std::max(1.0, evidence.patches);
  pair.weakest = weak_direction(solver.eigenvalues()[0], rough / std::sqrt(independent), weakest);
  // As an estimate the smallest eigenvalues may be negative.
  const double least = kLeastInformation * std::max(solver.eigenvalues()[5], 0.0) + 1e-300;
  const Vector values = solver.eigenvalues().cwiseMax(least);
  const Matrix back = change.inverse(), axes = solver.eigenvectors();
  const Matrix turned = change * axes, returned = back.transpose() * axes;
  pair.covariance = plain(turned * values.cwiseInverse().asDiagonal() * turned.transpose());
  pair.information = plain(returned * values.asDiagonal() * returned.transpose());
}

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

void refuse(PairRegistration& pair, Refusal refusal, const std::string& reason) {
  pair.refusals.push_back(refusal);
  pair.reason += (pair.reason.empty() ? "" : "; ") + reason;
}

/// "along (1.00, 0.00, 0.00)".
std::string motion(const WeakDirection& weakest) {
  const Vec3d& a = weakest.axis;
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f})", weakest.turn ? "about" : "along", a.x, a.y,
                     a.z);
}

}  // namespace

void Evidence::add_match(const Vec3d& x, const Vec3d& n, const Vec3d& m, double weight,
                         double residual) {
  const TwistRow a = moment_row(x, n), b = moment_row(x, m);
  std::size_t k = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j, ++k) {
      information[k] += weight / 2 * (a[i] * b[j] + b[i] * a[j]);
      roughness[k] += weight / 2 * (a[i] - b[i]) * (a[j] - b[j]);
    }
  }
  sum += x;
  sum_squares += squared_norm(x);
  squares += residual * residual;
  ++matched;
}

Evidence& Evidence::operator+=(const Evidence& other) {
  points += other.points, compared += other.compared;
  matched += other.matched, contradicted += other.contradicted;
  squares += other.squares, patches += other.patches;
  for (std::size_t k = 0; k < 21; ++k) {
    information[k] += other.information[k];
    roughness[k] += other.roughness[k];
  }
  sum += other.sum, sum_squares += other.sum_squares;
  return *this;
}

void judge(const Evidence& forward, const Evidence& backward, const AcceptanceParams& acceptance,
           PairRegistration& pair) {
  pair.points = forward.points;
  pair.matched = forward.matched;
  pair.overlap = share(forward.matched, forward.points);
  pair.agreement = share(forward.matched, forward.compared);
  pair.contradiction = std::max(share(forward.contradicted, forward.compared),
                                share(backward.contradicted, backward.compared));
  pair.inlier_rmse =
      std::sqrt(forward.squares / static_cast<double>(std::max<std::size_t>(forward.matched, 1)));
  add_information(forward, pair);

  pair.refusals.clear();
  pair.reason.clear();
  if (!pair.converged) {
    refuse(pair, Refusal::not_converged,
           fmt::format("still moving after {} iterations", pair.iterations));
  }
  if (pair.overlap < acceptance.min_overlap) {
    refuse(pair, Refusal::too_little_overlap,
           fmt::format("{:.1f} % of the source have a counterpart, {:.1f} % are needed",
                       100 * pair.overlap, 100 * acceptance.min_overlap));
  }
  if (pair.inlier_rmse > acceptance.max_rmse) {
    refuse(pair, Refusal::residual_above_noise,
           fmt::format("counterparts differ by {:.2f} times the expected noise, {:.2f} is allowed",
                       pair.inlier_rmse, acceptance.max_rmse));
  }
  if (pair.contradiction > acceptance.max_contradiction) {
    refuse(pair, Refusal::contradiction,
           fmt::format("{:.1f} % of what both could see is surface to one and free to the other, "
                       "{:.1f} % are allowed",
                       100 * pair.contradiction, 100 * acceptance.max_contradiction));
  }
  const WeakDirection& weakest = pair.weakest;
  if (weakest.significance < acceptance.min_significance) {
    refuse(pair, Refusal::not_held,
           fmt::format(
               "the data do not hold it {}: what they say of that is {:.1f} times what noise "
               "alone would, {:.1f} is needed",
               motion(weakest), std::max(0.0, weakest.significance), acceptance.min_significance));
  } else if (weakest.deviation > acceptance.max_deviation) {
    refuse(pair, Refusal::not_held,
           fmt::format("the data hold it {} to {:.1f} mm, {:.1f} mm are needed", motion(weakest),
                       1e3 * weakest.deviation, 1e3 * acceptance.max_deviation));
  }
}

double shared_noise() {
  // The sum of the correlation over the image: of white noise blurred by a Gaussian of deviation s
  // it is that of exp(-d^2 / (4 s^2)), 4 pi s^2.
  constexpr double kArea = 4 * std::numbers::pi;
  return kWhiteShare +
         kArea * (kFineShare * kFineBlur * kFineBlur + kCoarseShare * kCoarseBlur * kCoarseBlur);
}

void move_twists(const Vec3d& origin, PairRegistration& pair) {
  const auto matrix_of = [](const Matrix6& m) {
    Matrix result;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        result(i, j) = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      }
    }
    return result;
  };
  // A twist about `origin` is one about the new origin whose translation is less by rotation x
  // origin.
  const Matrix change = from_centre(origin, 1), back = from_centre(-origin, 1);
  pair.covariance = plain(change * matrix_of(pair.covariance) * change.transpose());
  pair.information = plain(back.transpose() * matrix_of(pair.information) * back);
}

Result<void> check_pose(const RigidTransform& T) {
  if (rotation_defect(T) < 1e-3 && is_finite(T.translation)) return {};
  return Error{ErrorCode::invalid_argument, "the pose is not a rotation and a translation", {}};
}

}  // namespace burnish
