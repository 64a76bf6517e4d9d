#include <array>

#include <pounding/input/keys/isolators.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr Dimension turning_damping{1, 2, -1};  // [N m s]

/// One word for each displacement of a node; rotations have another dimension than translations.
constexpr std::array<Key, 6> by_displacement(const Dimension& of_translation, const Dimension& of_rotation,
                                             const Bounds& bounds, const std::array<std::string_view, 2>& examples) {
  constexpr std::array<std::string_view, 6> meanings{"Along x.",
                                                     "Along y, in space.",
                                                     "Along z, positive up.",
                                                     "About x, in space.",
                                                     "About y; positive turns z into x.",
                                                     "About z, in space."};
  std::array<Key, 6> keys{};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool turns = i >= 3;
    keys[i] = {.key = displacements[i],
               .takes = Takes::quantity,
               .dimension = turns ? of_rotation : of_translation,
               .unit = of_rotation == turning_damping && turns ? "N m s" : std::string_view{},
               .bounds = bounds,
               .meaning = meanings[i],
               .example = examples[turns]};
  }
  return keys;
}

constexpr auto masses =
    by_displacement(dimension::mass, dimension::rotational_inertia, bounds::non_negative, {"10 t", "5 t m^2"});
constexpr auto loads = by_displacement(dimension::force, dimension::energy, bounds::any, {"-10 kN", "5 kN m"});
constexpr auto moved = by_displacement(dimension::length, dimension::none, bounds::any, {"-5 mm", "0.002"});
constexpr auto springs =
    by_displacement(dimension::stiffness, dimension::energy, bounds::positive, {"20 MN/m", "100 MN m"});
constexpr auto dashpots =
    by_displacement(dimension::damping, turning_damping, bounds::positive, {"100 kN s/m", "1 MN m s"});

constexpr Key support_keys[] = {{.key = "fix",
                                 .takes = Takes::choice,
                                 .form = Form::one_or_list,
                                 .choices = displacements,
                                 .instead = supports,
                                 .noun = "support",
                                 .otherwise = "nothing; beside an isolator all but ux, and uy in space",
                                 .meaning = "Displacements that are fixed: a list, or fixed, pinned or roller.",
                                 .example = "[uz, ry]"},
                                {.key = "isolator",
                                 .inside = &isolator,
                                 .otherwise = "none",
                                 .since = "0.2.0",
                                 .meaning = "An isolator along ux, in space also along uy. It lets the foot neither "
                                            "lift nor turn unless fix says what is held.",
                                 .example = "{friction_pendulum: {radius: 2 m, friction: 6 %, weight: 500 kN}}"},
                                {.key = "springs",
                                 .inside = &support_springs,
                                 .meaning = "Springs to the ground, by their displacements.",
                                 .example = "{ux: 20 MN/m, ry: 100 MN m}"},
                                {.key = "dashpots",
                                 .inside = &support_dashpots,
                                 .meaning = "Dashpots to the ground, by their displacements.",
                                 .example = "{ux: 100 kN s/m}"},
                                {.key = "delay",
                                 .takes = Takes::quantity,
                                 .dimension = dimension::time,
                                 .bounds = bounds::non_negative,
                                 .otherwise = "0 s",
                                 .meaning = "Time by which the ground moves later under this support.",
                                 .example = "0.05 s"},
                                {.key = "ground_motion",
                                 .inside = &ground_motion,
                                 .otherwise = "that of the structure",
                                 .meaning = "Motion of the ground under this support alone; without a wave.",
                                 .example = "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"}};

constexpr Key spring_keys[] = {
    {.key = "node",
     .takes = Takes::text,
     .need = Need::exactly_one,
     .meaning = "Node of a spring to the ground.",
     .example = "b"},
    {.key = "between",
     .takes = Takes::text,
     .form = Form::list,
     .minimum = 2,
     .maximum = 2,
     .need = Need::exactly_one,
     .meaning = "Two nodes of a spring between them.",
     .example = "[b, c]"},
    {.key = "dof",
     .takes = Takes::choice,
     .choices = displacements,
     .noun = "displacement",
     .need = Need::required,
     .meaning = "Displacement that the spring resists; the length of a spring between two nodes does not matter.",
     .example = "ux"},
    {.key = "stiffness",
     .takes = Takes::quantity,
     .dimension = dimension::stiffness,
     .turning = dimension::energy,
     .bounds = bounds::non_negative,
     .need = Need::at_least_one,
     .meaning = "Stiffness, of a rotation a moment per radian.",
     .example = "1 MN/m"},
    {.key = "damping",
     .takes = Takes::quantity,
     .dimension = dimension::damping,
     .turning = turning_damping,
     .unit = "N s/m or N m s",
     .bounds = bounds::non_negative,
     .need = Need::at_least_one,
     .meaning = "Force of the dashpot over its velocity.",
     .example = "100 kN s/m"}};

constexpr Key tie_keys[] = {{.key = "master",
                             .takes = Takes::text,
                             .need = Need::required,
                             .meaning = "Node that the others follow.",
                             .example = "a"},
                            {.key = "nodes",
                             .takes = Takes::text,
                             .form = Form::list,
                             .minimum = 1,
                             .need = Need::required,
                             .meaning = "Nodes that follow.",
                             .example = "[b, c]"},
                            {.key = "dofs",
                             .takes = Takes::choice,
                             .form = Form::list,
                             .choices = displacements,
                             .noun = "displacement",
                             .need = Need::exactly_one,
                             .meaning = "Displacements that are equal to those of the master.",
                             .example = "[ux]"},
                            {.key = "rigid",
                             .takes = Takes::boolean,
                             .need = Need::exactly_one,
                             .meaning = "true joins the nodes to the master by rigid arms.",
                             .example = "true"}};

}  // namespace

constinit const Section support{.name = "supports",
                                .place = "structures.NAME.frame.supports.NODE",
                                .meaning = "One support of a frame.",
                                .keys = support_keys};
constinit const Section support_springs{.name = "support_springs",
                                        .place = "structures.NAME.frame.supports.NODE.springs",
                                        .meaning = "Springs to the ground.",
                                        .keys = springs};
constinit const Section support_dashpots{.name = "support_dashpots",
                                         .place = "structures.NAME.frame.supports.NODE.dashpots",
                                         .meaning = "Dashpots to the ground.",
                                         .keys = dashpots};
constinit const Section node_masses{
    .name = "masses", .place = "structures.NAME.frame.masses.NODE", .meaning = "Masses of one node.", .keys = masses};
constinit const Section node_loads{.name = "loads",
                                   .place = "structures.NAME.frame.loads.NODE",
                                   .meaning = "Forces and moments on one node, in global axes.",
                                   .keys = loads};
constinit const Section node_displacements{
    .name = "node_displacements",
    .place = "structures.NAME.frame.initial_node_displacements.NODE",
    .meaning = "Displacements and rotations of one node at time 0, relative to its place at rest.",
    .keys = moved};
constinit const Section spring{.name = "springs",
                               .place = "structures.NAME.frame.springs[]",
                               .meaning = "A spring, a dashpot, or both side by side.",
                               .keys = spring_keys};
constinit const Section tie{.name = "ties",
                            .place = "structures.NAME.frame.ties[]",
                            .meaning = "Nodes that move with a master, exactly.",
                            .keys = tie_keys};

}  // namespace pounding::keys
