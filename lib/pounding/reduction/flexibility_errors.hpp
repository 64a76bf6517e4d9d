#pragma once
/// How wrong the flexibility of links is in few modes, and in still fewer.

#include <Eigen/Core>

#include <pounding/linear/group_modes.hpp>

namespace pounding::petsc {

/// Modes of a run with the columns of its links, and directions beside them. All are orthonormal by the mass, so that
/// the stiffness is [squares, coupling; coupling^T, own].
struct FurtherDirections {
  Eigen::VectorXd squares;        ///< of the circular frequencies of the modes [rad^2/s^2]
  Eigen::MatrixXd links;          ///< [mode, link]
  Eigen::MatrixXd coupling, own;  ///< [mode, direction] and [direction, direction]
  Eigen::MatrixXd further_links;  ///< [direction, link]
};

/// Rayleigh damping, by_mass M + by_stiffness K [1/s, s], and a part of critical damping in every mode.
struct ClassicalDamping {
  double by_mass = 0, by_stiffness = 0, modal = 0;

  bool operator==(const ClassicalDamping&) const = default;
};

/// Errors of the links' flexibility G(w) = B^T (K + i w C - w^2 M)^-1 B in the modes of a run, and in those of its
/// shadow.
struct FlexibilityErrors {
  double run = 0, shadow = 0;  ///< [m/N]; both 0 where they are not known
};

/// Both against the modes with the further directions: largest entries at frequencies up to four times that of the
/// contact, w [rad/s], each over 1 + (w / contact)^2, as the spectrum of a pulse of half a period of the contact falls.
/// What the shadow misses of a force is such a pulse through the error of its flexibility, and so is what the run
/// misses. Resonances that neither has yet count in both, so that the errors are alike where modes that are little
/// damped are missing. Modal damping is that of the modes of each basis.
FlexibilityErrors flexibility_errors(const FurtherDirections& of, const ShadowModes& shadow,
                                     const ClassicalDamping& damping, double contact);

}  // namespace pounding::petsc
