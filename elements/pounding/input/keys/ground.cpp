#include <array>
#include <numbers>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view soils[] = {"firm", "medium", "soft"};
constexpr std::string_view directions[] = {"x", "y"};

constexpr std::array motion_keys{
    Key{"record", text(), exactly_one,
        "File of an accelerogram; a relative path starts at the folder of the input. Linear between its samples and "
        "zero after the last. The format is found from the content.",
        "RSN6_IMPVALL.I_I-ELC180.AT2"},
    Key{"channel", text(), otherwise("the only channel of the file"),
        "Channel of a record's file that holds several: its number from 1, its name, or its azimuth.", "90 deg"},
    Key{"units", text(), otherwise("that of the file"), "Unit of the accelerations in a record that states none.", "g"},
    Key{"step", quantity(dimension::time, bounds::positive), otherwise("that of the file"),
        "Time between two values of a record without times; the first is at time 0.", "0.01 s", "0.2.0"},
    Key{"scale", number(), otherwise("1"),
        "Factor on the record's accelerations, not 0; a negative one turns the direction. Give scale or pga.", "1.5"},
    Key{"pga", quantity(dimension::acceleration, bounds::positive), otherwise("that of the record"),
        "Largest absolute acceleration to which the record is scaled. Give scale or pga.", "0.35 g"},
    Key{"initial_velocity", quantity(dimension::velocity), otherwise("0 m/s"),
        "Velocity of the ground at time 0, beside a record or a sum. It matters where supports move differently.",
        "0.1 m/s", "0.2.0"},
    Key{"harmonic", map(harmonic), exactly_one, "a = A sin(2 pi t/T + phase), zero after the duration.",
        "{amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}"},
    Key{"sum", map(sum_part).nonempty_list(), exactly_one,
        "Harmonics that are added; their duration stands beside them.",
        "[{amplitude: 0.2 g, period: 0.5 s}, {amplitude: 0.1 g, period: 0.2 s, phase: 90 deg}]", "0.2.0"},
    Key{"duration", quantity(dimension::time, bounds::positive), otherwise("none: a sum needs it"),
        "Length of a sum of harmonics, which begins at time 0.", "10 s", "0.2.0"},
    Key{"pulse", map(pulse), exactly_one, "One pulse of acceleration.",
        "{shape: sine, amplitude: 0.2 g, duration: 1.6 s}"},
    Key{"synthetic", map(synthetic), exactly_one,
        "An artificial earthquake: noise through the filter of Clough and Penzien, under an envelope.",
        "{seed: 1, duration: 10 s, pga: 0.3 g, soil: firm}"},
    Key{"displacement", map(displacement), exactly_one, "Displacement of the ground instead of its acceleration.",
        "{harmonic: {amplitude: 20 mm, period: 0.5 s, duration: 10 s}}", "0.2.0"},
};

constexpr Key components_key{"components", map(components), exactly_one,
                             "Motions along x, y and z instead of one along x.",
                             "{x: {record: EW.AT2}, z: {record: UP.AT2}}"};
constexpr Key wave_key{"wave", map(wave), otherwise("all supports move at once"),
                       "Wave that carries the motion from support to support; only in the ground_motion of the model.",
                       "{velocity: 500 m/s, direction: x}"};

constexpr auto ground_motion_keys = [] {
  std::array<Key, motion_keys.size() + 2> all{};
  for (std::size_t i = 0; i < motion_keys.size(); ++i) all[i] = motion_keys[i];
  all[motion_keys.size()] = components_key;
  all[motion_keys.size() + 1] = wave_key;
  return all;
}();

constexpr Key components_keys[] = {
    {"x", map(motion), at_least_one, "Horizontal, from the left structure to the right.", "{record: EW.AT2}"},
    {"y", map(motion), at_least_one, "Horizontal, across; for frames in space.", "{record: NS.AT2}"},
    {"z", map(motion), at_least_one, "Vertical, positive up; for frames.", "{record: UP.AT2}"},
};

constexpr Key wave_keys[] = {
    {"velocity", quantity(dimension::velocity, bounds::positive), required,
     "Apparent velocity along the surface of the ground.", "500 m/s"},
    {"direction", number().list(2).or_one_of(directions), otherwise("x"),
     "Direction in plan in which the wave travels: x, y, or two numbers along x and y.", "[0.6, 0.8]"},
};

constexpr Key amplitude_key{"amplitude", quantity(dimension::acceleration), required,
                            "Largest acceleration A. Positive begins towards +x, the right.", "0.35 g"};
constexpr Key length_key{"amplitude", quantity(dimension::length),
                         required,    "Largest displacement. Positive begins towards +x, the right.",
                         "20 mm",     "0.2.0"};
constexpr Key period_key{"period", quantity(dimension::time, bounds::positive), required, "Period T of the motion.",
                         "0.5 s"};
constexpr Key duration_key{"duration", quantity(dimension::time, bounds::positive), required,
                           "Length of the motion, which begins at time 0.", "3 s"};
constexpr Key phase_key{
    "phase",        number(-2 * std::numbers::pi, 2 * std::numbers::pi).in("rad").called("an angle"),
    otherwise("0"), "Angle of the sine at time 0, at most a full turn; a bare number is in rad.",
    "90 deg",       "0.2.0"};
constexpr Key velocity_of_ground{
    "initial_velocity", quantity(dimension::velocity),
    otherwise("0 m/s"), "Velocity of the ground at time 0. With -A T/(2 pi) cos(phase) the ground does not drift.",
    "-0.3 m/s",         "0.2.0"};

constexpr Key harmonic_keys[] = {
    amplitude_key, period_key, duration_key, phase_key, velocity_of_ground,
};
constexpr Key sum_part_keys[] = {amplitude_key, period_key, phase_key};
constexpr Key moved_harmonic_keys[] = {
    length_key,
    period_key,
    duration_key,
    phase_key,
};
constexpr Key moved_part_keys[] = {length_key, period_key, phase_key};

constexpr Key displacement_keys[] = {
    {"record", text(), exactly_one,
     "File of displacements: PEER, ESM, or columns of numbers. A cubic spline goes through them.", "moved.csv",
     "0.2.0"},
    {"channel", text(), otherwise("the only channel of the file"),
     "Channel of a file that holds several: its number from 1, or its name.", "2", "0.2.0"},
    {"units", text(), otherwise("that of the file"),
     "Unit of the displacements in a file that states none: m, cm, mm or in.", "mm", "0.2.0"},
    {"step", quantity(dimension::time, bounds::positive), otherwise("that of the file"),
     "Time between two values of a file without times; the first is at time 0.", "0.01 s", "0.2.0"},
    {"scale", number(), otherwise("1"), "Factor on the displacements of a record, not 0.", "1.5", "0.2.0"},
    {"initial_velocity", quantity(dimension::velocity), otherwise("0 m/s"),
     "Velocity of the ground at the first displacement of a record.", "0.1 m/s", "0.2.0"},
    {"harmonic", map(moved_harmonic), exactly_one, "d = D sin(2 pi t/T + phase).",
     "{amplitude: 20 mm, period: 0.5 s, duration: 10 s}", "0.2.0"},
    {"sum", map(moved_part).nonempty_list(), exactly_one,
     "Harmonics that are added; their duration stands beside them.",
     "[{amplitude: 20 mm, period: 0.5 s}, {amplitude: 5 mm, period: 0.2 s}]", "0.2.0"},
    {"duration", quantity(dimension::time, bounds::positive), otherwise("none: a sum needs it"),
     "Length of a sum of harmonics, which begins at time 0.", "10 s", "0.2.0"},
};

constexpr Key pulse_keys[] = {
    {"shape", choice(pulse_shapes, "pulse shape"), required,
     "half_sine has one sign, sine is a full wave, rectangle is constant.", "half_sine"},
    {"amplitude", quantity(dimension::acceleration), required,
     "Largest acceleration. Positive begins towards +x, the right.", "0.35 g"},
    {"duration", quantity(dimension::time, bounds::positive), required, "Length of the pulse.", "0.5 s"},
    {"start", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Time at which the pulse begins; the ground is still before.", "0.2 s"},
};

constexpr Key synthetic_keys[] = {
    {"seed", integer(bounds::non_negative), required,
     "Number of the earthquake: the same seed gives the same motion on every machine.", "1"},
    {"duration", quantity(dimension::time, bounds::positive), required, "Length of the motion.", "20 s"},
    {"pga", quantity(dimension::acceleration, bounds::positive), required,
     "Largest absolute acceleration of the samples, met exactly.", "0.35 g"},
    {"soil", choice(soils), otherwise("firm"),
     "Filter of Der Kiureghian and Neuenhofer (1992): firm has omega_g 15, zeta_g 0.6, omega_f 1.5, zeta_f 0.6; medium "
     "10, 0.4, 1, 0.6; soft 5, 0.2, 0.5, 0.6. Give soil, or all four numbers of the filter.",
     "firm"},
    {"omega_g", quantity(dimension::frequency, bounds::positive).in("rad/s"), otherwise("that of the soil"),
     "Circular frequency of the soil layer, around which the ground amplifies. Not in Hz: multiply by 2 pi.",
     "15 rad/s"},
    {"zeta_g", number(bounds::above_0_to_1), otherwise("that of the soil"), "Damping ratio of the soil layer.", "0.6"},
    {"omega_f", quantity(dimension::frequency, bounds::positive).in("rad/s"), otherwise("that of the soil"),
     "Circular frequency below which the second filter removes the motion.", "1.5 rad/s"},
    {"zeta_f", number(bounds::above_0_to_1), otherwise("that of the soil"), "Damping ratio of the second filter.",
     "0.6"},
    {"step", quantity(dimension::time, bounds::positive), otherwise("0.01 s"),
     "Time between two samples: at most a tenth of the duration, and 1/2 divided by the larger omega.", "0.005 s"},
    {"rise", number(bounds::between_0_and_1), otherwise("0.15"),
     "End of the growing part of the envelope, as a part of the duration.", "0.2"},
    {"strong_until", number(bounds::between_0_and_1), otherwise("0.5"),
     "End of the strong part, as a part of the duration and not before rise; the motion then decays to 2 % at the end.",
     "0.6"},
};

}  // namespace

constinit const Section ground_motion{"ground_motion", "ground_motion",
                                      "Motion of the ground, along x unless there are components. Also of one "
                                      "structure (structures.NAME.ground_motion) or one support of a frame.",
                                      ground_motion_keys};
constinit const Section components{"components", "ground_motion.components", "Motions along the axes.",
                                   components_keys};
constinit const Section motion{"motion", "ground_motion.components.x", "Motion along one axis: x, y or z.",
                               motion_keys};
constinit const Section wave{"wave", "ground_motion.wave", "A wave that reaches the supports one after the other.",
                             wave_keys};
constinit const Section harmonic{"harmonic", "ground_motion.harmonic",
                                 "a = A sin(2 pi t/T + phase), zero after the duration.", harmonic_keys};
constinit const Section sum_part{"sum", "ground_motion.sum[]", "One harmonic of a sum.", sum_part_keys};
constinit const Section displacement{"displacement", "ground_motion.displacement",
                                     "Displacement of the ground: a record, a harmonic or a sum.", displacement_keys};
constinit const Section moved_harmonic{"displacement_harmonic", "ground_motion.displacement.harmonic",
                                       "d = D sin(2 pi t/T + phase).", moved_harmonic_keys};
constinit const Section moved_part{"displacement_sum", "ground_motion.displacement.sum[]",
                                   "One harmonic of a sum of displacements.", moved_part_keys};
constinit const Section pulse{"pulse", "ground_motion.pulse", "One pulse of acceleration.", pulse_keys};
constinit const Section synthetic{
    "synthetic", "ground_motion.synthetic",
    "An artificial earthquake: noise through the filter of Clough and Penzien, under the envelope of Amin and Ang.",
    synthetic_keys};

}  // namespace pounding::keys
