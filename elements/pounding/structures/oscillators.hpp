#pragma once
/// Structures along x from a few numbers: bodies, oscillators, shear buildings and walls. SI units.

#include <optional>
#include <vector>

#include <pounding/structures/isolators.hpp>
#include <pounding/structures/one_or_each.hpp>
#include <pounding/structures/structure.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// A free mass.
struct BodyOptions {
  double mass = 0;  ///< [kg]
  /// Constant acceleration along x, as by the weight where x is drawn upright [m/s^2]: -9.80665 falls to the left.
  double gravity = 0;
};
/// A mass that nothing holds to the ground. Throws std::invalid_argument for a mass that is not positive and finite,
/// and for a gravity that is not finite.
Structure make_body(const BodyOptions& options);

/// One mass on a spring and a dashpot.
struct OscillatorOptions {
  double mass = 0;                    ///< m [kg]
  std::optional<double> period{};     ///< T [s]: k = m (2 pi/T)^2
  std::optional<double> stiffness{};  ///< k [N/m], instead of the period
  /// c = 2 ratio sqrt(k m), in [0, 1). Nothing where the damping is given to Model::add.
  std::optional<double> damping_ratio{};
  std::optional<double> yield_force{};    ///< [N]; the spring stays elastic without one
  double hardening = 0;                   ///< of a spring that yields, see let_storeys_yield
  std::optional<SpringOptions> spring{};  ///< another law by which it yields, instead of the two above
};
/// Throws std::invalid_argument for what is missing, given twice or out of range.
Structure make_oscillator(const OscillatorOptions& options);
/// m (2 pi/T)^2 [N/m].
double stiffness_of_period(double mass, double period);

/// Storeys on each other, each a mass on a spring. Every list goes from the ground up. Where the lowest storey is
/// isolators, the lowest floor is the slab on them, and what is said of storeys, their stiffness and how they yield, is
/// said of those above it.
struct ShearBuildingOptions {
  int storeys = 0;                            ///< the isolators included
  OneOrEach mass{}, stiffness{};              ///< [kg], [N/m]
  std::optional<IsolatorOptions> isolator{};  ///< all isolators together, under the weight of all masses
  OneOrEach height{};                         ///< of each storey [m]; may be left out
  OneOrEach yield_force{};                    ///< [N]; the storeys stay elastic without one
  OneOrEach hardening{};                      ///< of storeys that yield, 0 unless given, see let_storeys_yield
  std::optional<SpringOptions> spring{};      ///< another law by which they yield, instead of the two above
};
/// No damping yet: it is given to Model::add. Throws std::invalid_argument for what is missing or out of range.
Structure make_shear_building(const ShearBuildingOptions& options);

/// Stiffness of the storeys that may yield by let_storeys_yield, those above isolators, from the ground up [N/m].
std::vector<double> stiffness_of_storeys(const Structure& structure);

/// Lets every storey of a structure, above isolators where there are any, yield bilinearly at the force given for it,
/// from the ground up [N]; its stiffness after that is `hardening` in [0, 1) times the initial one. The damping stays
/// that of the initial stiffness. Throws std::invalid_argument when a number is out of range or the storeys are counted
/// wrong.
void let_storeys_yield(Structure& structure, const std::vector<double>& yield_forces,
                       const std::vector<double>& hardening);

/// Lets these storeys of a structure yield by a law. The damping stays that of the initial stiffness. Throws
/// std::invalid_argument, with the storey, for what the law refuses.
void let_storeys_yield(Structure& structure, const SpringOptions& spring);

/// Rigid, moves with the ground.
Structure make_wall();

}  // namespace pounding
