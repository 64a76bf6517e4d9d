#include <pounding/input/keys/devices.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

#include <pounding/model/model.hpp>
#include <pounding/model/warning_names.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view comparisons[] = {"no_pounding"};

constexpr Key model_keys[] = {
    {"title", text(), otherwise("no title"), "Title of the model, for reports and pictures.", "Two oscillators"},
    {"ground_motion", map(ground_motion), otherwise("a still ground"),
     "Motion of the ground under all structures that have none of their own.",
     "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
    {"structures", map(structure).named(), required,
     "The structures by their names, in the order of the results. A name has no \".\" and no \"/\".",
     "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}"},
    {"links", map(link).list(), otherwise("no links"),
     "The places where two structures can hit each other, one member of the list a link.",
     "[{between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}]"},
    {"devices", map(device).named(), otherwise("no devices"),
     "Bars and dampers between two structures by their names: they always act, both ways.",
     "{top damper: {between: [left, right], damper: {coefficient: 200 kN s/m}}}", "0.2.0"},
    {"analysis", map(analysis), optional, "How long and how exactly the model is run.", "{duration: 10 s}"},
    {"checkpoint", map(checkpoint), otherwise("every second of run time"),
     "How often the results file is rewritten while the run goes on, so that a run that was killed can be resumed.",
     "{every: 60 s}"},
    {"compare", choice(comparisons, "comparison"), otherwise("no comparison"),
     "no_pounding also runs the structures without links and reports the ratio of the peaks.", "no_pounding"},
    {"accept", choice(warning_names, "warning").list(), otherwise("no warning"),
     "Warnings about what is implausible that are meant as they are, and not printed.", "[period]", "0.2.0"},
};

constexpr Key analysis_keys[] = {
    {"duration", quantity(dimension::time, bounds::positive), otherwise("that of the ground motion"),
     "Length of the run, from time 0.", "10 s"},
    {"tolerance", number(min_tolerance, max_tolerance), otherwise("1e-4"),
     "Largest error, relative to the motion and to the forces of the links.", "1e-5"},
    {"output_step", quantity(dimension::time, bounds::positive),
     otherwise("the step of the record; without a record a thousandth of the duration"),
     "Time between two outputs; at most the duration. It does not change the run.", "0.01 s"},
    {"integrator", choice(Scheme::names), otherwise("esdirk4"),
     "Scheme of the time stepping: esdirk4 of order four, generalized_alpha of order two.", "esdirk4"},
    {"spectral_radius", number(bounds::from_0_to_1), otherwise("1"),
     "Spectral radius at infinite frequency: 1 damps nothing, 0 all high modes. It needs integrator: "
     "generalized_alpha.",
     "0.8"},
    {"max_step", quantity(dimension::time, bounds::positive),
     otherwise("chosen from the record and from the shortest period"), "Longest step of the time stepping.", "1 ms"},
    {"most_steps", integer(1, limits::max_steps), otherwise("100000000"),
     "Steps that the run may take. A run that needs more is refused where that is known at its start; otherwise it "
     "ends there, and --resume goes on with it.",
     "500000000", "0.2.0"},
    reduction_key,
    {"collapse_drift", number(bounds::positive), otherwise("no end before the duration"),
     "Drift of a storey over its height at which a structure has collapsed. The run ends there, as done, and says "
     "when, where and what had yielded.",
     "10 %", "0.2.0"},
};

constexpr std::string_view bound_by_error[] = {"acceleration", "members"};

constexpr Key reduction_keys[] = {
    {"links", integer(1, 100), otherwise("5"),
     "Blocks of the chain of the links: one is their static answers, each more brings higher frequencies. Four serve a "
     "tolerance of 1e-3, more with light damping.",
     "5", "0.2.0"},
    {"ground", integer(0, 500), otherwise("20"),
     "Blocks of the chain of the ground and of forces over time, with a few coordinates each.", "20", "0.2.0"},
    {"modes", integer(1, 5000), optional,
     "Lowest natural modes beside the static answers, instead of blocks: for comparison with other programs.", "2",
     "0.2.0"},
    {"error", number(1e-9, 0.1), otherwise("0.3 of the tolerance"),
     "As deep as this bound needs, instead of numbers: three times the estimated error of the forces of links and of "
     "the displacements of floors that the reduction makes, over the largest ones.",
     "1e-4", "0.2.0"},
    {"of", choice(bound_by_error, "response").list(), otherwise("forces and displacements alone"),
     "What else the error holds for: accelerations of floors, forces of members.", "[acceleration]", "0.2.0"},
    {"check", boolean(), otherwise("false"),
     "true steps all unknowns through the three hardest impacts after the run, from its state and with its link "
     "forces, and tells how far they are from it. Alone it reduces as auto does.",
     "true", "0.2.0"},
};

constexpr Key checkpoint_keys[] = {
    {"every", quantity(dimension::time, bounds::positive), at_least_one,
     "Run time between two checkpoints, by the clock.", "60 s"},
    {"every_simulated", quantity(dimension::time, bounds::positive), at_least_one,
     "Simulated time between two checkpoints.", "1 s"},
};

}  // namespace

constinit const Section model{"model", "", "The whole file.", model_keys};
constinit const Section analysis{"analysis", "analysis", "Length and accuracy of the run.", analysis_keys};
constinit const Section reduction{"reduction", "analysis.reduction",
                                  "Depth of reduced structures; under a structure for that one alone.", reduction_keys};
constinit const Section checkpoint{"checkpoint", "checkpoint", "States that a run leaves to be resumed from.",
                                   checkpoint_keys};

}  // namespace pounding::keys
