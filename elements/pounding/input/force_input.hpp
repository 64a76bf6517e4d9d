#pragma once
/// The `forces:` of a structure.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/forces.hpp>

namespace pounding {

/// Reads a list of forces over time, each with its place (floor or node, dof) and exactly one of
///
///     harmonic:   {amplitude, period or frequency, duration, phase, start}
///     sum: [{amplitude, period or frequency, phase}, ...]   with duration and start beside it
///     pulse:      {shape: half_sine | sine | rectangle, amplitude, duration, start}
///     step_force: {amplitude, start, rise}
///     record: FILE   with channel, units, step, scale and start as those of a ground motion
///
/// Amplitudes are forces, or moments where the dof is a rotation. Throws InputError with the place of what is wrong.
std::vector<ForceOptions> read_forces(const Input& list);

}  // namespace pounding
