#pragma once
/// The few numbers that a run is remembered by.

#include <optional>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// Of all impacts of one link: the largest of them, and the sums of impulse and loss.
struct LinkSummary {
  std::string name;
  int impacts = 0;
  double peak_force = 0, peak_penetration = 0, impulse = 0, energy_lost = 0;  ///< [N], [m], [N s], [J]
};

/// Largest absolute values, one a floor. Displacement and drift relative, acceleration absolute. A body has no drift.
struct StructureSummary {
  std::string name;
  std::vector<double> peak_displacement, peak_drift, peak_acceleration;  ///< [m], [m], [m/s^2]

  /// For a checkpoint.
  void archive(Archive& archive) {
    archive(name);
    archive(peak_displacement);
    archive(peak_drift);
    archive(peak_acceleration);
  }
};

/// At the end of the run [J]; `error` is the largest imbalance of the run as part of the largest input.
struct EnergySummary {
  double input = 0, kinetic = 0, strain = 0, damping = 0, hysteretic = 0, impact = 0, error = 0;
};

/// A run in a few numbers.
struct Summary {
  std::string status;
  std::vector<LinkSummary> links;
  std::vector<StructureSummary> structures;
  EnergySummary energy;
  std::string integrator;  ///< scheme of the time stepping by its name in the input
  SolverStatistics solver;
  /// The same structures without links, when `compare: no_pounding` asks for it.
  std::vector<StructureSummary> without_pounding;
};

/// The object that `pounding run --json` prints, on one line.
std::string to_json(const Summary& summary);

/// What to tell beside the results of a run with this tolerance: that its energies do not close. Empty when they do.
std::string warning(const Summary& summary, double tolerance);

/// The tables that `pounding run` prints, in engineering units.
std::string to_table(const Summary& summary);

}  // namespace pounding
