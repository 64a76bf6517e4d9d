#pragma once
/// Summary numbers of a run, and the tables that show them.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/links/impact_row.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// All impacts of one link: peaks over the impacts, sums of impulse and loss, and the state at the end of the run.
struct LinkSummary {
  std::string name;
  int impacts = 0;
  double peak_force = 0;        ///< [N]; NaN if every impact is rigid and has no finite force
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< [N s]
  double energy_lost = 0;       ///< dissipated, including friction [J]
  double energy_stored = 0;     ///< recoverable [J]
  bool presses = false;         ///< true if the link is in contact at the end
  /// Largest relative displacement of the two ends that opens the joint, from the undeformed state: its width minus the
  /// initial gap, at least 0 [m]; and its time [s].
  double largest_opening = 0, t_opening = 0;
  std::optional<double> seat{};  ///< length of the seat [m]

  /// True if the opening exceeds the seat.
  bool unseated() const { return seat && largest_opening > *seat; }
};

/// Summary of the impacts of one link, without friction.
LinkSummary summary_of(const std::string& name, std::span<const ImpactRow> impacts);

/// Extremes of one bar or damper with their times; positive in tension.
struct DeviceSummary {
  std::string name;
  Extremes extremes{2};    ///< elongation [m], force [N]
  double energy_lost = 0;  ///< dissipated by the damper [J]
};

/// Peaks of one structure: largest absolute values, one per floor from the lowest up. Displacement is relative to the
/// ground, drift relative to the floor below, acceleration absolute; in space, lengths of horizontal vectors. A
/// structure without storeys has no drift. The envelope contains the signed extremes of these and of the forces, with
/// their times.
struct StructureSummary {
  std::string name;
  std::vector<double> peak_displacement, peak_drift, peak_acceleration;  ///< [m], [m], [m/s^2]
  std::vector<std::string> directions;                                   ///< of the floor motion: x; in space x, y, rz
  /// Largest rotation about z [rad], and largest displacement of a corner of the plan, the length of a horizontal
  /// vector [m]: one per floor, NaN for a floor that is not rigid; empty for a structure without rigid floors in space.
  std::vector<double> peak_rotation{}, peak_edge_displacement{};
  StructureEnvelope envelope{};
  std::vector<SpringSummary> springs{};  ///< yielding parts; empty if there are none, as are the next three
  /// State at the end of the run, possibly still moving, one entry per floor: signed along x, in space lengths of
  /// horizontal vectors [m]. A structure without storeys has no drift.
  std::vector<double> residual_displacement{}, residual_drift{};
  /// absolute drift divided by the storey height [-]; empty if heights are unknown
  std::vector<double> residual_drift_ratio{};

  /// For a checkpoint.
  void archive(Archive& archive) {
    archive(name, peak_displacement, peak_drift, peak_acceleration, directions, peak_rotation, peak_edge_displacement,
            envelope, springs, residual_displacement, residual_drift, residual_drift_ratio);
  }
};

/// Gap that keeps the two ends of a link apart: from the run without links, and by rules that combine the largest
/// absolute displacements of the two ends in that run [m].
struct LinkSeparation {
  std::string link;
  double gap = 0;           ///< actual gap of the link
  double enough = 0;        ///< largest approach of the two ends over time, at least 0
  double time = 0;          ///< time of that approach [s]
  double left = 0;          ///< uA: peak displacement of the left end along the link, either sign
  double right = 0;         ///< uB: of the right end
  double absolute_sum = 0;  ///< uA + uB
  double srss = 0;          ///< sqrt(uA^2 + uB^2)
  /// sqrt(uA^2 + uB^2 - 2 rho uA uB), see double_difference(); NaN if a structure has no period
  double ddc = 0;

  /// For a checkpoint.
  void archive(Archive& archive) {
    archive(link);
    for (double* value : {&gap, &enough, &time, &left, &right, &absolute_sum, &srss, &ddc}) archive(*value);
  }
};

/// Energies at the end of the run [J]; `error` is the largest imbalance over the run divided by its largest input [-].
struct EnergySummary {
  double input = 0, kinetic = 0, strain = 0, damping = 0, hysteretic = 0, impact = 0, devices = 0, error = 0;
};

/// Summary numbers of a run.
struct Summary {
  std::string status;  ///< running | done | done: collapse ... | failed: reason
  std::vector<LinkSummary> links;
  std::vector<DeviceSummary> devices;
  std::vector<StructureSummary> structures;
  EnergySummary energy;
  std::string integrator;  ///< time integration scheme by its name in the input
  SolverStatistics solver;
  std::vector<std::string> options;       ///< PETSc options in effect: "-pounding_ts_rtol 1e-6"
  std::vector<ReducedStructure> reduced;  ///< reduced structures, with estimated errors
  /// Warnings of implausible values in the model and the run, and of energies that do not balance; one line each.
  std::vector<std::string> warnings;
  /// Structures in the run without links that `compare: no_pounding` requests; otherwise empty.
  std::vector<StructureSummary> without_pounding;
  std::string without_links_status;         ///< status of that run, as above
  std::vector<LinkSeparation> separations;  ///< from that run, one per link
  std::vector<ImpactRow> impacts;           ///< in order of touch; `link` is an index into `links`
  double tolerance = 0, duration = 0;       ///< in effect, including options [-], [s]
  std::string model_json;                   ///< assumptions_json() of the model; empty if not requested
};

/// The object that `pounding run --json` prints, on one line.
std::string to_json(const Summary& summary);

/// A warning that the energies of a run with this tolerance do not balance; empty if they do.
std::string warning(const Summary& summary, double tolerance);

/// The tables that `pounding run` prints, in engineering units.
std::string to_table(const Summary& summary);

}  // namespace pounding
