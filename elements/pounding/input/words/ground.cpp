#include <array>
#include <numbers>

#include <pounding/input/words/sections.hpp>
#include <pounding/input/words/shared.hpp>

namespace pounding::words {
namespace {

constexpr std::string_view soils[] = {"firm", "medium", "soft"};
constexpr std::string_view directions[] = {"x", "y"};

constexpr std::array motion_words{
    Word{.key = "record", .takes = Takes::text, .need = Need::exactly_one,
         .meaning = "File of an accelerogram; a relative path starts at the folder of the input. Linear between its samples and "
                    "zero after the last. The format is found from the content.",
         .example = "RSN6_IMPVALL.I_I-ELC180.AT2"},
    Word{.key = "channel", .takes = Takes::text, .otherwise = "the only channel of the file",
         .meaning = "Channel of a record's file that holds several: its number from 1, its name, or its azimuth.",
         .example = "90 deg"},
    Word{.key = "units", .takes = Takes::text, .otherwise = "that of the file",
         .meaning = "Unit of the accelerations in a record that states none.", .example = "g"},
    Word{.key = "step", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
         .otherwise = "that of the file", .since = "0.2.0",
         .meaning = "Time between two values of a record without times; the first is at time 0.", .example = "0.01 s"},
    Word{.key = "scale", .takes = Takes::quantity, .otherwise = "1",
         .meaning = "Factor on the record's accelerations, not 0; a negative one turns the direction. Give scale or pga.",
         .example = "1.5"},
    Word{.key = "pga", .takes = Takes::quantity, .dimension = dimension::acceleration, .bounds = bounds::positive,
         .otherwise = "that of the record",
         .meaning = "Largest absolute acceleration to which the record is scaled. Give scale or pga.", .example = "0.35 g"},
    Word{.key = "initial_velocity", .takes = Takes::quantity, .dimension = dimension::velocity, .otherwise = "0 m/s", .since = "0.2.0",
         .meaning = "Velocity of the ground at time 0, beside a record or a sum. It matters where supports move differently.",
         .example = "0.1 m/s"},
    Word{.key = "harmonic", .inside = &harmonic, .need = Need::exactly_one,
         .meaning = "a = A sin(2 pi t/T + phase), zero after the duration.",
         .example = "{amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}"},
    Word{.key = "sum", .form = Form::list, .least = 1, .inside = &sum_part, .need = Need::exactly_one, .since = "0.2.0",
         .meaning = "Harmonics that are added; their duration stands beside them.",
         .example = "[{amplitude: 0.2 g, period: 0.5 s}, {amplitude: 0.1 g, period: 0.2 s, phase: 90 deg}]"},
    Word{.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "none: a sum needs it",
         .since = "0.2.0", .meaning = "Length of a sum of harmonics, which begins at time 0.", .example = "10 s"},
    Word{.key = "pulse", .inside = &pulse, .need = Need::exactly_one, .meaning = "One pulse of acceleration.",
         .example = "{shape: sine, amplitude: 0.2 g, duration: 1.6 s}"},
    Word{.key = "synthetic", .inside = &synthetic, .need = Need::exactly_one,
         .meaning = "An artificial earthquake: noise through the filter of Clough and Penzien, under an envelope.",
         .example = "{seed: 1, duration: 10 s, pga: 0.3 g, soil: firm}"},
    Word{.key = "displacement", .inside = &displacement, .need = Need::exactly_one, .since = "0.2.0",
         .meaning = "Displacement of the ground instead of its acceleration.",
         .example = "{harmonic: {amplitude: 20 mm, period: 0.5 s, duration: 10 s}}"}};

constexpr Word components_word{
    .key = "components", .inside = &components, .need = Need::exactly_one,
    .meaning = "Motions along x, y and z instead of one along x.", .example = "{x: {record: EW.AT2}, z: {record: UP.AT2}}"};
constexpr Word wave_word{.key = "wave", .inside = &wave, .otherwise = "all supports move at once",
                         .meaning = "Wave that carries the motion from support to support; only in the ground_motion of the model.",
                         .example = "{velocity: 500 m/s, direction: x}"};

constexpr auto ground_motion_words = [] {
  std::array<Word, motion_words.size() + 2> all{};
  for (std::size_t i = 0; i < motion_words.size(); ++i) all[i] = motion_words[i];
  all[motion_words.size()] = components_word;
  all[motion_words.size() + 1] = wave_word;
  return all;
}();

constexpr Word components_words[] = {
    {.key = "x", .inside = &motion, .need = Need::at_least_one, .meaning = "Horizontal, from the left structure to the right.",
     .example = "{record: EW.AT2}"},
    {.key = "y", .inside = &motion, .need = Need::at_least_one, .meaning = "Horizontal, across; for frames in space.",
     .example = "{record: NS.AT2}"},
    {.key = "z", .inside = &motion, .need = Need::at_least_one, .meaning = "Vertical, positive up; for frames.",
     .example = "{record: UP.AT2}"}};

constexpr Word wave_words[] = {
    {.key = "velocity", .takes = Takes::quantity, .dimension = dimension::velocity, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Apparent velocity along the surface of the ground.", .example = "500 m/s"},
    {.key = "direction", .takes = Takes::quantity, .form = Form::list, .least = 2, .most = 2, .instead = directions,
     .otherwise = "x", .meaning = "Direction in plan in which the wave travels: x, y, or two numbers along x and y.",
     .example = "[0.6, 0.8]"}};

constexpr Word amplitude_word{.key = "amplitude", .takes = Takes::quantity, .dimension = dimension::acceleration, .need = Need::required,
                              .meaning = "Largest acceleration A. Positive begins towards +x, the right.", .example = "0.35 g"};
constexpr Word length_word{.key = "amplitude", .takes = Takes::quantity, .dimension = dimension::length, .need = Need::required, .since = "0.2.0",
                           .meaning = "Largest displacement. Positive begins towards +x, the right.", .example = "20 mm"};
constexpr Word period_word{.key = "period", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
                           .need = Need::required, .meaning = "Period T of the motion.", .example = "0.5 s"};
constexpr Word duration_word{.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
                             .need = Need::required, .meaning = "Length of the motion, which begins at time 0.", .example = "3 s"};
constexpr Word phase_word{.key = "phase", .takes = Takes::quantity, .unit = "rad", .bounds = {.low = -2 * std::numbers::pi, .high = 2 * std::numbers::pi},
                          .noun = "an angle", .otherwise = "0", .since = "0.2.0",
                          .meaning = "Angle of the sine at time 0, at most a full turn; a bare number is in rad.", .example = "90 deg"};
constexpr Word velocity_of_ground{.key = "initial_velocity", .takes = Takes::quantity, .dimension = dimension::velocity, .otherwise = "0 m/s",
                                  .since = "0.2.0",
                                  .meaning = "Velocity of the ground at time 0. With -A T/(2 pi) cos(phase) the ground does not drift.",
                                  .example = "-0.3 m/s"};

constexpr Word harmonic_words[] = {amplitude_word, period_word, duration_word, phase_word, velocity_of_ground};
constexpr Word sum_part_words[] = {amplitude_word, period_word, phase_word};
constexpr Word moved_harmonic_words[] = {length_word, period_word, duration_word, phase_word};
constexpr Word moved_part_words[] = {length_word, period_word, phase_word};

constexpr Word displacement_words[] = {
    {.key = "record", .takes = Takes::text, .need = Need::exactly_one, .since = "0.2.0",
     .meaning = "File of displacements: PEER, ESM, or columns of numbers. A cubic spline goes through them.", .example = "moved.csv"},
    {.key = "channel", .takes = Takes::text, .otherwise = "the only channel of the file", .since = "0.2.0",
     .meaning = "Channel of a file that holds several: its number from 1, or its name.", .example = "2"},
    {.key = "units", .takes = Takes::text, .otherwise = "that of the file", .since = "0.2.0",
     .meaning = "Unit of the displacements in a file that states none: m, cm, mm or in.", .example = "mm"},
    {.key = "step", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "that of the file",
     .since = "0.2.0", .meaning = "Time between two values of a file without times; the first is at time 0.", .example = "0.01 s"},
    {.key = "scale", .takes = Takes::quantity, .otherwise = "1", .since = "0.2.0",
     .meaning = "Factor on the displacements of a record, not 0.", .example = "1.5"},
    {.key = "initial_velocity", .takes = Takes::quantity, .dimension = dimension::velocity, .otherwise = "0 m/s", .since = "0.2.0",
     .meaning = "Velocity of the ground at the first displacement of a record.", .example = "0.1 m/s"},
    {.key = "harmonic", .inside = &moved_harmonic, .need = Need::exactly_one, .since = "0.2.0",
     .meaning = "d = D sin(2 pi t/T + phase).", .example = "{amplitude: 20 mm, period: 0.5 s, duration: 10 s}"},
    {.key = "sum", .form = Form::list, .least = 1, .inside = &moved_part, .need = Need::exactly_one, .since = "0.2.0",
     .meaning = "Harmonics that are added; their duration stands beside them.",
     .example = "[{amplitude: 20 mm, period: 0.5 s}, {amplitude: 5 mm, period: 0.2 s}]"},
    {.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "none: a sum needs it",
     .since = "0.2.0", .meaning = "Length of a sum of harmonics, which begins at time 0.", .example = "10 s"}};

constexpr Word pulse_words[] = {
    {.key = "shape", .takes = Takes::choice, .choices = pulse_shapes, .noun = "pulse shape", .need = Need::required,
     .meaning = "half_sine has one sign, sine is a full wave, rectangle is constant.", .example = "half_sine"},
    {.key = "amplitude", .takes = Takes::quantity, .dimension = dimension::acceleration, .need = Need::required,
     .meaning = "Largest acceleration. Positive begins towards +x, the right.", .example = "0.35 g"},
    {.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Length of the pulse.", .example = "0.5 s"},
    {.key = "start", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::non_negative, .otherwise = "0 s",
     .meaning = "Time at which the pulse begins; the ground is still before.", .example = "0.2 s"}};

constexpr Word synthetic_words[] = {
    {.key = "seed", .takes = Takes::integer, .bounds = bounds::non_negative, .need = Need::required,
     .meaning = "Number of the earthquake: the same seed gives the same motion on every machine.", .example = "1"},
    {.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Length of the motion.", .example = "20 s"},
    {.key = "pga", .takes = Takes::quantity, .dimension = dimension::acceleration, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Largest absolute acceleration of the samples, met exactly.", .example = "0.35 g"},
    {.key = "soil", .takes = Takes::choice, .choices = soils, .otherwise = "firm",
     .meaning = "Filter of Der Kiureghian and Neuenhofer (1992): firm has omega_g 15, zeta_g 0.6, omega_f 1.5, zeta_f 0.6; "
                "medium 10, 0.4, 1, 0.6; soft 5, 0.2, 0.5, 0.6. Give soil, or all four numbers of the filter.",
     .example = "firm"},
    {.key = "omega_g", .takes = Takes::quantity, .dimension = dimension::frequency, .unit = "rad/s", .bounds = bounds::positive,
     .otherwise = "that of the soil",
     .meaning = "Circular frequency of the soil layer, around which the ground amplifies. Not in Hz: multiply by 2 pi.",
     .example = "15 rad/s"},
    {.key = "zeta_g", .takes = Takes::quantity, .bounds = bounds::above_0_to_1, .otherwise = "that of the soil",
     .meaning = "Damping ratio of the soil layer.", .example = "0.6"},
    {.key = "omega_f", .takes = Takes::quantity, .dimension = dimension::frequency, .unit = "rad/s", .bounds = bounds::positive,
     .otherwise = "that of the soil", .meaning = "Circular frequency below which the second filter removes the motion.",
     .example = "1.5 rad/s"},
    {.key = "zeta_f", .takes = Takes::quantity, .bounds = bounds::above_0_to_1, .otherwise = "that of the soil",
     .meaning = "Damping ratio of the second filter.", .example = "0.6"},
    {.key = "step", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "0.01 s",
     .meaning = "Time between two samples: at most a tenth of the duration, and 1/2 divided by the larger omega.",
     .example = "0.005 s"},
    {.key = "rise", .takes = Takes::quantity, .bounds = bounds::between_0_and_1, .otherwise = "0.15",
     .meaning = "End of the growing part of the envelope, as a part of the duration.", .example = "0.2"},
    {.key = "strong_until", .takes = Takes::quantity, .bounds = bounds::between_0_and_1, .otherwise = "0.5",
     .meaning = "End of the strong part, as a part of the duration and not before rise; the motion then decays to 2 % at the end.",
     .example = "0.6"}};

}  // namespace

constinit const Section ground_motion{.name = "ground_motion", .place = "ground_motion",
                                      .meaning = "Motion of the ground, along x unless there are components. Also of one "
                                                 "structure (structures.NAME.ground_motion) or one support of a frame.",
                                      .words = ground_motion_words};
constinit const Section components{.name = "components", .place = "ground_motion.components",
                                   .meaning = "Motions along the axes.", .words = components_words};
constinit const Section motion{.name = "motion", .place = "ground_motion.components.x",
                               .meaning = "Motion along one axis: x, y or z.", .words = motion_words};
constinit const Section wave{.name = "wave", .place = "ground_motion.wave",
                             .meaning = "A wave that reaches the supports one after the other.", .words = wave_words};
constinit const Section harmonic{.name = "harmonic", .place = "ground_motion.harmonic",
                                 .meaning = "a = A sin(2 pi t/T + phase), zero after the duration.", .words = harmonic_words};
constinit const Section sum_part{.name = "sum", .place = "ground_motion.sum[]", .meaning = "One harmonic of a sum.", .words = sum_part_words};
constinit const Section displacement{.name = "displacement", .place = "ground_motion.displacement",
                                     .meaning = "Displacement of the ground: a record, a harmonic or a sum.", .words = displacement_words};
constinit const Section moved_harmonic{.name = "displacement_harmonic", .place = "ground_motion.displacement.harmonic",
                                       .meaning = "d = D sin(2 pi t/T + phase).", .words = moved_harmonic_words};
constinit const Section moved_part{.name = "displacement_sum", .place = "ground_motion.displacement.sum[]",
                                   .meaning = "One harmonic of a sum of displacements.", .words = moved_part_words};
constinit const Section pulse{.name = "pulse", .place = "ground_motion.pulse", .meaning = "One pulse of acceleration.",
                              .words = pulse_words};
constinit const Section synthetic{.name = "synthetic", .place = "ground_motion.synthetic",
                                  .meaning = "An artificial earthquake: noise through the filter of Clough and Penzien, under "
                                             "the envelope of Amin and Ang.",
                                  .words = synthetic_words};

}  // namespace pounding::words
