#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

#include <pounding/model/model.hpp>
#include <pounding/model/warning_names.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view comparisons[] = {"no_pounding"};

constexpr Key model_keys[] = {
    {"title", text(), otherwise("no title"), "Title of the model, for reports and pictures.", "Two oscillators"},
    {"project", text(), otherwise("no project"), "Line below the title of a report: project, client, number.",
     "Main Street 5 and 7", "0.3.0"},
    {"ground_motion", map(ground_motion), otherwise("no ground motion"),
     "Ground motion of all structures without a separate one.",
     "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
    {"structures", map(structure).named(), required,
     "Structures by name; results follow this order. A name contains neither \".\" nor \"/\".",
     "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}"},
    {"links", map(link).list(), otherwise("no links"), "Links: locations at which two structures can collide.",
     "[{between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}]"},
    {"devices", map(device).named(), otherwise("no devices"),
     "Bars and dampers between two structures, by name. They act permanently, in tension and compression.",
     "{top damper: {between: [left, right], damper: {coefficient: 200 kN s/m}}}", "0.2.0"},
    {"analysis", map(analysis), optional, "Duration, accuracy and method of the time integration.", "{duration: 10 s}"},
    {"checkpoint", map(checkpoint), otherwise("every second of wall-clock time"),
     "Interval at which the results file is updated during a run, so that an interrupted run can be resumed.",
     "{every: 60 s}"},
    {"compare", choice(comparisons, "comparison"), otherwise("no comparison"),
     "no_pounding also runs the structures without links and reports the ratios of the peak responses.", "no_pounding"},
    {"accept", choice(warning_names, "warning").list(), otherwise("no warning"), "Plausibility warnings to suppress.",
     "[period]", "0.2.0"},
};

constexpr Key analysis_keys[] = {
    {"duration", quantity(dimension::time, bounds::positive), otherwise("duration of the ground motion"),
     "Simulated time, starting at 0.", "10 s"},
    {"tolerance", number(min_tolerance, max_tolerance), otherwise("1e-4"),
     "Error tolerance of the time integration, relative to the peak motion and the peak link forces.", "1e-5"},
    {"output_step", quantity(dimension::time, bounds::positive),
     otherwise("time step of the record; without a record, 1/1000 of the duration"),
     "Time between two outputs; at most the duration. It does not affect the time integration.", "0.01 s"},
    {"integrator", choice(Scheme::names), otherwise("esdirk4"),
     "Time integration scheme: esdirk4 (fourth order) or generalized_alpha (second order).", "esdirk4"},
    {"spectral_radius", number(bounds::from_0_to_1), otherwise("1"),
     "Spectral radius at infinite frequency: 1 for no numerical damping, 0 for maximum damping of high modes. Requires "
     "integrator: generalized_alpha.",
     "0.8"},
    {"max_step", quantity(dimension::time, bounds::positive), otherwise("from the record and the shortest period"),
     "Maximum time step.", "1 ms"},
    {"most_steps", integer(1, max_step_count), otherwise("100000000"),
     "Maximum number of steps. A run that is known to need more does not start; any other run stops at this number and "
     "can be continued with --resume.",
     "500000000", "0.2.0"},
    reduction_key,
    {"collapse_drift", number(bounds::positive), otherwise("no limit"),
     "Storey drift ratio at which a structure counts as collapsed. The run then ends normally and reports the time, "
     "the storey and the members that have yielded.",
     "10 %", "0.2.0"},
};

constexpr std::string_view bound_by_error[] = {"acceleration", "members"};

constexpr Key reduction_keys[] = {
    {"links", integer(1, 100), otherwise("5"),
     "Number of blocks of the Krylov subspace for link forces: the first block contains the static responses, each "
     "further block adds higher frequencies. Four suffice for a tolerance of 1e-3; light damping needs more.",
     "5", "0.2.0"},
    {"ground", integer(0, 500), otherwise("20"),
     "Number of blocks of the Krylov subspace for ground motion and applied forces, with a few coordinates per block.",
     "20", "0.2.0"},
    {"modes", integer(1, 5000), optional,
     "Number of lowest natural modes used with the static responses instead of blocks, for comparison with other "
     "programs.",
     "2", "0.2.0"},
    {"error", number(1e-9, 0.1), otherwise("0.3 times the tolerance"),
     "Error bound that determines the number of blocks: three times the estimated reduction error of link forces and "
     "floor displacements, relative to their peaks.",
     "1e-4", "0.2.0"},
    {"of", choice(bound_by_error, "response").list(), otherwise("link forces and floor displacements only"),
     "Additional responses to which the error bound applies: floor accelerations, member forces.", "[acceleration]",
     "0.2.0"},
    {"check", boolean(), otherwise("false"),
     "true integrates the full system through the three strongest impacts after the run, from its states and with its "
     "link forces, and reports the difference. Without other keys the structure is reduced as with auto.",
     "true", "0.2.0"},
};

constexpr Key checkpoint_keys[] = {
    {"every", quantity(dimension::time, bounds::positive), at_least_one, "Wall-clock time between two checkpoints.",
     "60 s"},
    {"every_simulated", quantity(dimension::time, bounds::positive), at_least_one,
     "Simulated time between two checkpoints.", "1 s"},
};

}  // namespace

constinit const Section model{"model", "", "The whole input file.", model_keys};
constinit const Section analysis{"analysis", "analysis", "Duration, accuracy and method of the time integration.",
                                 analysis_keys};
constinit const Section reduction{"reduction", "analysis.reduction",
                                  "Size of reduced models. Under a structure, for that structure only.",
                                  reduction_keys};
constinit const Section checkpoint{"checkpoint", "checkpoint", "Checkpoints from which a run can be resumed.",
                                   checkpoint_keys};

}  // namespace pounding::keys
