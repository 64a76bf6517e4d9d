#pragma once
/// Natural modes of one structure, and damping matrices from ratios of critical damping.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include <pounding/structures/massless.hpp>

namespace pounding {

/// Angular frequencies [rad/s], increasing, and shapes with phi^T M phi = 1 (n x count); unknowns without mass follow
/// statically.
struct Eigenmodes {
  Eigen::VectorXd frequencies;
  Eigen::MatrixXd shapes;
};

/// Finds the `count` lowest modes of sparse symmetric M (may have empty rows: massless unknowns), K.
using ModeSolver = std::function<Eigenmodes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count)>;

/// A ModeSolver by dense matrices of the size of the unknowns with mass, all others condensed: for hundreds of them.
///
/// A frequency that rounding cannot tell from zero is zero. The largest component of a shape is positive.
/// Throws std::invalid_argument for a count that is not in 0 .. number of unknowns with mass, a mass matrix that is not
/// positive definite over these, a stiffness that is singular over the others (naming one), or one that is negative for
/// some motion: a structure that buckles.
Eigenmodes dense_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count);

/// The modes that these columns (n x count) are the shapes of: frequencies by Rayleigh's quotient, order, scale and
/// sign as dense_modes gives them. Throws std::invalid_argument for a stiffness that is negative for one of them.
Eigenmodes modes_of_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness, const Eigen::MatrixXd& shapes);

/// Throws std::invalid_argument, naming an unknown, when the stiffness is singular over the unknowns without mass.
void require_static_stiffness(const SparseMatrix& mass, const SparseMatrix& stiffness);

/// Throws std::invalid_argument when there are not so many modes.
void require_mode_count(int count, std::size_t available);

/// All solutions of K phi = w^2 M phi: the w^2 [1/s^2], increasing, and phi as columns with phi^T M phi = 1.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// Throws std::invalid_argument when M is not positive definite, or they do not converge.
Eigenpairs eigenpairs(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);
/// Their frequencies and shapes; a square below zero counts as zero. Throws as eigenpairs does.
Eigenmodes eigenmodes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// Factors a and b of C = a M + b K.
struct Rayleigh {
  double by_mass = 0;       ///< a [1/s]
  double by_stiffness = 0;  ///< b [s]
};

/// The ratio `ratio` at the circular frequencies w1 and w2 [rad/s]; w1 = w2 gives a and b that share the ratio equally
/// there.
Rayleigh rayleigh_damping(double ratio, double w1, double w2);

/// C = M Phi diag(2 ratio w) Phi^T M: the ratio in every mode.
Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const Eigenmodes& modes, double ratio);

/// Modal damping fills a matrix of as many rows as there are modes; of more than these none is formed.
inline constexpr int max_for_modal_damping = 1500;

/// The matrix of a ratio in every mode of sparse M (may have empty rows), K. Unknowns without mass take no part in it.
/// Throws std::invalid_argument for more modes than max_for_modal_damping, with what to type instead, and as
/// dense_modes does.
SparseMatrix modal_damping_matrix(const SparseMatrix& mass, const SparseMatrix& stiffness, double ratio);

}  // namespace pounding
