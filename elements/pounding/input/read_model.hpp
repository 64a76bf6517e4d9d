#pragma once
/// A model from an input file.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads, checks and completes a whole model; `modes` finds what damping and the first periods need. Throws InputError
/// with file, line and column. `stiffness_factor` multiplies the stiffness of every contact. `ground`, unless null, is
/// the motion in the place of that of the input, which is not read.
Model read_model(const Input& input, const ModeSolver& modes = dense_modes, double stiffness_factor = 1,
                 const GroundSection* ground = nullptr);

}  // namespace pounding
