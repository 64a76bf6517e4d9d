#pragma once
/// Cross-sections from their dimensions. SI units.
///
/// Shear areas are those of Cowper (J. Appl. Mech. 33, 1966) with Poisson's ratio 0, so that a section does not depend
/// on its material; for the rectangle this is Timoshenko's 5/6. With a ratio of 0.3 they would be larger by 1 % (I) to
/// 6 % (tube). All functions throw std::invalid_argument, naming the dimension, for an invalid shape.

#include <pounding/frames/beam.hpp>
#include <pounding/frames/hinge.hpp>

namespace pounding {

/// `width` along local y, `depth` along local z [m]. Torsion constant by St Venant's series, to round-off. Shear factor
/// 5/6.
Section rectangle_section(double width, double depth);

/// A solid circle [m]. Shear factor 6/7.
Section circle_section(double diameter);

/// A round tube, outer `diameter` [m]. Shear factor 6 (1 + m^2)^2 / (7 (1 + m^2)^2 + 20 m^2), where m is the ratio of
/// inner to outer diameter.
Section tube_section(double diameter, double thickness);

/// A doubly symmetric I-section of three rectangles without fillets [m]: overall `depth` along local z, flanges of
/// `width` along local y. Torsion of thin walls: sum of length times thickness cubed over 3, with the web length
/// between the middles of the flanges. Shear along z by Cowper's thin-walled factor, along y 5/6 of the flanges.
Section i_section(double depth, double width, double flange, double web);

/// A material from Young's modulus [Pa], density [kg/m^3] and Poisson's ratio in [0, 0.5], with that of concrete as
/// default.
Material isotropic(double young, double density = 0, double poisson = 0.2);

/// A section without shear deformation (Euler-Bernoulli).
Section without_shear_deformation(Section section);

/// Size of a section across a member in a direction [m]; `axes` as from beam_axes(). A section defined by its
/// properties is treated as a rectangle with its area and inertias.
double extent(const Section& section, const Eigen::Matrix3d& axes, const Eigen::Vector3d& direction);
/// True if a member is closer to vertical than to horizontal, like a column.
bool is_upright(const Beam& beam);

/// The section turned by 90 degrees about its axis: local y and z are exchanged.
Section turned_section(Section section);

/// Plastic moment of a section about a local axis [N m] for a yield strength > 0 [Pa], without axial force. Throws
/// std::invalid_argument if the plastic modulus is unknown.
double plastic_moment(const Section& section, BendingAxis axis, double strength);

/// Multiplies both inertias by a factor > 0, as for cracked concrete; area, torsion, shear areas and
/// plastic moduli are unchanged.
Section with_stiffness(Section section, double factor);

}  // namespace pounding
