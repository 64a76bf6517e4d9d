#pragma once
/// A building that is pushed over by horizontal forces on its floors.

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <pounding/pushover/push_path.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// How the forces on the floors are shared out: with the masses m of the floors,
enum class LoadPattern {
  triangular,  ///< m z, with the height z above the lowest support; with the number of the floor where heights are not
               ///< known
  uniform,     ///< m
  mode1,       ///< m phi, with the mode that has the largest effective mass in the direction
  given
};

/// Name in the input: "triangular".
const char* name_of(LoadPattern pattern);

/// How a structure is pushed, and how far.
struct PushoverOptions {
  LoadPattern pattern = LoadPattern::triangular;
  std::vector<double> forces{};  ///< of a given pattern, from the ground up, to any scale
  int direction = 0;             ///< 0 for x, 1 for y
  /// Displacements of the roof, reached one after the other [m]. One of them makes a capacity curve, several make
  /// cycles.
  std::vector<double> targets;
};

/// A curve of base shear over displacement of the roof as two straight lines, the second one level, by EN 1998-1, annex
/// B (the N2 method): the lines end where the curve ends, or at its largest base shear where it falls after that; the
/// area under both is the same. Behind a mechanism without hardening the yield displacement does not depend on that
/// end.
struct BilinearCurve {
  double base_shear = 0;          ///< [N]
  double yield_displacement = 0;  ///< [m]
  double displacement = 0;        ///< where the lines end [m]
};

/// The oscillator that stands for the building in annex B, where displacements follow the loads over the masses: phi =
/// load/mass, 1 at the roof.
struct EquivalentOscillator {
  double mass = 0;  ///< m* = sum m phi [kg]
  double participation =
      0;              ///< Gamma = m*/sum m phi^2: base shear and displacement of the roof over those of the oscillator
  double period = 0;  ///< T* = 2 pi sqrt(m* d/F), with yield displacement and base shear of the two lines [s]
};

/// Results of a pushover.
struct Pushover {
  std::string structure;
  PushoverOptions options;
  double height = std::numeric_limits<double>::quiet_NaN();  ///< of the roof above the lowest support [m]; NaN where it
                                                             ///< is not known
  std::vector<std::string> floors;                           ///< labels, from the ground up
  std::vector<double> loads;                                 ///< on the floors, with the sum 1
  /// A part that yields: its name, its law, k, and the deformation at which it yields [N/m] and [m], or [N m/rad] and
  /// [rad].
  struct Part {
    std::string name, law;
    double stiffness = 0, yield_deformation = 0;
    YieldLimits limits{};
  };
  std::vector<Part> parts;
  PushPath path;                                   ///< the factor of the load is the base shear [N]
  Eigen::MatrixXd floor_displacements;             ///< [point, floor] in the direction [m]
  std::optional<BilinearCurve> bilinear;           ///< of a single target
  std::optional<EquivalentOscillator> equivalent;  ///< where the load on the roof and all masses are positive

  /// The point at which a part first yields; nothing where none does.
  std::optional<int> first_yield() const;
  /// The point with the largest base shear, of cycles by its size.
  int strongest() const;
  /// Base shear at a point over that at the first yield; at the mechanism this is alpha_u/alpha_1 of EN 1998-1. NaN
  /// without a yield.
  double overstrength(int point) const;
  /// Largest deformation of a part over the path, over that at which it yields in its direction; of a hinge as
  /// YieldLimits::ductility() says.
  double ductility(int part) const;
  /// Force of a part at a point [N] or [N m].
  double force(int point, int part) const;
  /// Plastic part of the deformation of a part at the end of the path [m] or [rad].
  double plastic_deformation(int part) const;
};

/// Height of the highest floor above the lowest support [m]; NaN where heights were not given.
double roof_height(const Structure& structure);

/// Pushes a building. Throws std::invalid_argument for one without floors or without parts that yield, for a direction
/// in which it does not move, for loads that are not one a floor or have no sum, for targets that are zero or so small
/// that nothing yields (with the displacement at which something does), and as push(); SolverError as push().
Pushover pushover(const Structure& structure, const PushoverOptions& options, const ModeSolver& modes = dense_modes);

/// The two straight lines of a curve.
BilinearCurve bilinear_curve(const std::vector<double>& displacements, const std::vector<double>& base_shears);

/// The oscillator that stands for a building under these loads on its floors; nothing where a floor has no mass or the
/// roof no load.
std::optional<EquivalentOscillator> equivalent_oscillator(const Structure& structure, const std::vector<double>& loads,
                                                          const BilinearCurve& curve);

/// A few lines: events in their order, mechanism, overstrength, the two straight lines, ductilities.
std::string pushover_table(const Pushover& found);
/// All of it as one JSON object, in SI; the guide of the program lists its members. The points of the path may be left
/// out.
std::string pushover_json(const Pushover& found, bool with_points = true);

}  // namespace pounding
