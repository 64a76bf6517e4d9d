#include <pounding/input/keys/devices.hpp>
#include <pounding/input/keys/isolators.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>
#include <pounding/input/keys/springs.hpp>

namespace pounding::keys {
namespace {

constexpr Key mass_key{.key = "mass",
                       .takes = Takes::quantity,
                       .dimension = dimension::mass,
                       .bounds = bounds::positive,
                       .need = Need::required,
                       .meaning = "Its mass.",
                       .example = "100 t"};
constexpr Key yield_key{.key = "yield_force",
                        .takes = Takes::quantity,
                        .form = Form::one_or_each,
                        .dimension = dimension::force,
                        .bounds = bounds::positive,
                        .otherwise = "the storeys stay elastic",
                        .meaning =
                            "Storey shear at which a storey yields, bilinearly: one for all storeys, or a list from "
                            "the ground up. The damping "
                            "stays that of the initial stiffness.",
                        .example = "2 MN"};
constexpr Key hardening_key{
    .key = "hardening",
    .takes = Takes::quantity,
    .form = Form::one_or_each,
    .bounds = bounds::from_0_below_1,
    .otherwise = "0",
    .meaning =
        "Stiffness after yielding over the initial one: one for all storeys, or a list from the ground up. It needs "
        "yield_force.",
    .example = "5 %"};

constexpr Key spring_key{.key = "spring",
                         .inside = &storey_spring,
                         .otherwise = "bilinear where yield_force is given, else elastic",
                         .since = "0.2.0",
                         .meaning =
                             "Law by which the storeys yield, by its name with its numbers, instead of yield_force "
                             "and hardening. The damping stays that "
                             "of the initial stiffness.",
                         .example = "{bouc_wen: {yield_force: 2 MN, hardening: 5 %}}"};

constexpr Key devices_key{
    .key = "devices",
    .form = Form::named,
    .inside = &own_device,
    .since = "0.2.0",
    .meaning = "Braces and dampers inside the structure, by their names.",
    .example = "{brace: {storey: 1, bilinear: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}}"};

constexpr Key structure_keys[] = {
    damping_key,
    velocity_key,
    displacement_key,
    face_key,
    {.key = "delay",
     .takes = Takes::quantity,
     .dimension = dimension::time,
     .bounds = bounds::non_negative,
     .otherwise = "0 s",
     .meaning = "Time by which the ground moves later under this structure.",
     .example = "0.05 s"},
    {.key = "ground_motion",
     .inside = &ground_motion,
     .otherwise = "that of the model",
     .meaning = "Motion of the ground under this structure alone; without a wave.",
     .example = "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
    {.key = "forces",
     .form = Form::list,
     .inside = &force,
     .since = "0.2.0",
     .meaning = "Forces over time on floors, nodes and bodies. A wall takes none.",
     .example = "[{floor: 1, harmonic: {amplitude: 20 kN, period: 0.5 s, duration: 10 s}}]"},
    {.key = "reduction",
     .takes = Takes::choice,
     .inside = &reduction,
     .choices = reductions,
     .noun = "reduction",
     .otherwise = "that of analysis",
     .since = "0.2.0",
     .meaning =
         "As reduction under analysis, for this structure alone. none: all its natural modes where others are reduced.",
     .example = "none"},
    {.key = "body",
     .inside = &body,
     .need = Need::exactly_one,
     .meaning = "A free mass, for collisions.",
     .example = "{mass: 60 t}"},
    {.key = "oscillator",
     .inside = &oscillator,
     .need = Need::exactly_one,
     .meaning = "One mass on one spring.",
     .example = "{mass: 100 t, period: 0.8 s, damping: 5 %}"},
    {.key = "shear_building",
     .inside = &shear_building,
     .need = Need::exactly_one,
     .meaning = "Floors on storeys that deform in shear, along x.",
     .example = "{storeys: 5, mass: 250 t, stiffness: 350 MN/m, height: 3.2 m, damping: 5 %}"},
    {.key = "frame",
     .inside = &frame,
     .need = Need::exactly_one,
     .meaning = "Beams and columns, in the plane or in space.",
     .example =
         "{material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: "
         "[0.4 m, 0.4 m]}, beams: {rectangle: [0.3 m, 0.5 m]}, floor_mass: 20 t}, damping: 5 %}"},
    {.key = "wall",
     .inside = &wall,
     .need = Need::exactly_one,
     .meaning = "Rigid and infinitely heavy; moves with the ground.",
     .example = "{}"}};

constexpr Key body_keys[] = {mass_key,
                             {.key = "gravity",
                              .takes = Takes::quantity,
                              .dimension = dimension::acceleration,
                              .otherwise = "0 m/s^2",
                              .since = "0.2.0",
                              .meaning = "Constant acceleration along x, for a body that falls: with -1 g it falls "
                                         "to the left, onto what stands there.",
                              .example = "-1 g"},
                             velocity_key,
                             displacement_key};

constexpr Key oscillator_keys[] = {mass_key,
                                   {.key = "period",
                                    .takes = Takes::quantity,
                                    .dimension = dimension::time,
                                    .bounds = bounds::positive,
                                    .need = Need::exactly_one,
                                    .meaning = "Natural period T: the stiffness is m (2 pi/T)^2.",
                                    .example = "0.8 s"},
                                   {.key = "stiffness",
                                    .takes = Takes::quantity,
                                    .dimension = dimension::stiffness,
                                    .bounds = bounds::positive,
                                    .need = Need::exactly_one,
                                    .meaning = "Stiffness of the spring.",
                                    .example = "6.2 MN/m"},
                                   yield_key,
                                   hardening_key,
                                   spring_key,
                                   devices_key,
                                   damping_key,
                                   velocity_key,
                                   displacement_key};

constexpr Key shear_building_keys[] = {
    {.key = "storeys",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = 1000},
     .need = Need::required,
     .meaning = "Number of storeys. Floor 1 is the lowest one above the ground.",
     .example = "5"},
    {.key = "mass",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::mass,
     .bounds = bounds::positive,
     .need = Need::required,
     .meaning = "Mass of a floor: one for all floors, or a list from the ground up.",
     .example = "250 t"},
    {.key = "stiffness",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::stiffness,
     .bounds = bounds::positive,
     .need = Need::required,
     .meaning =
         "Shear stiffness of a storey: one for all storeys, or a list from the ground up. The first one is between the "
         "ground and floor 1; beside isolator it is between the slab and floor 2, and so are those of yield_force and "
         "spring.",
     .example = "350 MN/m"},
    {.key = "isolator",
     .inside = &isolator,
     .otherwise = "none",
     .since = "0.2.0",
     .meaning = "The lowest storey is isolators, all of them together, and floor 1 is the slab on them. The weight on "
                "sliders is that of all floors.",
     .example = "{lead_rubber: {strength: 375 kN, yield_displacement: 12 mm, post_yield_stiffness: 3.5 MN/m}}"},
    {.key = "height",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .otherwise = "floors without elevations, and no drifts",
     .meaning = "Height of a storey: one for all storeys, or a list from the ground up.",
     .example = "3.2 m"},
    yield_key,
    hardening_key,
    spring_key,
    devices_key,
    damping_key,
    velocity_key,
    displacement_key};

constexpr Key damping_keys[] = {{.key = "rayleigh",
                                 .inside = &rayleigh,
                                 .need = Need::exactly_one,
                                 .meaning = "Damping a M + b K with a ratio in two modes or at two periods.",
                                 .example = "{ratio: 5 %, modes: [1, 2]}"},
                                {.key = "modal",
                                 .inside = &modal,
                                 .need = Need::exactly_one,
                                 .meaning = "The same damping ratio in every mode.",
                                 .example = "{ratio: 5 %}"}};

constexpr Key ratio_key{.key = "ratio",
                        .takes = Takes::quantity,
                        .bounds = bounds::from_0_below_1,
                        .need = Need::required,
                        .meaning = "Damping ratio.",
                        .example = "5 %"};

constexpr Key rayleigh_keys[] = {ratio_key,
                                 {.key = "modes",
                                  .takes = Takes::integer,
                                  .form = Form::list,
                                  .minimum = 2,
                                  .maximum = 2,
                                  .bounds = {.low = 1},
                                  .otherwise = "[1, 2]",
                                  .meaning = "Two modes that have the ratio, from 1. Give modes or periods.",
                                  .example = "[1, 2]"},
                                 {.key = "periods",
                                  .takes = Takes::quantity,
                                  .form = Form::list,
                                  .minimum = 2,
                                  .maximum = 2,
                                  .dimension = dimension::time,
                                  .bounds = bounds::positive,
                                  .otherwise = "those of the modes",
                                  .meaning = "Two periods at which the damping has the ratio. Give modes or periods.",
                                  .example = "[0.8 s, 0.25 s]"}};

constexpr Key modal_keys[] = {ratio_key};

}  // namespace

constinit const Section structure{.name = "structures",
                                  .place = "structures.NAME",
                                  .meaning = "One structure: its kind, and beside it what every kind can have.",
                                  .keys = structure_keys};
constinit const Section body{
    .name = "body", .place = "structures.NAME.body", .meaning = "A free mass, for collisions.", .keys = body_keys};
constinit const Section oscillator{.name = "oscillator",
                                   .place = "structures.NAME.oscillator",
                                   .meaning = "One mass on one spring.",
                                   .keys = oscillator_keys};
constinit const Section shear_building{.name = "shear_building",
                                       .place = "structures.NAME.shear_building",
                                       .meaning = "Floors on storeys that deform in shear, along x.",
                                       .keys = shear_building_keys};
constinit const Section wall{
    .name = "wall",
    .place = "structures.NAME.wall",
    .meaning = "Rigid and infinitely heavy; moves with the ground. It has no keys: type wall: {}.",
    .keys = {}};
constinit const Section damping{.name = "damping",
                                .place = "structures.NAME.damping",
                                .meaning = "Damping that is more than one ratio.",
                                .keys = damping_keys};
constinit const Section rayleigh{.name = "rayleigh",
                                 .place = "structures.NAME.damping.rayleigh",
                                 .meaning = "Damping a M + b K.",
                                 .keys = rayleigh_keys};
constinit const Section modal{.name = "modal",
                              .place = "structures.NAME.damping.modal",
                              .meaning = "The same damping ratio in every mode.",
                              .keys = modal_keys};

}  // namespace pounding::keys
