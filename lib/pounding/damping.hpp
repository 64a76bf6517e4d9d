#pragma once
/// Damping matrices of one structure from ratios of critical damping.

#include <Eigen/Core>

namespace pounding {

/// Natural circular frequencies [rad/s], ascending, and mass-normalised mode shapes as columns.
struct Eigenmodes {
  Eigen::VectorXd frequencies;
  Eigen::MatrixXd shapes;
};

/// Solves K phi = w^2 M phi. Throws std::invalid_argument when M is not positive definite.
Eigenmodes eigenmodes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// C = a M + b K with the ratio `ratio` at the circular frequencies w1 and w2 [rad/s]; w1 = w2 gives a and b that share
/// the ratio equally there.
Eigen::MatrixXd rayleigh_damping(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness, double ratio, double w1,
                                 double w2);

/// C = M Phi diag(2 ratio w) Phi^T M: the ratio in every mode.
Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const Eigenmodes& modes, double ratio);

}  // namespace pounding
