#pragma once
/// Cross-sections from their shape. SI units.
///
/// Shear areas are Cowper's (J. Appl. Mech. 33, 1966) with Poisson's ratio 0, so that a section does not depend on its
/// material; for the rectangle this is Timoshenko's 5/6. With the ratio 0.3 they would be larger by 1 (I) to 6 %
/// (tube). Every function throws std::invalid_argument, with the length in its text, for a shape that cannot be.

#include <pounding/frames/beam.hpp>

namespace pounding {

/// `width` along local y, `depth` along local z [m]. Torsion constant by St Venant's series, to rounding. Shear factor
/// 5/6.
Section rectangle_section(double width, double depth);

/// A solid circle [m]. Shear factor 6/7.
Section circle_section(double diameter);

/// A round tube, `diameter` outside [m]. Shear factor 6 (1 + m^2)^2 / (7 (1 + m^2)^2 + 20 m^2), m inner over outer
/// diameter.
Section tube_section(double diameter, double thickness);

/// A doubly symmetric I of three rectangles without fillets [m]: `depth` over the flanges along local z, flanges of
/// `width` along local y. Torsion by the thin walls' sum of length times thickness cubed over 3, the web counted
/// between the middles of the flanges. Shear along z by Cowper's thin-walled factor, along y 5/6 of the flanges.
Section i_section(double depth, double width, double flange, double web);

/// A material by Young's modulus [Pa], density [kg/m^3] and Poisson's ratio in [0, 0.5], which concrete has unless it
/// is given.
Material isotropic(double young, double density = 0, double poisson = 0.2);

/// A section without its shear deformation (Euler-Bernoulli).
Section without_shear_deformation(Section section);

/// Size of a section across a member in a direction [m]; `axes` as from beam_axes(). A section given by numbers counts
/// as a rectangle of its area and inertias.
double extent(const Section& section, const Eigen::Matrix3d& axes, const Eigen::Vector3d& direction);
/// Whether a member rises more than it runs, as columns do.
bool is_upright(const Beam& beam);

/// Both inertias times a factor > 0, as for cracked concrete; area, torsion and shear areas stay.
Section with_stiffness(Section section, double factor);

}  // namespace pounding
