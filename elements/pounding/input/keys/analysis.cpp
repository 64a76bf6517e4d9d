#include <pounding/input/keys/devices.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

#include <pounding/model/model.hpp>
#include <pounding/model/warning_names.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view comparisons[] = {"no_pounding"};

constexpr Key model_keys[] = {
    {.key = "title",
     .takes = Takes::text,
     .otherwise = "no title",
     .meaning = "Title of the model, for reports and pictures.",
     .example = "Two oscillators"},
    {.key = "ground_motion",
     .inside = &ground_motion,
     .otherwise = "a still ground",
     .meaning = "Motion of the ground under all structures that have none of their own.",
     .example = "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
    {.key = "structures",
     .form = Form::named,
     .inside = &structure,
     .need = Need::required,
     .meaning = "The structures by their names, in the order of the results. A name has no \".\" and no \"/\".",
     .example = "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}"},
    {.key = "links",
     .form = Form::list,
     .inside = &link,
     .otherwise = "no links",
     .meaning = "The places where two structures can hit each other, one member of the list a link.",
     .example = "[{between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}]"},
    {.key = "devices",
     .form = Form::named,
     .inside = &device,
     .otherwise = "no devices",
     .since = "0.2.0",
     .meaning = "Bars and dampers between two structures by their names: they always act, both ways.",
     .example = "{top damper: {between: [left, right], damper: {coefficient: 200 kN s/m}}}"},
    {.key = "analysis",
     .inside = &analysis,
     .meaning = "How long and how exactly the model is run.",
     .example = "{duration: 10 s}"},
    {.key = "checkpoint",
     .inside = &checkpoint,
     .otherwise = "every second of run time",
     .meaning =
         "How often the results file is rewritten while the run goes on, so that a run that was killed can be resumed.",
     .example = "{every: 60 s}"},
    {.key = "compare",
     .takes = Takes::choice,
     .choices = comparisons,
     .noun = "comparison",
     .otherwise = "no comparison",
     .meaning = "no_pounding also runs the structures without links and reports the ratio of the peaks.",
     .example = "no_pounding"},
    {.key = "accept",
     .takes = Takes::choice,
     .form = Form::list,
     .choices = warning_names,
     .noun = "warning",
     .otherwise = "no warning",
     .since = "0.2.0",
     .meaning = "Warnings about what is implausible that are meant as they are, and not printed.",
     .example = "[period]"}};

constexpr Key analysis_keys[] = {
    {.key = "duration",
     .takes = Takes::quantity,
     .dimension = dimension::time,
     .bounds = bounds::positive,
     .otherwise = "that of the ground motion",
     .meaning = "Length of the run, from time 0.",
     .example = "10 s"},
    {.key = "tolerance",
     .takes = Takes::quantity,
     .bounds = {.low = min_tolerance, .high = max_tolerance},
     .otherwise = "1e-4",
     .meaning = "Largest error, relative to the motion and to the forces of the links.",
     .example = "1e-5"},
    {.key = "output_step",
     .takes = Takes::quantity,
     .dimension = dimension::time,
     .bounds = bounds::positive,
     .otherwise = "the step of the record; without a record a thousandth of the duration",
     .meaning = "Time between two outputs; at most the duration. It does not change the run.",
     .example = "0.01 s"},
    {.key = "integrator",
     .takes = Takes::choice,
     .choices = Scheme::names,
     .otherwise = "esdirk4",
     .meaning = "Scheme of the time stepping: esdirk4 of order four, generalized_alpha of order two.",
     .example = "esdirk4"},
    {.key = "spectral_radius",
     .takes = Takes::quantity,
     .bounds = bounds::from_0_to_1,
     .otherwise = "1",
     .meaning = "Spectral radius at infinite frequency: 1 damps nothing, 0 all high modes. It needs integrator: "
                "generalized_alpha.",
     .example = "0.8"},
    {.key = "max_step",
     .takes = Takes::quantity,
     .dimension = dimension::time,
     .bounds = bounds::positive,
     .otherwise = "chosen from the record and from the shortest period",
     .meaning = "Longest step of the time stepping.",
     .example = "1 ms"},
    {.key = "most_steps",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = limits::max_steps},
     .otherwise = "100000000",
     .since = "0.2.0",
     .meaning = "Steps that the run may take. A run that needs more is refused where that is known at its start; "
                "otherwise it ends there, and "
                "--resume goes on with it.",
     .example = "500000000"},
    reduction_key,
    {.key = "collapse_drift",
     .takes = Takes::quantity,
     .bounds = bounds::positive,
     .otherwise = "no end before the duration",
     .since = "0.2.0",
     .meaning = "Drift of a storey over its height at which a structure has collapsed. The run ends there, as done, "
                "and says when, where and "
                "what had yielded.",
     .example = "10 %"}};

constexpr std::string_view bound_by_error[] = {"acceleration", "members"};

constexpr Key reduction_keys[] = {
    {.key = "links",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = 100},
     .otherwise = "5",
     .since = "0.2.0",
     .meaning = "Blocks of the chain of the links: one is their static answers, each more brings higher frequencies. "
                "Four serve a tolerance "
                "of 1e-3, more with light damping.",
     .example = "5"},
    {.key = "ground",
     .takes = Takes::integer,
     .bounds = {.low = 0, .high = 500},
     .otherwise = "20",
     .since = "0.2.0",
     .meaning = "Blocks of the chain of the ground and of forces over time, with a few coordinates each.",
     .example = "20"},
    {.key = "modes",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = 5000},
     .since = "0.2.0",
     .meaning =
         "Lowest natural modes beside the static answers, instead of blocks: for comparison with other programs.",
     .example = "2"},
    {.key = "error",
     .takes = Takes::quantity,
     .bounds = {.low = 1e-9, .high = 0.1},
     .otherwise = "0.3 of the tolerance",
     .since = "0.2.0",
     .meaning = "As deep as this bound needs, instead of numbers: three times the estimated error of the forces of "
                "links and of the displacements of "
                "floors that the reduction makes, over the largest ones.",
     .example = "1e-4"},
    {.key = "of",
     .takes = Takes::choice,
     .form = Form::list,
     .choices = bound_by_error,
     .noun = "response",
     .otherwise = "forces and displacements alone",
     .since = "0.2.0",
     .meaning = "What else the error holds for: accelerations of floors, forces of members.",
     .example = "[acceleration]"},
    {.key = "check",
     .takes = Takes::boolean,
     .otherwise = "false",
     .since = "0.2.0",
     .meaning = "true steps all unknowns through the three hardest impacts after the run, from its state and with its "
                "link forces, and tells how far they "
                "are from it. Alone it reduces as auto does.",
     .example = "true"}};

constexpr Key checkpoint_keys[] = {{.key = "every",
                                    .takes = Takes::quantity,
                                    .dimension = dimension::time,
                                    .bounds = bounds::positive,
                                    .need = Need::at_least_one,
                                    .meaning = "Run time between two checkpoints, by the clock.",
                                    .example = "60 s"},
                                   {.key = "every_simulated",
                                    .takes = Takes::quantity,
                                    .dimension = dimension::time,
                                    .bounds = bounds::positive,
                                    .need = Need::at_least_one,
                                    .meaning = "Simulated time between two checkpoints.",
                                    .example = "1 s"}};

}  // namespace

constinit const Section model{.name = "model", .place = "", .meaning = "The whole file.", .keys = model_keys};
constinit const Section analysis{
    .name = "analysis", .place = "analysis", .meaning = "Length and accuracy of the run.", .keys = analysis_keys};
constinit const Section reduction{.name = "reduction",
                                  .place = "analysis.reduction",
                                  .meaning = "Depth of reduced structures; under a structure for that one alone.",
                                  .keys = reduction_keys};
constinit const Section checkpoint{.name = "checkpoint",
                                   .place = "checkpoint",
                                   .meaning = "States that a run leaves to be resumed from.",
                                   .keys = checkpoint_keys};

}  // namespace pounding::keys
