#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view mass_kinds[] = {"lumped", "consistent"};
constexpr std::string_view geometries[] = {"linear", "p_delta", "corotational"};
constexpr std::string_view everything[] = {"all"};
constexpr std::string_view no_supports[] = {"none"};

constexpr Key frame_keys[] = {
    {"dimension", integer(2, 3), otherwise("from the bays or the nodes, else 2"),
     "Number of dimensions: 2 in the plane (x, z), 3 in space (x, y, z); z is up.", "2"},
    {"origin", quantity(dimension::length).list(1, 3), otherwise("[0, 0]"),
     "Position of the frame: [x] or [x, z] in the plane, [x, y] or [x, y, z] in space. It is added to all coordinates "
     "and elevations.",
     "[12 m, 0 m]"},
    face_key,
    {"material", text().or_map(material), otherwise("none; each member then names a material"),
     "Material of all members that do not name one: a name from materials, a steel grade (S235, S275, S355, S420, "
     "S460, "
     "A36, A992) with its strength and density, or a map.",
     "{E: 30 GPa, poisson: 0.2, density: 2500 kg/m^3}"},
    {"materials", map(material).named(), optional, "Elastic materials and laws of fibres by name.",
     "{concrete: {E: 30 GPa}, steel: {E: 210 GPa}}"},
    {"sections", map(cross_section).named(), optional, "Cross-sections by name.",
     "{column: {rectangle: [0.5 m, 0.5 m]}}"},
    {"grid", map(grid), at_least_one, "Regular frame.",
     "{storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: "
     "{rectangle: [0.3 m, 0.5 m]}, floor_mass: 20 t}"},
    {"nodes", quantity(dimension::length).named_lists(2, 3), at_least_one,
     "Nodes by name: [x, z] in the plane, [x, y, z] in space, relative to the origin. Nodes of a grid are named S.I, "
     "in space S.I.K: S is the storey, 0 at the ground; I and K are the column lines along x and y, from 0.",
     "{a: [0, 0], b: [0, 3 m]}"},
    {"members", map(member).named(), optional,
     "Beams, columns and trusses by name. Members of a grid are named column S.I, beam x S.I, beam y S.I.K. The name "
     "columns refers to all columns of the grid, beams to all its beams, columns I to one column line (columns I.K in "
     "space). The entry of a single member replaces that of its group.",
     "{c1: {between: [a, b], section: {rectangle: [0.4 m, 0.4 m]}}}"},
    {"supports", choice(supports, "support").or_map(support).named().or_one_of(no_supports),
     otherwise("feet of a grid fixed"),
     "Supports by node; feet refers to all ground nodes of a grid. fixed restrains all degrees of freedom, pinned the "
     "translations, roller uz. none leaves the frame unsupported: it takes no loads, and a damping ratio applies to "
     "the first deformation mode.",
     "{a: fixed, d: {fix: [uz, ry], springs: {ux: 20 MN/m}}}"},
    {"floors", map(floor).list(), otherwise("floors of the grid"),
     "Floors from the ground up, in addition to or instead of the floors of a grid.",
     "[{nodes: [b, c], elevation: 3 m}]"},
    {"masses", quantity(dimension::mass, bounds::non_negative).or_map(node_masses).named(), optional,
     "Masses by node: one value for all translations, or a map of degrees of freedom.",
     "{b: 10 t, c: {ux: 10 t, ry: 5 t m^2}}"},
    {"loads", map(node_loads).named(), optional, "Constant forces by node; they act before and during the motion.",
     "{b: {uz: -10 kN}}"},
    {"springs", map(spring).list(), optional,
     "Springs and dashpots of zero length, from a node to the ground or between two nodes.",
     "[{node: b, dof: ux, stiffness: 1 MN/m}]"},
    {"ties", map(tie).list(), optional, "Rigid constraints: nodes that follow a master node.",
     "[{master: b, nodes: [c], dofs: [ux]}]"},
    {"mass", choice(mass_kinds, "mass of members"), otherwise("lumped"),
     "Mass matrix of members with a density: lumped has no rotational mass, consistent follows the shape functions. "
     "Columns that are hit between their ends require consistent.",
     "consistent"},
    {"gravity", boolean(), otherwise("true with loads or geometry: p_delta, else false"),
     "true applies the weights of all masses, including floor_mass. false omits them, for example if the loads already "
     "include them.",
     "true"},
    {"geometry", choice(geometries), otherwise("linear"),
     "Geometric nonlinearity: linear for none, p_delta with the axial forces at rest, corotational for large rotations "
     "of members.",
     "p_delta"},
    {"hinges", map(hinge).named(), otherwise("elastic members"),
     "Plastic hinges at the ends of members, by member, or for all beams or columns. Not available with geometry: "
     "corotational.",
     "{beams: {at: both, yield_moment: 210 kN m, hardening: 3 %}}", "0.2.0"},
    {"fibres", map(frame_fibres), otherwise("elastic members"),
     "Members whose sections of fibres yield along their length. Without this key such members are elastic, with the "
     "initial stiffness of their fibres.",
     "{rule: lobatto, points: 5, members: all}", "0.3.0"},
    {"devices", map(own_device).named(), optional,
     "Braces and dampers between two nodes, or between a node and the ground, by name.",
     "{brace: {between: [a, c], bilinear: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}}", "0.2.0"},
    {"report", map(report), otherwise("all nodes in frames of up to 100 nodes, no members"),
     "Nodes and members with time histories in the results.", "{nodes: all, members: [c1]}"},
    damping_key,
    velocity_key,
    displacement_key,
    {"initial_node_displacements", map(node_displacements).named(), otherwise("none"),
     "Displacements at time 0 by node, instead of by floor. All other degrees of freedom follow statically.",
     "{b: {ux: -5 mm}}", "0.2.0"},
};

constexpr Key grid_keys[] = {
    {"storeys", integer(1, 1000), required, "Number of storeys.", "5"},
    {"bays", integer(1, 1000).or_list(2), required, "Number of bays. In space: two numbers, along x and along y.", "3"},
    {"storey_height", quantity(dimension::length, bounds::positive).or_each(), required,
     "Storey height: one value for all storeys, or a list from the ground up.", "3.2 m"},
    {"bay_width", quantity(dimension::length, bounds::positive).or_map(bay_width).or_each(), required,
     "Bay width: one value for all bays, or a list from the left. In space also one value or list per direction.",
     "6 m"},
    {"columns", text().or_map(cross_section).by_storey(), required,
     "Cross-section of the columns: a name from sections, a standard steel section such as HEB400, or a map. It may "
     "vary by storey, {1-3: C60, 4-5: C50}, and "
     "by column line, {1-5: [C50, C60, C60, C50]}, from the left (in space along x, then along y).",
     "{rectangle: [0.4 m, 0.4 m]}"},
    {"beams", text().or_map(cross_section).by_storey(), required,
     "Cross-section of the beams: a name from sections, a standard steel section such as HEB400, or a map. It may vary "
     "by storey, where a storey includes the "
     "floor above it, and by bay from the left; in space by the column line at the first end of the beam.",
     "{rectangle: [0.3 m, 0.5 m]}"},
    {"floor_mass", quantity(dimension::mass, bounds::non_negative).or_each(), otherwise("0 t"),
     "Floor mass in addition to the mass of the members: one value for all floors, or a list from the ground up. It is "
     "distributed over the nodes of the floor and acts in all translations.",
     "60 t"},
    {"beams_load", quantity(dimension::stiffness).called("a force per length").by_storey(), otherwise("no load"),
     "Vertical load on the beams, before and during the motion; negative downwards. One value, or by storey and line "
     "like the sections of the beams. The weights of floor_mass act as well; gravity: false omits them if the load "
     "already contains them.",
     "-25 kN/m", "0.3.0"},
    {"dead_load", quantity(dimension::stiffness).called("a force per length").by_storey(), otherwise("no load"),
     "Vertical dead load on the beams, like beams_load, multiplied by its factor in combination.", "-20 kN/m", "0.3.0"},
    {"live_load", quantity(dimension::stiffness).called("a force per length").by_storey(), otherwise("no load"),
     "Vertical live load on the beams, like beams_load, multiplied by its factor in combination.", "-10 kN/m", "0.3.0"},
    {"combination", map(combination), otherwise("{dead: 1}; required with live_load"),
     "Factors of dead_load and live_load: the load on the beams is dead times dead_load plus live times live_load.",
     "{dead: 1, live: 0.3}", "0.3.0"},
    {"mass_from_loads", boolean(), otherwise("false"),
     "true adds the mass of the combined load on the beams, load times length over g, half at each end of a beam. Its "
     "weight is the load itself and does not act twice.",
     "true", "0.3.0"},
    {"rigid_floors", boolean(), otherwise("true in space, false in the plane"),
     "true makes the floors rigid in their plane.", "true"},
};

constexpr Key combination_keys[] = {
    {"dead", number(bounds::non_negative), otherwise("1"), "Factor of the dead load.", "1", "0.3.0"},
    {"live", number(bounds::non_negative), otherwise("none; required with live_load"), "Factor of the live load.",
     "0.3", "0.3.0"},
};

constexpr Key bay_width_keys[] = {
    {"x", quantity(dimension::length, bounds::positive).or_each(), required,
     "Bay width along x: one value, or a list in the order of the bays.", "6 m"},
    {"y", quantity(dimension::length, bounds::positive).or_each(), required,
     "Bay width along y: one value, or a list in the order of the bays.", "6 m"},
};

constexpr Key floor_keys[] = {
    {"nodes", text().nonempty_list(), required, "Nodes of the floor; the first one defines its elevation.", "[b, c]"},
    {"elevation", quantity(dimension::length), otherwise("elevation of the first node"),
     "Elevation of the floor above the origin. Floors are listed in ascending order.", "3 m"},
    {"rigid", boolean(), otherwise("true in space, false in the plane"), "true makes the floor rigid in its plane.",
     "true"},
    {"label", text(), otherwise("number of the floor, from the ground up"), "Name of the floor in the results.",
     "roof"},
};

constexpr Key report_keys[] = {
    {"nodes", text().list().or_one_of(everything), otherwise("all in frames of up to 100 nodes, else none"),
     "Nodes with time histories: a list of names, or all.", "all"},
    {"members", text().list().or_one_of(everything), otherwise("none"),
     "Members with time histories of end forces: a list of names, or all.", "[c1]"},
};

}  // namespace

constinit const Section frame{
    "frame", "structures.NAME.frame",
    "Beams and columns, in the plane or in space: a grid, lists of nodes and members, or both.", frame_keys};
constinit const Section grid{"grid", "structures.NAME.frame.grid", "Regular frame.", grid_keys};
constinit const Section bay_width{"bay_width", "structures.NAME.frame.grid.bay_width",
                                  "Bay widths of a frame in space.", bay_width_keys};
constinit const Section combination{"combination", "structures.NAME.frame.grid.combination",
                                    "Factors of the load cases on the beams.", combination_keys};
constinit const Section floor{"floors", "structures.NAME.frame.floors[]", "Floor of a frame.", floor_keys};
constinit const Section report{"report", "structures.NAME.frame.report",
                               "Nodes and members with time histories in the results.", report_keys};

}  // namespace pounding::keys
