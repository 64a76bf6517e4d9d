#pragma once
/// A model in the form used by the kernel.

#include <string>

#include <pounding/model/model.hpp>
#include <pounding/study/linear_model.hpp>

namespace pounding::study {

/// Reason why the kernel cannot run a complete model, in one line; empty if it can. The kernel accepts structures
/// without yielding, large rotations and devices, Rayleigh or modal damping, links with one penalty law without
/// friction and preload, one ground motion along x under all supports, and no forces over time.
std::string needs_solver(const Model& model);

/// A complete model in modal coordinates, with all modes of each structure. Outputs, structure by structure:
/// displacements of the floors along x from the lowest up, drifts of a structure with storeys and, if requested,
/// absolute accelerations. Throws std::invalid_argument with the text of needs_solver().
LinearModel modal_form(const Model& model, bool accelerations = false);

}  // namespace pounding::study
