#pragma once
/// Structures along x with few parameters: bodies, oscillators, shear buildings and walls. SI units.

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
  /// Constant acceleration along x [m/s^2], such as gravity if x is vertical: -9.80665 acts in the negative direction.
  double gravity = 0;
};
/// Creates a mass without a connection to the ground. Throws std::invalid_argument for a mass that is not positive and
/// finite, and for a gravity that is not finite.
Structure make_body(const BodyOptions& options);

/// One mass on a spring and a dashpot.
struct OscillatorOptions {
  double mass = 0;                    ///< m [kg]
  std::optional<double> period{};     ///< T [s]: k = m (2 pi/T)^2
  std::optional<double> stiffness{};  ///< k [N/m], instead of the period
  /// c = 2 ratio sqrt(k m), in [0, 1). Empty if the damping is passed to Model::add.
  std::optional<double> damping_ratio{};
  std::optional<double> yield_force{};    ///< [N]; if empty, the spring is elastic
  double hardening = 0;                   ///< post-yield stiffness ratio, see let_storeys_yield
  std::optional<SpringOptions> spring{};  ///< another hysteretic law, instead of the two above
};
/// Throws std::invalid_argument for a parameter that is missing, given twice or out of range.
Structure make_oscillator(const OscillatorOptions& options);
/// m (2 pi/T)^2 [N/m].
double stiffness_of_period(double mass, double period);

/// A stack of storeys, each a mass on a spring. Lists are ordered from the ground up. If the lowest storey consists of
/// isolators, the lowest floor is the slab above them, and stiffness and yielding refer to the storeys above it.
struct ShearBuildingOptions {
  int storeys = 0;                            ///< including the isolators
  OneOrEach mass{}, stiffness{};              ///< [kg], [N/m]
  std::optional<IsolatorOptions> isolator{};  ///< all isolators combined, under the weight of all masses
  OneOrEach height{};                         ///< of each storey [m]; optional
  OneOrEach yield_force{};                    ///< [N]; if empty, the storeys are elastic
  OneOrEach hardening{};  ///< post-yield stiffness ratio of yielding storeys, default 0, see let_storeys_yield
  std::optional<SpringOptions> spring{};  ///< another hysteretic law, instead of the two above
};
/// Creates a building without damping, which is passed to Model::add. Throws std::invalid_argument for a parameter that
/// is missing or out of range.
Structure make_shear_building(const ShearBuildingOptions& options);

/// Stiffness of the storeys that let_storeys_yield() applies to, those above isolators, from the ground up [N/m].
std::vector<double> stiffness_of_storeys(const Structure& structure);

/// Lets every storey of a structure (above isolators, if any) yield bilinearly at the given force, from the ground up
/// [N]. The post-yield stiffness is `hardening` in [0, 1) times the initial one. The damping remains that of the
/// initial stiffness. Throws std::invalid_argument for values out of range and for lists of the wrong length.
void let_storeys_yield(Structure& structure, const std::vector<double>& yield_forces,
                       const std::vector<double>& hardening);

/// Lets these storeys of a structure yield by a hysteretic law. The damping remains that of the initial stiffness.
/// Throws std::invalid_argument, naming the storey, for settings that the law rejects.
void let_storeys_yield(Structure& structure, const SpringOptions& spring);

/// Rigid, moves with the ground.
Structure make_wall();

}  // namespace pounding
