#pragma once
/// Pushover of a building by horizontal forces on its floors.

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <pounding/pushover/push_path.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Distribution of the forces over the floors, with the floor masses m.
enum class LoadPattern {
  triangular,  ///< m z, with the height z above the lowest support, or the floor number if heights are unknown
  uniform,     ///< m
  mode1,       ///< m phi, with the mode of largest effective mass in the direction
  given
};

/// Name in the input: "triangular".
const char* name_of(LoadPattern pattern);

/// Loads and targets of a pushover.
struct PushoverOptions {
  LoadPattern pattern = LoadPattern::triangular;
  std::vector<double> forces{};  ///< of a given pattern, from the ground up, in any scale
  int direction = 0;             ///< 0 for x, 1 for y
  /// Successive roof displacements [m]. A single one yields a capacity curve, several yield cycles.
  std::vector<double> targets;
};

/// Bilinear idealisation of a curve of base shear over roof displacement, with a horizontal second line, according to
/// EN 1998-1, annex B (the N2 method). The lines end at the end of the curve, or at its maximum base shear if it falls
/// after that; the area under both is the same. After a mechanism without hardening, the yield displacement does not
/// depend on that end.
struct BilinearCurve {
  double base_shear = 0;          ///< [N]
  double yield_displacement = 0;  ///< [m]
  double displacement = 0;        ///< at the end of the lines [m]
};

/// Equivalent oscillator of annex B, for displacements proportional to the loads divided by the masses: phi =
/// load/mass, 1 at the roof.
struct EquivalentOscillator {
  double mass = 0;  ///< m* = sum m phi [kg]
  double participation =
      0;              ///< Gamma = m*/sum m phi^2: ratio of base shear and roof displacement to those of the oscillator
  double period = 0;  ///< T* = 2 pi sqrt(m* d/F), with yield displacement and base shear of the two lines [s]
};

/// Results of a pushover.
struct Pushover {
  std::string structure;
  PushoverOptions options;
  double height =
      std::numeric_limits<double>::quiet_NaN();  ///< of the roof above the lowest support [m]; NaN if unknown
  std::vector<std::string> floors;               ///< labels, from the ground up
  std::vector<double> loads;                     ///< on the floors, with sum 1
  /// A yielding part: name, law, k [N/m] or [N m/rad], and yield deformation [m] or [rad].
  struct Part {
    std::string name, law;
    double stiffness = 0, yield_deformation = 0;
    YieldLimits limits{};
  };
  std::vector<Part> parts;
  PushPath path;                                   ///< the load factor is the base shear [N]
  Eigen::MatrixXd floor_displacements;             ///< [point, floor] in the direction [m]
  std::optional<BilinearCurve> bilinear;           ///< for a single target
  std::optional<EquivalentOscillator> equivalent;  ///< if the load on the roof and all masses are positive

  /// Index of the first point at which a part yields; nullopt if there is none.
  std::optional<int> first_yield() const;
  /// Index of the point with the maximum base shear; its magnitude for cycles.
  int strongest() const;
  /// Ratio of the base shear at a point to that at first yield; at the mechanism this is alpha_u/alpha_1 of EN 1998-1.
  /// NaN without yielding.
  double overstrength(int point) const;
  /// Maximum ratio over the path of the deformation of a part to its yield deformation in the same direction; for a
  /// hinge as defined by YieldLimits::ductility().
  double ductility(int part) const;
  /// Force of a part at a point [N] or [N m].
  double force(int point, int part) const;
  /// Plastic deformation of a part at the end of the path [m] or [rad].
  double plastic_deformation(int part) const;
};

/// Height of the highest floor above the lowest support [m]; NaN if heights were not given.
double roof_height(const Structure& structure);

/// Pushes a building. Throws std::invalid_argument for one without floors or yielding parts, for a direction in which
/// it does not move, for loads that are not one per floor or have zero sum, for targets that are zero or too small for
/// yielding (with the displacement at first yield), and like push(); SolverError like push().
Pushover pushover(const Structure& structure, const PushoverOptions& options, const ModeSolver& modes = dense_modes);

/// Bilinear idealisation of a curve.
BilinearCurve bilinear_curve(const std::vector<double>& displacements, const std::vector<double>& base_shears);

/// Equivalent oscillator of a building under these loads on its floors; nullopt if a floor has no mass or the roof no
/// load.
std::optional<EquivalentOscillator> equivalent_oscillator(const Structure& structure, const std::vector<double>& loads,
                                                          const BilinearCurve& curve);

/// Short text: events in order, mechanism, overstrength, bilinear idealisation, ductilities.
std::string pushover_table(const Pushover& found);
/// JSON object of the results, in SI; the guide of the program lists its members. The points of the path may be
/// omitted.
std::string pushover_json(const Pushover& found, bool with_points = true);

}  // namespace pounding
