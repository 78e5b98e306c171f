#include <Eigen/SparseCore>

#include "passes_peer.h"

// The mean as a sparse product: a row-normalised adjacency matrix with the identity, times N x 3.
// Eq. 1 is not linear.
int main(int argc, char** argv) {
  if (wants_equation1(argc, argv)) return 3;
  const PlainMesh mesh = read_plain_mesh(argv[1]);
  const auto count = static_cast<Eigen::Index>(mesh.positions.size());
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Stopwatch adjacency;
  std::vector<Eigen::Triplet<double>> ones;
  ones.reserve(6 * mesh.triangles.size() + mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [v, w] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      ones.emplace_back(static_cast<int>(v), static_cast<int>(w), 1.);
      ones.emplace_back(static_cast<int>(w), static_cast<int>(v), 1.);
    }
  }
  for (int v = 0; v < count; ++v) ones.emplace_back(v, v, 1.);
  Matrix mean(count, count);
  mean.setFromTriplets(ones.begin(), ones.end(), [](double, double) { return 1.; });
  for (Eigen::Index v = 0; v < count; ++v) {
    const double share = 1. / static_cast<double>(mean.innerVector(v).nonZeros());
    for (Matrix::InnerIterator entry(mean, v); entry; ++entry) entry.valueRef() = share;
  }
  adjacency.print();
  Points points(count, 3);
  for (Eigen::Index v = 0; v < count; ++v) {
    const auto& p = mesh.positions[static_cast<std::size_t>(v)];
    points.row(v) << p[0], p[1], p[2];
  }
  Points next(count, 3);
  const Stopwatch passes;
  for (int pass = 0; pass < kPasses; ++pass) {
    next.noalias() = mean * points;
    points.swap(next);
  }
  passes.print();
  return points.allFinite() ? 0 : 1;
}
