#pragma once
/// Reductions that a run asks of the solver for the structures of a model, and the line that tells of them.

#include <Eigen/Core>
#include <string>

#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/reduction/reduce.hpp>

namespace pounding {

/// `-pounding_red_links N` and `-pounding_red_ground N` are the blocks of the two chains, `-pounding_red_auto` leaves
/// them to the tolerance; none of these is no reduction. Reads the options, so call it before those that nothing reads
/// are refused. Throws InputError for a number out of range.
Reduction reduction_from_options();

/// `-pounding_red_cache FOLDER`, where modes are kept from one run to the next; empty without it. To be called as
/// early.
std::string mode_cache_folder();

/// The reduction of each structure of a model that moves: that of the options where they give one, else that of the
/// model.
std::vector<Reduction> requested_reductions(const Model& model);

/// A plan with these reductions, but for structures that cannot be reduced: what is automatic leaves them out, numbers
/// of the options are an InputError where such a structure has more than small_structure unknowns. The run starts from
/// displacements u [m] and velocities v [m/s].
petsc::ReductionPlan reduction_plan(const Model& model, const std::vector<Reduction>& requested,
                                    const Eigen::VectorXd& u, const Eigen::VectorXd& v, double tolerance);

/// Whether a run must be repeated with more blocks: one whose depth is automatic has estimated errors that are too
/// large.
bool must_be_deeper(const petsc::ReductionPlan& plan, const std::vector<ReducedStructure>& reduced);

/// Warnings of reduced structures with errors that exceed what is allowed, or that nothing estimates; and where a
/// reduction was asked for and there is none.
std::vector<std::string> reduction_warnings(const petsc::ReductionPlan& plan,
                                            const std::vector<ReducedStructure>& reduced);

}  // namespace pounding
