#pragma once
/// Points along a member at which its sections are evaluated.

#include <vector>

namespace pounding {

/// A section of a member: distance from the start and weight, as fractions of the length.
struct IntegrationPoint {
  double at = 0, weight = 0;
};

/// Points of a member at which sections are evaluated.
struct IntegrationRule {
  std::vector<IntegrationPoint> points;
  std::vector<IntegrationPoint> elastic{};  ///< points that keep their initial stiffness

  /// Throws std::invalid_argument if there are no points, a point is outside the member, a weight is zero or not
  /// finite, or the weights of all points do not sum to 1.
  void check() const;
};

/// Gauss-Lobatto, Gauss-Legendre, Gauss-Radau (with a point at the start) and Newton-Cotes rules of 2 to 10 points;
/// exact for polynomials of degree 2n - 3, 2n - 1, 2n - 2 and n - 1. Throw std::invalid_argument for another number.
IntegrationRule lobatto(int points);
IntegrationRule legendre(int points);
IntegrationRule radau(int points);
IntegrationRule newton_cotes(int points);
/// Given locations, with the weights that integrate polynomials of degree n - 1. Throws std::invalid_argument for
/// fewer than one or more than 20 locations, or two equal ones.
IntegrationRule fixed_locations(std::vector<double> locations);

/// Behaviour of a member between its hinges: points with fibres, or elastic ones.
enum class HingeInterior { fibres, elastic };

/// Hinges of given lengths (fractions of the length, at least 0) at both ends, with a two-point Gauss rule between
/// them. Scott & Fenves 2006, J. Struct. Eng. 132(2), 244-252. Throw std::invalid_argument if the hinges overlap.
///
/// Modified Gauss-Radau: weights lp and 3 lp at the end and at 8/3 lp; a hinge yields only at the end. If the interior
/// is elastic, only the two ends have fibres.
IntegrationRule hinge_radau(double start, double end, HingeInterior interior = HingeInterior::fibres);
/// Two-point Gauss-Radau rule in each hinge: weights lp/4 and 3/4 lp at the end and at 2/3 lp.
IntegrationRule hinge_radau_two(double start, double end, HingeInterior interior = HingeInterior::fibres);
/// One point in the middle of each hinge.
IntegrationRule hinge_midpoint(double start, double end, HingeInterior interior = HingeInterior::fibres);
/// One point at the end of each hinge.
IntegrationRule hinge_endpoint(double start, double end, HingeInterior interior = HingeInterior::fibres);

}  // namespace pounding
