#include <pounding/structures/damping.hpp>

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pounding {
namespace {

// Relative size of a pivot below which the matrix is singular.
constexpr double no_pivot = 1e-12;
// Round-off of Rayleigh's quotient and of the entries of K, relative to the sum of magnitudes |phi|^T |K| |phi|.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
// Components of almost the same size are treated as equal, as those of a symmetric structure are up to round-off.
constexpr double equally_large = 1 - 1e-6;

// Factorizes K for the massless degrees of freedom.
void factor(Eigen::SimplicialLDLT<SparseMatrix>& ldlt, const SparseMatrix& k, const std::vector<int>& unknowns) {
  if (unknowns.empty()) return;
  ldlt.compute(k);
  const Eigen::VectorXd pivots = ldlt.vectorD();
  // In the order of elimination, which ends at a pivot of exactly zero.
  for (int step = 0; step < pivots.size(); ++step) {
    const int i = ldlt.permutationPinv().indices()[step];
    if (!(pivots[step] > no_pivot * k.coeff(i, i)))
      throw std::invalid_argument(
          fmt::format("the stiffness of the massless degrees of freedom is singular or not positive definite: a motion "
                      "that involves degree of freedom {} has no stiffness",
                      unknowns[i]));
  }
}

bool turned(const Eigen::VectorXd& shape) {
  const double largest = shape.lpNorm<Eigen::Infinity>();
  for (const double component : shape)
    if (std::abs(component) >= equally_large * largest) return component < 0;
  return false;
}

}  // namespace

void require_mode_count(int count, std::size_t available) {
  if (count < 0 || static_cast<std::size_t>(count) > available)
    throw std::invalid_argument(
        fmt::format("{} modes requested, but only {} degrees of freedom have mass", count, available));
}

void require_static_stiffness(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const std::vector<int> massless = split_by_mass(mass).massless;
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  factor(ldlt, submatrix(stiffness, massless, massless), massless);
}

Eigenmodes modes_of_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness, const Eigen::MatrixXd& shapes) {
  const SparseMatrix magnitudes = stiffness.cwiseAbs();
  const int count = static_cast<int>(shapes.cols());
  Eigen::VectorXd squares(count);
  Eigen::MatrixXd scaled(shapes.rows(), count);
  for (int j = 0; j < count; ++j) {
    Eigen::VectorXd shape = shapes.col(j);
    shape /= (turned(shape) ? -1 : 1) * std::sqrt(shape.dot(mass * shape));
    const double noise = rounding * shape.cwiseAbs().dot(magnitudes * shape.cwiseAbs());
    squares[j] = shape.dot(stiffness * shape);
    if (squares[j] < -noise)
      throw std::invalid_argument(fmt::format(
          "the stiffness is negative in some mode (w^2 = {:.4g} (rad/s)^2): the structure buckles", squares[j]));
    if (squares[j] <= noise) squares[j] = 0;
    scaled.col(j) = shape;
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return squares[a] < squares[b]; });
  return {squares(order).cwiseSqrt(), scaled(Eigen::all, order)};
}

Eigenmodes dense_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count) {
  const auto [dynamic, massless] = split_by_mass(mass);
  require_mode_count(count, dynamic.size());
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  factor(ldlt, submatrix(stiffness, massless, massless), massless);
  const SparseMatrix coupling = submatrix(stiffness, massless, dynamic);
  const Eigen::MatrixXd following =
      massless.empty() ? Eigen::MatrixXd(0, dynamic.size()) : -ldlt.solve(Eigen::MatrixXd(coupling));
  const Eigen::MatrixXd condensed =
      dense_submatrix(stiffness, dynamic, dynamic) + Eigen::MatrixXd(coupling.transpose() * following);
  const Eigen::MatrixXd shapes =
      dynamic.empty() ? Eigen::MatrixXd(0, 0) : eigenmodes(dense_submatrix(mass, dynamic, dynamic), condensed).shapes;
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(mass.rows(), count);
  whole(dynamic, Eigen::all) += shapes.leftCols(count);
  whole(massless, Eigen::all) += following * shapes.leftCols(count);
  return modes_of_shapes(mass, stiffness, whole);
}

Eigenpairs eigenpairs(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  // The solver does not check that the mass matrix has a Cholesky factor.
  if (mass.llt().info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  if (solver.info() != Eigen::Success)
    throw std::invalid_argument("the eigenvalue solver for the modes of a structure did not converge");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigenmodes eigenmodes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  Eigenpairs pairs = eigenpairs(mass, stiffness);
  return {pairs.values.cwiseMax(0).cwiseSqrt(), std::move(pairs.vectors)};
}

Rayleigh rayleigh_damping(double ratio, double w1, double w2) {
  return {2 * ratio * w1 * w2 / (w1 + w2), 2 * ratio / (w1 + w2)};
}

Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const Eigenmodes& modes, double ratio) {
  const Eigen::MatrixXd shapes = mass * modes.shapes;
  return shapes * (2 * ratio * modes.frequencies).asDiagonal() * shapes.transpose();
}

void require_modal_matrix(int modes) {
  if (modes > max_for_modal_damping)
    throw std::invalid_argument(
        fmt::format("modal damping would fill a dense {0} x {0} matrix; type damping: {{rayleigh: {{ratio: 5 "
                    "%, modes: [1, 2]}}}}",
                    modes));
}

SparseMatrix modal_damping_matrix(const SparseMatrix& mass, const SparseMatrix& stiffness, double ratio) {
  const int count = static_cast<int>(split_by_mass(mass).dynamic.size());
  require_modal_matrix(count);
  return SparseMatrix(modal_damping(Eigen::MatrixXd(mass), dense_modes(mass, stiffness, count), ratio).sparseView());
}

}  // namespace pounding
