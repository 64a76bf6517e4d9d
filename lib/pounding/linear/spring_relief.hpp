#pragma once
/// Deflection of massless degrees of freedom under spring forces.

#include <Eigen/Core>

#include <pounding/model/system.hpp>

namespace pounding {

/// True if a link of the system is a spring.
inline bool is_spring(const System& system, int link) {
  return link >= system.contact_count() && link < system.contact_count() + system.spring_count();
}

/// Massless degrees of freedom (s) are in static equilibrium with the others (m) and with the springs of their
/// structure,
///
///   u_s = -K_ss^-1 K_sm u_m - W F,   W = K_ss^-1 B_s,
///
/// so the deformation of a spring is B_e^T u_m - S F + c with B_e = B_m - K_ms W and S = B_s^T W + R. The coordinates
/// of a StructureSolver exclude W F: massless degrees of freedom follow the others as without springs, and B^T
/// applied to the coordinates equals B_e^T u_m. Spring forces act on the coordinates through B_e.
///
/// Every process holds all of it. Columns of W cover a structure, columns of S its springs. All are empty if no spring
/// deflects a massless degree of freedom.
class SpringRelief {
 public:
  /// No spring acts on a massless degree of freedom.
  SpringRelief() = default;
  /// Throws std::invalid_argument if a massless degree of freedom has no stiffness, and for a spring at a massless
  /// degree of freedom of a structure with its own elastic forces.
  explicit SpringRelief(const System& system);

  /// True if the force of a spring changes its own deformation, or that of another spring, instantaneously.
  bool any() const { return flexibility_.nonZeros() > 0; }
  /// S [springs x springs], symmetric [m/N] or [rad/(N m)]; empty for none.
  const SparseMatrix& flexibility() const { return flexibility_; }
  /// W [unknowns x springs]; empty if no spring acts on a massless degree of freedom.
  const SparseMatrix& way() const { return way_; }
  /// B_e of all springs [unknowns x springs], with zero rows at massless degrees of freedom; empty if way() is.
  const SparseMatrix& push() const { return push_; }

  /// y += factor S f for springs with nonzero force; one entry per spring.
  void add_relief(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::Ref<Eigen::VectorXd> y) const;
  /// u += factor W f, for forces or their rates.
  void add_way(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::VectorXd& u) const;

 private:
  SparseMatrix flexibility_, way_, push_;
};

}  // namespace pounding
