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

constexpr Key friction_keys[] = {
    {"coefficient", number(bounds::non_negative), required, "Coulomb coefficient of sliding friction.", "0.3", "0.3.0"},
    {"static", number(bounds::non_negative), otherwise("like coefficient"),
     "Coefficient at rest, at least that of sliding; requires stribeck_velocity and a tangential stiffness. At the "
     "sliding velocity v the coefficient is sliding + (static - sliding) exp(-v/stribeck_velocity).",
     "0.4", "0.3.0"},
    {"stribeck_velocity", quantity(dimension::velocity, bounds::positive), otherwise("none; required with static"),
     "Velocity over which the coefficient decays from static to sliding friction.", "10 mm/s", "0.3.0"},
    {"tangential_stiffness", quantity(dimension::stiffness, bounds::positive),
     otherwise("none: the contact does not stick; see sliding_velocity"),
     "Constant stiffness of the contact along its plane until it slips. Give one of tangential_stiffness, "
     "tangential_ratio and poisson.",
     "50 MN/m", "0.3.0"},
    {"tangential_ratio", number(bounds::positive), otherwise("none"),
     "Tangential stiffness as a multiple of the slope of the law at the current penetration in slow loading.", "0.85",
     "0.3.0"},
    {"poisson", number(0, 0.5), otherwise("none"),
     "Poisson's ratio nu of both bodies, for the tangential_ratio of Mindlin, 2 (1 - nu)/(2 - nu).", "0.2", "0.3.0"},
};

constexpr Key link_keys[] = {
    {"between", text().or_map(link_end).list(2).or_one_of(neighbours), required,
     "The two structures, the left one first; A.3 is floor 3 of A, counted from the ground up. An end may be a map "
     "with a floor, a node or an elevation. neighbours links all adjacent frames along x or y, except pairs that an "
     "earlier entry links.",
     "[left, right]"},
    {"within", quantity(dimension::length, bounds::positive), otherwise("1 m"), "Maximum distance between neighbours.",
     "1 m", "0.2.0"},
    {"floors", choice(choices_of_floors, "choice of floors"),
     otherwise("the pair of ends in between; all for neighbours"),
     "Floors to link. all: every floor up to the lower roof, each of which must face a floor of the other structure. "
     "level: only floors at equal elevations. any: floors without a counterpart also hit the column at their "
     "elevation.",
     "all"},
    {"level_within", quantity(dimension::length, bounds::non_negative),
     otherwise("depth of the deeper beam, at least 50 mm"),
     "Maximum difference in elevation of two floors that count as level: they form one pair, and no column is hit "
     "there.",
     "50 mm", "0.3.0"},
    {"gap", quantity(dimension::length).or_each(),
     otherwise("distance between the faces of frames; required for other structures"),
     "Distance between the two ends at rest: one value for all pairs of floors, or a list from the ground up. At least "
     "0 unless preload is true. Between frames it must agree with the distance between their faces to within 0.1 mm or "
     "0.1 %.",
     "20 mm"},
    {"preload", boolean(), otherwise("false"),
     "true permits a negative gap: the overlap of the two ends of the undeformed structures. The run then starts in "
     "static equilibrium, with the structures pushed apart by the contact force.",
     "true", "0.2.0"},
    {"seat", quantity(dimension::length, bounds::positive), otherwise("none"),
     "Length of the seat that supports one end on the other, such as a bridge deck on its pier. The run warns, and "
     "marks "
     "the link as unseated, if the joint opens by more than this beyond its width in the undeformed state. It has no "
     "effect on forces.",
     "300 mm", "0.3.0"},
    {"name", text(), otherwise("from the two ends: left.1-right.1"),
     "Name in reports and results. The first of several pairs is name.1.", "roof"},
    {"points", integer(1, 100), otherwise("2 if edges overlap, else 1"),
     "Number of contact points along the common edge of two floors in space, including its ends. Each uses the given "
     "parameters of the law and its share of the masses.",
     "2"},
    {"friction", number(bounds::non_negative).or_map(link_friction), otherwise("0"),
     "Coulomb friction coefficient in the contact plane; for frames and for laws with a contact force. A map adds "
     "static friction and a tangential stiffness, with which the contact sticks.",
     "0.3"},
    {"sliding_velocity", quantity(dimension::velocity, bounds::positive), otherwise("5 mm/s"),
     "Velocity s that smooths the friction force without a tangential stiffness: F_t = mu F_n v_t/sqrt(v_t^2 + s^2).",
     "5 mm/s"},
    {"law", choice(law_names), required,
     "Contact law; its parameters are keys of the link. `pounding laws` lists them.", "hertz_damped"},
    {"formula", text(), otherwise("exact"),
     "Damping formula of the law. exact attains the target restitution; published formulas deviate from it.", "exact"},
    {"restitution", number(bounds::from_0_to_1),
     otherwise("none; required by laws with damping, unless the damping is given directly"),
     "Coefficient of restitution: ratio of the separation speed to the approach speed. With 0 the bodies stick "
     "together; only stereomechanical and kelvin_voigt allow it.",
     "0.65"},
    {"impact_velocity", quantity(dimension::velocity, bounds::positive), otherwise("approach velocity of each impact"),
     "Fixed approach velocity for which the damping is calibrated.", "0.5 m/s"},
    {"reduced_mass", quantity(dimension::mass, bounds::positive), otherwise("from the masses at the two ends"),
     "Reduced mass m1 m2/(m1 + m2) for which the damping is calibrated. A wall has infinite mass.", "60 t"},
};

constexpr Key end_face_key = [] {
  Key spec = face_key;
  spec.otherwise = "face of the structure";
  spec.meaning = "Like face of the structure, for this end only.";
  return spec;
}();

constexpr Key link_end_keys[] = {
    {"structure", text(), required, "Name of the structure.", "left"},
    {"floor", text(), otherwise("the only floor"),
     "Floor number; 1 is the lowest. Give one of floor, node and elevation.", "3"},
    {"node", text(), optional, "Node of a frame.", "2.1"},
    {"elevation", quantity(dimension::length), optional,
     "Elevation above the common datum, at which a column of a frame is hit.", "10.5 m"},
    end_face_key,
};

constexpr Key stiffness_keys[] = {
    {"E", quantity(dimension::stress, bounds::positive), otherwise("30 GPa"), "Young's modulus of both bodies.",
     "30 GPa", "0.2.0"},
    {"poisson", number(0, 0.5), otherwise("0.2"), "Poisson's ratio of both bodies, for a Hertz stiffness.", "0.2",
     "0.2.0"},
    {"density", quantity(dimension::density, bounds::positive), otherwise("2500 kg/m^3"),
     "Density of the equivalent spheres with the masses of the two ends, if no radius is given.", "2500 kg/m^3",
     "0.2.0"},
    {"radius", quantity(dimension::length, bounds::positive).or_list(2),
     otherwise("radius of the equivalent sphere; a wall is flat"),
     "Radius of curvature at the contact, for a Hertz stiffness: one value for both bodies, or [left, right].", "2 m",
     "0.2.0"},
    {"area", quantity(dimension::area, bounds::positive).or_list(2), otherwise("none, for a Hertz stiffness"),
     "Cross-sectional area of slabs that collide end to end; requires length. One value for both bodies, or [left, "
     "right].",
     "3 m^2", "0.2.0"},
    {"length", quantity(dimension::length, bounds::non_negative).or_list(2), otherwise("none, for a Hertz stiffness"),
     "Length of the slabs from the contact to the centre of mass of the floor: one value for both bodies, or [left, "
     "right]. A slab of zero length is rigid.",
     "9 m", "0.2.0"},
    {"penetration", quantity(dimension::length, bounds::positive), otherwise("none, for a Hertz stiffness"),
     "Target peak penetration in an elastic impact with the approach velocity given by the key velocity.", "5 mm",
     "0.2.0"},
    {"velocity", quantity(dimension::velocity, bounds::positive), otherwise("0.5 m/s"),
     "Approach velocity for the target penetration.", "0.5 m/s", "0.2.0"},
};

}  // namespace

constinit const Section link{"links", "links[]",
                             "Link between two structures. The parameters of its law are further keys.", link_keys};
constinit const Section link_end{"between", "links[].between[]", "End of a link.", link_end_keys};

constinit const Section link_friction{"friction", "links[].friction",
                                      "Friction along a contact that sticks until it slips.", friction_keys};

constinit const Section stiffness{
    "stiffness", "links[].stiffness",
    "Estimate of the contact stiffness: Hertz stiffness of two spheres with the masses of the ends (auto uses "
    "concrete) or with given radii; stiffness of two slabs with area and length; or stiffness for a target "
    "penetration. The report contains the result.",
    stiffness_keys};

}  // namespace pounding::keys
