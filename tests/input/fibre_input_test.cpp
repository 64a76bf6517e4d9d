// Materials and sections of fibres in the input, members with fibres, and their errors.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/frames/fibre_member.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/profiles/profiles.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include <pounding/input/frames/whole_members.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include <pounding/sections/moment_curvature.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace fibre_input_test {

// Materials on lines 1 to 4, sections on lines 5 to 7. Diameters give areas of 300 and 400 mm2.
const std::string materials =
    "materials:\n"
    "  core: {concrete02: {fpc: -36 MPa, epsc0: -0.004, fpcu: -28 MPa, epsU: -0.03, lambda: 0.1, ft: 2.5 MPa, Ets: 1.5 "
    "GPa}}\n"
    "  cover: {concrete02: {fpc: -28 MPa, epsc0: -0.002, fpcu: -5.6 MPa, epsU: -0.006, lambda: 0.1, ft: 2.5 MPa, Ets: "
    "1.5 GPa}}\n"
    "  bars: {steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01}}\n";
const std::string column =
    "{rc_rectangle: {width: 0.4 m, depth: 0.4 m, cover: 40 mm, core: core, shell: cover, bars: bars, top: 4 "
    "d19.544100476116796, bottom: 4 d19.544100476116796, sides: 2 d22.567583341910253}}";
const std::string grid =
    "grid: {storeys: 2, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: column, beams: beam, floor_mass: 20 "
    "t}\n";

std::string sections(const std::string& beam = "{rectangle: [0.3 m, 0.5 m], material: bars}") {
  return "sections:\n  column: " + column + "\n  beam: " + beam + "\n";
}

FrameModel read(const std::string& yaml) { return read_frame(Input::read_text(yaml, "test.yaml")).model; }

// The section of a cantilever in the plane or in space.
Section section(const std::string& yaml, int dimension = 2, const std::string& more = "") {
  const std::string nodes = dimension == 2 ? "{a: [0, 0], b: [0, 3]}" : "{a: [0, 0, 0], b: [0, 0, 3]}";
  return read(materials + more + "sections: {one: " + yaml + "}\nnodes: " + nodes +
              "\nmembers: {c: {between: [a, b], section: one}}\nsupports: {a: fixed}\n")
      .frame.beam(0)
      .section();
}

void refused(const std::string& yaml, const std::string& location, const test::Facts& facts,
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal<InputError>([&] { read_frame_structure(Input::read_text(yaml, "test.yaml")); }),
                       "test.yaml:" + location, facts, line);
}

using test::at, test::mentions;

TEST(FibreInput, MaterialsHaveTheParametersOfTheirLaws) {
  const Section read = section(column);
  ASSERT_TRUE(read.fibres);
  const std::vector<FibreMaterial>& of = read.fibres->materials;
  ASSERT_EQ(of.size(), 3u);
  EXPECT_EQ(of[0].name, "core");
  const auto& core = std::get<materials::Concrete02>(of[0].law);
  EXPECT_EQ(core.fpc, -36e6);
  EXPECT_EQ(core.epsU, -0.03);
  EXPECT_EQ(core.Ets, 1.5e9);
  EXPECT_EQ(of[1].concrete_strength, 28e6);
  EXPECT_EQ(std::get<materials::Steel01>(of[2].law).E0, 200e9);
}

// The reference of tests/sections: an independent program, which agrees with OpenSees 3.7.1 to 3e-12.
TEST(FibreInput, AReinforcedColumnHasTheMomentsOfTheReference) {
  const auto fibres = section(column).fibres;
  std::vector<double> path;
  for (int i = 1; i <= 120; ++i) path.push_back(0.0005 * i);
  const std::vector<double> forces{0, -1e6, -2e6, -3e6, -4e6, -5e6};
  const std::vector<double> moments{253578.39469499106, 341796.1482219584,  377675.25086288986,
                                    334094.6383369934,  253322.87623266544, 144482.87023209018};
  const auto diagram = sections::interaction(fibres->section, forces, path);
  for (std::size_t i = 0; i < forces.size(); ++i)
    EXPECT_NEAR(diagram[i].moment, moments[i], 1e-9 * 377675) << forces[i];
}

// EA and EI by hand: concrete of both moduli and bars, all of them symmetric.
TEST(FibreInput, TheElasticSectionHasTheInitialStiffnessOfTheFibres) {
  const Section read = section(column);
  const double core = 18e9, cover = 28e9, steel = 200e9, inner = 0.32, outer = 0.4;
  const double ea = core * inner * inner + cover * (outer * outer - inner * inner) + steel * (8 * 3e-4 + 2 * 4e-4);
  const double ei = (core * std::pow(inner, 4) + cover * (std::pow(outer, 4) - std::pow(inner, 4))) / 12 +
                    steel * 8 * 3e-4 * 0.16 * 0.16;
  const Material& material = read.fibres->material;
  EXPECT_DOUBLE_EQ(read.area, 0.16);
  EXPECT_NEAR(material.young * read.area, ea, 1e-12 * ea);
  EXPECT_NEAR(material.young * read.inertia_y, ei, 2e-3 * ei);  // by 24 layers
  EXPECT_TRUE(std::isinf(read.shear_area_z));
  EXPECT_DOUBLE_EQ(section(column.substr(0, column.size() - 1) + ", shear: true}").shear_area_z, 0.16 * 5 / 6);
}

TEST(FibreInput, AMemberIsElasticWithTheUncrackedStiffness) {
  const FrameModel model = read(materials + "material: {E: 30 GPa, density: 2500}\n" + sections() + grid);
  const Beam& beam = model.frame.beam(0);
  EXPECT_EQ(beam.material().young, beam.section().fibres->material.young);
  EXPECT_EQ(beam.material().density, 2500);
  EXPECT_TRUE(model.fibres.empty());
  const std::vector<WholeMember> beams = members_of_group(model.frame, "beams");
  const Beam& steel = model.frame.beam(beams.front().first);
  EXPECT_NEAR(steel.material().young, 200e9, 1);
}

TEST(FibreInput, SteelShapesHaveTheirAreaAndInertia) {
  for (const char* const shape :
       {"profile: HEB400", "profile: IPE300", "profile: W14x90", "profile: SHS 200x8", "profile: RHS 300x200x10",
        "profile: HSS8x8x1/2", "profile: CHS 219.1x8", "profile: PIPE8STD", "tube: {diameter: 0.5, thickness: 0.01}",
        "circle: 0.3", "rectangle: [0.1, 0.3]", "i_section: {depth: 0.3, width: 0.15, flange: 0.0107, web: 0.0071}"})
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE(fmt::format("{} in {}D", shape, dimension));
      const Section elastic = section(fmt::format("{{{}}}", shape), dimension, "material: {E: 200 GPa}\n");
      const Section fibres = section(fmt::format("{{{}, material: bars}}", shape), dimension);
      const double scale = fibres.fibres->material.young / 200e9;
      EXPECT_NEAR(scale, 1, 0.01);
      EXPECT_EQ(fibres.area, elastic.area);
      EXPECT_NEAR(scale * fibres.inertia_y, elastic.inertia_y, 0.01 * elastic.inertia_y);
      if (dimension == 3) {
        EXPECT_NEAR(scale * fibres.inertia_z, elastic.inertia_z, 0.015 * elastic.inertia_z);
      }
      EXPECT_EQ(fibres.torsion, elastic.torsion);
    }
}

TEST(FibreInput, TheWeakAxisExchangesTheAxesOfTheFibres) {
  const Section strong = section("{profile: HEB400, material: bars}", 3);
  const Section weak = section("{profile: HEB400, material: bars, axis: weak}");
  EXPECT_NEAR(weak.inertia_y, strong.inertia_z, 1e-12);
  EXPECT_NEAR(weak.inertia_z, strong.inertia_y, 1e-12);
}

TEST(FibreInput, ExplicitFibresAreThoseOfTheShape) {
  const Section shape = section(column);
  const Section made = section(
      "{fibres: {patches: [{rectangle: {y: [-0.16, 0.16], z: [-0.16, 0.16]}, cells: [1, 24], material: core}, "
      "{quadrilateral: [[-0.2, 0.16], [0.2, 0.16], [0.2, 0.2], [-0.2, 0.2]], cells: [1, 3], material: cover}, "
      "{rectangle: {y: [-0.2, 0.2], z: [-0.2, -0.16]}, cells: [1, 3], material: cover}, "
      "{rectangle: {y: [0.16, 0.2], z: [-0.16, 0.16]}, cells: [1, 24], material: cover}, "
      "{rectangle: {y: [-0.2, -0.16], z: [-0.16, 0.16]}, cells: [1, 24], material: cover}], "
      "layers: [{bars: 4 d19.544100476116796, from: [-0.16, 0.16], to: [0.16, 0.16], material: bars}], "
      "points: [[0, -0.16 m, 1200 mm2, bars], [0, 0, 800 mm2, bars]], area: 0.16 m^2}}");
  EXPECT_NEAR(made.inertia_y, shape.inertia_y, 1e-9 * shape.inertia_y);
  EXPECT_NEAR(made.fibres->material.young, shape.fibres->material.young, 1e-9 * shape.fibres->material.young);
  const Section ring = section(
      "{fibres: {patches: [{ring: {outer: 0.25, inner: 0.24}, cells: [2, 48], material: bars}], layers: [{bars: 6 d20, "
      "radius: 0.2, material: bars}]}, GJ: 40 MN m^2}",
      3);
  EXPECT_NEAR(ring.area, M_PI * (0.25 * 0.25 - 0.24 * 0.24), 1e-12);
  EXPECT_NEAR(ring.torsion * ring.fibres->material.shear, 40e6, 1e-3);
}

// The numbers of confine(), which tests/materials compares with published ones. Hoops hold four bars at top and bottom.
TEST(FibreInput, ConfinedConcreteFollowsFromItsHoops) {
  const auto fibres = section("{rectangle: [0.33, 0.33], material: inner}", 2,
                              "  inner: {confined: {of: cover, width: 330 mm, depth: 330 mm, bars: 10 d20, hoops: 10 "
                              "mm, spacing: 100 mm, fyh: "
                              "420 MPa, legs: [2, 4]}}\n")
                          .fibres;
  const FibreMaterial& inner = fibres->materials[0];
  const double leg = M_PI * 0.01 * 0.01 / 4;
  const std::vector<double> gaps{0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.28, 0.28};
  const materials::Confinement expected = materials::confine({.strength = 28e6,
                                                              .strain = 0.002,
                                                              .width = 0.33,
                                                              .depth = 0.33,
                                                              .bars = 10 * M_PI * 1e-4,
                                                              .hoops_across_width = 2 * leg,
                                                              .hoops_across_depth = 4 * leg,
                                                              .spacing = 0.1,
                                                              .clear_spacing = 0.09,
                                                              .hoop_strength = 420e6},
                                                             gaps);
  const auto& law = std::get<materials::Concrete02>(inner.law);
  EXPECT_NEAR(law.fpc, -expected.strength, 1e-6 * expected.strength);
  EXPECT_NEAR(law.epsc0, -expected.strain, 1e-9);
  EXPECT_NEAR(law.epsU, -expected.ultimate_strain, 1e-9);
  EXPECT_GT(law.fpcu, law.fpc);
  EXPECT_LT(law.fpcu, 0.5 * law.fpc);
  EXPECT_EQ(law.ft, 2.5e6);
  EXPECT_EQ(inner.concrete_strength, 28e6);
}

TEST(FibreInput, MembersYieldByTheirFibres) {
  const std::string frame = materials + sections() + grid + "geometry: corotational\n";
  const FrameModel all = read(frame + "fibres: {regularized: none}\n");
  ASSERT_EQ(all.fibres.size(), 6u);
  for (const FrameFibres& each : all.fibres) {
    EXPECT_TRUE(all.frame.beam(each.member).section().fibres);
    EXPECT_EQ(each.options->rule.points.size(), 5u);
    EXPECT_EQ(each.options->formulation, MemberFormulation::force);
    EXPECT_EQ(each.options->geometry, FrameGeometry::corotational);
    EXPECT_TRUE(std::isinf(each.options->shear_stiffness_z));
  }
  const FrameModel columns =
      read(frame + "fibres: {members: columns, rule: hinge_radau, hinge_length: [0.4 m, 0.3 m]}\n");
  ASSERT_EQ(columns.fibres.size(), 4u);
  const IntegrationRule expected = hinge_radau(0.4 / 3.2, 0.3 / 3.2);
  ASSERT_EQ(columns.fibres[0].options->rule.points.size(), expected.points.size());
  EXPECT_EQ(columns.fibres[0].options->rule.points[1].weight, expected.points[1].weight);
  EXPECT_EQ(
      read(frame + "fibres: {members: [beams, column 1.0], rule: legendre, points: 3, formulation: displacement}\n")
          .fibres.size(),
      3u);
}

TEST(FibreInput, ASofteningCoreNeedsAHingeLength) {
  const std::string frame = materials + sections() + grid;
  refused(frame + "fibres: {rule: lobatto}\n", at("9:16", "fibres.rule"),
          mentions({"column", "core", "-36 MPa", "-28 MPa", "hinge_radau", "hinge_length", "regularized: none"}));
  EXPECT_EQ(read(frame + "fibres: {members: beams}\n").fibres.size(), 2u);
  EXPECT_EQ(read(frame + "fibres: {formulation: displacement}\n").fibres.size(), 6u);
  std::string constant = frame;
  constant.replace(constant.find("fpcu: -28 MPa"), 13, "fpcu: -36 MPa");
  EXPECT_EQ(read(constant + "fibres: {rule: lobatto}\n").fibres.size(), 6u);
}

TEST(FibreInput, WrongMaterialsAreRefused) {
  const auto frame = [](const std::string& material, const std::string& more = "") {
    return "materials: {one: " + material +
           "}\nsections: {s: {rectangle: [0.1, 0.3], material: one}}\nnodes: {a: [0, 0], "
           "b: [0, 3]}\nmembers: {c: {between: [a, b], section: s" +
           more + "}}\nsupports: {a: fixed}\nmasses: {b: 1 t}\n";
  };
  refused(frame("{steel1: {Fy: 460 MPa}}"), at("1:19", "materials.one"), mentions({"steel1", "steel01"}));
  refused(frame("{steel01: {Fy: 460 MPa, E: 200 GPa, b: 0.01}}"), at("1:42", "materials.one.steel01"),
          mentions({"E", "E0"}));
  refused(frame("{steel01: {Fy: 460 MPa, E0: 200 GPa}}"), at("1:28", "materials.one.steel01"), mentions({"b"}));
  refused(frame("{steel01: {Fy: 460 kN, E0: 200 GPa, b: 0.01}}"), at("1:33", "materials.one.steel01.Fy"),
          mentions({"460 kN", "stress"}));
  refused(frame("{steel01: {Fy: 460 MPa, E0: 200 GPa, b: 1.5}}"), at("1:58", "materials.one.steel01.b"),
          mentions({"1.5"}));
  refused(frame("{concrete01: {fpc: 30 MPa, epsc0: -0.002, fpcu: -5 MPa, epsU: -0.006}}"),
          at("1:37", "materials.one.concrete01.fpc"), mentions({"negative"}));
  refused(frame("{E: 200 GPa}"), at("2:49", "sections.s.material"), mentions({"one", "elastic"}));
  refused(frame("{steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01}, density: 7850}"), at("1:65", "materials.one.density"),
          mentions({"steel01"}));
  refused(frame("{steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01}}", ", material: {E: 200 GPa}"),
          at("4:44", "members.c.material"), mentions({"fibres"}));
}

TEST(FibreInput, WrongSectionsAreRefused) {
  const auto one = [](const std::string& section) {
    return materials + "sections:\n  one: " + section +
           "\nnodes: {a: [0, 0], b: [0, 3]}\nmembers: {c: {between: [a, b], section: one}}\n"
           "supports: {a: fixed}\nmasses: {b: 1 t}\n";
  };
  const std::string rc = "{rc_rectangle: {width: 0.4, depth: 0.4, cover: 0.04, core: core, shell: cover, bars: bars, ";
  refused(one(rc + "top: 4 x 20, bottom: 4 d20}}"), at("6:104", "sections.one.rc_rectangle.top"),
          mentions({"4 d20", "4 x 20"}));
  refused(one(rc + "top: 2000000000 d20, bottom: 4 d20}}"), at("6:104", "sections.one.rc_rectangle.top"),
          mentions({"1000"}));
  refused(one(rc + "top: 4 d20, bottom: 4 d20, sides: 3 d20}}"), at("6:133", "sections.one.rc_rectangle.sides"),
          mentions({"even"}));
  refused(one("{rc_rectangle: {width: 0.4, depth: 0.4, cover: 0.04, core: cor, shell: cover, bars: bars, top: 4 d20, "
              "bottom: 4 d20}}"),
          at("6:67", "sections.one.rc_rectangle.core"), mentions({"cor", "core"}));
  refused(one("{rectangle: [0.3, 0.5], material: bars, stiffness: 0.5}"), at("6:48", "sections.one.stiffness"),
          mentions({"fibres"}));
  refused(one("{rectangle: [0.3, 0.5], layers: 10}"), at("6:32", "sections.one.layers"), mentions({"material"}));
  const std::string patch = "{rectangle: {y: [-0.2, 0.2], z: [-0.2, 0.2]}, cells: [1, 10], material: core}";
  refused(one("{fibres: {patches: [" + patch + "], area: 0.2 m^2}}"), at("6:114", "sections.one.fibres.area"),
          mentions({"0.16", "0.2"}));
  refused(one("{fibres: {patches: [" + patch + "]}, shear: true}"), at("6:116", "sections.one.shear"),
          mentions({"shape"}));
  refused(one("{fibres: {}}"), at("6:17", "sections.one.fibres"), mentions({"patches", "points"}));
}

TEST(FibreInput, WrongMembersAreRefused) {
  const std::string frame = materials + sections() + grid;
  refused(frame + "fibres: {rule: hinge_radau}\n", at("9:9", "fibres"), mentions({"hinge_length: 0.3 m"}));
  refused(frame + "fibres: {hinge_length: 0.3 m}\n", at("9:10", "fibres.hinge_length"),
          mentions({"hinge_radau", "lobatto"}));
  refused(frame + "fibres: {rule: hinge_radau, hinge_length: 2 m}\n", at("9:43", "fibres.hinge_length"), {});
  refused(frame + "fibres: {members: [colums]}\n", at("9:20", "fibres.members[0]"), mentions({"colums", "columns"}));
  refused(frame + "fibres: {points: 11}\n", at("9:18", "fibres.points"), mentions({"10"}));
  refused(frame + "fibres: {rul: lobatto}\n", at("9:10", "fibres"), mentions({"rul", "rule"}));
  refused(frame + "hinges: {beams: {at: both, yield_moment: 210 kN m}}\nfibres: {members: beams}\n",
          at("10:9", "fibres"), mentions({"beam x 1.0", "hinge"}));
  refused(frame + "members: {column 1.0: {material: {E: 30 GPa}}}\n", at("8:7", "grid"),
          mentions({"column 1.0", "fibres", "material"}));
  const std::string elastic = materials + sections("{rectangle: [0.3, 0.5]}") + grid + "material: {E: 30 GPa}\n";
  refused(elastic + "fibres: {members: beams}\n", at("10:19", "fibres.members"), mentions({"beams", "fibres"}));
}

// A complete model with these lines of a frame.
Model model(const std::string& frame) {
  std::string indented = "    ";
  for (const char c : frame) indented += c == '\n' ? "\n    " : std::string(1, c);
  return read_model(Input::read_text(
      "analysis: {duration: 1}\nstructures:\n  old:\n   damping: 5 %\n   frame:\n" + indented, "test.yaml"));
}

TEST(FibreInput, CheckPrintsTheModuliNextToThoseOfTheCode) {
  const Model read = model(materials + sections() + grid + "fibres: {members: columns, regularized: none}\n");
  const std::string text = describe(read);
  EXPECT_TRUE(test::mentions(
      text, {"section column", "0.16 m^2", "4 members", "core: concrete02", "E0 18 GPa", "EN 1992-1-1: 32.31 GPa",
             "cover: concrete02", "E0 28 GPa", "29.96 GPa", "section beam", "elastic"}));
  const std::string warning = test::only(implausible(read));
  EXPECT_TRUE(test::mentions(warning, {"core", "18 GPa", "44 %", "32.31 GPa", "epsc0", "E0"})) << warning;
}

// Beam of the reference: 0.3 x 0.5 m with 1000 mm2 at top and bottom.
const std::string beam =
    "{rc_rectangle: {width: 0.3 m, depth: 0.5 m, cover: 40 mm, core: core, shell: cover, bars: bars, top: 4 "
    "d17.841241161527712, bottom: 4 d17.841241161527712}}";
const std::string reference_grid =
    "grid: {storeys: 3, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: column, beams: beam, floor_mass: 40 "
    "t}\n";

// The same frame with EA and EI by hand, see above; beams have no side bars.
TEST(FibreInput, AFrameHasThePeriodOfItsElasticSections) {
  const auto rigidities = [](double width, double depth, double bars, double middle) {
    const double inner = (width - 0.08) * (depth - 0.08), arm = depth / 2 - 0.04;
    const double core = (width - 0.08) * std::pow(depth - 0.08, 3) / 12;
    return std::pair(18e9 * inner + 28e9 * (width * depth - inner) + 200e9 * (2 * bars + middle),
                     18e9 * core + 28e9 * (width * std::pow(depth, 3) / 12 - core) + 200e9 * 2 * bars * arm * arm);
  };
  std::string elastic = "material: {E: 1 Pa, G: 1 Pa}\nsections:\n";
  for (const auto& [name, of] : {std::pair{"column", rigidities(0.4, 0.4, 1200e-6, 800e-6)},
                                 std::pair{"beam", rigidities(0.3, 0.5, 1000e-6, 0)}})
    elastic += fmt::format("  {}: {{area: {}, inertia_y: {}}}\n", name, of.first, of.second);
  const double expected = model(elastic + reference_grid).structures[0].frequencies[0];
  const double found = model(materials + sections(beam) + reference_grid).structures[0].frequencies[0];
  EXPECT_NEAR(found, expected, 5e-4 * expected);  // second moments of 24 layers
}

// An independent program: 205 and 419 kN m at 0.02 1/m, with -1.6 MN.
TEST(FibreInput, RigidFloorsOverBeamsOfFibresAreWarnedAbout) {
  std::string frame = materials + sections(beam) + reference_grid + "fibres: {members: beams, regularized: none}\n";
  EXPECT_EQ(implausible(model(frame)).size(), 1u);  // E0
  frame.insert(frame.find("floor_mass"), "rigid_floors: true, ");
  const Model rigid = model(frame);
  const auto& restraint = rigid.structures[0].fibre_sections.at(1).restraint.value();
  EXPECT_EQ(restraint.beams, 3);
  EXPECT_NEAR(restraint.moment, 419e3, 500);
  EXPECT_NEAR(restraint.free_moment, 205e3, 500);
  EXPECT_NEAR(restraint.axial_force, -1.6e6, 5e4);
  const std::vector<std::string> warnings = implausible(rigid);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(test::mentions(warnings[1], {"3 beams", "section beam", "0.02 1/m", "rigid_floors: false", "diaphragm"}))
      << warnings[1];
}

TEST(FibreInput, Steel02IsWarnedAboutWhereItYields) {
  std::string frame = materials + sections("{rectangle: [0.3 m, 0.5 m], material: other}") + grid;
  frame.insert(frame.find("sections:"), "  other: {steel02: {Fy: 355 MPa, E: 200 GPa, b: 0.01}}\n");
  EXPECT_EQ(implausible(model(frame)).size(), 1u);  // E0
  const std::vector<std::string> warnings = implausible(model(frame + "fibres: {members: beams}\n"));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(test::mentions(warnings[1], {"other", "steel02", "menegotto_pinto", "0.36 Fy"})) << warnings[1];
}

TEST(FibreInput, TheResolvedModelContainsConfinedValues) {
  std::string frame = materials + sections(beam) + reference_grid;
  frame.insert(frame.find("sections:"),
               "  inner: {confined: {of: cover, width: 330 mm, depth: 330 mm, bars: 10 d20, hoops: 10 mm, spacing: 100 "
               "mm, fyh: 420 MPa}}\n");
  frame.replace(frame.find("core: core"), 10, "core: inner");
  const Model read = model(frame);
  const std::string text = resolved_yaml(read);
  EXPECT_NE(text.find("fibre_sections:"), text.npos);
  EXPECT_NE(text.find("fcc:"), text.npos);
  EXPECT_TRUE(test::mentions(describe(read), {"inner: concrete02", "confined: ke", "fcc", "MPa", "ecu"}));
}

}  // namespace fibre_input_test
}  // namespace pounding
