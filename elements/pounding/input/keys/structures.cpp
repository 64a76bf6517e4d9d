#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr Key mass_key("mass", quantity(dimension::mass, bounds::positive), required, "Mass.", "100 t");
constexpr Key yield_key("yield_force", quantity(dimension::force, bounds::positive).or_each(),
                        otherwise("elastic storeys"),
                        "Yield shear of a bilinear storey: one value for all storeys, or a list from the ground up. "
                        "The damping is that of the initial stiffness.",
                        "2 MN");
constexpr Key hardening_key("hardening", number(bounds::from_0_below_1).or_each(), otherwise("0"),
                            "Hardening ratio of the post-yield to the initial stiffness: one value for all storeys, or "
                            "a list from the ground up. Requires yield_force.",
                            "5 %");

constexpr Key spring_key("spring", map(storey_spring), otherwise("bilinear if yield_force is given, else elastic"),
                         "Hysteretic law of the storeys, by name with its parameters, instead of yield_force and "
                         "hardening. The damping is that of the initial stiffness.",
                         "{bouc_wen: {yield_force: 2 MN, hardening: 5 %}}", "0.2.0");

constexpr Key devices_key("devices", map(own_device).named(), optional,
                          "Braces and dampers inside the structure, by name.",
                          "{brace: {storey: 1, bilinear: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}}",
                          "0.2.0");

constexpr Key structure_keys[] = {
    damping_key,
    velocity_key,
    displacement_key,
    face_key,
    {"delay", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Time delay of the ground motion at this structure.", "0.05 s"},
    {"ground_motion", map(ground_motion), otherwise("ground motion of the model"),
     "Ground motion of this structure only; without a wave.",
     "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
    {"forces", map(force).list(), optional, "Time-dependent forces on floors, nodes and bodies. Not allowed on a wall.",
     "[{floor: 1, harmonic: {amplitude: 20 kN, period: 0.5 s, duration: 10 s}}]", "0.2.0"},
    {"reduction", choice(reductions, "reduction").or_map(reduction), otherwise("reduction under analysis"),
     "Like reduction under analysis, for this structure only. none: full set of natural modes even if other structures "
     "are reduced.",
     "none", "0.2.0"},
    {"body", map(body), exactly_one, "Free rigid mass.", "{mass: 60 t}"},
    {"oscillator", map(oscillator), exactly_one, "Single mass on a spring.",
     "{mass: 100 t, period: 0.8 s, damping: 5 %}"},
    {"shear_building", map(shear_building), exactly_one,
     "Shear building: floor masses on storeys that deform in shear along x.",
     "{storeys: 5, mass: 250 t, stiffness: 350 MN/m, height: 3.2 m, damping: 5 %}"},
    {"frame", map(frame), exactly_one, "Beams and columns, in the plane or in space.",
     "{material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: "
     "[0.4 m, 0.4 m]}, beams: {rectangle: [0.3 m, 0.5 m]}, floor_mass: 20 t}, damping: 5 %}"},
    {"wall", map(wall), exactly_one, "Rigid wall of infinite mass that moves with the ground.", "{}"},
};

constexpr Key body_keys[] = {
    mass_key,
    {"gravity", quantity(dimension::acceleration), otherwise("0 m/s^2"),
     "Constant acceleration along x, for a falling body: with -1 g it falls to the left.", "-1 g", "0.2.0"},
    velocity_key,
    displacement_key,
};

constexpr Key oscillator_keys[] = {
    mass_key,
    {"period", quantity(dimension::time, bounds::positive), exactly_one,
     "Natural period T, which gives the stiffness m (2 pi/T)^2.", "0.8 s"},
    {"stiffness", quantity(dimension::stiffness, bounds::positive), exactly_one, "Stiffness of the spring.",
     "6.2 MN/m"},
    yield_key,
    hardening_key,
    spring_key,
    devices_key,
    damping_key,
    velocity_key,
    displacement_key,
};

constexpr Key shear_building_keys[] = {
    {"storeys", integer(1, 1000), required, "Number of storeys. Floor 1 is the lowest floor above the ground.", "5"},
    {"mass", quantity(dimension::mass, bounds::positive).or_each(), required,
     "Floor mass: one value for all floors, or a list from the ground up.", "250 t"},
    {"stiffness", quantity(dimension::stiffness, bounds::positive).or_each(), required,
     "Storey shear stiffness: one value for all storeys, or a list from the ground up. The first value is between the "
     "ground and floor 1. With isolator it is between floors 1 and 2, as are the first values of yield_force and "
     "spring.",
     "350 MN/m"},
    {"isolator", map(isolator), otherwise("none"),
     "Isolators, all together, as the lowest storey; floor 1 is the slab above them. The weight on sliding isolators "
     "is that of all floors.",
     "{lead_rubber: {strength: 375 kN, yield_displacement: 12 mm, post_yield_stiffness: 3.5 MN/m}}", "0.2.0"},
    {"height", quantity(dimension::length, bounds::positive).or_each(),
     otherwise("none; floors then have no elevations and drifts are not reported"),
     "Storey height: one value for all storeys, or a list from the ground up.", "3.2 m"},
    yield_key,
    hardening_key,
    spring_key,
    devices_key,
    damping_key,
    velocity_key,
    displacement_key,
};

constexpr std::string_view damped_stiffnesses[] = {"initial", "superstructure"};

constexpr Key damping_keys[] = {
    {"rayleigh", map(rayleigh), exactly_one,
     "Rayleigh damping alpha M + beta K, by the damping ratio in two modes or at two periods, or by its factors.",
     "{ratio: 5 %, modes: [1, 2]}"},
    {"mass_proportional", map(mass_proportional), exactly_one,
     "Damping alpha M alone, by the damping ratio in one mode or at one period, or by its factor. The ratio of a mode "
     "is proportional to its period.",
     "{ratio: 5 %, mode: 1}", "0.3.0"},
    {"stiffness_proportional", map(stiffness_proportional), exactly_one,
     "Damping beta K alone, by the damping ratio in one mode or at one period, or by its factor. The ratio of a mode "
     "is proportional to its frequency.",
     "{ratio: 5 %, mode: 1}", "0.3.0"},
    {"modal", map(modal), exactly_one, "Modal damping: one damping ratio for all modes, or ratios by mode.",
     "{ratio: 5 %}"},
    {"of", choice(damped_stiffnesses, "stiffness"), otherwise("superstructure on isolators, initial without isolators"),
     "Stiffness K of a structure on isolators that defines its damping. superstructure: without that of the isolators, "
     "which are not damped; modes are those on a fixed base. initial: of the whole structure with the initial "
     "stiffness "
     "of the isolators, whose motion is then damped as well.",
     "initial", "0.3.0"},
};

constexpr Value factor_by_mass = quantity(dimension::frequency, bounds::non_negative);
constexpr Value factor_by_stiffness = quantity(dimension::time, bounds::non_negative);

constexpr Key ratio_or(Need need, std::string_view description) {
  return {"ratio", number(bounds::from_0_below_1), need, description, "5 %"};
}

constexpr Key one_mode_key("mode", integer({.low = 1}), otherwise("1"),
                           "The mode with the damping ratio; 1 is the lowest. Give mode or period, not both.", "1",
                           "0.3.0");
constexpr Key one_period_key("period", quantity(dimension::time, bounds::positive), otherwise("period of the mode"),
                             "The period with the damping ratio. Give mode or period, not both.", "0.8 s", "0.3.0");

constexpr Key rayleigh_keys[] = {
    ratio_or(at_least_one, "Damping ratio in two modes. Give ratio, or alpha and beta."),
    {"alpha", factor_by_mass, {at_least_one, "0"}, "Factor of the mass matrix.", "0.3 1/s", "0.3.0"},
    {"beta", factor_by_stiffness, {at_least_one, "0"}, "Factor of the stiffness matrix.", "0.002 s", "0.3.0"},
    {"modes", integer({.low = 1}).list(2), otherwise("[1, 2]"),
     "The two modes with the damping ratio; 1 is the lowest. Give modes or periods, not both.", "[1, 2]"},
    {"periods", quantity(dimension::time, bounds::positive).list(2), otherwise("periods of the modes"),
     "The two periods with the damping ratio. Give modes or periods, not both.", "[0.8 s, 0.25 s]"},
};

constexpr Key mass_proportional_keys[] = {
    ratio_or(exactly_one, "Damping ratio in one mode."),
    one_mode_key,
    one_period_key,
    {"alpha", factor_by_mass, exactly_one, "Factor of the mass matrix.", "0.6 1/s", "0.3.0"},
};

constexpr Key stiffness_proportional_keys[] = {
    ratio_or(exactly_one, "Damping ratio in one mode."),
    one_mode_key,
    one_period_key,
    {"beta", factor_by_stiffness, exactly_one, "Factor of the stiffness matrix.", "0.004 s", "0.3.0"},
};

constexpr Key modal_keys[] = {
    ratio_or(exactly_one, "Damping ratio of all modes."),
    {"ratios", number(bounds::from_0_below_1).nonempty_list(), exactly_one, "Damping ratios of the lowest modes.",
     "[5 %, 5 %]", "0.3.0"},
    {"others", number(bounds::from_0_below_1), otherwise("none; required if modes remain beyond the list"),
     "Damping ratio of all modes beyond the list ratios.", "2 %", "0.3.0"},
};

}  // namespace

constinit const Section structure{"structures", "structures.NAME",
                                  "Structure: its kind, and the keys common to all kinds.", structure_keys};
constinit const Section body{"body", "structures.NAME.body", "Free rigid mass.", body_keys};
constinit const Section oscillator{"oscillator", "structures.NAME.oscillator", "Single mass on a spring.",
                                   oscillator_keys};
constinit const Section shear_building{"shear_building", "structures.NAME.shear_building",
                                       "Shear building: floor masses on storeys that deform in shear along x.",
                                       shear_building_keys};
constinit const Section wall{"wall",
                             "structures.NAME.wall",
                             "Rigid wall of infinite mass that moves with the ground. It has no keys; type wall: {}.",
                             {}};
constinit const Section damping{"damping", "structures.NAME.damping",
                                "Damping model, if a single damping ratio is not sufficient.", damping_keys};
constinit const Section rayleigh{"rayleigh", "structures.NAME.damping.rayleigh", "Rayleigh damping alpha M + beta K.",
                                 rayleigh_keys};
constinit const Section mass_proportional{"mass_proportional", "structures.NAME.damping.mass_proportional",
                                          "Damping proportional to the mass alone: alpha M.", mass_proportional_keys};
constinit const Section stiffness_proportional{
    "stiffness_proportional", "structures.NAME.damping.stiffness_proportional",
    "Damping proportional to the stiffness alone: beta K.", stiffness_proportional_keys};
constinit const Section modal{"modal", "structures.NAME.damping.modal",
                              "Modal damping: one damping ratio for all modes, or ratios by mode.", modal_keys};

}  // namespace pounding::keys
