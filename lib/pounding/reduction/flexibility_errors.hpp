#pragma once
/// Errors of the flexibility of links in the modes of a run and of its shadow.

#include <Eigen/Core>

#include <pounding/linear/group_modes.hpp>

namespace pounding::petsc {

/// Modes of a run with the columns of its links, and further directions. All are mass-orthonormal, so the stiffness is
/// [squares, coupling; coupling^T, own].
struct FurtherDirections {
  Eigen::VectorXd squares;        ///< of the circular frequencies of the modes [rad^2/s^2]
  Eigen::MatrixXd links;          ///< [mode, link]
  Eigen::MatrixXd coupling, own;  ///< [mode, direction] and [direction, direction]
  Eigen::MatrixXd further_links;  ///< [direction, link]
};

/// Rayleigh damping, by_mass M + by_stiffness K [1/s, s], and a fraction of critical damping in every mode.
struct ClassicalDamping {
  double by_mass = 0, by_stiffness = 0, modal = 0;

  bool operator==(const ClassicalDamping&) const = default;
};

/// Errors of the link flexibility G(w) = B^T (K + i w C - w^2 M)^-1 B in the modes of a run, and in those of its
/// shadow.
struct FlexibilityErrors {
  double run = 0, shadow = 0;  ///< [m/N]; both 0 if unknown
};

/// Both are relative to the modes with the further directions. Each is the largest entry at frequencies w up to four
/// times that of the contact [rad/s], divided by 1 + (w / contact)^2, the decay of the spectrum of a pulse of half a
/// contact period. The force error of the shadow is such a pulse acting on the error of its flexibility; the same holds
/// for the run. Resonances missing from both count in both, so the errors are similar if lightly damped modes are
/// missing. Modal damping applies to the modes of each basis.
FlexibilityErrors flexibility_errors(const FurtherDirections& of, const ShadowModes& shadow,
                                     const ClassicalDamping& damping, double contact);

}  // namespace pounding::petsc
