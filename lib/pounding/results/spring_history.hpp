#pragma once
/// Parts of a structure that yield, storeys and hinges, over a run: their histories, and each part in a few numbers.

#include <limits>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/structures/yield_limits.hpp>

namespace pounding {

/// Counts swings of deformations: each goes on by more than the sum of both yield deformations beyond the last turn,
/// the first one by more than one of them from zero. A bilinear part yields in each of them once.
struct CycleCounts {
  std::vector<double> turn;    ///< deformation farthest on the way of the present swing, one a part
  std::vector<double> swings;  ///< so far; the present one goes up where this is positive, down where it is negative

  /// A part goes straight to a deformation, and yields at these for the first time.
  void follow(std::size_t part, double deformation, const YieldLimits& limits);
  /// Half the number of swings of a part.
  double cycles(std::size_t part) const { return 0.5 * std::abs(swings[part]); }
  void archive(Archive& archive);
};

/// Deformations are drifts of storeys [m] or rotations of hinges [rad]; forces are shears [N] or moments [N m], k times
/// the deformation while the part is elastic. Lists are row-major [time, part] at the output times, or have one entry a
/// part.
struct SpringHistory {
  std::vector<std::string> names, laws;    ///< "storey 1", "bilinear"
  std::vector<double> ultimate;            ///< plastic rotation that a hinge can bear [rad]; NaN where none was given
  std::vector<bool> hinges;                ///< whether it is a hinge at the end of a member
  std::vector<double> stiffness;           ///< initial k
  std::vector<YieldLimits> limits;         ///< deformations at the first yield
  std::vector<double> deformation, force;  ///< over time
  std::vector<double> hysteretic;          ///< energy lost so far [J], over time

  // These count the whole run so far.
  Extremes deformations, forces;    ///< over all steps, inside the steps too
  std::vector<double> last;         ///< deformation now
  std::vector<double> lost;         ///< energy lost by yielding [J]
  std::vector<double> first_yield;  ///< when the yield deformation was first exceeded [s]; NaN where it never was
  /// Largest force of the structure's damping across a storey, over its yield force; NaN for parts that are no storeys.
  std::vector<double> damping_shear;
  std::vector<double> plastic;  ///< largest size of the plastic part of the deformation, d - f/k
  CycleCounts cycles;

  /// Number of parts.
  std::size_t size() const { return names.size(); }
  /// For a checkpoint: all that moves and is not over time.
  void archive(Archive& archive);
};

/// One part over the run so far.
struct SpringSummary {
  std::string name, law;
  bool is_hinge = false;           ///< at the end of a member
  double peak = 0, peak_time = 0;  ///< deformation of the largest size, signed [m] or [rad], and when [s]
  double peak_force = 0;           ///< largest absolute force [N] or [N m]
  double ductility = 0;  ///< largest size over the yield deformation of its direction, see YieldLimits::ductility()
  double plastic = 0;    ///< largest size of the plastic part of the deformation [m] or [rad]
  double ultimate =
      std::numeric_limits<double>::quiet_NaN();  ///< what a hinge can bear of it [rad]; NaN where none was given
  double cycles = 0;                             ///< half the number of swings, see CycleCounts
  double residual = 0;                           ///< deformation at the end, which may still move [m] or [rad]
  double energy_lost = 0;                        ///< [J]
  double first_yield = std::numeric_limits<double>::quiet_NaN();    ///< [s]; NaN where it stayed elastic
  double damping_shear = std::numeric_limits<double>::quiet_NaN();  ///< see SpringHistory

  /// Whether its yield deformation was ever exceeded.
  bool yielded() const { return first_yield == first_yield; }
  /// Whether a hinge has turned further than it can bear.
  bool is_beyond_ultimate() const { return plastic > ultimate; }
  /// "elastic", "yielded" or "beyond ultimate".
  const char* state() const { return is_beyond_ultimate() ? "beyond ultimate" : yielded() ? "yielded" : "elastic"; }
  /// For a checkpoint.
  void archive(Archive& archive);
};

/// One entry a part, in their order.
std::vector<SpringSummary> summaries(const SpringHistory& springs);
/// The part with the largest ductility; nullptr for none.
const SpringSummary* most_ductile(const std::vector<SpringSummary>& springs);

}  // namespace pounding
