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
    {.key = "dimension",
     .takes = Takes::integer,
     .bounds = {.low = 2, .high = 3},
     .otherwise = "as the bays or the nodes tell, else 2",
     .meaning = "2 for a frame in the plane (x, z), 3 for one in space (x, y, z); z is up.",
     .example = "2"},
    {.key = "origin",
     .takes = Takes::quantity,
     .form = Form::list,
     .minimum = 1,
     .maximum = 3,
     .dimension = dimension::length,
     .otherwise = "[0, 0]",
     .meaning = "Place of the frame: [x] or [x, z] in the plane, [x, y] or [x, y, z] in space. It is added to all "
                "coordinates and "
                "elevations.",
     .example = "[12 m, 0 m]"},
    face_key,
    {.key = "material",
     .takes = Takes::text,
     .inside = &material,
     .otherwise = "none: then every member names its own",
     .meaning = "Material of the members that name none: a name from materials, or a map.",
     .example = "{E: 30 GPa, poisson: 0.2, density: 2500 kg/m^3}"},
    {.key = "materials",
     .form = Form::named,
     .inside = &material,
     .meaning = "Materials by their names.",
     .example = "{concrete: {E: 30 GPa}, steel: {E: 210 GPa}}"},
    {.key = "sections",
     .form = Form::named,
     .inside = &cross_section,
     .meaning = "Cross-sections by their names.",
     .example = "{column: {rectangle: [0.5 m, 0.5 m]}}"},
    {.key = "grid",
     .inside = &grid,
     .need = Need::at_least_one,
     .meaning = "A regular frame.",
     .example =
         "{storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: "
         "{rectangle: [0.3 m, 0.5 m]}, floor_mass: 20 t}"},
    {.key = "nodes",
     .takes = Takes::quantity,
     .form = Form::named_lists,
     .minimum = 2,
     .maximum = 3,
     .dimension = dimension::length,
     .need = Need::at_least_one,
     .meaning = "Nodes by their names: [x, z] in the plane, [x, y, z] in space, from the origin. Nodes of a grid are "
                "called S.I, in "
                "space S.I.K: storey from 0 at the ground, column lines along x and along y from 0.",
     .example = "{a: [0, 0], b: [0, 3 m]}"},
    {.key = "members",
     .form = Form::named,
     .inside = &member,
     .meaning = "Beams, columns and trusses by their names. Members of a grid are called column S.I, beam x S.I, beam "
                "y S.I.K; "
                "columns are all of its columns, beams all of its beams, columns I one line of columns (columns I.K in "
                "space). A member that "
                "is named itself takes nothing from these.",
     .example = "{c1: {between: [a, b], section: {rectangle: [0.4 m, 0.4 m]}}}"},
    {.key = "supports",
     .takes = Takes::choice,
     .form = Form::named,
     .inside = &support,
     .choices = supports,
     .instead = no_supports,
     .noun = "support",
     .otherwise = "the feet of a grid are fixed",
     .meaning = "Supports by the names of their nodes; feet are all nodes of a grid on the ground. fixed holds every "
                "displacement, "
                "pinned the translations, roller uz. none leaves the frame free in space: it takes no loads, and a "
                "damping ratio is "
                "that of the first mode that bends it.",
     .example = "{a: fixed, d: {fix: [uz, ry], springs: {ux: 20 MN/m}}}"},
    {.key = "floors",
     .form = Form::list,
     .inside = &floor,
     .otherwise = "those of the grid",
     .meaning = "Floors from the ground up, beside or instead of those of a grid.",
     .example = "[{nodes: [b, c], elevation: 3 m}]"},
    {.key = "masses",
     .takes = Takes::quantity,
     .form = Form::named,
     .inside = &node_masses,
     .dimension = dimension::mass,
     .bounds = bounds::non_negative,
     .meaning = "Masses by the names of their nodes: one for every translation, or a map of displacements.",
     .example = "{b: 10 t, c: {ux: 10 t, ry: 5 t m^2}}"},
    {.key = "loads",
     .form = Form::named,
     .inside = &node_loads,
     .meaning = "Forces on nodes, by the names of the nodes, that act before and during the motion.",
     .example = "{b: {uz: -10 kN}}"},
    {.key = "springs",
     .form = Form::list,
     .inside = &spring,
     .meaning = "Springs and dashpots without length, from a node to the ground or between two nodes.",
     .example = "[{node: b, dof: ux, stiffness: 1 MN/m}]"},
    {.key = "ties",
     .form = Form::list,
     .inside = &tie,
     .meaning = "Nodes that move with a master, exactly.",
     .example = "[{master: b, nodes: [c], dofs: [ux]}]"},
    {.key = "mass",
     .takes = Takes::choice,
     .choices = mass_kinds,
     .noun = "mass of members",
     .otherwise = "lumped",
     .meaning = "Mass matrix of the members with a density: lumped leaves rotations without mass, consistent follows "
                "the shape "
                "functions. Columns that are hit between their ends need consistent.",
     .example = "consistent"},
    {.key = "gravity",
     .takes = Takes::boolean,
     .otherwise = "true beside loads or geometry: p_delta, else false",
     .meaning = "true lets the weights of all masses act, downwards, floor_mass among them; false leaves them out, as "
                "where loads hold them already.",
     .example = "true"},
    {.key = "geometry",
     .takes = Takes::choice,
     .choices = geometries,
     .otherwise = "linear",
     .meaning = "linear; p_delta with the axial forces at rest; corotational for members that turn by large angles.",
     .example = "p_delta"},
    {.key = "hinges",
     .form = Form::named,
     .inside = &hinge,
     .otherwise = "no end of a member yields",
     .since = "0.2.0",
     .meaning = "Ends of members that yield in bending, by the names of the members, or of all beams or columns. "
                "Members in large rotations "
                "(geometry: corotational) take none.",
     .example = "{beams: {at: both, yield_moment: 210 kN m, hardening: 3 %}}"},
    {.key = "devices",
     .form = Form::named,
     .inside = &own_device,
     .since = "0.2.0",
     .meaning = "Braces and dampers between two nodes, or a node and the ground, by their names.",
     .example = "{brace: {between: [a, c], bilinear: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}}"},
    {.key = "report",
     .inside = &report,
     .otherwise = "all nodes of a frame of up to 100, and no members",
     .meaning = "Nodes and members whose histories stand in the results.",
     .example = "{nodes: all, members: [c1]}"},
    damping_key,
    velocity_key,
    displacement_key,
    {.key = "initial_node_displacements",
     .form = Form::named,
     .inside = &node_displacements,
     .otherwise = "none",
     .since = "0.2.0",
     .meaning = "Displacements at time 0 of nodes by their names, instead of floors; all else follows as if forces "
                "held the nodes there.",
     .example = "{b: {ux: -5 mm}}"}};

constexpr Key grid_keys[] = {
    {.key = "storeys",
     .takes = Takes::integer,
     .bounds = {.low = 1, .high = 1000},
     .need = Need::required,
     .meaning = "Number of storeys.",
     .example = "5"},
    {.key = "bays",
     .takes = Takes::integer,
     .form = Form::one_or_list,
     .minimum = 2,
     .maximum = 2,
     .bounds = {.low = 1, .high = 1000},
     .need = Need::required,
     .meaning = "Number of bays; in space the two numbers along x and along y, which make the frame one in space.",
     .example = "3"},
    {.key = "storey_height",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .need = Need::required,
     .meaning = "Height of a storey: one for all storeys, or a list from the ground up.",
     .example = "3.2 m"},
    {.key = "bay_width",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .inside = &bay_width,
     .dimension = dimension::length,
     .bounds = bounds::positive,
     .need = Need::required,
     .meaning =
         "Width of a bay: one for all bays, or a list from the left; in space also one or a list for each direction.",
     .example = "6 m"},
    {.key = "columns",
     .takes = Takes::text,
     .form = Form::by_storey,
     .inside = &cross_section,
     .need = Need::required,
     .meaning = "Section of the columns: a name from sections, or a map. It may change with the storey, {1-3: C60, "
                "4-5: C50}, and with "
                "the line of columns, {1-5: [C50, C60, C60, C50]} from the left (in space along x, then along y).",
     .example = "{rectangle: [0.4 m, 0.4 m]}"},
    {.key = "beams",
     .takes = Takes::text,
     .form = Form::by_storey,
     .inside = &cross_section,
     .need = Need::required,
     .meaning = "Section of the beams: a name from sections, or a map. It may change with the storey whose floor they "
                "carry, and with the "
                "bay from the left; in space with the line of columns at their first end.",
     .example = "{rectangle: [0.3 m, 0.5 m]}"},
    {.key = "floor_mass",
     .takes = Takes::quantity,
     .form = Form::one_or_each,
     .dimension = dimension::mass,
     .bounds = bounds::non_negative,
     .otherwise = "0 t",
     .meaning = "Mass of a floor beside that of its members: one for all floors, or a list from the ground up. The "
                "nodes of the "
                "floor share it, in every translation.",
     .example = "60 t"},
    {.key = "rigid_floors",
     .takes = Takes::boolean,
     .otherwise = "true in space, false in the plane",
     .meaning = "Whether the floors are rigid in their own plane.",
     .example = "true"}};

constexpr Key bay_width_keys[] = {{.key = "x",
                                   .takes = Takes::quantity,
                                   .form = Form::one_or_each,
                                   .dimension = dimension::length,
                                   .bounds = bounds::positive,
                                   .need = Need::required,
                                   .meaning = "Width of a bay along x: one, or a list in the order of the bays.",
                                   .example = "6 m"},
                                  {.key = "y",
                                   .takes = Takes::quantity,
                                   .form = Form::one_or_each,
                                   .dimension = dimension::length,
                                   .bounds = bounds::positive,
                                   .need = Need::required,
                                   .meaning = "Width of a bay along y: one, or a list in the order of the bays.",
                                   .example = "6 m"}};

constexpr Key floor_keys[] = {
    {.key = "nodes",
     .takes = Takes::text,
     .form = Form::list,
     .minimum = 1,
     .need = Need::required,
     .meaning = "Nodes of the floor; the first one gives the elevation.",
     .example = "[b, c]"},
    {.key = "elevation",
     .takes = Takes::quantity,
     .dimension = dimension::length,
     .otherwise = "that of the first node",
     .meaning = "Elevation of the floor above the origin; each floor is above the one before.",
     .example = "3 m"},
    {.key = "rigid",
     .takes = Takes::boolean,
     .otherwise = "true in space, false in the plane",
     .meaning = "Whether the floor is rigid in its own plane.",
     .example = "true"},
    {.key = "label",
     .takes = Takes::text,
     .otherwise = "its number from the ground up",
     .meaning = "Name of the floor in the results.",
     .example = "roof"}};

constexpr Key report_keys[] = {{.key = "nodes",
                                .takes = Takes::text,
                                .form = Form::list,
                                .instead = everything,
                                .otherwise = "all of a frame of up to 100 nodes, else none",
                                .meaning = "Nodes with histories: a list of names, or all.",
                                .example = "all"},
                               {.key = "members",
                                .takes = Takes::text,
                                .form = Form::list,
                                .instead = everything,
                                .otherwise = "none",
                                .meaning = "Members with histories of their end forces: a list of names, or all.",
                                .example = "[c1]"}};

}  // namespace

constinit const Section frame{
    .name = "frame",
    .place = "structures.NAME.frame",
    .meaning = "Beams and columns, in the plane or in space: a grid, lists, or a grid with lists that add to it.",
    .keys = frame_keys};
constinit const Section grid{
    .name = "grid", .place = "structures.NAME.frame.grid", .meaning = "A regular frame.", .keys = grid_keys};
constinit const Section bay_width{.name = "bay_width",
                                  .place = "structures.NAME.frame.grid.bay_width",
                                  .meaning = "Widths of the bays of a frame in space.",
                                  .keys = bay_width_keys};
constinit const Section floor{.name = "floors",
                              .place = "structures.NAME.frame.floors[]",
                              .meaning = "One floor of a frame.",
                              .keys = floor_keys};
constinit const Section report{.name = "report",
                               .place = "structures.NAME.frame.report",
                               .meaning = "Nodes and members whose histories stand in the results.",
                               .keys = report_keys};

}  // namespace pounding::keys
