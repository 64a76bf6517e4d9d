#pragma once
/// Moment-curvature of a section under a constant axial force, and N-M interaction.

#include <span>
#include <vector>

#include <pounding/sections/fibre_section.hpp>

namespace pounding::sections {

/// Axis of bending.
enum class Axis { y, z };

/// Point of a moment-curvature curve.
struct CurvePoint {
  double curvature = 0;     ///< [1/m]
  double moment = 0;        ///< [N m]
  double axial_strain = 0;  ///< at the origin [-]
};

/// Axial strain that gives an axial force [N] with the curvatures of `deformation`, whose axial strain is the first
/// guess. Newton's method, with bisection as fallback. Throws std::invalid_argument if the section cannot resist the
/// force.
double find_axial_strain(const FibreSection& section, const FibreStates& states, double axial_force,
                         Deformation deformation);

/// Moments along a path of curvatures about one axis under a constant axial force (compression negative), which acts
/// first. Each curvature is accepted, so the path may be cyclic. Throws std::invalid_argument, with force and
/// curvature, if the section cannot resist the force.
std::vector<CurvePoint> moment_curvature(const FibreSection& section, double axial_force,
                                         std::span<const double> curvatures, Axis axis = Axis::y);

/// As moment_curvature(), but ends before the first curvature at which the section cannot resist the force. Throws
/// std::invalid_argument if it cannot resist it at zero curvature.
std::vector<CurvePoint> resisted_curve(const FibreSection& section, double axial_force,
                                       std::span<const double> curvatures, Axis axis = Axis::y);

/// Point of an interaction diagram: axial force [N] and largest moment [N m].
struct InteractionPoint {
  double axial_force = 0, moment = 0;
};

/// Largest moment on a path of curvatures for each axial force. The path ends where the section can no longer resist
/// the force. Throws std::invalid_argument if it cannot resist a force at zero curvature.
std::vector<InteractionPoint> interaction(const FibreSection& section, std::span<const double> axial_forces,
                                          std::span<const double> curvatures, Axis axis = Axis::y);

}  // namespace pounding::sections
