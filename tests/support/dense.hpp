#pragma once
/// Algebra of full matrices for expected values, compiled once: in every file of its own a decomposition costs seconds
/// of the compiler.

#include <Eigen/Core>

#include <vector>

namespace pounding::test::dense {

/// x of A x = b by an LDL^T decomposition; A is symmetric and invertible.
Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// One x a column of b.
Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The inverse of any matrix that has one.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
/// Eigenvalues of a symmetric matrix in ascending order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a);

/// K x = w^2 M x: squares of the circular frequencies [1/s^2] in ascending order, and a mode in each column with x^T M
/// x = 1.
struct Modes {
  Eigen::VectorXd squares;
  Eigen::MatrixXd shapes;
};
/// Modes of a structure whose masses are all positive.
Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// A structure whose unknowns without mass follow the others: u(massless) = following u(dynamic) where no force acts on
/// them.
struct Condensed {
  std::vector<int> dynamic, massless;  ///< unknowns with mass and without
  Eigen::MatrixXd stiffness, mass;     ///< of those with mass
  Eigen::MatrixXd following;
};
/// An unknown has no mass where the diagonal of the mass is zero: found without split_by_mass, which belongs to what is
/// tested.
Condensed condense(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

}  // namespace pounding::test::dense
