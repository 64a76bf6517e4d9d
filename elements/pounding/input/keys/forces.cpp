#include <numbers>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view since = "0.2.0";

constexpr Key force_amplitude_key{
    "amplitude", quantity(dimension::force).or_rotation(dimension::energy),
    required,    "Largest force, of a rotation a moment. Positive begins along the axis, towards +x, the right.",
    "20 kN",     since};
constexpr Key force_period_key{
    "period", quantity(dimension::time, bounds::positive), exactly_one, "Period T of the force.", "0.5 s", since};
constexpr Key frequency_key{"frequency", quantity(dimension::frequency, bounds::positive).in("Hz"),
                            exactly_one, "Turns in a second, 1/T. Not in rad/s: divide by 2 pi.",
                            "2 Hz",      since};
constexpr Key force_duration_key{
    "duration", quantity(dimension::time, bounds::positive), required, "How long the force acts.", "10 s", since};
constexpr Key start_key{"start",          quantity(dimension::time, bounds::non_negative),
                        otherwise("0 s"), "Time at which the force begins.",
                        "0.2 s",          since};
constexpr Key force_phase_key{
    "phase",        number(-2 * std::numbers::pi, 2 * std::numbers::pi).in("rad").called("an angle"),
    otherwise("0"), "Angle of the sine at the start, at most a full turn; a bare number is in rad.",
    "90 deg",       since};

constexpr Key force_keys[] = {
    {"floor", integer({.low = 1}), otherwise("the only floor, or the body"),
     "Floor on which the force acts, from 1 at the lowest. A rigid floor is pushed at its centre of mass, another one "
     "of a frame in the plane at its first node.",
     "1", since},
    {"node", text(), optional, "Node of a frame on which the force acts, instead of a floor.", "b", since},
    {"dof", choice(displacements, "displacement"), otherwise("ux"),
     "Displacement on which the force works: of a floor ux, in space also uy and rz; of a node any. On a rotation it "
     "is a moment. The displacement needs a mass.",
     "ux", since},
    {"harmonic", map(force_harmonic), exactly_one, "F = A sin(2 pi (t - start)/T + phase) while it lasts.",
     "{amplitude: 20 kN, period: 0.5 s, duration: 10 s}", since},
    {"sum", map(force_sum_part).nonempty_list(), exactly_one,
     "Harmonics that are added; their duration and start stand beside them.",
     "[{amplitude: 20 kN, period: 0.5 s}, {amplitude: 5 kN, frequency: 8 Hz, phase: 90 deg}]", since},
    {"pulse", map(force_pulse), exactly_one, "One pulse of force, however short.",
     "{shape: half_sine, amplitude: 500 kN, duration: 20 ms}", since},
    {"step_force", map(step_force), exactly_one, "A force that sets in, at once or within a rise, and stays.",
     "{amplitude: 50 kN, start: 1 s}", since},
    {"record", text(), exactly_one,
     "File of forces in columns, as those of a ground motion; linear between its samples and zero after the last.",
     "forces.csv", since},
    {"channel", text(), otherwise("the only channel of the file"),
     "Channel of a record that holds several: its number from 1, or its name.", "2", since},
    {"units", text(), otherwise("that of the file"),
     "Unit of the forces in a record that states none: N, kN, MN; of moments N m, kN m.", "kN", since},
    {"step", quantity(dimension::time, bounds::positive), otherwise("that of the file"),
     "Time between two values of a record without times; the first is at the start.", "0.01 s", since},
    {"scale", number(), otherwise("1"), "Factor on the forces of a record, not 0.", "1.5", since},
    {"duration", quantity(dimension::time, bounds::positive), otherwise("none: a sum needs it"),
     "How long a sum of harmonics acts.", "10 s", since},
    {"start", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Time at which a sum or a record begins.", "0.2 s", since},
};

constexpr Key force_harmonic_keys[] = {
    force_amplitude_key, force_period_key, frequency_key, force_duration_key, force_phase_key, start_key,
};
constexpr Key sum_keys[] = {
    force_amplitude_key,
    force_period_key,
    frequency_key,
    force_phase_key,
};
constexpr Key force_pulse_keys[] = {
    {"shape", choice(pulse_shapes, "pulse shape"), required,
     "half_sine has one sign, sine is a full wave, rectangle is constant.", "half_sine", since},
    force_amplitude_key,
    force_duration_key,
    start_key,
};
constexpr Key step_keys[] = {
    force_amplitude_key,
    start_key,
    {"rise", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Time within which the force grows straight to its amplitude.", "0.5 s", since},
};

}  // namespace

constinit const Section force{"forces", "structures.NAME.forces[]",
                              "A force over time on a floor, a node or a body. Several on one place add.", force_keys};
constinit const Section force_harmonic{"force_harmonic", "structures.NAME.forces[].harmonic",
                                       "F = A sin(2 pi (t - start)/T + phase) while it lasts.", force_harmonic_keys};
constinit const Section force_sum_part{"force_sum", "structures.NAME.forces[].sum[]",
                                       "One harmonic of a sum of forces.", sum_keys};
constinit const Section force_pulse{"force_pulse", "structures.NAME.forces[].pulse", "One pulse of force.",
                                    force_pulse_keys};
constinit const Section step_force{"step_force", "structures.NAME.forces[].step_force",
                                   "A force that sets in and stays; it needs the duration of the analysis.", step_keys};

}  // namespace pounding::keys
