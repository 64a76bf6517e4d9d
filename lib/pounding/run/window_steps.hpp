#pragma once
/// All unknowns of a reduced structure, stepped through an impact of the run.

#include <Eigen/Core>
#include <span>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/run/impact_windows.hpp>

namespace pounding {

/// By which a structure in all its unknowns differs from the same in the modes of the run, at the ends of the steps of
/// a window.
struct WindowDifferences {
  Eigen::MatrixXd closings,
      rates;                ///< of the contacts [contact, step], by the motion of this structure alone [m], [m/s]
  Eigen::MatrixXd outputs;  ///< of these outputs of the system [output, step]
};

/// Steps the equations of one group that is reduced, in all its unknowns by sparse factors and in its modes, from the
/// state of the run at the beginning of a window, by equal steps:
///
///   M a + C v + K u = -P ag(t) - B F(t),
///
/// with the ground and the forces F that all links had in the run. They are given, so that the equations are linear
/// whatever the links and what yields do; both are integrated alike by ESDIRK4 on straight lines between the steps, so
/// that the modes alone make the difference. At least 200 steps, and as many as the run has taken. The bits do not
/// depend on the number of processes: each takes all steps by itself.
///
/// `base` is the solver of the run. Throws SolverError where a step fails.
WindowDifferences differences_in_window(const System& system, const StructureSolver& base, int group,
                                        std::span<const int> outputs, const ImpactWindow& window);

}  // namespace pounding
