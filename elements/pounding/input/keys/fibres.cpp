#include <pounding/input/keys/sections.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view integration_rules[] = {"lobatto", "legendre", "radau", "hinge_radau"};
constexpr std::string_view formulations[] = {"force", "displacement"};
constexpr std::string_view not_regularized[] = {"none"};
constexpr std::string_view member_groups[] = {"all", "beams", "columns"};

constexpr Key rc_rectangle_keys[] = {
    {"width", quantity(dimension::length, bounds::positive), required, "Width along local y.", "0.4 m", "0.3.0"},
    {"depth", quantity(dimension::length, bounds::positive), required, "Depth along local z.", "0.4 m", "0.3.0"},
    {"cover", quantity(dimension::length, bounds::positive), required,
     "Distance from the surface to the axes of the bars, which bound the core.", "40 mm", "0.3.0"},
    {"core", text(), required, "Concrete of the core: a name from materials.", "core", "0.3.0"},
    {"shell", text(), required, "Concrete of the cover: a name from materials.", "cover", "0.3.0"},
    {"bars", text(), required, "Steel of the bars: a name from materials.", "bars", "0.3.0"},
    {"top", text(), required, "Number and diameter [mm] of the bars at positive local z, from corner to corner.",
     "4 d20", "0.3.0"},
    {"bottom", text(), required, "Number and diameter [mm] of the bars at negative local z, from corner to corner.",
     "4 d20", "0.3.0"},
    {"sides", text(), otherwise("none"),
     "Number and diameter [mm] of the bars between top and bottom, in both sides together.", "2 d20", "0.3.0"},
};

constexpr Key fibres_of_section_keys[] = {
    {"patches", map(patch).list(), at_least_one, "Areas divided into cells.",
     "[{rectangle: {y: [-0.2 m, 0.2 m], z: [-0.2 m, 0.2 m]}, cells: [1, 24], material: core}]", "0.3.0"},
    {"layers", map(bar_layer).list(), at_least_one, "Rows and circles of bars.",
     "[{bars: 4 d20, from: [-0.16 m, 0.16 m], to: [0.16 m, 0.16 m], material: bars}]", "0.3.0"},
    {"points", any_value().lists(4, 4), at_least_one, "Single fibres: [y, z, area, material].",
     "[[0, 0.16 m, 1257 mm2, bars], [0, -0.16 m, 1257 mm2, bars]]", "0.3.0"},
    {"area", quantity(dimension::area, bounds::positive),
     otherwise("area of the patches; without patches of all fibres"),
     "Gross area, from which the mass follows. The patches, or without patches all fibres, must cover it.", "0.16 m^2",
     "0.3.0"},
};

constexpr Key patch_keys[] = {
    {"rectangle", map(patch_rectangle), exactly_one, "Rectangle with sides along local y and z.",
     "{y: [-0.2 m, 0.2 m], z: [-0.2 m, 0.2 m]}", "0.3.0"},
    {"quadrilateral", quantity(dimension::length).lists(2, 2), exactly_one,
     "Four corners [y, z] in order around a convex quadrilateral.",
     "[[-0.2 m, -0.2 m], [0.2 m, -0.2 m], [0.2 m, 0.2 m], [-0.2 m, 0.2 m]]", "0.3.0"},
    {"ring", map(patch_ring), exactly_one, "Ring or circle.", "{outer: 0.25 m}", "0.3.0"},
    {"cells", integer(1, 200).list(2), required,
     "Number of cells along y and z, along the first two sides of a quadrilateral, or along the radius and around.",
     "[1, 24]", "0.3.0"},
    {"material", text(), required, "Law of the fibres: a name from materials.", "core", "0.3.0"},
};

constexpr Key patch_rectangle_keys[] = {
    {"y", quantity(dimension::length).list(2), required, "Bounds along local y, ascending.", "[-0.2 m, 0.2 m]",
     "0.3.0"},
    {"z", quantity(dimension::length).list(2), required, "Bounds along local z, ascending.", "[-0.2 m, 0.2 m]",
     "0.3.0"},
};

constexpr Key patch_ring_keys[] = {
    {"outer", quantity(dimension::length, bounds::positive), required, "Outer radius.", "0.25 m", "0.3.0"},
    {"inner", quantity(dimension::length, bounds::non_negative), otherwise("0 m"), "Inner radius; 0 for a circle.",
     "0.24 m", "0.3.0"},
    {"centre", quantity(dimension::length).list(2), otherwise("[0, 0]"), "Centre [y, z].", "[0, 0]", "0.3.0"},
};

constexpr Key bar_layer_keys[] = {
    {"bars", text(), required, "Number and diameter [mm] of the bars.", "4 d20", "0.3.0"},
    {"from", quantity(dimension::length).list(2), otherwise("none; required with to"),
     "First bar [y, z] of a straight row of equally spaced bars; a single bar is in the middle.", "[-0.16 m, 0.16 m]",
     "0.3.0"},
    {"to", quantity(dimension::length).list(2), otherwise("none; required with from"), "Last bar [y, z] of the row.",
     "[0.16 m, 0.16 m]", "0.3.0"},
    {"radius", quantity(dimension::length, bounds::positive), otherwise("a straight row"),
     "Radius of a circle of equally spaced bars, instead of from and to.", "0.2 m", "0.3.0"},
    {"centre", quantity(dimension::length).list(2), otherwise("[0, 0]"), "Centre [y, z] of the circle.", "[0, 0]",
     "0.3.0"},
    {"material", text(), required, "Law of the bars: a name from materials.", "bars", "0.3.0"},
};

constexpr Key frame_fibres_keys[] = {
    {"members", text().nonempty_list().or_one_of(member_groups), otherwise("all"),
     "Members that yield along their length: all with a section of fibres, beams (horizontal) or columns (vertical), "
     "or "
     "a list of names and of these groups. All others are elastic.",
     "[columns]", "0.3.0"},
    {"formulation", choice(formulations), otherwise("force"),
     "force interpolates the section forces (exact equilibrium, one element per member); displacement interpolates the "
     "displacements, so that a member that yields must be divided into parts.",
     "force", "0.3.0"},
    {"rule", choice(integration_rules, "integration rule"), otherwise("lobatto"),
     "Positions and weights of the sections: Gauss-Lobatto, Gauss-Legendre, Gauss-Radau, or hinge_radau with plastic "
     "hinges of a given length and an elastic interior (Scott & Fenves 2006).",
     "lobatto", "0.3.0"},
    {"points", integer(2, 10), otherwise("5"), "Number of sections of a member, for all rules but hinge_radau.", "5",
     "0.3.0"},
    {"hinge_length", quantity(dimension::length, bounds::positive).or_list(2),
     otherwise("none; required by hinge_radau"),
     "Plastic hinge length at both ends, or two, [start, end]. Paulay & Priestley (1992): 0.08 L + 0.022 fy db, with "
     "the shear span L and the bar diameter db in m and fy in MPa.",
     "0.3 m", "0.3.0"},
    {"regularized", choice(not_regularized), otherwise("required for softening sections without a hinge length"),
     "none accepts that results of sections that soften depend on the number of points.", "none", "0.3.0"},
};

}  // namespace

constinit const Section rc_rectangle{
    "rc_rectangle", "structures.NAME.frame.sections.NAME.rc_rectangle",
    "Reinforced-concrete rectangle of fibres. The area of concrete that bars displace is not subtracted.",
    rc_rectangle_keys};
constinit const Section fibres_of_section{"section_fibres", "structures.NAME.frame.sections.NAME.fibres",
                                          "Fibres of a cross-section, in local y and z.", fibres_of_section_keys};
constinit const Section patch{"patches", "structures.NAME.frame.sections.NAME.fibres.patches[]",
                              "Area divided into fibres.", patch_keys};
constinit const Section patch_rectangle{"patch_rectangle",
                                        "structures.NAME.frame.sections.NAME.fibres.patches[].rectangle",
                                        "Rectangle with sides along local y and z.", patch_rectangle_keys};
constinit const Section patch_ring{"ring", "structures.NAME.frame.sections.NAME.fibres.patches[].ring",
                                   "Ring or circle.", patch_ring_keys};
constinit const Section bar_layer{"layers", "structures.NAME.frame.sections.NAME.fibres.layers[]",
                                  "Straight row or circle of equal bars.", bar_layer_keys};
constinit const Section frame_fibres{"fibres", "structures.NAME.frame.fibres",
                                     "Members whose sections of fibres yield along their length.", frame_fibres_keys};

}  // namespace pounding::keys
