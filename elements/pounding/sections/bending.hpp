#pragma once
/// Analysis of a section in bending: yield, largest moment and failure under axial forces.

#include <span>
#include <string>
#include <vector>

#include <pounding/sections/moment_curvature.hpp>

namespace pounding::sections {

/// A section that bends under a constant axial force.
struct Bending {
  double axial_force = 0;         ///< compression negative [N]
  std::vector<CurvePoint> curve;  ///< from the undeformed section, as far as it resists the force
  /// First yield: steel at its yield strain, or concrete at the strain of its strength. Zero if it is not reached.
  double yield_curvature = 0, yield_moment = 0;
  double largest_moment = 0;  ///< before crushing [N m]
  /// First curvature at which the moment has fallen to 80 % of the largest one, or the most ductile concrete is at its
  /// crushing strain; zero if it is not reached.
  double ultimate_curvature = 0;
  bool crushes = false;  ///< true if it ends by crushing

  /// Cracked EI: secant to first yield [N m^2]; zero without yield.
  double cracked_stiffness() const { return yield_curvature > 0 ? yield_moment / yield_curvature : 0; }
  /// Yield curvature of the bilinear curve through first yield with the largest moment: phi_y M_max/M_y [1/m].
  double idealized_yield_curvature() const {
    return yield_curvature > 0 ? yield_curvature * largest_moment / yield_moment : 0;
  }
};

/// Bends a section to `curvatures`, ascending from above 0. Throws std::invalid_argument if it cannot resist the force.
Bending bend(const FibreSection& section, double axial_force, std::span<const double> curvatures, Axis axis = Axis::y);

/// Bending stiffness of the undeformed section about the elastic centroid [N m^2].
double initial_bending_stiffness(const FibreSection& section, Axis axis = Axis::y);

/// Largest tension and compression on monotonic paths of axial strain without curvature [N].
struct AxialStrength {
  double tension = 0, compression = 0;  ///< compression < 0
};
AxialStrength axial_strength(const FibreSection& section);

/// 30 axial forces within the strength of a section, from tension to compression [N].
std::vector<double> forces_of_diagram(const FibreSection& section);

}  // namespace pounding::sections
