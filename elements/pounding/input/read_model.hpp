#pragma once
/// A model from an input file.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads, checks and completes a whole model; `modes` finds what damping and the first periods need. Throws InputError with file,
/// line and column. `stiffness_factor` multiplies the stiffness of every contact.
Model read_model(const Input& input, const ModeSolver& modes = dense_modes, double stiffness_factor = 1);

}  // namespace pounding
