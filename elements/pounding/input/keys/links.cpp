#include <array>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view neighbours[] = {"neighbours"};
constexpr std::string_view choices_of_floors[] = {"all", "level", "any"};

constexpr auto law_names = [] {
  constexpr auto& laws = laws::Laws::entries;
  std::array<std::string_view, laws.size()> names{};
  for (std::size_t i = 0; i < laws.size(); ++i) names[i] = laws[i].name;
  return names;
}();

constexpr Key link_keys[] = {
    {.key = "between",
     .takes = Takes::text,
     .form = Form::list,
     .minimum = 2,
     .maximum = 2,
     .inside = &link_end,
     .instead = neighbours,
     .need = Need::required,
     .meaning =
         "The two structures, the left one first; A.3 is floor 3 of A, counted from the ground up. An end may be a map "
         "that names a floor, a node or an elevation. neighbours links all frames that stand beside each other along x "
         "or "
         "along y, but for pairs that links above it join.",
     .example = "[left, right]"},
    {.key = "within",
     .takes = Takes::quantity,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .otherwise = "1 m",
     .since = "0.2.0",
     .meaning = "Neighbours stand at most so far apart.",
     .example = "1 m"},
    {.key = "floors",
     .takes = Takes::choice,
     .choices = choices_of_floors,
     .noun = "choice of floors",
     .otherwise = "the one pair that between names; all of neighbours",
     .meaning = "Links several floors: all of them, which must face each other up to the lower roof; those that are "
                "level; or any, "
                "where a floor that faces none hits the column there.",
     .example = "all"},
    {.key = "level_within",
     .takes = Takes::quantity,
     .dimension = dimension::length,
     .bounds = bounds::non_negative,
     .otherwise = "the depth of the deeper beam, at least 50 mm",
     .since = "0.3.0",
     .meaning = "Largest difference in elevation of two floors that are level: they are one pair, and neither hits a "
                "column there.",
     .example = "50 mm"},
    {.key = "gap",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::length,
     .otherwise = "the distance drawn between frames; needed where nothing is drawn",
     .meaning = "Distance between the two at rest: one for all pairs of floors, or a list from the ground up. At least "
                "0, unless "
                "preload is true. Between frames it may differ from the distance drawn between faces by 0.1 mm or a "
                "thousandth.",
     .example = "20 mm"},
    {.key = "preload",
     .takes = Takes::boolean,
     .otherwise = "false",
     .since = "0.2.0",
     .meaning = "A negative gap is the overlap of the two ends where their structures are undeformed: the run begins "
                "in static "
                "equilibrium, with the structures pushed apart by the contact.",
     .example = "true"},
    {.key = "name",
     .takes = Takes::text,
     .otherwise = "the two ends, left.1-right.1",
     .meaning = "Name in reports and results; of several pairs the first is name.1.",
     .example = "roof"},
    {.key = "points",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = 100},
     .otherwise = "2 where edges overlap, else 1",
     .meaning =
         "Contacts along the edge that two floors in space share, from one of its ends to the other. Each takes the "
         "parameters of the law as they are given, and its share of the masses.",
     .example = "2"},
    {.key = "friction",
     .takes = Takes::quantity,
     .bounds = bounds::non_negative,
     .otherwise = "0",
     .meaning = "Coulomb's coefficient in the plane of the contact; for frames, and laws with a force.",
     .example = "0.3"},
    {.key = "sliding_velocity",
     .takes = Takes::quantity,
     .dimension = dimension::velocity,
     .bounds = bounds::positive,
     .otherwise = "5 mm/s",
     .meaning = "Velocity s that smooths the friction: F_t = mu F_n v_t/sqrt(v_t^2 + s^2).",
     .example = "5 mm/s"},
    {.key = "law",
     .takes = Takes::choice,
     .choices = law_names,
     .need = Need::required,
     .meaning = "Contact law; its parameters stand beside it. pounding laws describes them.",
     .example = "hertz_damped"},
    {.key = "formula",
     .takes = Takes::text,
     .otherwise = "exact",
     .meaning = "Damping formula, one of the law's. exact gives the restitution that is asked for; published formulas "
                "miss it.",
     .example = "exact"},
    {.key = "restitution",
     .takes = Takes::quantity,
     .bounds = bounds::from_0_to_1,
     .otherwise = "none: a law with damping needs it, or a damping value of its own",
     .meaning = "Coefficient of restitution: the speed of separation over that of approach. With 0 the bodies stick; "
                "stereomechanical "
                "and kelvin_voigt take it, the other laws need more.",
     .example = "0.65"},
    {.key = "impact_velocity",
     .takes = Takes::quantity,
     .dimension = dimension::velocity,
     .bounds = bounds::positive,
     .otherwise = "that of each impact",
     .meaning = "Fixed design velocity of approach with which the damping is calibrated.",
     .example = "0.5 m/s"},
    {.key = "reduced_mass",
     .takes = Takes::quantity,
     .dimension = dimension::mass,
     .bounds = bounds::positive,
     .otherwise = "from the masses of the two ends",
     .meaning = "m1 m2/(m1 + m2) with which the damping is calibrated; a wall is infinitely heavy.",
     .example = "60 t"}};

constexpr Key end_face_key = [] {
  Key spec = face_key;
  spec.otherwise = "that of the structure";
  spec.meaning = "As face of the structure, for this end alone.";
  return spec;
}();

constexpr Key link_end_keys[] = {
    {.key = "structure",
     .takes = Takes::text,
     .need = Need::required,
     .meaning = "Name of the structure.",
     .example = "left"},
    {.key = "floor",
     .takes = Takes::text,
     .otherwise = "its only floor",
     .meaning = "Number of the floor, from 1 at the lowest. Give one of floor, node and elevation.",
     .example = "3"},
    {.key = "node", .takes = Takes::text, .meaning = "Name of a node of a frame.", .example = "2.1"},
    {.key = "elevation",
     .takes = Takes::quantity,
     .dimension = dimension::length,
     .meaning = "Elevation above the common datum: the column of a frame there.",
     .example = "10.5 m"},
    end_face_key};

constexpr Key stiffness_keys[] = {
    {.key = "E",
     .takes = Takes::quantity,
     .dimension = dimension::stress,
     .bounds = bounds::positive,
     .otherwise = "30 GPa",
     .since = "0.2.0",
     .meaning = "Young's modulus of both bodies.",
     .example = "30 GPa"},
    {.key = "poisson",
     .takes = Takes::quantity,
     .bounds = {.low = 0, .high = 0.5},
     .otherwise = "0.2",
     .since = "0.2.0",
     .meaning = "Poisson's ratio of both bodies, for a stiffness of Hertz.",
     .example = "0.2"},
    {.key = "density",
     .takes = Takes::quantity,
     .dimension = dimension::density,
     .bounds = bounds::positive,
     .otherwise = "2500 kg/m^3",
     .since = "0.2.0",
     .meaning = "Density of the balls that have the masses of the two ends, where no radius is given.",
     .example = "2500 kg/m^3"},
    {.key = "radius",
     .takes = Takes::quantity,
     .form = Form::one_or_list,
     .minimum = 2,
     .maximum = 2,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .otherwise = "that of a ball with the mass of the end; a wall is flat",
     .since = "0.2.0",
     .meaning = "Radius of the bodies at the contact, for a stiffness of Hertz: one for both, or [left, right].",
     .example = "2 m"},
    {.key = "area",
     .takes = Takes::quantity,
     .form = Form::one_or_list,
     .minimum = 2,
     .maximum = 2,
     .dimension = dimension::area,
     .bounds = bounds::positive,
     .otherwise = "none: a stiffness of Hertz",
     .since = "0.2.0",
     .meaning = "Section of the slabs that meet end to end, with length: one for both, or [left, right].",
     .example = "3 m^2"},
    {.key = "length",
     .takes = Takes::quantity,
     .form = Form::one_or_list,
     .minimum = 2,
     .maximum = 2,
     .dimension = dimension::length,
     .bounds = bounds::non_negative,
     .otherwise = "none: a stiffness of Hertz",
     .since = "0.2.0",
     .meaning = "Length of the slabs from the contact to the centre of mass of the floor: one for both, or [left, "
                "right]. A slab "
                "without length does not yield.",
     .example = "9 m"},
    {.key = "penetration",
     .takes = Takes::quantity,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .otherwise = "none: a stiffness of Hertz",
     .since = "0.2.0",
     .meaning = "Penetration that an elastic impact of the two ends at this velocity shall have.",
     .example = "5 mm"},
    {.key = "velocity",
     .takes = Takes::quantity,
     .dimension = dimension::velocity,
     .bounds = bounds::positive,
     .otherwise = "0.5 m/s",
     .since = "0.2.0",
     .meaning = "Velocity of approach of that impact.",
     .example = "0.5 m/s"}};

}  // namespace

constinit const Section link{.name = "links",
                             .place = "links[]",
                             .meaning = "One link; the parameters of its law stand beside these keys.",
                             .keys = link_keys};
constinit const Section link_end{
    .name = "between", .place = "links[].between[]", .meaning = "One end of a link.", .keys = link_end_keys};

constinit const Section stiffness{
    .name = "stiffness",
    .place = "links[].stiffness",
    .meaning =
        "An estimate of the stiffness of a contact: of Hertz for two balls of the masses that meet (auto is that for "
        "concrete), or "
        "for two radii; of two slabs, with area and length; or from a penetration. The report says what was found.",
    .keys = stiffness_keys};

}  // namespace pounding::keys
