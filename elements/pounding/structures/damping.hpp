#pragma once
/// Natural modes of a structure, and damping matrices from fractions of critical damping.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>

#include <pounding/structures/massless.hpp>

namespace pounding {

/// Angular frequencies [rad/s] in increasing order, and mode shapes with phi^T M phi = 1 (n x count), including the
/// massless degrees of freedom by static condensation.
struct Eigenmodes {
  Eigen::VectorXd frequencies;
  Eigen::MatrixXd shapes;
};

/// Computes the `count` lowest modes of sparse symmetric M and K. Empty rows of M are massless degrees of freedom.
using ModeSolver = std::function<Eigenmodes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count)>;

/// ModeSolver with dense matrices of the size of the degrees of freedom with mass, and static condensation of all
/// others. For up to hundreds of them.
///
/// Frequencies that are zero within round-off are set to zero. The largest component of each shape is positive. Throws
/// std::invalid_argument for a count outside 0 .. number of degrees of freedom with mass, for a mass matrix that is not
/// positive definite over these, for a stiffness that is singular over the massless ones (naming one), and for a
/// stiffness that is negative in some mode: a structure that buckles.
Eigenmodes dense_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count);

/// Modes with these shapes (n x count): frequencies from Rayleigh's quotient, with the order, scale and sign of
/// dense_modes. Throws std::invalid_argument if the stiffness is negative in one of them.
Eigenmodes modes_of_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness, const Eigen::MatrixXd& shapes);

/// Throws std::invalid_argument, naming a degree of freedom, if the stiffness is singular over the massless ones.
void require_static_stiffness(const SparseMatrix& mass, const SparseMatrix& stiffness);

/// Throws std::invalid_argument if fewer modes are available.
void require_mode_count(int count, std::size_t available);

/// All solutions of K phi = w^2 M phi: w^2 [1/s^2] in increasing order, and phi as columns with phi^T M phi = 1.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// Throws std::invalid_argument if M is not positive definite, or if the solver does not converge.
Eigenpairs eigenpairs(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);
/// Frequencies and shapes of all modes; negative squares are set to zero. Throws like eigenpairs.
Eigenmodes eigenmodes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// Factors a and b of C = a M + b K.
struct Rayleigh {
  double by_mass = 0;       ///< a [1/s]
  double by_stiffness = 0;  ///< b [s]
};

/// Damping ratio `ratio` at the angular frequencies w1 and w2 [rad/s]; for w1 = w2, mass and stiffness contribute
/// equally.
Rayleigh rayleigh_damping(double ratio, double w1, double w2);

/// C = M Phi diag(2 ratio w) Phi^T M: the same ratio in every mode.
Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const Eigenmodes& modes, double ratio);

/// Maximum number of modes for which the dense matrix of modal damping is formed.
inline constexpr int max_for_modal_damping = 1500;

/// Throws std::invalid_argument for more than max_for_modal_damping modes, with the alternative to type.
void require_modal_matrix(int modes);

/// Modal damping matrix with the same ratio in every mode of sparse M and K. Empty rows of M are massless degrees of
/// freedom, which are not damped. Throws std::invalid_argument like require_modal_matrix and dense_modes.
SparseMatrix modal_damping_matrix(const SparseMatrix& mass, const SparseMatrix& stiffness, double ratio);

}  // namespace pounding
