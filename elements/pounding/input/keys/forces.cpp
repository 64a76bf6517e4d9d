#include <numbers>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view since = "0.2.0";

constexpr Key force_amplitude_key("amplitude", quantity(dimension::force).or_rotation(dimension::energy), required,
                                  "Amplitude of the force, or of the moment on a rotation. A positive value starts in "
                                  "the positive direction of the axis; +x is to the right.",
                                  "20 kN", since);
constexpr Key force_period_key("period", quantity(dimension::time, bounds::positive), exactly_one,
                               "Period T of the force.", "0.5 s", since);
constexpr Key frequency_key("frequency", quantity(dimension::frequency, bounds::positive).in("Hz"), exactly_one,
                            "Frequency 1/T in Hz, not in rad/s.", "2 Hz", since);
constexpr Key force_duration_key("duration", quantity(dimension::time, bounds::positive), required,
                                 "Duration of the force.", "10 s", since);
constexpr Key start_key("start", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
                        "Start time of the force.", "0.2 s", since);
constexpr Key force_phase_key(
    "phase", number(-2 * std::numbers::pi, 2 * std::numbers::pi).in("rad").called("an angle"), otherwise("0"),
    "Phase angle of the sine at the start, at most one full cycle. A number without a unit is in rad.", "90 deg",
    since);

constexpr Key force_keys[] = {
    {"floor", integer({.low = 1}), otherwise("the only floor, or the body"),
     "Floor on which the force acts; 1 is the lowest. The force acts at the centre of mass of a rigid floor, and at "
     "the first node of any other floor of a plane frame.",
     "1", since},
    {"node", text(), optional, "Node of a frame on which the force acts, instead of a floor.", "b", since},
    {"dof", choice(displacements, "displacement"), otherwise("ux"),
     "Degree of freedom on which the force acts: ux of a floor, in space also uy and rz; any of a node. On a rotation "
     "the force is a moment. The degree of freedom must have mass.",
     "ux", since},
    {"harmonic", map(force_harmonic), exactly_one, "F = A sin(2 pi (t - start)/T + phase), zero after the duration.",
     "{amplitude: 20 kN, period: 0.5 s, duration: 10 s}", since},
    {"sum", map(force_sum_part).nonempty_list(), exactly_one,
     "Sum of harmonics; duration and start are given next to this list.",
     "[{amplitude: 20 kN, period: 0.5 s}, {amplitude: 5 kN, frequency: 8 Hz, phase: 90 deg}]", since},
    {"pulse", map(force_pulse), exactly_one, "Single pulse of any duration.",
     "{shape: half_sine, amplitude: 500 kN, duration: 20 ms}", since},
    {"step_force", map(step_force), exactly_one, "Constant force that starts suddenly or with a linear rise.",
     "{amplitude: 50 kN, start: 1 s}", since},
    {"record", text(), exactly_one,
     "File of forces in columns, in the format of ground motions. Linear between samples and zero after the last.",
     "forces.csv", since},
    {"channel", text(), otherwise("the only channel of the file"),
     "Channel of a file with several channels: its number, from 1, or its name.", "2", since},
    {"units", text(), otherwise("unit in the file"),
     "Unit of the forces if the file does not state one: N, kN, MN; for moments N m, kN m.", "kN", since},
    {"step", quantity(dimension::time, bounds::positive), otherwise("time step in the file"),
     "Time step of a record without times; the first value is at the start.", "0.01 s", since},
    {"scale", number(), otherwise("1"), "Scale factor of a record; not 0.", "1.5", since},
    {"duration", quantity(dimension::time, bounds::positive), otherwise("none; required for a sum"),
     "Duration of a sum of harmonics.", "10 s", since},
    {"start", quantity(dimension::time, bounds::non_negative), otherwise("0 s"), "Start time of a sum or a record.",
     "0.2 s", since},
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
     "Time of the linear rise from zero to the amplitude.", "0.5 s", since},
};

}  // namespace

constinit const Section force{"forces", "structures.NAME.forces[]",
                              "Force over time on a floor, a node or a body. Several forces at one location add up.",
                              force_keys};
constinit const Section force_harmonic{"force_harmonic", "structures.NAME.forces[].harmonic",
                                       "F = A sin(2 pi (t - start)/T + phase), zero after the duration.",
                                       force_harmonic_keys};
constinit const Section force_sum_part{"force_sum", "structures.NAME.forces[].sum[]",
                                       "Harmonic component of a sum of forces.", sum_keys};
constinit const Section force_pulse{"force_pulse", "structures.NAME.forces[].pulse", "Single pulse of force.",
                                    force_pulse_keys};
constinit const Section step_force{"step_force", "structures.NAME.forces[].step_force",
                                   "Force that starts and remains constant. Requires the duration of the analysis.",
                                   step_keys};

}  // namespace pounding::keys
