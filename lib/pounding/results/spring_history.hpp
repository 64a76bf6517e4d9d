#pragma once
/// Yielding parts of a structure (storeys and hinges): their histories, and a few summary numbers per part.

#include <limits>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/structures/yield_limits.hpp>

namespace pounding {

/// Counts swings of deformation. A new swing starts when the deformation reverses by more than the sum of both yield
/// deformations; the first one when it exceeds one of them. A bilinear part yields once in each swing.
struct CycleCounts {
  std::vector<double> turn;  ///< largest excursion of the current swing, one per part
  std::vector<double>
      swings;  ///< number including the current one, which is upwards if positive, downwards if negative

  /// Moves a part monotonically to a deformation; `limits` are its deformations at first yield.
  void follow(std::size_t part, double deformation, const YieldLimits& limits);
  /// Half the number of swings of a part.
  double cycles(std::size_t part) const { return 0.5 * std::abs(swings[part]); }
  void archive(Archive& archive);
};

/// Deformations are storey drifts [m] or hinge rotations [rad]. Forces are shears [N] or moments [N m], equal to k
/// times the deformation while the part is elastic. Lists are row-major [time, part] at the output times, or have one
/// entry per part.
struct SpringHistory {
  std::vector<std::string> names, laws;    ///< "storey 1", "bilinear"
  std::vector<double> ultimate;            ///< ultimate plastic rotation of a hinge [rad]; NaN if not given
  std::vector<bool> hinges;                ///< true for a hinge at the end of a member
  std::vector<double> stiffness;           ///< initial k
  std::vector<YieldLimits> limits;         ///< deformations at the first yield
  std::vector<double> deformation, force;  ///< over time
  std::vector<double> hysteretic;          ///< cumulative dissipated energy [J], over time

  // The following cover the whole run up to now.
  Extremes deformations, forces;    ///< over all steps, including interior extrema
  Extremes resultants;              ///< resultants of isolators that couple two directions; without values for others
  std::vector<double> last;         ///< current deformation
  std::vector<double> lost;         ///< energy dissipated by yielding [J]
  std::vector<double> first_yield;  ///< time at which the yield deformation was first exceeded [s]; NaN if never
  /// Largest damping force across a storey divided by its yield force; NaN for parts that are not storeys.
  std::vector<double> damping_shear;
  std::vector<double> plastic;  ///< largest absolute plastic deformation, d - f/k
  CycleCounts cycles;

  /// Number of parts.
  std::size_t size() const { return names.size(); }
  /// For a checkpoint: everything that changes, except histories over time.
  void archive(Archive& archive);
};

/// Summary of one part over the run up to now.
struct SpringSummary {
  std::string name, law;
  bool is_hinge = false;           ///< hinge at the end of a member
  double peak = 0, peak_time = 0;  ///< deformation of largest magnitude, signed [m] or [rad], and its time [s]
  double peak_force = 0;           ///< largest absolute force [N] or [N m]
  /// largest deformation in any direction of an element [m], and its time [s]
  double resultant = 0, resultant_time = 0;
  /// largest ratio of deformation to the yield deformation in its direction, see YieldLimits::ductility(); of a part
  /// that yields together with others, of their resultant
  double ductility = 0;
  double plastic = 0;  ///< largest absolute plastic deformation [m] or [rad]
  /// ultimate plastic rotation of a hinge [rad]; NaN if not given
  double ultimate = std::numeric_limits<double>::quiet_NaN();
  double cycles = 0;       ///< half the number of swings, see CycleCounts
  double residual = 0;     ///< deformation at the end, possibly still moving [m] or [rad]
  double energy_lost = 0;  ///< [J]
  double first_yield = std::numeric_limits<double>::quiet_NaN();    ///< [s]; NaN if it stayed elastic
  double damping_shear = std::numeric_limits<double>::quiet_NaN();  ///< see SpringHistory

  /// True if its yield deformation was ever exceeded.
  bool yielded() const { return first_yield == first_yield; }
  /// True if a hinge exceeds its ultimate plastic rotation.
  bool is_beyond_ultimate() const { return plastic > ultimate; }
  /// "elastic", "yielded" or "beyond ultimate".
  const char* state() const { return is_beyond_ultimate() ? "beyond ultimate" : yielded() ? "yielded" : "elastic"; }
  /// For a checkpoint.
  void archive(Archive& archive);
};

/// One entry per part, in their order.
std::vector<SpringSummary> summaries(const SpringHistory& springs);
/// Part with the largest ductility; nullptr if the list is empty.
const SpringSummary* most_ductile(const std::vector<SpringSummary>& springs);

}  // namespace pounding
