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
    {"between", text().or_map(link_end).list(2).or_one_of(neighbours), required,
     "The two structures, the left one first; A.3 is floor 3 of A, counted from the ground up. An end may be a map "
     "that names a floor, a node or an elevation. neighbours links all frames that stand beside each other along x or "
     "along y, but for pairs that links above it join.",
     "[left, right]"},
    {"within", quantity(dimension::length, bounds::positive), otherwise("1 m"),
     "Neighbours stand at most so far apart.", "1 m", "0.2.0"},
    {"floors", choice(choices_of_floors, "choice of floors"),
     otherwise("the one pair that between names; all of neighbours"),
     "Links several floors: all of them, which must face each other up to the lower roof; those that are level; or "
     "any, where a floor that faces none hits the column there.",
     "all"},
    {"level_within", quantity(dimension::length, bounds::non_negative),
     otherwise("the depth of the deeper beam, at least 50 mm"),
     "Largest difference in elevation of two floors that are level: they are one pair, and neither hits a column "
     "there.",
     "50 mm", "0.3.0"},
    {"gap", quantity(dimension::length).or_each(),
     otherwise("the distance drawn between frames; needed where nothing is drawn"),
     "Distance between the two at rest: one for all pairs of floors, or a list from the ground up. At least 0, unless "
     "preload is true. Between frames it may differ from the distance drawn between faces by 0.1 mm or a thousandth.",
     "20 mm"},
    {"preload", boolean(), otherwise("false"),
     "A negative gap is the overlap of the two ends where their structures are undeformed: the run begins in static "
     "equilibrium, with the structures pushed apart by the contact.",
     "true", "0.2.0"},
    {"name", text(), otherwise("the two ends, left.1-right.1"),
     "Name in reports and results; of several pairs the first is name.1.", "roof"},
    {"points", integer(1, 100), otherwise("2 where edges overlap, else 1"),
     "Contacts along the edge that two floors in space share, from one of its ends to the other. Each takes the "
     "parameters of the law as they are given, and its share of the masses.",
     "2"},
    {"friction", number(bounds::non_negative), otherwise("0"),
     "Coulomb's coefficient in the plane of the contact; for frames, and laws with a force.", "0.3"},
    {"sliding_velocity", quantity(dimension::velocity, bounds::positive), otherwise("5 mm/s"),
     "Velocity s that smooths the friction: F_t = mu F_n v_t/sqrt(v_t^2 + s^2).", "5 mm/s"},
    {"law", choice(law_names), required, "Contact law; its parameters stand beside it. pounding laws describes them.",
     "hertz_damped"},
    {"formula", text(), otherwise("exact"),
     "Damping formula, one of the law's. exact gives the restitution that is asked for; published formulas miss it.",
     "exact"},
    {"restitution", number(bounds::from_0_to_1),
     otherwise("none: a law with damping needs it, or a damping value of its own"),
     "Coefficient of restitution: the speed of separation over that of approach. With 0 the bodies stick; "
     "stereomechanical and kelvin_voigt take it, the other laws need more.",
     "0.65"},
    {"impact_velocity", quantity(dimension::velocity, bounds::positive), otherwise("that of each impact"),
     "Fixed design velocity of approach with which the damping is calibrated.", "0.5 m/s"},
    {"reduced_mass", quantity(dimension::mass, bounds::positive), otherwise("from the masses of the two ends"),
     "m1 m2/(m1 + m2) with which the damping is calibrated; a wall is infinitely heavy.", "60 t"},
};

constexpr Key end_face_key = [] {
  Key spec = face_key;
  spec.otherwise = "that of the structure";
  spec.meaning = "As face of the structure, for this end alone.";
  return spec;
}();

constexpr Key link_end_keys[] = {
    {"structure", text(), required, "Name of the structure.", "left"},
    {"floor", text(), otherwise("its only floor"),
     "Number of the floor, from 1 at the lowest. Give one of floor, node and elevation.", "3"},
    {"node", text(), optional, "Name of a node of a frame.", "2.1"},
    {"elevation", quantity(dimension::length), optional,
     "Elevation above the common datum: the column of a frame there.", "10.5 m"},
    end_face_key,
};

constexpr Key stiffness_keys[] = {
    {"E", quantity(dimension::stress, bounds::positive), otherwise("30 GPa"), "Young's modulus of both bodies.",
     "30 GPa", "0.2.0"},
    {"poisson", number(0, 0.5), otherwise("0.2"), "Poisson's ratio of both bodies, for a stiffness of Hertz.", "0.2",
     "0.2.0"},
    {"density", quantity(dimension::density, bounds::positive), otherwise("2500 kg/m^3"),
     "Density of the balls that have the masses of the two ends, where no radius is given.", "2500 kg/m^3", "0.2.0"},
    {"radius", quantity(dimension::length, bounds::positive).or_list(2),
     otherwise("that of a ball with the mass of the end; a wall is flat"),
     "Radius of the bodies at the contact, for a stiffness of Hertz: one for both, or [left, right].", "2 m", "0.2.0"},
    {"area", quantity(dimension::area, bounds::positive).or_list(2), otherwise("none: a stiffness of Hertz"),
     "Section of the slabs that meet end to end, with length: one for both, or [left, right].", "3 m^2", "0.2.0"},
    {"length", quantity(dimension::length, bounds::non_negative).or_list(2), otherwise("none: a stiffness of Hertz"),
     "Length of the slabs from the contact to the centre of mass of the floor: one for both, or [left, right]. A slab "
     "without length does not yield.",
     "9 m", "0.2.0"},
    {"penetration", quantity(dimension::length, bounds::positive), otherwise("none: a stiffness of Hertz"),
     "Penetration that an elastic impact of the two ends at this velocity shall have.", "5 mm", "0.2.0"},
    {"velocity", quantity(dimension::velocity, bounds::positive), otherwise("0.5 m/s"),
     "Velocity of approach of that impact.", "0.5 m/s", "0.2.0"},
};

}  // namespace

constinit const Section link{"links", "links[]", "One link; the parameters of its law stand beside these keys.",
                             link_keys};
constinit const Section link_end{"between", "links[].between[]", "One end of a link.", link_end_keys};

constinit const Section stiffness{"stiffness", "links[].stiffness",
                                  "An estimate of the stiffness of a contact: of Hertz for two balls of the masses "
                                  "that meet (auto is that for concrete), or for two radii; of two slabs, with area "
                                  "and length; or from a penetration. The report says what was found.",
                                  stiffness_keys};

}  // namespace pounding::keys
