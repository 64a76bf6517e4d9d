#include <pounding/input/words/sections.hpp>
#include <pounding/input/words/shared.hpp>

namespace pounding::words {
namespace {

constexpr Word material_words[] = {
    {.key = "E", .takes = Takes::quantity, .dimension = dimension::stress, .bounds = bounds::positive, .need = Need::required,
     .meaning = "Young's modulus.", .example = "30 GPa"},
    {.key = "G", .takes = Takes::quantity, .dimension = dimension::stress, .bounds = bounds::positive,
     .otherwise = "E/(2 (1 + poisson))", .meaning = "Shear modulus. Give G or poisson.", .example = "12.5 GPa"},
    {.key = "poisson", .takes = Takes::quantity, .bounds = {.low = 0, .high = 0.5}, .otherwise = "0.2",
     .meaning = "Poisson's ratio. Give G or poisson.", .example = "0.2"},
    {.key = "density", .takes = Takes::quantity, .dimension = dimension::density, .bounds = bounds::non_negative,
     .otherwise = "0 kg/m^3", .meaning = "Density, which gives the members their mass.", .example = "2500 kg/m^3"}};

constexpr Word cross_section_words[] = {
    {.key = "rectangle", .takes = Takes::quantity, .form = Form::list, .least = 2, .most = 2, .dimension = dimension::length,
     .bounds = bounds::positive, .need = Need::exactly_one,
     .meaning = "[width, depth]: along local y and along local z, which is vertical in a beam.", .example = "[0.4 m, 0.6 m]"},
    {.key = "i_section", .inside = &i_section, .need = Need::exactly_one, .meaning = "A doubly symmetric I of three rectangles.",
     .example = "{depth: 300 mm, width: 150 mm, flange: 10.7 mm, web: 7.1 mm}"},
    {.key = "tube", .inside = &tube, .need = Need::exactly_one, .meaning = "A round tube.",
     .example = "{diameter: 0.5 m, thickness: 10 mm}"},
    {.key = "circle", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive,
     .need = Need::exactly_one, .meaning = "Diameter of a solid circle.", .example = "0.6 m"},
    {.key = "area", .takes = Takes::quantity, .dimension = dimension::area, .bounds = bounds::positive, .need = Need::exactly_one,
     .meaning = "Area of a section that is given by numbers, with inertia_y; in space also inertia_z and torsion.",
     .example = "0.16 m^2"},
    {.key = "inertia_y", .takes = Takes::quantity, .dimension = dimension::second_moment, .bounds = bounds::positive,
     .otherwise = "that of the shape", .meaning = "Second moment of area for bending about local y, the one of a plane frame.",
     .example = "2.1e-3 m^4"},
    {.key = "inertia_z", .takes = Takes::quantity, .dimension = dimension::second_moment, .bounds = bounds::positive,
     .otherwise = "that of the shape", .meaning = "Second moment of area for bending about local z.", .example = "2.1e-3 m^4"},
    {.key = "torsion", .takes = Takes::quantity, .dimension = dimension::second_moment, .bounds = bounds::positive,
     .otherwise = "that of the shape", .meaning = "St Venant's torsion constant.", .example = "3.6e-3 m^4"},
    {.key = "shear_area_y", .takes = Takes::quantity, .dimension = dimension::area, .bounds = bounds::positive,
     .otherwise = "that of the shape; of numbers no shear deformation", .meaning = "Shear area for shear along local y.",
     .example = "0.13 m^2"},
    {.key = "shear_area_z", .takes = Takes::quantity, .dimension = dimension::area, .bounds = bounds::positive,
     .otherwise = "that of the shape; of numbers no shear deformation", .meaning = "Shear area for shear along local z.",
     .example = "0.13 m^2"},
    {.key = "shear", .takes = Takes::boolean, .otherwise = "true where there are shear areas",
     .meaning = "false leaves shear deformation out.", .example = "false"},
    {.key = "stiffness", .takes = Takes::quantity, .bounds = bounds::positive, .otherwise = "1",
     .meaning = "Factor on both inertias, as for cracked concrete; area, torsion and shear areas stay.", .example = "0.5"}};

constexpr Word i_section_words[] = {
    {.key = "depth", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive, .need = Need::required,
     .meaning = "Depth over the flanges, along local z.", .example = "300 mm"},
    {.key = "width", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive, .need = Need::required,
     .meaning = "Width of the flanges, along local y.", .example = "150 mm"},
    {.key = "flange", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive, .need = Need::required,
     .meaning = "Thickness of a flange.", .example = "10.7 mm"},
    {.key = "web", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive, .need = Need::required,
     .meaning = "Thickness of the web.", .example = "7.1 mm"}};

constexpr Word tube_words[] = {
    {.key = "diameter", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Outside diameter.", .example = "0.5 m"},
    {.key = "thickness", .takes = Takes::quantity, .dimension = dimension::length, .bounds = bounds::positive,
     .need = Need::required, .meaning = "Thickness of the wall.", .example = "10 mm"}};

constexpr Word member_words[] = {
    {.key = "between", .takes = Takes::text, .form = Form::list, .least = 2, .most = 2,
     .otherwise = "the two of the grid, where the name is that of one of its members",
     .meaning = "Start node and end node. Local x goes from start to end.", .example = "[a, b]"},
    {.key = "section", .takes = Takes::text, .inside = &cross_section, .otherwise = "that of the grid, for one of its members",
     .meaning = "Cross-section of a beam: a name from sections, or a map. A member has a section or is a truss.", .example = "{rectangle: [0.4 m, 0.6 m]}"},
    {.key = "truss", .takes = Takes::quantity, .dimension = dimension::area, .bounds = bounds::positive,
     .otherwise = "a beam", .meaning = "Area of a member that carries axial force only.", .example = "20 cm^2"},
    {.key = "material", .takes = Takes::text, .inside = &material, .otherwise = "that of the frame",
     .meaning = "Material: a name from materials, or a map.", .example = "{E: 210 GPa}"},
    {.key = "releases", .inside = &releases, .otherwise = "both ends transmit everything",
     .meaning = "Displacements whose forces an end does not transmit, in the axes of the member.", .example = "{start: [ry]}"},
    {.key = "offsets", .inside = &offsets, .otherwise = "the ends are at the nodes",
     .meaning = "Rigid arms from the nodes to the ends of the member, in global axes.", .example = "{start: [0, 0.3 m]}"},
    {.key = "load", .takes = Takes::quantity, .form = Form::list, .least = 2, .most = 3, .dimension = dimension::stiffness,
     .noun = "a force per length", .otherwise = "no load",
     .meaning = "Force per length that acts before and during the motion, in global axes: [x, z] in the plane, [x, y, z] in "
                "space; z is up.",
     .example = "[0, -10 kN/m]"},
    {.key = "parts", .takes = Takes::integer, .bounds = {.low = 1, .high = 100}, .otherwise = "1", .since = "0.2.0",
     .meaning = "Equal parts into which the member is cut, with nodes between them: it bows there, and a contact can hit the nodes. The "
                "parts of c1 are c1/1, c1/2 ... from the start on, the nodes between them likewise.",
     .example = "3"},
    {.key = "reference", .takes = Takes::quantity, .form = Form::list, .least = 3, .most = 3,
     .otherwise = "[0, 0, 1]; of vertical members [-1, 0, 0]",
     .meaning = "Vector to which local z leans, in space: local y is reference x local x.", .example = "[0, 1, 0]"}};

constexpr Word releases_words[] = {
    {.key = "start", .takes = Takes::choice, .form = Form::list, .choices = displacements, .noun = "displacement",
     .otherwise = "none", .meaning = "Of the start: ry is a hinge in the plane.", .example = "[ry]"},
    {.key = "end", .takes = Takes::choice, .form = Form::list, .choices = displacements, .noun = "displacement",
     .otherwise = "none", .meaning = "Of the end: ry is a hinge in the plane.", .example = "[ry]"}};

constexpr Word offsets_words[] = {
    {.key = "start", .takes = Takes::quantity, .form = Form::list, .least = 2, .most = 3, .dimension = dimension::length,
     .otherwise = "none", .meaning = "From the start node to the start of the member: [x, z] in the plane, [x, y, z] in space.",
     .example = "[0, 0.3 m]"},
    {.key = "end", .takes = Takes::quantity, .form = Form::list, .least = 2, .most = 3, .dimension = dimension::length,
     .otherwise = "none", .meaning = "From the end node to the end of the member: [x, z] in the plane, [x, y, z] in space.",
     .example = "[0, -0.3 m]"}};

}  // namespace

constinit const Section material{.name = "materials", .place = "structures.NAME.frame.materials.NAME",
                                 .meaning = "A linear elastic material; also of frame.material and of a member.",
                                 .words = material_words};
constinit const Section cross_section{.name = "sections", .place = "structures.NAME.frame.sections.NAME",
                                      .meaning = "A cross-section; also of grid.columns, grid.beams and of a member.",
                                      .words = cross_section_words};
constinit const Section i_section{.name = "i_section", .place = "structures.NAME.frame.sections.NAME.i_section",
                                  .meaning = "A doubly symmetric I of three rectangles without fillets.", .words = i_section_words};
constinit const Section tube{.name = "tube", .place = "structures.NAME.frame.sections.NAME.tube", .meaning = "A round tube.",
                             .words = tube_words};
constinit const Section member{.name = "members", .place = "structures.NAME.frame.members.NAME",
                               .meaning = "One beam, column or truss.", .words = member_words};
constinit const Section releases{.name = "releases", .place = "structures.NAME.frame.members.NAME.releases",
                                 .meaning = "Displacements whose forces an end does not transmit, in the axes of the member.",
                                 .words = releases_words};
constinit const Section offsets{.name = "offsets", .place = "structures.NAME.frame.members.NAME.offsets",
                                .meaning = "Rigid arms from the nodes to the ends of the member, in global axes.",
                                .words = offsets_words};

}  // namespace pounding::words
