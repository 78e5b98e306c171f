#include "burnish/registration/pose_fit.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

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

/// One fit to the constraints that count.
class Fit {
 public:
  Fit(PoseModel& poses, std::span<const PoseConstraint> constraints, const std::vector<bool>& out)
      : poses_(poses), size_(static_cast<Eigen::Index>(poses.unknowns())) {
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      if (!out[i]) constraints_.push_back(&constraints[i]);
    }
  }

  /// Levenberg and Marquardt's method until a step changes next to nothing.
  Result<bool> run(int& iterations, const Context& context) {
    constexpr int kMostIterations = 100;
    constexpr double kSmallChange = 1e-10;
    if (size_ == 0) return true;
    double damping = 1e-6, cost = cost_now();
    for (int i = 0; i < kMostIterations; ++i, ++iterations) {
      if (context.cancelled()) return cancelled();
      linearize();
      bool better = false;
      for (; damping < 1e9 && !better; damping *= 10) {
        const Eigen::VectorXd step = solve(damping);
        if (!step.allFinite()) continue;
        poses_.move(std::span(step.data(), std::size_t(size_)));
        const double after = cost_now();
        if (after <= cost) {
          better = true;
          const bool small = cost - after <= kSmallChange * (cost + 1e-12);
          cost = after;
          if (small) return true;
        } else {
          poses_.take_back();
        }
      }
      damping = std::max(damping / 1000, 1e-9);
      if (!better) return true;  // no step makes it better: this is the least
    }
    return false;
  }

 private:
  double cost_now() const {
    double cost = 0;
    for (const PoseConstraint* constraint : constraints_) cost += squares(poses_, *constraint);
    return cost;
  }

  void linearize() {
    std::vector<Eigen::Triplet<double>> entries;
    gradient_ = Eigen::VectorXd::Zero(size_);
    for (const PoseConstraint* constraint : constraints_) {
      const Square6 information = matrix_of(constraint->information);
      const Vector6 pull = information * error_of(poses_, *constraint);
      const std::vector<Column> columns = jacobian(poses_, *constraint);
      for (const Column& a : columns) {
        gradient_[a.unknown] += a.change.dot(pull);
        const Vector6 weighted = information * a.change;
        for (const Column& b : columns) {
          if (b.unknown <= a.unknown)
            entries.emplace_back(int(a.unknown), int(b.unknown), weighted.dot(b.change));
        }
      }
    }
    // What nothing holds stays where it is: its diagonal is not 0 any more.
    double largest = 0;
    for (const auto& entry : entries) largest = std::max(largest, std::abs(entry.value()));
    for (int i = 0; i < size_; ++i) entries.emplace_back(i, i, 1e-12 * largest + 1e-300);
    matrix_.resize(size_, size_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
  }

  Eigen::VectorXd solve(double damping) const {
    Eigen::SparseMatrix<double> damped = matrix_;
    for (int i = 0; i < size_; ++i) damped.coeffRef(i, i) *= 1 + damping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(damped);
    return -factors.solve(gradient_);
  }

  PoseModel& poses_;
  Eigen::Index size_;
  std::vector<const PoseConstraint*> constraints_;
  Eigen::SparseMatrix<double> matrix_;  ///< the lower triangle
  Eigen::VectorXd gradient_;
};

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
    const Result<bool> done =
        Fit(poses, constraints, result.contradicted).run(result.iterations, context);
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

}  // namespace burnish
