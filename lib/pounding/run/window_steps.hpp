#pragma once
/// Integrates all degrees of freedom of a reduced structure through an impact of the run.

#include <Eigen/Core>
#include <span>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/run/impact_windows.hpp>

namespace pounding {

/// Differences between a structure with all degrees of freedom and with the modes of the run, at the ends of the steps
/// of a window.
struct WindowDifferences {
  Eigen::MatrixXd closings,
      rates;                ///< of the contacts [contact, step], due to the motion of this structure alone [m], [m/s]
  Eigen::MatrixXd outputs;  ///< of these outputs of the system [output, step]
};

/// Integrates one reduced group with all its degrees of freedom by sparse factorization, and with its modes, from the
/// state of the run at the beginning of a window, with equal steps:
///
///   M a + C v + K u = -P ag(t) - B F(t),
///
/// with the ground motion and all link forces F of the run. These are prescribed, so the equations are linear
/// regardless of links and yielding parts. Both integrations use ESDIRK4 with linear interpolation of the loads, so
/// only the modes make a difference. There are at least 200 steps and at least as many as in the run. Results are
/// bitwise independent of the number of processes: each process computes all steps.
///
/// `base` is the solver of the run. Throws SolverError if a step fails.
WindowDifferences differences_in_window(const System& system, const StructureSolver& base, int group,
                                        std::span<const int> outputs, const ImpactWindow& window);

}  // namespace pounding
