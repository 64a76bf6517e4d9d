#pragma once
/// A model from an input file.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads, checks and completes the model of an input file. `modes` computes the natural modes for damping and periods.
/// `stiffness_factor` multiplies all contact stiffnesses. `ground`, if not null, replaces the ground motion of the
/// input. Throws InputError with file, line and column.
Model read_model(const Input& input, const ModeSolver& modes = dense_modes, double stiffness_factor = 1,
                 const GroundSection* ground = nullptr);

}  // namespace pounding
