#pragma once
/// Reductions that a run asks of the solver for the structures of a model, and the line that tells of them.

#include <Eigen/Core>
#include <string>

#include <pounding/linear/reduce.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>

namespace pounding {

/// `-pounding_red_links N` and `-pounding_red_ground N` are the blocks of the two chains, `-pounding_red_auto` leaves them to the tolerance; none of
/// these is no reduction. Reads the options, so call it before those that nothing reads are refused. Throws InputError for a number out of range.
Reduction reduction_from_options();

/// A plan with this reduction for every structure of a model, but for those that cannot be reduced: what is automatic leaves them out, numbers
/// are an InputError where such a structure has more than petsc::small_structure unknowns. The run starts from displacements u [m] and velocities v [m/s].
petsc::ReductionPlan reduction_plan(const Model& model, const Reduction& how, const Eigen::VectorXd& u, const Eigen::VectorXd& v, double tolerance);

/// A warning that tells the coordinates of reduced structures, and that nothing has measured their error; empty where none was asked for.
/// `description` of the solver.
std::string reduction_note(const Reduction& how, const std::string& description);

}  // namespace pounding
