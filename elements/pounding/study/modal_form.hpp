#pragma once
/// A model as the kernel runs it.

#include <string>

#include <pounding/model/model.hpp>
#include <pounding/study/linear_model.hpp>

namespace pounding::study {

/// Why the kernel cannot run a complete model, one line that names what needs the solver; empty where it can:
/// structures without yielding, large turns and devices, damping by Rayleigh or by modes, links by one penalty law
/// without friction and preload, one ground motion along x under all supports, no forces over time.
std::string needs_solver(const Model& model);

/// A complete model in modal coordinates, all modes of every structure. Outputs, structure by structure: displacements
/// of the floors along x from the lowest up, drifts of a structure with storeys, and, when asked for, absolute
/// accelerations. Throws std::invalid_argument with the text of needs_solver().
LinearModel modal_form(const Model& model, bool accelerations = false);

}  // namespace pounding::study
