#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view section_axes[] = {"strong", "weak"};

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
    {"rc_rectangle", map(rc_rectangle), exactly_one, "Reinforced-concrete rectangle of fibres.",
     "{width: 0.4 m, depth: 0.4 m, cover: 40 mm, core: core, shell: cover, bars: bars, top: 4 d20, bottom: 4 d20, "
     "sides: 2 d20}",
     "0.3.0"},
    {"fibres", map(fibres_of_section), exactly_one, "Section of fibres by patches, layers of bars and points.",
     "{patches: [{rectangle: {y: [-0.2 m, 0.2 m], z: [-0.2 m, 0.2 m]}, cells: [1, 24], material: core}], layers: "
     "[{bars: 4 d20, from: [-0.16 m, 0.16 m], to: [0.16 m, 0.16 m], material: bars}]}",
     "0.3.0"},
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
    {"material", text(), otherwise("an elastic section"),
     "Law from materials, which makes a section of fibres from profile, rectangle, i_section, tube or circle.", "steel",
     "0.3.0"},
    {"layers", integer(1, 200), otherwise("24"),
     "Number of fibres along the depth of the core, of a rectangle or of a web; around a circle or tube twice as many.",
     "40", "0.3.0"},
    {"across", integer(1, 200), otherwise("12 in space, 1 in the plane"),
     "Number of fibres across the width of the core, of a rectangle or of a flange.", "8", "0.3.0"},
    {"density", quantity(dimension::density, bounds::non_negative), otherwise("density of the material of the frame"),
     "Density of a section of fibres, from which the mass of members follows.", "2500 kg/m^3", "0.3.0"},
    {"GJ", quantity({1, 3, -2}, bounds::positive), otherwise("from the shape, with G = E/2.4"),
     "Elastic torsional stiffness of a section of fibres, in space; required with fibres.", "40 MN m^2", "0.3.0"},
    {"shear", boolean(), otherwise("true if shear areas are known; false with fibres"),
     "false neglects shear deformation. true adds elastic shear deformation to a section of fibres.", "false"},
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
