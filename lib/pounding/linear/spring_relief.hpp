#pragma once
/// How unknowns without mass give way to the forces of springs.

#include <Eigen/Core>

#include <pounding/model/system.hpp>

namespace pounding {

/// Whether a link of the system is a spring.
inline bool is_spring(const System& system, int link) {
  return link >= system.contact_count() && link < system.contact_count() + static_cast<int>(system.springs.size());
}

/// Unknowns without mass (s) are in static equilibrium with those with mass (m) and with the springs of their
/// structure,
///
///   u_s = -K_ss^-1 K_sm u_m - W F,   W = K_ss^-1 B_s,
///
/// so the deformation of a spring is B_e^T u_m - S F + c with B_e = B_m - K_ms W and S = B_s^T W + R. The coordinates
/// of a StructureSolver leave W F out: they follow those with mass as without springs, and B_e^T u_m is B^T of them.
/// Forces of springs act on them by B_e.
///
/// Every process holds all of it. Columns of W fill a structure, those of S its springs; there is nothing where no
/// spring gives way.
class SpringRelief {
 public:
  /// No spring gives way.
  SpringRelief() = default;
  /// Throws std::invalid_argument where the stiffness leaves an unknown without mass loose, and for a spring at such an
  /// unknown of a structure that has elastic forces of its own.
  explicit SpringRelief(const System& system);

  /// Whether the force of any spring changes its own deformation or that of another at once.
  bool any() const { return flexibility_.nonZeros() > 0; }
  /// S [springs x springs], symmetric [m/N] or [rad/(N m)]; empty for none.
  const SparseMatrix& flexibility() const { return flexibility_; }
  /// W [unknowns x springs]; empty where no spring acts on an unknown without mass.
  const SparseMatrix& way() const { return way_; }
  /// B_e of all springs [unknowns x springs], with rows of zeros at unknowns without mass; empty where way() is.
  const SparseMatrix& push() const { return push_; }

  /// y += factor S f for the springs whose force is not zero, one entry a spring.
  void add_relief(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::Ref<Eigen::VectorXd> y) const;
  /// u += factor W f, for forces or their rates.
  void add_way(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::VectorXd& u) const;

 private:
  SparseMatrix flexibility_, way_, push_;
};

}  // namespace pounding
