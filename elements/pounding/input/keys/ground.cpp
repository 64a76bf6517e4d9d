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
        "Accelerogram file; relative paths start at the folder of the input file. Linear between samples and zero "
        "after the last. The format is detected from the content.",
        "RSN6_IMPVALL.I_I-ELC180.AT2"},
    Key{"channel", text(), otherwise("the only channel of the file"),
        "Channel of a file with several channels: its number, from 1, its name, or its azimuth.", "90 deg"},
    Key{"units", text(), otherwise("unit in the file"), "Unit of the accelerations if the file does not state one.",
        "g"},
    Key{"step", quantity(dimension::time, bounds::positive), otherwise("time step in the file"),
        "Time step of a record without times; the first value is at time 0.", "0.01 s", "0.2.0"},
    Key{"scale", number(), otherwise("1"),
        "Scale factor of the accelerations, not 0; a negative factor reverses the direction. Give scale or pga, not "
        "both.",
        "1.5"},
    Key{"pga", quantity(dimension::acceleration, bounds::positive), otherwise("PGA of the record"),
        "Peak absolute acceleration to which the record is scaled. Give scale or pga, not both.", "0.35 g"},
    Key{"initial_velocity", quantity(dimension::velocity), otherwise("0 m/s"),
        "Ground velocity at time 0, for a record or a sum. It matters only if supports move differently.", "0.1 m/s",
        "0.2.0"},
    Key{"harmonic", map(harmonic), exactly_one, "a = A sin(2 pi t/T + phase), zero after the duration.",
        "{amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}"},
    Key{"sum", map(sum_part).nonempty_list(), exactly_one,
        "Sum of harmonics; their duration is given next to this list.",
        "[{amplitude: 0.2 g, period: 0.5 s}, {amplitude: 0.1 g, period: 0.2 s, phase: 90 deg}]", "0.2.0"},
    Key{"duration", quantity(dimension::time, bounds::positive), otherwise("none; required for a sum"),
        "Duration of a sum of harmonics, which starts at time 0.", "10 s", "0.2.0"},
    Key{"pulse", map(pulse), exactly_one, "Single acceleration pulse.",
        "{shape: sine, amplitude: 0.2 g, duration: 1.6 s}"},
    Key{"synthetic", map(synthetic), exactly_one,
        "Artificial earthquake: white noise through the Clough-Penzien filter, with an envelope.",
        "{seed: 1, duration: 10 s, pga: 0.3 g, soil: firm}"},
    Key{"displacement", map(displacement), exactly_one, "Ground displacement instead of acceleration.",
        "{harmonic: {amplitude: 20 mm, period: 0.5 s, duration: 10 s}}", "0.2.0"},
};

constexpr Key components_key("components", map(components), exactly_one,
                             "Motions along x, y and z instead of along x only.",
                             "{x: {record: EW.AT2}, z: {record: UP.AT2}}");
constexpr Key wave_key(
    "wave", map(wave), otherwise("all supports move simultaneously"),
    "Travelling wave: the motion reaches the supports one after another. Only in the ground_motion of the model.",
    "{velocity: 500 m/s, direction: x}");

constexpr auto ground_motion_keys = [] {
  std::array<Key, motion_keys.size() + 2> all{};
  for (std::size_t i = 0; i < motion_keys.size(); ++i) all[i] = motion_keys[i];
  all[motion_keys.size()] = components_key;
  all[motion_keys.size() + 1] = wave_key;
  return all;
}();

constexpr Key components_keys[] = {
    {"x", map(motion), at_least_one, "Horizontal, positive to the right, from the left structure to the right one.",
     "{record: EW.AT2}"},
    {"y", map(motion), at_least_one, "Horizontal, transverse; for frames in space.", "{record: NS.AT2}"},
    {"z", map(motion), at_least_one, "Vertical, positive up; for frames.", "{record: UP.AT2}"},
};

constexpr Key wave_keys[] = {
    {"velocity", quantity(dimension::velocity, bounds::positive), required,
     "Apparent wave velocity along the ground surface.", "500 m/s"},
    {"direction", number().list(2).or_one_of(directions), otherwise("x"),
     "Direction of wave propagation in plan: x, y, or a vector [x, y].", "[0.6, 0.8]"},
};

constexpr Key amplitude_key("amplitude", quantity(dimension::acceleration), required,
                            "Acceleration amplitude A. A positive value starts towards +x, to the right.", "0.35 g");
constexpr Key length_key("amplitude", quantity(dimension::length), required,
                         "Displacement amplitude D. A positive value starts towards +x, to the right.", "20 mm",
                         "0.2.0");
constexpr Key period_key("period", quantity(dimension::time, bounds::positive), required, "Period T of the motion.",
                         "0.5 s");
constexpr Key duration_key("duration", quantity(dimension::time, bounds::positive), required,
                           "Duration of the motion, which starts at time 0.", "3 s");
constexpr Key phase_key("phase", number(-2 * std::numbers::pi, 2 * std::numbers::pi).in("rad").called("an angle"),
                        otherwise("0"),
                        "Phase angle of the sine at time 0, at most one full cycle. A number without a unit is in rad.",
                        "90 deg", "0.2.0");
constexpr Key velocity_of_ground("initial_velocity", quantity(dimension::velocity), otherwise("0 m/s"),
                                 "Ground velocity at time 0. The value -A T/(2 pi) cos(phase) prevents drift.",
                                 "-0.3 m/s", "0.2.0");

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
     "File of displacements: PEER, ESM, or columns of numbers. A cubic spline interpolates them.", "moved.csv",
     "0.2.0"},
    {"channel", text(), otherwise("the only channel of the file"),
     "Channel of a file with several channels: its number, from 1, or its name.", "2", "0.2.0"},
    {"units", text(), otherwise("unit in the file"),
     "Unit of the displacements if the file does not state one: m, cm, mm or in.", "mm", "0.2.0"},
    {"step", quantity(dimension::time, bounds::positive), otherwise("time step in the file"),
     "Time step of a file without times; the first value is at time 0.", "0.01 s", "0.2.0"},
    {"scale", number(), otherwise("1"), "Scale factor of the displacements of a record; not 0.", "1.5", "0.2.0"},
    {"initial_velocity", quantity(dimension::velocity), otherwise("0 m/s"),
     "Ground velocity at the first displacement of a record.", "0.1 m/s", "0.2.0"},
    {"harmonic", map(moved_harmonic), exactly_one, "d = D sin(2 pi t/T + phase).",
     "{amplitude: 20 mm, period: 0.5 s, duration: 10 s}", "0.2.0"},
    {"sum", map(moved_part).nonempty_list(), exactly_one,
     "Sum of harmonics; their duration is given next to this list.",
     "[{amplitude: 20 mm, period: 0.5 s}, {amplitude: 5 mm, period: 0.2 s}]", "0.2.0"},
    {"duration", quantity(dimension::time, bounds::positive), otherwise("none; required for a sum"),
     "Duration of a sum of harmonics, which starts at time 0.", "10 s", "0.2.0"},
};

constexpr Key pulse_keys[] = {
    {"shape", choice(pulse_shapes, "pulse shape"), required,
     "half_sine has one sign, sine is a full wave, rectangle is constant.", "half_sine"},
    {"amplitude", quantity(dimension::acceleration), required,
     "Acceleration amplitude. A positive value starts towards +x, to the right.", "0.35 g"},
    {"duration", quantity(dimension::time, bounds::positive), required, "Duration of the pulse.", "0.5 s"},
    {"start", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Start time of the pulse; the ground is at rest before it.", "0.2 s"},
};

constexpr Key synthetic_keys[] = {
    {"seed", integer(bounds::non_negative), required,
     "Seed of the random numbers. The motion is identical on every machine.", "1"},
    {"duration", quantity(dimension::time, bounds::positive), required, "Duration of the motion.", "20 s"},
    {"pga", quantity(dimension::acceleration, bounds::positive), required,
     "Peak absolute acceleration of the samples, attained exactly.", "0.35 g"},
    {"soil", choice(soils), otherwise("firm"),
     "Soil filter of Der Kiureghian and Neuenhofer (1992): firm has omega_g 15, zeta_g 0.6, omega_f 1.5, zeta_f 0.6; "
     "medium 10, 0.4, 1, 0.6; soft 5, 0.2, 0.5, 0.6. Give soil or all four filter parameters.",
     "firm"},
    {"omega_g", quantity(dimension::frequency, bounds::positive).in("rad/s"), otherwise("from the soil"),
     "Angular frequency of the soil layer, at which the ground amplifies the motion; in rad/s, not in Hz.", "15 rad/s"},
    {"zeta_g", number(bounds::above_0_to_1), otherwise("from the soil"), "Damping ratio of the soil layer.", "0.6"},
    {"omega_f", quantity(dimension::frequency, bounds::positive).in("rad/s"), otherwise("from the soil"),
     "Angular frequency below which the second filter removes the motion.", "1.5 rad/s"},
    {"zeta_f", number(bounds::above_0_to_1), otherwise("from the soil"), "Damping ratio of the second filter.", "0.6"},
    {"step", quantity(dimension::time, bounds::positive), otherwise("0.01 s"),
     "Time step of the samples: at most 1/10 of the duration and at most 0.5 divided by the larger omega.", "0.005 s"},
    {"rise", number(bounds::between_0_and_1), otherwise("0.15"),
     "End of the rise of the envelope, as a fraction of the duration.", "0.2"},
    {"strong_until", number(bounds::between_0_and_1), otherwise("0.5"),
     "End of the strong-motion phase, as a fraction of the duration; at least rise. The envelope then decays to 2 % at "
     "the end.",
     "0.6"},
};

}  // namespace

constinit const Section ground_motion{
    "ground_motion", "ground_motion",
    "Ground motion, along x unless components are given. The same keys apply to the ground motion of one structure "
    "(structures.NAME.ground_motion) or of one support of a frame.",
    ground_motion_keys};
constinit const Section components{"components", "ground_motion.components", "Ground motion along each axis.",
                                   components_keys};
constinit const Section motion{"motion", "ground_motion.components.x", "Motion along one axis: x, y or z.",
                               motion_keys};
constinit const Section wave{"wave", "ground_motion.wave",
                             "Travelling wave that reaches the supports one after another.", wave_keys};
constinit const Section harmonic{"harmonic", "ground_motion.harmonic",
                                 "a = A sin(2 pi t/T + phase), zero after the duration.", harmonic_keys};
constinit const Section sum_part{"sum", "ground_motion.sum[]", "Harmonic component of a sum.", sum_part_keys};
constinit const Section displacement{"displacement", "ground_motion.displacement",
                                     "Ground displacement: a record, a harmonic or a sum.", displacement_keys};
constinit const Section moved_harmonic{"displacement_harmonic", "ground_motion.displacement.harmonic",
                                       "d = D sin(2 pi t/T + phase).", moved_harmonic_keys};
constinit const Section moved_part{"displacement_sum", "ground_motion.displacement.sum[]",
                                   "Harmonic component of a sum of displacements.", moved_part_keys};
constinit const Section pulse{"pulse", "ground_motion.pulse", "Single acceleration pulse.", pulse_keys};
constinit const Section synthetic{
    "synthetic", "ground_motion.synthetic",
    "Artificial earthquake: white noise through the Clough-Penzien filter, with the envelope of Amin and Ang.",
    synthetic_keys};

}  // namespace pounding::keys
