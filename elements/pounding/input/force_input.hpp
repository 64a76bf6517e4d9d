#pragma once
/// The `forces:` of a structure.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/forces.hpp>

namespace pounding {

/// Reads a list of time-dependent forces, each with its location (floor or node, dof) and exactly one of
///
///     harmonic:   {amplitude, period or frequency, duration, phase, start}
///     sum: [{amplitude, period or frequency, phase}, ...]   with duration and start
///     pulse:      {shape: half_sine | sine | rectangle, amplitude, duration, start}
///     step_force: {amplitude, start, rise}
///     record: FILE   with channel, units, step, scale and start, as for a ground motion
///
/// Amplitudes are forces, or moments if the degree of freedom is a rotation. Throws InputError with the location.
std::vector<ForceOptions> read_forces(const Input& list);

}  // namespace pounding
