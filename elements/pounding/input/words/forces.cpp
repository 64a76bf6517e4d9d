#include <numbers>

#include <pounding/input/words/sections.hpp>
#include <pounding/input/words/shared.hpp>

namespace pounding::words {
namespace {

constexpr std::string_view since = "0.2.0";

constexpr Word force_amplitude_word{.key = "amplitude", .takes = Takes::quantity, .dimension = dimension::force, .turning = dimension::energy,
                              .need = Need::required, .since = since,
                              .meaning = "Largest force, of a rotation a moment. Positive begins along the axis, towards +x, the right.",
                              .example = "20 kN"};
constexpr Word force_period_word{.key = "period", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
                           .need = Need::exactly_one, .since = since, .meaning = "Period T of the force.", .example = "0.5 s"};
constexpr Word frequency_word{.key = "frequency", .takes = Takes::quantity, .dimension = dimension::frequency, .unit = "Hz",
                              .bounds = bounds::positive, .need = Need::exactly_one, .since = since,
                              .meaning = "Turns in a second, 1/T. Not in rad/s: divide by 2 pi.", .example = "2 Hz"};
constexpr Word force_duration_word{.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive,
                             .need = Need::required, .since = since, .meaning = "How long the force acts.", .example = "10 s"};
constexpr Word start_word{.key = "start", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::non_negative,
                          .otherwise = "0 s", .since = since, .meaning = "Time at which the force begins.", .example = "0.2 s"};
constexpr Word force_phase_word{.key = "phase", .takes = Takes::quantity, .unit = "rad",
                          .bounds = {.low = -2 * std::numbers::pi, .high = 2 * std::numbers::pi}, .noun = "an angle", .otherwise = "0",
                          .since = since, .meaning = "Angle of the sine at the start, at most a full turn; a bare number is in rad.",
                          .example = "90 deg"};

constexpr Word force_words[] = {
    {.key = "floor", .takes = Takes::integer, .bounds = {.low = 1}, .otherwise = "the only floor, or the body", .since = since,
     .meaning = "Floor on which the force acts, from 1 at the lowest. A rigid floor is pushed at its centre of mass, another one of a frame "
                "in the plane at its first node.",
     .example = "1"},
    {.key = "node", .takes = Takes::text, .since = since, .meaning = "Node of a frame on which the force acts, instead of a floor.",
     .example = "b"},
    {.key = "dof", .takes = Takes::choice, .choices = displacements, .noun = "displacement", .otherwise = "ux", .since = since,
     .meaning = "Displacement on which the force works: of a floor ux, in space also uy and rz; of a node any. On a rotation it is a "
                "moment. The displacement needs a mass.",
     .example = "ux"},
    {.key = "harmonic", .inside = &force_harmonic, .need = Need::exactly_one, .since = since,
     .meaning = "F = A sin(2 pi (t - start)/T + phase) while it lasts.", .example = "{amplitude: 20 kN, period: 0.5 s, duration: 10 s}"},
    {.key = "sum", .form = Form::list, .least = 1, .inside = &force_sum_part, .need = Need::exactly_one, .since = since,
     .meaning = "Harmonics that are added; their duration and start stand beside them.",
     .example = "[{amplitude: 20 kN, period: 0.5 s}, {amplitude: 5 kN, frequency: 8 Hz, phase: 90 deg}]"},
    {.key = "pulse", .inside = &force_pulse, .need = Need::exactly_one, .since = since, .meaning = "One pulse of force, however short.",
     .example = "{shape: half_sine, amplitude: 500 kN, duration: 20 ms}"},
    {.key = "step_force", .inside = &step_force, .need = Need::exactly_one, .since = since,
     .meaning = "A force that sets in, at once or within a rise, and stays.", .example = "{amplitude: 50 kN, start: 1 s}"},
    {.key = "record", .takes = Takes::text, .need = Need::exactly_one, .since = since,
     .meaning = "File of forces in columns, as those of a ground motion; linear between its samples and zero after the last.",
     .example = "forces.csv"},
    {.key = "channel", .takes = Takes::text, .otherwise = "the only channel of the file", .since = since,
     .meaning = "Channel of a record that holds several: its number from 1, or its name.", .example = "2"},
    {.key = "units", .takes = Takes::text, .otherwise = "that of the file", .since = since,
     .meaning = "Unit of the forces in a record that states none: N, kN, MN; of moments N m, kN m.", .example = "kN"},
    {.key = "step", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "that of the file",
     .since = since, .meaning = "Time between two values of a record without times; the first is at the start.", .example = "0.01 s"},
    {.key = "scale", .takes = Takes::quantity, .otherwise = "1", .since = since, .meaning = "Factor on the forces of a record, not 0.",
     .example = "1.5"},
    {.key = "duration", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::positive, .otherwise = "none: a sum needs it",
     .since = since, .meaning = "How long a sum of harmonics acts.", .example = "10 s"},
    {.key = "start", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::non_negative, .otherwise = "0 s", .since = since,
     .meaning = "Time at which a sum or a record begins.", .example = "0.2 s"}};

constexpr Word force_harmonic_words[] = {force_amplitude_word, force_period_word, frequency_word, force_duration_word, force_phase_word, start_word};
constexpr Word sum_words[] = {force_amplitude_word, force_period_word, frequency_word, force_phase_word};
constexpr Word force_pulse_words[] = {
    {.key = "shape", .takes = Takes::choice, .choices = pulse_shapes, .noun = "pulse shape", .need = Need::required, .since = since,
     .meaning = "half_sine has one sign, sine is a full wave, rectangle is constant.", .example = "half_sine"},
    force_amplitude_word, force_duration_word, start_word};
constexpr Word step_words[] = {
    force_amplitude_word, start_word,
    {.key = "rise", .takes = Takes::quantity, .dimension = dimension::time, .bounds = bounds::non_negative, .otherwise = "0 s", .since = since,
     .meaning = "Time within which the force grows straight to its amplitude.", .example = "0.5 s"}};

}  // namespace

constinit const Section force{.name = "forces", .place = "structures.NAME.forces[]",
                              .meaning = "A force over time on a floor, a node or a body. Several on one place add.", .words = force_words};
constinit const Section force_harmonic{.name = "force_harmonic", .place = "structures.NAME.forces[].harmonic",
                                       .meaning = "F = A sin(2 pi (t - start)/T + phase) while it lasts.", .words = force_harmonic_words};
constinit const Section force_sum_part{.name = "force_sum", .place = "structures.NAME.forces[].sum[]",
                                       .meaning = "One harmonic of a sum of forces.", .words = sum_words};
constinit const Section force_pulse{.name = "force_pulse", .place = "structures.NAME.forces[].pulse", .meaning = "One pulse of force.",
                                    .words = force_pulse_words};
constinit const Section step_force{.name = "step_force", .place = "structures.NAME.forces[].step_force",
                                   .meaning = "A force that sets in and stays; it needs the duration of the analysis.", .words = step_words};

}  // namespace pounding::words
