#pragma once
/// Dense matrix algebra for expected values, compiled once: a decomposition costs seconds of compile time per file.

#include <Eigen/Core>

#include <vector>

namespace pounding::test::dense {

/// x of A x = b by an LDL^T decomposition; A is symmetric and invertible.
Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// One x per column of b.
Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The inverse of an invertible matrix.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
/// Eigenvalues of a symmetric matrix in ascending order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a);

/// K x = w^2 M x: squares of the circular frequencies [1/s^2] in ascending order, and one mode per column with x^T M x
/// = 1.
struct Modes {
  Eigen::VectorXd squares;
  Eigen::MatrixXd shapes;
};
/// Modes of a structure whose masses are all positive.
Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// A structure whose massless degrees of freedom follow the others: u(massless) = following u(dynamic) without forces
/// on them.
struct Condensed {
  std::vector<int> dynamic, massless;  ///< degrees of freedom with mass, and massless ones
  Eigen::MatrixXd stiffness, mass;     ///< of those with mass
  Eigen::MatrixXd following;
};
/// A degree of freedom is massless if its diagonal of M is zero; found without split_by_mass, which is under test.
Condensed condense(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

}  // namespace pounding::test::dense
