#include <pounding/damping.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace pounding {

Eigenmodes eigenmodes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  if (solver.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
  return {solver.eigenvalues().cwiseMax(0).cwiseSqrt(), solver.eigenvectors()};
}

Eigen::MatrixXd rayleigh_damping(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness, double ratio, double w1,
                                 double w2) {
  const double by_mass = 2 * ratio * w1 * w2 / (w1 + w2);
  const double by_stiffness = 2 * ratio / (w1 + w2);
  return by_mass * mass + by_stiffness * stiffness;
}

Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const Eigenmodes& modes, double ratio) {
  const Eigen::MatrixXd shapes = mass * modes.shapes;
  return shapes * (2 * ratio * modes.frequencies).asDiagonal() * shapes.transpose();
}

}  // namespace pounding
