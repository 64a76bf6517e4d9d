#include "support/dense.hpp"

#include <Eigen/Dense>

namespace pounding::test::dense {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }

MatrixXd solve_columns(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

VectorXd eigenvalues(const MatrixXd& a) { return a.selfadjointView<Eigen::Lower>().eigenvalues(); }

Modes modes(const MatrixXd& stiffness, const MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> found(stiffness, mass);
  return {found.eigenvalues(), found.eigenvectors()};
}

Condensed condense(const MatrixXd& stiffness, const MatrixXd& mass) {
  Condensed made;
  for (int i = 0; i < mass.rows(); ++i) (mass(i, i) > 0 ? made.dynamic : made.massless).push_back(i);
  const MatrixXd coupling = stiffness(made.massless, made.dynamic);
  made.stiffness = stiffness(made.dynamic, made.dynamic);
  made.mass = mass(made.dynamic, made.dynamic);
  made.following = MatrixXd::Zero(coupling.rows(), coupling.cols());
  if (!made.massless.empty()) {
    made.following = -solve_columns(stiffness(made.massless, made.massless), coupling);
    made.stiffness += coupling.transpose() * made.following;
  }
  return made;
}

}  // namespace pounding::test::dense
