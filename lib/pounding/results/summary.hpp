#pragma once
/// A run in a few numbers, and the tables that show them.

#include <span>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/links/impact_row.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// All impacts of one link: peaks over the impacts, sums of impulse and loss; and what it holds at the end of the run.
struct LinkSummary {
  std::string name;
  int impacts = 0;
  double peak_force = 0;        ///< [N]; NaN where every impact is rigid and so has no finite force
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< [N s]
  double energy_lost = 0;       ///< dissipated, friction included [J]
  double energy_stored = 0;     ///< can still be given back [J]
  bool presses = false;         ///< the bodies press on each other at the end
};

/// Summary of the impacts of one link, without friction.
LinkSummary summary_of(const std::string& name, std::span<const ImpactRow> impacts);

/// Extremes of one bar or damper with their times; positive in tension.
struct DeviceSummary {
  std::string name;
  Extremes extremes{2};    ///< elongation [m], force [N]
  double energy_lost = 0;  ///< by the damper [J]
};

/// Peaks of one structure: largest absolute values, one a floor from the lowest up. Displacement relative to the
/// ground, drift relative to the floor below, acceleration absolute; in space lengths of horizontal vectors. A
/// structure without storeys has no drift. The envelope has the signed extremes of these and of the forces, with their
/// times.
struct StructureSummary {
  std::string name;
  std::vector<double> peak_displacement, peak_drift, peak_acceleration;  ///< [m], [m], [m/s^2]
  std::vector<std::string> directions;  ///< of the floors' motion: x; in space x, y, rz
  /// Largest rotation about z [rad], and largest displacement of a corner of the plan, the length of a horizontal
  /// vector [m]: one per floor, NaN for a floor that is not rigid; empty for a structure without rigid floors in space.
  std::vector<double> peak_rotation{}, peak_edge_displacement{};
  StructureEnvelope envelope{};
  std::vector<SpringSummary> springs{};  ///< of the parts that yield; empty for none, and so are the three below
  /// At the end of the run, where it may still move, one a floor: signed along x, in space lengths of horizontal
  /// vectors [m]. A structure without storeys has no drift.
  std::vector<double> residual_displacement{}, residual_drift{};
  std::vector<double> residual_drift_ratio{};  ///< size of the drift over the height of the storey [-]; empty where
                                               ///< heights are not known

  /// For a checkpoint.
  void archive(Archive& archive) {
    archive(name, peak_displacement, peak_drift, peak_acceleration, directions, peak_rotation, peak_edge_displacement,
            envelope, springs, residual_displacement, residual_drift, residual_drift_ratio);
  }
};

/// The gap that keeps two ends of a link apart: from the run without links, and by rules that combine the largest
/// absolute displacements of the two ends in it [m].
struct LinkSeparation {
  std::string link;
  double gap = 0;           ///< that the link has
  double enough = 0;        ///< largest approach of the two ends over time, at least 0
  double time = 0;          ///< of that approach [s]
  double absolute_sum = 0;  ///< uA + uB
  double srss = 0;          ///< sqrt(uA^2 + uB^2)
  double ddc = 0;  ///< sqrt(uA^2 + uB^2 - 2 rho uA uB), see double_difference(); NaN where a structure has no period

  /// For a checkpoint.
  void archive(Archive& archive) {
    archive(link);
    for (double* value : {&gap, &enough, &time, &absolute_sum, &srss, &ddc}) archive(*value);
  }
};

/// Energies at the end of the run [J]; `error` is the largest imbalance of the run over its largest input [-].
struct EnergySummary {
  double input = 0, kinetic = 0, strain = 0, damping = 0, hysteretic = 0, impact = 0, devices = 0, error = 0;
};

/// A run in a few numbers.
struct Summary {
  std::string status;  ///< running | done | done: collapse ... | failed: reason
  std::vector<LinkSummary> links;
  std::vector<DeviceSummary> devices;
  std::vector<StructureSummary> structures;
  EnergySummary energy;
  std::string integrator;  ///< scheme of the time stepping by its name in the input
  SolverStatistics solver;
  std::vector<std::string> options;       ///< PETSc options in force: "-pounding_ts_rtol 1e-6"
  std::vector<ReducedStructure> reduced;  ///< structures in fewer coordinates, with estimated errors
  /// Warnings of the implausible in the model and in the run, and of energies that do not balance; one line each.
  std::vector<std::string> warnings;
  /// Structures in the run without links that `compare: no_pounding` asks for; else empty.
  std::vector<StructureSummary> without_pounding;
  std::string without_links_status;         ///< its status, as above
  std::vector<LinkSeparation> separations;  ///< of that run, one a link
  std::vector<ImpactRow> impacts;           ///< in the order of their touches; `link` counts in `links`
};

/// The object that `pounding run --json` prints, on one line.
std::string to_json(const Summary& summary);

/// A warning that the energies of a run with this tolerance do not balance; empty when they do.
std::string warning(const Summary& summary, double tolerance);

/// The tables that `pounding run` prints, in engineering units.
std::string to_table(const Summary& summary);

}  // namespace pounding
