#include "burnish/smoothing/symmetric_solver.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace burnish {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix lower_triangle(const std::vector<MatrixTerm>& terms, Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(terms.size());
  for (const MatrixTerm& term : terms) {
    const auto [low, high] = std::minmax(term.row, term.column);
    lower.emplace_back(static_cast<int>(high), static_cast<int>(low), term.value);
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(lower.begin(), lower.end());
  return matrix;
}

bool same_places(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

struct SymmetricSolver::Factors {
  Matrix matrix;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> ldlt;
};

SymmetricSolver::SymmetricSolver() : factors_(std::make_unique<Factors>()) {}
SymmetricSolver::~SymmetricSolver() = default;

Result<void> SymmetricSolver::solve(const std::vector<MatrixTerm>& terms, std::vector<Vec3d>& sides,
                                    const Context& context) {
  const auto size = static_cast<Eigen::Index>(sides.size());
  if (size == 0) return {};
  auto& ldlt = factors_->ldlt;
  Matrix matrix = lower_triangle(terms, size);
  const bool known = same_places(matrix, factors_->matrix);
  factors_->matrix = std::move(matrix);
  if (context.cancelled()) return cancelled();
  context.progress(0.1);
  if (!known) ldlt.analyzePattern(factors_->matrix);
  if (context.cancelled()) return cancelled();
  context.progress(0.3);
  ldlt.factorize(factors_->matrix);
  const auto unsolvable = [] {
    return Error{ErrorCode::bad_geometry,
                 "the equations of these positions have no solution in numbers",
                 {}};
  };
  if (ldlt.info() != Eigen::Success) return unsolvable();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    context.progress(0.7 + 0.1 * static_cast<double>(axis));
    if (context.cancelled()) return cancelled();
    Eigen::VectorXd side(size);
    for (Eigen::Index i = 0; i < size; ++i) side[i] = sides[static_cast<std::size_t>(i)][axis];
    const Eigen::VectorXd solution = ldlt.solve(side);
    for (Eigen::Index i = 0; i < size; ++i) sides[static_cast<std::size_t>(i)][axis] = solution[i];
  }
  if (!std::all_of(sides.begin(), sides.end(), is_finite<double>)) return unsolvable();
  return {};
}

}  // namespace burnish
