#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr Key material_keys[] = {
    {"E", quantity(dimension::stress, bounds::positive), required, "Young's modulus.", "30 GPa"},
    {"G", quantity(dimension::stress, bounds::positive), otherwise("E/(2 (1 + poisson))"),
     "Shear modulus. Give G or poisson.", "12.5 GPa"},
    {"poisson", number(0, 0.5), otherwise("0.2"), "Poisson's ratio. Give G or poisson.", "0.2"},
    {"density", quantity(dimension::density, bounds::non_negative), otherwise("0 kg/m^3"),
     "Density, which gives the members their mass.", "2500 kg/m^3"},
};

constexpr Key cross_section_keys[] = {
    {"rectangle", quantity(dimension::length, bounds::positive).list(2), exactly_one,
     "[width, depth]: along local y and along local z, which is vertical in a beam.", "[0.4 m, 0.6 m]"},
    {"i_section", map(i_section), exactly_one, "A doubly symmetric I of three rectangles.",
     "{depth: 300 mm, width: 150 mm, flange: 10.7 mm, web: 7.1 mm}"},
    {"tube", map(tube), exactly_one, "A round tube.", "{diameter: 0.5 m, thickness: 10 mm}"},
    {"circle", quantity(dimension::length, bounds::positive), exactly_one, "Diameter of a solid circle.", "0.6 m"},
    {"area", quantity(dimension::area, bounds::positive), exactly_one,
     "Area of a section that is given by numbers, with inertia_y; in space also inertia_z and torsion.", "0.16 m^2"},
    {"inertia_y", quantity(dimension::second_moment, bounds::positive), otherwise("that of the shape"),
     "Second moment of area for bending about local y, the one of a plane frame.", "2.1e-3 m^4"},
    {"inertia_z", quantity(dimension::second_moment, bounds::positive), otherwise("that of the shape"),
     "Second moment of area for bending about local z.", "2.1e-3 m^4"},
    {"torsion", quantity(dimension::second_moment, bounds::positive), otherwise("that of the shape"),
     "St Venant's torsion constant.", "3.6e-3 m^4"},
    {"shear_area_y", quantity(dimension::area, bounds::positive),
     otherwise("that of the shape; of numbers no shear deformation"), "Shear area for shear along local y.",
     "0.13 m^2"},
    {"shear_area_z", quantity(dimension::area, bounds::positive),
     otherwise("that of the shape; of numbers no shear deformation"), "Shear area for shear along local z.",
     "0.13 m^2"},
    {"shear", boolean(), otherwise("true where there are shear areas"), "false leaves shear deformation out.", "false"},
    {"stiffness", number(bounds::positive), otherwise("1"),
     "Factor on both inertias, as for cracked concrete; area, torsion and shear areas stay.", "0.5"},
};

constexpr Key i_section_keys[] = {
    {"depth", quantity(dimension::length, bounds::positive), required, "Depth over the flanges, along local z.",
     "300 mm"},
    {"width", quantity(dimension::length, bounds::positive), required, "Width of the flanges, along local y.",
     "150 mm"},
    {"flange", quantity(dimension::length, bounds::positive), required, "Thickness of a flange.", "10.7 mm"},
    {"web", quantity(dimension::length, bounds::positive), required, "Thickness of the web.", "7.1 mm"},
};

constexpr Key tube_keys[] = {
    {"diameter", quantity(dimension::length, bounds::positive), required, "Outside diameter.", "0.5 m"},
    {"thickness", quantity(dimension::length, bounds::positive), required, "Thickness of the wall.", "10 mm"},
};

constexpr Key member_keys[] = {
    {"between", text().list(2), otherwise("the two of the grid, where the name is that of one of its members"),
     "Start node and end node. Local x goes from start to end.", "[a, b]"},
    {"section", text().or_map(cross_section), otherwise("that of the grid, for one of its members"),
     "Cross-section of a beam: a name from sections, or a map. A member has a section or is a truss.",
     "{rectangle: [0.4 m, 0.6 m]}"},
    {"truss", quantity(dimension::area, bounds::positive), otherwise("a beam"),
     "Area of a member that carries axial force only.", "20 cm^2"},
    {"material", text().or_map(material), otherwise("that of the frame"), "Material: a name from materials, or a map.",
     "{E: 210 GPa}"},
    {"releases", map(releases), otherwise("both ends transmit everything"),
     "Displacements whose forces an end does not transmit, in the axes of the member.", "{start: [ry]}"},
    {"offsets", map(offsets), otherwise("the ends are at the nodes"),
     "Rigid arms from the nodes to the ends of the member, in global axes.", "{start: [0, 0.3 m]}"},
    {"load", quantity(dimension::stiffness).called("a force per length").list(2, 3), otherwise("no load"),
     "Force per length that acts before and during the motion, in global axes: [x, z] in the plane, [x, y, z] in "
     "space; z is up.",
     "[0, -10 kN/m]"},
    {"parts", integer(1, 100), otherwise("1"),
     "Equal parts into which the member is cut, with nodes between them: it bows there, and a contact can hit the "
     "nodes. The parts of c1 are c1/1, c1/2 ... from the start on, the nodes between them likewise.",
     "3", "0.2.0"},
    {"reference", number().list(3), otherwise("[0, 0, 1]; of vertical members [-1, 0, 0]"),
     "Vector to which local z leans, in space: local y is reference x local x.", "[0, 1, 0]"},
};

constexpr Key releases_keys[] = {
    {"start", choice(displacements, "displacement").list(), otherwise("none"),
     "Of the start: ry is a hinge in the plane.", "[ry]"},
    {"end", choice(displacements, "displacement").list(), otherwise("none"), "Of the end: ry is a hinge in the plane.",
     "[ry]"},
};

constexpr Key offsets_keys[] = {
    {"start", quantity(dimension::length).list(2, 3), otherwise("none"),
     "From the start node to the start of the member: [x, z] in the plane, [x, y, z] in space.", "[0, 0.3 m]"},
    {"end", quantity(dimension::length).list(2, 3), otherwise("none"),
     "From the end node to the end of the member: [x, z] in the plane, [x, y, z] in space.", "[0, -0.3 m]"},
};

}  // namespace

constinit const Section material{"materials", "structures.NAME.frame.materials.NAME",
                                 "A linear elastic material; also of frame.material and of a member.", material_keys};
constinit const Section cross_section{"sections", "structures.NAME.frame.sections.NAME",
                                      "A cross-section; also of grid.columns, grid.beams and of a member.",
                                      cross_section_keys};
constinit const Section i_section{"i_section", "structures.NAME.frame.sections.NAME.i_section",
                                  "A doubly symmetric I of three rectangles without fillets.", i_section_keys};
constinit const Section tube{"tube", "structures.NAME.frame.sections.NAME.tube", "A round tube.", tube_keys};
constinit const Section member{"members", "structures.NAME.frame.members.NAME", "One beam, column or truss.",
                               member_keys};
constinit const Section releases{"releases", "structures.NAME.frame.members.NAME.releases",
                                 "Displacements whose forces an end does not transmit, in the axes of the member.",
                                 releases_keys};
constinit const Section offsets{"offsets", "structures.NAME.frame.members.NAME.offsets",
                                "Rigid arms from the nodes to the ends of the member, in global axes.", offsets_keys};

}  // namespace pounding::keys
