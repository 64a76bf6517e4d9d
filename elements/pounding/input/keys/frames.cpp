#include <pounding/input/keys/devices.hpp>
#include <pounding/input/keys/hinges.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view mass_kinds[] = {"lumped", "consistent"};
constexpr std::string_view geometries[] = {"linear", "p_delta", "corotational"};
constexpr std::string_view everything[] = {"all"};
constexpr std::string_view no_supports[] = {"none"};

constexpr Key frame_keys[] = {
    {"dimension", integer(2, 3), otherwise("as the bays or the nodes tell, else 2"),
     "2 for a frame in the plane (x, z), 3 for one in space (x, y, z); z is up.", "2"},
    {"origin", quantity(dimension::length).list(1, 3), otherwise("[0, 0]"),
     "Place of the frame: [x] or [x, z] in the plane, [x, y] or [x, y, z] in space. It is added to all coordinates and "
     "elevations.",
     "[12 m, 0 m]"},
    face_key,
    {"material", text().or_map(material), otherwise("none: then every member names its own"),
     "Material of the members that name none: a name from materials, or a map.",
     "{E: 30 GPa, poisson: 0.2, density: 2500 kg/m^3}"},
    {"materials", map(material).named(), optional, "Materials by their names.",
     "{concrete: {E: 30 GPa}, steel: {E: 210 GPa}}"},
    {"sections", map(cross_section).named(), optional, "Cross-sections by their names.",
     "{column: {rectangle: [0.5 m, 0.5 m]}}"},
    {"grid", map(grid), at_least_one, "A regular frame.",
     "{storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: "
     "{rectangle: [0.3 m, 0.5 m]}, floor_mass: 20 t}"},
    {"nodes", quantity(dimension::length).named_lists(2, 3), at_least_one,
     "Nodes by their names: [x, z] in the plane, [x, y, z] in space, from the origin. Nodes of a grid are called S.I, "
     "in space S.I.K: storey from 0 at the ground, column lines along x and along y from 0.",
     "{a: [0, 0], b: [0, 3 m]}"},
    {"members", map(member).named(), optional,
     "Beams, columns and trusses by their names. Members of a grid are called column S.I, beam x S.I, beam y S.I.K; "
     "columns are all of its columns, beams all of its beams, columns I one line of columns (columns I.K in space). A "
     "member that is named itself takes nothing from these.",
     "{c1: {between: [a, b], section: {rectangle: [0.4 m, 0.4 m]}}}"},
    {"supports", choice(supports, "support").or_map(support).named().or_one_of(no_supports),
     otherwise("the feet of a grid are fixed"),
     "Supports by the names of their nodes; feet are all nodes of a grid on the ground. fixed holds every "
     "displacement, pinned the translations, roller uz. none leaves the frame free in space: it takes no loads, and a "
     "damping ratio is that of the first mode that bends it.",
     "{a: fixed, d: {fix: [uz, ry], springs: {ux: 20 MN/m}}}"},
    {"floors", map(floor).list(), otherwise("those of the grid"),
     "Floors from the ground up, beside or instead of those of a grid.", "[{nodes: [b, c], elevation: 3 m}]"},
    {"masses", quantity(dimension::mass, bounds::non_negative).or_map(node_masses).named(), optional,
     "Masses by the names of their nodes: one for every translation, or a map of displacements.",
     "{b: 10 t, c: {ux: 10 t, ry: 5 t m^2}}"},
    {"loads", map(node_loads).named(), optional,
     "Forces on nodes, by the names of the nodes, that act before and during the motion.", "{b: {uz: -10 kN}}"},
    {"springs", map(spring).list(), optional,
     "Springs and dashpots without length, from a node to the ground or between two nodes.",
     "[{node: b, dof: ux, stiffness: 1 MN/m}]"},
    {"ties", map(tie).list(), optional, "Nodes that move with a master, exactly.",
     "[{master: b, nodes: [c], dofs: [ux]}]"},
    {"mass", choice(mass_kinds, "mass of members"), otherwise("lumped"),
     "Mass matrix of the members with a density: lumped leaves rotations without mass, consistent follows the shape "
     "functions. Columns that are hit between their ends need consistent.",
     "consistent"},
    {"gravity", boolean(), otherwise("true beside loads or geometry: p_delta, else false"),
     "true lets the weights of all masses act, downwards, floor_mass among them; false leaves them out, as where loads "
     "hold them already.",
     "true"},
    {"geometry", choice(geometries), otherwise("linear"),
     "linear; p_delta with the axial forces at rest; corotational for members that turn by large angles.", "p_delta"},
    {"hinges", map(hinge).named(), otherwise("no end of a member yields"),
     "Ends of members that yield in bending, by the names of the members, or of all beams or columns. Members in large "
     "rotations (geometry: corotational) take none.",
     "{beams: {at: both, yield_moment: 210 kN m, hardening: 3 %}}", "0.2.0"},
    {"devices", map(own_device).named(), optional,
     "Braces and dampers between two nodes, or a node and the ground, by their names.",
     "{brace: {between: [a, c], bilinear: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}}", "0.2.0"},
    {"report", map(report), otherwise("all nodes of a frame of up to 100, and no members"),
     "Nodes and members whose histories stand in the results.", "{nodes: all, members: [c1]}"},
    damping_key,
    velocity_key,
    displacement_key,
    {"initial_node_displacements", map(node_displacements).named(), otherwise("none"),
     "Displacements at time 0 of nodes by their names, instead of floors; all else follows as if forces held the nodes "
     "there.",
     "{b: {ux: -5 mm}}", "0.2.0"},
};

constexpr Key grid_keys[] = {
    {"storeys", integer(1, 1000), required, "Number of storeys.", "5"},
    {"bays", integer(1, 1000).or_list(2), required,
     "Number of bays; in space the two numbers along x and along y, which make the frame one in space.", "3"},
    {"storey_height", quantity(dimension::length, bounds::positive).or_each(), required,
     "Height of a storey: one for all storeys, or a list from the ground up.", "3.2 m"},
    {"bay_width", quantity(dimension::length, bounds::positive).or_map(bay_width).or_each(), required,
     "Width of a bay: one for all bays, or a list from the left; in space also one or a list for each direction.",
     "6 m"},
    {"columns", text().or_map(cross_section).by_storey(), required,
     "Section of the columns: a name from sections, or a map. It may change with the storey, {1-3: C60, 4-5: C50}, and "
     "with the line of columns, {1-5: [C50, C60, C60, C50]} from the left (in space along x, then along y).",
     "{rectangle: [0.4 m, 0.4 m]}"},
    {"beams", text().or_map(cross_section).by_storey(), required,
     "Section of the beams: a name from sections, or a map. It may change with the storey whose floor they carry, and "
     "with the bay from the left; in space with the line of columns at their first end.",
     "{rectangle: [0.3 m, 0.5 m]}"},
    {"floor_mass", quantity(dimension::mass, bounds::non_negative).or_each(), otherwise("0 t"),
     "Mass of a floor beside that of its members: one for all floors, or a list from the ground up. The nodes of the "
     "floor share it, in every translation.",
     "60 t"},
    {"rigid_floors", boolean(), otherwise("true in space, false in the plane"),
     "Whether the floors are rigid in their own plane.", "true"},
};

constexpr Key bay_width_keys[] = {
    {"x", quantity(dimension::length, bounds::positive).or_each(), required,
     "Width of a bay along x: one, or a list in the order of the bays.", "6 m"},
    {"y", quantity(dimension::length, bounds::positive).or_each(), required,
     "Width of a bay along y: one, or a list in the order of the bays.", "6 m"},
};

constexpr Key floor_keys[] = {
    {"nodes", text().nonempty_list(), required, "Nodes of the floor; the first one gives the elevation.", "[b, c]"},
    {"elevation", quantity(dimension::length), otherwise("that of the first node"),
     "Elevation of the floor above the origin; each floor is above the one before.", "3 m"},
    {"rigid", boolean(), otherwise("true in space, false in the plane"), "Whether the floor is rigid in its own plane.",
     "true"},
    {"label", text(), otherwise("its number from the ground up"), "Name of the floor in the results.", "roof"},
};

constexpr Key report_keys[] = {
    {"nodes", text().list().or_one_of(everything), otherwise("all of a frame of up to 100 nodes, else none"),
     "Nodes with histories: a list of names, or all.", "all"},
    {"members", text().list().or_one_of(everything), otherwise("none"),
     "Members with histories of their end forces: a list of names, or all.", "[c1]"},
};

}  // namespace

constinit const Section frame{
    "frame", "structures.NAME.frame",
    "Beams and columns, in the plane or in space: a grid, lists, or a grid with lists that add to it.", frame_keys};
constinit const Section grid{"grid", "structures.NAME.frame.grid", "A regular frame.", grid_keys};
constinit const Section bay_width{"bay_width", "structures.NAME.frame.grid.bay_width",
                                  "Widths of the bays of a frame in space.", bay_width_keys};
constinit const Section floor{"floors", "structures.NAME.frame.floors[]", "One floor of a frame.", floor_keys};
constinit const Section report{"report", "structures.NAME.frame.report",
                               "Nodes and members whose histories stand in the results.", report_keys};

}  // namespace pounding::keys
