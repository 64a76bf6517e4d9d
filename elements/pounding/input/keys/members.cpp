#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view section_axes[] = {"strong", "weak"};

constexpr Key material_keys[] = {
    {"E", quantity(dimension::stress, bounds::positive), required, "Young's modulus.", "30 GPa"},
    {"G", quantity(dimension::stress, bounds::positive), otherwise("E/(2 (1 + poisson))"),
     "Shear modulus. Give G or poisson, not both.", "12.5 GPa"},
    {"poisson", number(0, 0.5), otherwise("0.2"), "Poisson's ratio. Give G or poisson, not both.", "0.2"},
    {"density", quantity(dimension::density, bounds::non_negative), otherwise("0 kg/m^3"),
     "Density, from which the mass of members follows.", "2500 kg/m^3"},
    {"strength", quantity(dimension::stress, bounds::positive), otherwise("none"),
     "Yield strength of steel, for hinges with strength: material.", "355 MPa", "0.3.0"},
};

constexpr Key cross_section_keys[] = {
    {"profile", text(), exactly_one,
     "Standard steel section by name, regardless of case and blanks: IPE, HEA, HEB, HEM, HD, HP, UB, UC, UBP; W, M, S, "
     "HP, HSS, PIPE of the AISC; SHS 200x8, RHS 300x200x10, CHS 219.1x8 in mm. Bending about local y is about the "
     "strong axis.",
     "HEB400", "0.3.0"},
    {"rectangle", quantity(dimension::length, bounds::positive).list(2), exactly_one,
     "[width, depth] along local y and local z; local z is vertical in a beam.", "[0.4 m, 0.6 m]"},
    {"i_section", map(i_section), exactly_one, "Doubly symmetric I-section of three rectangles.",
     "{depth: 300 mm, width: 150 mm, flange: 10.7 mm, web: 7.1 mm}"},
    {"tube", map(tube), exactly_one, "Circular hollow section.", "{diameter: 0.5 m, thickness: 10 mm}"},
    {"circle", quantity(dimension::length, bounds::positive), exactly_one, "Diameter of a solid circle.", "0.6 m"},
    {"area", quantity(dimension::area, bounds::positive), exactly_one,
     "Area of a section given by its properties; requires inertia_y, in space also inertia_z and torsion.", "0.16 m^2"},
    {"inertia_y", quantity(dimension::second_moment, bounds::positive), otherwise("from the shape"),
     "Second moment of area for bending about local y, the bending axis of a plane frame.", "2.1e-3 m^4"},
    {"inertia_z", quantity(dimension::second_moment, bounds::positive), otherwise("from the shape"),
     "Second moment of area for bending about local z.", "2.1e-3 m^4"},
    {"torsion", quantity(dimension::second_moment, bounds::positive), otherwise("from the shape"),
     "St Venant torsion constant.", "3.6e-3 m^4"},
    {"shear_area_y", quantity(dimension::area, bounds::positive),
     otherwise("from the shape; without a shape no shear deformation"), "Shear area along local y.", "0.13 m^2"},
    {"shear_area_z", quantity(dimension::area, bounds::positive),
     otherwise("from the shape; without a shape no shear deformation"), "Shear area along local z.", "0.13 m^2"},
    {"plastic_modulus_y", quantity(dimension::volume, bounds::positive), otherwise("from the shape, else unknown"),
     "Plastic modulus for bending about local y, for hinges with a strength.", "3.2e-3 m^3", "0.3.0"},
    {"plastic_modulus_z", quantity(dimension::volume, bounds::positive), otherwise("from the shape, else unknown"),
     "Plastic modulus for bending about local z, for hinges with a strength.", "1.1e-3 m^3", "0.3.0"},
    {"axis", choice(section_axes, "axis"), otherwise("strong"),
     "weak turns the section by 90 degrees about its axis: local y and z are exchanged, so that a plane frame bends a "
     "standard section about its weak axis.",
     "weak", "0.3.0"},
    {"shear", boolean(), otherwise("true if shear areas are known"), "false neglects shear deformation.", "false"},
    {"stiffness", number(bounds::positive), otherwise("1"),
     "Factor on both second moments of area, for example for cracked concrete. Area, torsion constant and shear areas "
     "are unchanged.",
     "0.5"},
};

constexpr Key i_section_keys[] = {
    {"depth", quantity(dimension::length, bounds::positive), required, "Overall depth along local z.", "300 mm"},
    {"width", quantity(dimension::length, bounds::positive), required, "Flange width along local y.", "150 mm"},
    {"flange", quantity(dimension::length, bounds::positive), required, "Flange thickness.", "10.7 mm"},
    {"web", quantity(dimension::length, bounds::positive), required, "Web thickness.", "7.1 mm"},
};

constexpr Key tube_keys[] = {
    {"diameter", quantity(dimension::length, bounds::positive), required, "Outside diameter.", "0.5 m"},
    {"thickness", quantity(dimension::length, bounds::positive), required, "Wall thickness.", "10 mm"},
};

constexpr Key member_keys[] = {
    {"between", text().list(2), otherwise("nodes of the grid, for a member of the grid"),
     "Start node and end node. Local x points from start to end.", "[a, b]"},
    {"section", text().or_map(cross_section), otherwise("section of the grid, for a member of the grid"),
     "Cross-section of a beam: a name from sections, a standard steel section such as HEB400, or a map. Give section "
     "or "
     "truss, not both.",
     "{rectangle: [0.4 m, 0.6 m]}"},
    {"truss", quantity(dimension::area, bounds::positive), otherwise("a beam"),
     "Cross-sectional area of a member with axial force only.", "20 cm^2"},
    {"material", text().or_map(material), otherwise("material of the frame"),
     "Material: a name from materials, a steel grade such as S355, or a map.", "{E: 210 GPa}"},
    {"releases", map(releases), otherwise("no releases"),
     "End releases: degrees of freedom without force transfer, in local axes.", "{start: [ry]}"},
    {"offsets", map(offsets), otherwise("no offsets"),
     "Rigid offsets from the nodes to the ends of the member, in global axes.", "{start: [0, 0.3 m]}"},
    {"load", quantity(dimension::stiffness).called("a force per length").list(2, 3), otherwise("no load"),
     "Constant force per length, before and during the motion, in global axes: [x, z] in the plane, [x, y, z] in "
     "space; z is up.",
     "[0, -10 kN/m]"},
    {"parts", integer(1, 100), otherwise("1"),
     "Number of equal elements into which the member is divided. The nodes in between capture its curvature and can be "
     "hit. The elements of c1 are named c1/1, c1/2, ... from the start, and the nodes in between use the same names.",
     "3", "0.2.0"},
    {"reference", number().list(3), otherwise("[0, 0, 1]; [-1, 0, 0] for vertical members"),
     "Reference vector for the orientation of local z, in space: local y is reference x local x.", "[0, 1, 0]"},
};

constexpr Key releases_keys[] = {
    {"start", choice(displacements, "displacement").list(), otherwise("none"),
     "Releases at the start; ry is a hinge in the plane.", "[ry]"},
    {"end", choice(displacements, "displacement").list(), otherwise("none"),
     "Releases at the end; ry is a hinge in the plane.", "[ry]"},
};

constexpr Key offsets_keys[] = {
    {"start", quantity(dimension::length).list(2, 3), otherwise("none"),
     "Offset from the start node to the start of the member: [x, z] in the plane, [x, y, z] in space.", "[0, 0.3 m]"},
    {"end", quantity(dimension::length).list(2, 3), otherwise("none"),
     "Offset from the end node to the end of the member: [x, z] in the plane, [x, y, z] in space.", "[0, -0.3 m]"},
};

}  // namespace

constinit const Section material{
    "materials", "structures.NAME.frame.materials.NAME",
    "Linear elastic material. The same keys apply to frame.material and to the material of a member.", material_keys};
constinit const Section cross_section{
    "sections", "structures.NAME.frame.sections.NAME",
    "Cross-section. The same keys apply to grid.columns, grid.beams and the section of a member.", cross_section_keys};
constinit const Section i_section{"i_section", "structures.NAME.frame.sections.NAME.i_section",
                                  "Doubly symmetric I-section of three rectangles, without fillets.", i_section_keys};
constinit const Section tube{"tube", "structures.NAME.frame.sections.NAME.tube", "Circular hollow section.", tube_keys};
constinit const Section member{"members", "structures.NAME.frame.members.NAME", "Beam, column or truss.", member_keys};
constinit const Section releases{"releases", "structures.NAME.frame.members.NAME.releases",
                                 "End releases: degrees of freedom without force transfer, in local axes.",
                                 releases_keys};
constinit const Section offsets{"offsets", "structures.NAME.frame.members.NAME.offsets",
                                "Rigid offsets from the nodes to the ends of the member, in global axes.",
                                offsets_keys};

}  // namespace pounding::keys
