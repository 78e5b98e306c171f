#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// A term of a symmetric matrix; of (row, column) and (column, row) only one is named. Terms of the
/// same place add up.
struct MatrixTerm {
  std::uint32_t row, column;
  double value;
};

/// Solves sparse systems of equations with a symmetric positive definite matrix by Cholesky's
/// method (L D L^T), on one thread, so that the result is the same bytes whatever the machine.
/// Matrices with the same places one after the other share what is found out about them.
class SymmetricSolver {
 public:
  SymmetricSolver();
  ~SymmetricSolver();
  SymmetricSolver(const SymmetricSolver&) = delete;
  SymmetricSolver& operator=(const SymmetricSolver&) = delete;

  /// Replaces `sides`, the right-hand sides of the equations for the three coordinates, by their
  /// solution. Errors: bad_geometry where the matrix is not positive definite in numbers;
  /// cancelled, which is looked for between the steps of the work.
  Result<void> solve(const std::vector<MatrixTerm>& matrix, std::vector<Vec3d>& sides,
                     const Context& context);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace burnish
