#include "burnish/registration/pose_fit.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/core/disjoint_sets.h"
#include "burnish/registration/twist.h"

namespace burnish {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Square6 = Eigen::Matrix<double, 6, 6>;

Vector6 vector_of(const Twist& twist) {
  Vector6 v;
  v << twist.rotation.x, twist.rotation.y, twist.rotation.z, twist.translation.x,
      twist.translation.y, twist.translation.z;
  return v;
}

Square6 matrix_of(const Matrix6& matrix) {
  Square6 m;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) m(i, j) = matrix[std::size_t(i)][std::size_t(j)];
  }
  return m;
}

/// How far the poses are from what a constraint says.
Vector6 error_of(const PoseModel& poses, const PoseConstraint& constraint) {
  const RigidTransform T_target_world = poses.pose(constraint.target).inverse();
  return vector_of(
      difference(constraint.T_target_source, T_target_world * poses.pose(constraint.source)));
}

double squares(const PoseModel& poses, const PoseConstraint& constraint) {
  const Vector6 e = error_of(poses, constraint);
  return std::max(0., e.dot(matrix_of(constraint.information) * e));
}

/// How the error of a constraint changes with an unknown.
struct Column {
  std::uint32_t unknown;
  Vector6 change;
};

std::vector<Column> jacobian(const PoseModel& poses, const PoseConstraint& constraint) {
  const RigidTransform T_target_world = poses.pose(constraint.target).inverse();
  std::vector<Column> columns;
  const auto add = [&](std::uint32_t view, double sign) {
    for (const PoseModel::Motion& motion : poses.motions(view)) {
      const Vector6 change = sign * vector_of(in_axes_of(T_target_world, motion.per_unit));
      const auto same = std::find_if(columns.begin(), columns.end(), [&](const Column& column) {
        return column.unknown == motion.unknown;
      });
      if (same == columns.end()) {
        columns.push_back({motion.unknown, change});
      } else {
        same->change += change;
      }
    }
  };
  add(constraint.source, 1);
  add(constraint.target, -1);
  return columns;
}

/// The matrix of a Gauss-Newton step (its lower triangle) and the gradient.
struct SparseEquations {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd gradient;
};

SparseEquations linearized(const PoseModel& poses,
                           std::span<const PoseConstraint* const> constraints) {
  const auto size = static_cast<Eigen::Index>(poses.unknowns());
  SparseEquations equations{Eigen::SparseMatrix<double>(size, size), Eigen::VectorXd::Zero(size)};
  std::vector<Eigen::Triplet<double>> entries;
  double largest = 0;
  for (const PoseConstraint* constraint : constraints) {
    const Square6 information = matrix_of(constraint->information);
    const Vector6 pull = information * error_of(poses, *constraint);
    const std::vector<Column> columns = jacobian(poses, *constraint);
    for (const Column& a : columns) {
      equations.gradient[a.unknown] += a.change.dot(pull);
      const Vector6 weighted = information * a.change;
      for (const Column& b : columns) {
        if (b.unknown > a.unknown) continue;
        entries.emplace_back(int(a.unknown), int(b.unknown), weighted.dot(b.change));
        largest = std::max(largest, std::abs(entries.back().value()));
      }
    }
  }
  // What nothing holds stays where it is: its diagonal is not 0 any more.
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1e-12 * largest + 1e-300);
  equations.matrix.setFromTriplets(entries.begin(), entries.end());
  return equations;
}

using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

std::vector<const PoseConstraint*> those_that_count(std::span<const PoseConstraint> constraints,
                                                    const std::vector<bool>& left_out) {
  std::vector<const PoseConstraint*> counting;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!left_out[i]) counting.push_back(&constraints[i]);
  }
  return counting;
}

double cost_of(const PoseModel& poses, std::span<const PoseConstraint* const> constraints) {
  double cost = 0;
  for (const PoseConstraint* constraint : constraints) cost += squares(poses, *constraint);
  return cost;
}

/// Levenberg and Marquardt's method until a step changes next to nothing; whether it came to that.
Result<bool> fit(PoseModel& poses, std::span<const PoseConstraint* const> constraints,
                 int& iterations, const Context& context) {
  constexpr int kMostIterations = 100;
  constexpr double kSmallChange = 1e-10, kMostDamping = 1e9;
  if (poses.unknowns() == 0) return true;
  double damping = 1e-6, cost = cost_of(poses, constraints);
  for (int i = 0; i < kMostIterations; ++i) {
    if (context.cancelled()) return cancelled();
    ++iterations;
    const SparseEquations equations = linearized(poses, constraints);
    double after = std::numeric_limits<double>::infinity();
    while (!(after <= cost)) {
      if (damping > kMostDamping) return true;  // no step makes it better: this is the least
      Eigen::SparseMatrix<double> damped = equations.matrix;
      for (Eigen::Index k = 0; k < damped.rows(); ++k) damped.coeffRef(k, k) *= 1 + damping;
      const Eigen::VectorXd step = -Factors(damped).solve(equations.gradient);
      if (step.allFinite()) {
        poses.move(std::span(step.data(), poses.unknowns()));
        after = cost_of(poses, constraints);
        if (!(after <= cost)) poses.take_back();
      }
      damping *= 10;
    }
    const bool small = cost - after <= kSmallChange * (cost + 1e-12);
    cost = after;
    if (small) return true;
    damping = std::max(damping / 1000, 1e-9);
  }
  return false;
}

/// Whether the views of `constraint` are joined by others that count.
bool joined_without(std::span<const PoseConstraint> constraints, const std::vector<bool>& out,
                    std::size_t left_out, std::size_t views) {
  DisjointSets sets(views);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!out[i] && i != left_out) sets.unite(constraints[i].target, constraints[i].source);
  }
  return sets.find(constraints[left_out].target) == sets.find(constraints[left_out].source);
}

Result<void> check(std::span<const PoseConstraint> constraints, std::size_t views) {
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const PoseConstraint& c = constraints[i];
    const std::string where = fmt::format("constraint {}", i);
    if (c.target >= views || c.source >= views || c.target == c.source) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("is of the views {} and {}; two of {} were expected", c.target,
                               c.source, views),
                   where};
    }
    if (!matrix_of(c.information).allFinite()) {
      return Error{ErrorCode::invalid_argument, "its information is not finite", where};
    }
  }
  return {};
}

}  // namespace

Facts PoseFit::facts() const {
  double largest = 0, sum = 0;
  std::size_t out = 0, count = 0;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    out += contradicted[i];
    if (contradicted[i]) continue;
    largest = std::max(largest, deviations[i]);
    sum += deviations[i] * deviations[i];
    ++count;
  }
  return {{"constraints", double(deviations.size()), ""},
          {"contradicted_constraints", double(out), ""},
          {"rms_deviation", count ? std::sqrt(sum / double(count)) : 0, ""},
          {"largest_deviation", largest, ""},
          {"iterations", double(iterations), ""},
          {"converged", converged ? 1. : 0., ""}};
}

Result<PoseFit> fit_poses(PoseModel& poses, std::span<const PoseConstraint> constraints,
                          double max_deviation, const Context& context) {
  if (!(max_deviation > 0)) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("more than 0 was expected, {} was given", max_deviation),
                 "max_deviation"};
  }
  if (auto sound = check(constraints, poses.views()); !sound) return sound.error();
  PoseFit result;
  result.contradicted.assign(constraints.size(), false);
  for (;;) {
    const auto counting = those_that_count(constraints, result.contradicted);
    const Result<bool> done = fit(poses, counting, result.iterations, context);
    if (!done) return done.error();
    result.converged = *done;
    result.deviations.clear();
    for (const PoseConstraint& constraint : constraints) {
      result.deviations.push_back(std::sqrt(squares(poses, constraint) / 6));
    }
    std::size_t worst = constraints.size();
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      if (result.contradicted[i] || result.deviations[i] <= max_deviation) continue;
      if (worst < constraints.size() && result.deviations[i] <= result.deviations[worst]) continue;
      if (joined_without(constraints, result.contradicted, i, poses.views())) worst = i;
    }
    if (worst == constraints.size()) return result;
    result.contradicted[worst] = true;
  }
}

Result<std::vector<Matrix6>> pose_covariances(const PoseModel& poses,
                                              std::span<const PoseConstraint> constraints,
                                              const std::vector<bool>& contradicted,
                                              std::size_t reference, const Context& context) {
  if (auto sound = check(constraints, poses.views()); !sound) return sound.error();
  if (reference >= poses.views() || contradicted.size() != constraints.size()) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("view {} of {} and {} constraints of {} were given", reference,
                             poses.views(), contradicted.size(), constraints.size()),
                 {}};
  }
  const SparseEquations equations = linearized(poses, those_that_count(constraints, contradicted));
  const Factors factors(equations.matrix);
  std::vector<Matrix6> covariances(poses.views());
  for (std::uint32_t view = 0; view < poses.views(); ++view) {
    if (context.cancelled()) return cancelled();
    if (view == reference) continue;
    // How this view moves as seen from the reference: what the whole world does cancels.
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(equations.matrix.rows(), 6);
    const PoseConstraint seen{std::uint32_t(reference), view, {}, {}};
    for (const Column& column : jacobian(poses, seen)) {
      motion.row(column.unknown) = column.change.transpose();
    }
    const Square6 covariance = motion.transpose() * factors.solve(motion);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        covariances[view][i][j] = covariance(Eigen::Index(i), Eigen::Index(j));
      }
    }
  }
  return covariances;
}

double deviation_at(const Matrix6& covariance, const Vec3d& x) {
  Eigen::Matrix<double, 3, 6> change;  // rotation x x + translation
  change << 0, x.z, -x.y, 1, 0, 0,     //
      -x.z, 0, x.x, 0, 1, 0,           //
      x.y, -x.x, 0, 0, 0, 1;
  const Eigen::Matrix3d spread = change * matrix_of(covariance) * change.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(axes.eigenvalues()[2], 0.));
}

}  // namespace burnish
