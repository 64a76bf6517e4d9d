#pragma once
/// Reductions of the structures of a model that a run requests from the solver, and warnings about them.

#include <Eigen/Core>
#include <string>

#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/reduction/reduce.hpp>

namespace pounding {

/// Reads `-pounding_red_links N` and `-pounding_red_ground N`, the numbers of blocks of the two chains, and
/// `-pounding_red_auto`, which derives them from the tolerance. Without these options, no structure is reduced. Call it
/// before unread options are refused. Throws InputError for a number out of range.
Reduction reduction_from_options();

/// Reads `-pounding_red_cache FOLDER`, where modes are cached between runs; empty if not given. Call it before unread
/// options are refused.
std::string mode_cache_folder();

/// The reduction of each structure of a model that is not rigid: that of the options if given, otherwise that of the
/// model.
std::vector<Reduction> requested_reductions(const Model& model);

/// A plan with these reductions. Structures that cannot be reduced are excluded from automatic reductions; with numbers
/// from the options, such a structure is an InputError if it has more than small_structure degrees of freedom. The run
/// starts from displacements u [m] and velocities v [m/s].
petsc::ReductionPlan reduction_plan(const Model& model, const std::vector<Reduction>& requested,
                                    const Eigen::VectorXd& u, const Eigen::VectorXd& v, double tolerance);

/// True if a run must be repeated with more blocks: the estimated errors of an automatic reduction are too large.
bool must_be_deeper(const petsc::ReductionPlan& plan, const std::vector<ReducedStructure>& reduced);

/// Warnings about reduced structures whose errors exceed the bound or are not estimated, and about a requested
/// reduction that was not applied.
std::vector<std::string> reduction_warnings(const petsc::ReductionPlan& plan,
                                            const std::vector<ReducedStructure>& reduced);

}  // namespace pounding
