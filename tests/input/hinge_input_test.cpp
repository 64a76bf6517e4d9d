// Hinges of frames in the input, and their errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace hinge_input_test {

const std::string grid =
    "material: {E: 30 GPa}\ngrid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, "
    "0.4], shear: false},\n       beams: {rectangle: [0.3, 0.5], shear: false}, floor_mass: 20 t}\n";
const std::string space =
    "material: {E: 30 GPa}\ngrid: {storeys: 1, bays: [1, 1], storey_height: 3 m, bay_width: 6 m, columns: {rectangle: "
    "[0.4, 0.4]},\n       beams: {rectangle: [0.3, 0.5]}, floor_mass: 20 t}\n";

FrameModel read(const std::string& yaml) { return read_frame(Input::read_text(yaml, "test.yaml")).model; }

Structure structure(const std::string& yaml) { return read_frame_structure(Input::read_text(yaml, "test.yaml")); }

std::vector<std::string> names(const std::string& yaml) {
  std::vector<std::string> all;
  for (const YieldingPart& part : structure(yaml).yielding) all.push_back(part.name);
  return all;
}

// `message` is the text after the file name; the hinges are on line 4.
void refused(const std::string& hinges, const std::string& location, const test::Facts& facts = {},
             const std::string& frame = grid, std::source_location line = std::source_location::current()) {
  const std::string yaml = frame + "hinges: " + hinges + "\n";
  test::expect_message(test::refusal<InputError>([&] { structure(yaml); }), "test.yaml:" + location, facts, line);
}

using test::at, test::mentions;

using Names = std::vector<std::string>;

TEST(HingeInput, GroupsAndNamesChooseTheEnds) {
  EXPECT_EQ(names(grid + "hinges: {beams: {at: both, yield_moment: 210 kN m}}"),
            (Names{"beam x 1.0 start", "beam x 1.0 end", "beam x 2.0 start", "beam x 2.0 end"}));
  EXPECT_EQ(names(grid + "hinges: {columns: {at: feet, yield_moment: 210 kN m}}"),
            (Names{"column 1.0 start", "column 1.1 start"}));
  EXPECT_EQ(names(grid + "hinges: {column 2.0: {at: end, yield_moment: 210 kN m}}"), Names{"column 2.0 end"});
  EXPECT_EQ(names(grid + "members: {column 1.0: {parts: 3}}\nhinges: {columns: {at: both, yield_moment: 210 kN m}}"),
            (Names{"column 1.0/1 start", "column 1.0/3 end", "column 1.1 start", "column 1.1 end", "column 2.0 start",
                   "column 2.0 end", "column 2.1 start", "column 2.1 end"}));
  EXPECT_EQ(names(space + "hinges: {beam y 1.0.0: {at: start, axis: both, yield_moment: 210 kN m}, columns: {at: feet, "
                          "axis: z, yield_moment: 1 MN m}}"),
            (Names{"column 1.0.0 start z", "beam y 1.0.0 start y", "beam y 1.0.0 start z", "column 1.1.0 start z",
                   "column 1.0.1 start z", "column 1.1.1 start z"}));
}

TEST(HingeInput, ASingleMemberOverridesItsGroup) {
  const FrameModel model =
      read(grid +
           "hinges:\n  beam x 2.0: {at: end, yield_moment: [100 kN m, -150 kN m], hardening: 1 %}\n  beams: {at: both, "
           "yield_moment: 210 kN m, hardening: 3 %, ultimate_rotation: 0.04}\n");
  const std::vector<Hinge>& hinges = model.frame.hinges();
  ASSERT_EQ(hinges.size(), 4u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(hinges[i].yield_moment, 210e3);
    EXPECT_EQ(hinges[i].hogging_moment, std::nullopt);
    EXPECT_EQ(hinges[i].hardening, 0.03);
    EXPECT_EQ(hinges[i].ultimate_rotation, 0.04);
    EXPECT_TRUE(hinges[i].is_rigid_plastic());
  }
  EXPECT_EQ(hinges[3].yield_moment, 100e3);
  EXPECT_EQ(hinges[3].hogging_moment, 150e3);
  EXPECT_EQ(hinges[3].hardening, 0.01);
}

TEST(HingeInput, SpringsFollowLawsByName) {
  const Structure s =
      structure(grid +
                "hinges:\n  columns: {at: feet, bilinear: {yield_moment: 250 kN m, hardening: 0.003}}\n  beam x 1.0: "
                "{at: both, menegotto_pinto: {yield_moment: 180 kN m, hardening: 0.01, stiffness: 90 MN m, memory: "
                "last}}\n  beam x 2.0: {at: start, bouc_wen: {yield_moment: 180 kN m, stiffness_factor: 5}}\n");
  const auto part = [&](const std::string& name) -> const YieldingPart& {
    return *std::find_if(s.yielding.begin(), s.yielding.end(),
                         [&](const YieldingPart& each) { return each.name == name; });
  };
  const double of_column = 6 * 30e9 * std::pow(0.4, 4) / 12 / 3, of_beam = 6 * 30e9 * 0.3 * 0.125 / 12 / 6;
  EXPECT_EQ(part("column 1.0 start").law, "bilinear");
  EXPECT_NEAR(part("column 1.0 start").stiffness(), 10 * of_column, 1e-6 * of_column);
  EXPECT_EQ(part("beam x 1.0 end").law, "menegotto_pinto");
  EXPECT_EQ(part("beam x 1.0 end").stiffness(), 90e6);
  EXPECT_EQ(part("beam x 2.0 start").law, "bouc_wen");
  EXPECT_NEAR(part("beam x 2.0 start").stiffness(), 5 * of_beam, 1e-6 * of_beam);
}

TEST(HingeInput, HardeningIsTheRatioOfTheMemberEnd) {
  const auto warnings = [](const std::string& hinges) {
    const Model model = test::model_of(
        "structures:\n  a:\n    frame:\n      material: {E: 30 GPa}\n      grid: {storeys: 1, bays: 1, storey_height: "
        "3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 20 t}\n    "
        "  hinges: " +
        hinges + "\n    damping: 5 %\nanalysis: {duration: 1}\n");
    std::string all;
    for (const std::string& text : implausible(model)) all += text;
    return all;
  };
  const std::string by_member = "{columns: {at: feet, bouc_wen: {yield_moment: 250 kN m, hardening: 3 %}}}";
  const Structure s = structure(grid + "hinges: " + by_member + "\n");
  EXPECT_NEAR(s.yielding[0].parameter("spring_hardening"), 0.03 / (1 + 10 * 0.97), 1e-15);
  EXPECT_NEAR(s.yielding[0].parameter("end_tangent") / s.yielding[0].parameter("end_stiffness"), 0.03, 1e-12);
  const Structure bare =
      structure(grid + "hinges: {columns: {at: feet, bouc_wen: {yield_moment: 250 kN m, spring_hardening: 3 %}}}\n");
  EXPECT_EQ(bare.yielding[0].parameter("spring_hardening"), 0.03);
  const std::string warning = warnings(by_member);
  EXPECT_TRUE(test::mentions(
      warning, {"accept: [hardening]", "hinges.columns.bouc_wen.hardening", "spring_hardening", "3 %", "0.2.0"}))
      << warning;
  EXPECT_EQ(
      warnings("{columns: {at: feet, bouc_wen: {yield_moment: 250 kN m, spring_hardening: 3 %}}}").find("hardening"),
      std::string::npos);
  EXPECT_EQ(warnings("{columns: {at: feet, yield_moment: 250 kN m, hardening: 3 %}}").find("hardening"),
            std::string::npos);
}

TEST(HingeInput, AnElementUsesTheLengthOfItsMember) {
  const FrameModel model =
      read(grid + "members: {beam x 1.0: {parts: 4}}\nhinges: {beam x 1.0: {at: both, yield_moment: 210 kN m}}");
  for (const Hinge& hinge : model.frame.hinges()) EXPECT_DOUBLE_EQ(hinge.member_length, 6);
}

TEST(HingeInput, RejectsTwoDefinitionsOfHardening) {
  refused("{beams: {at: both, bouc_wen: {yield_moment: 1, hardening: 0.1, spring_hardening: 0.1}}}",
          at("4:72", "hinges.beams.bouc_wen.spring_hardening"), mentions({"spring_hardening"}));
  refused("{beams: {at: both, bouc_wen: {yield_moment: 1, spring_hardening: 1}}}",
          at("4:74", "hinges.beams.bouc_wen.spring_hardening"), mentions({"5 %", "[0, 1)"}));
}

// p is sagging, n hogging; what is not given is mirrored.
TEST(HingeInput, ReadsTheBackboneOfALaw) {
  const FrameModel model =
      read(grid +
           "hinges: {beam x 1.0: {at: both, pinching4: {yield_moment: [150 kN m, -100 kN m], stiffness: 37.5 MN m, "
           "ePf2: 200 kN m, ePd2: 0.01, ePf3: 210 kN m, ePd3: 0.02, ePf4: 60 kN m, ePd4: 0.04, eNf2: -120 kN m, "
           "rDispP: 0.5, rForceP: 0.25, uForceP: 0.05, gK1: 0.3, gKLim: 0.9, dmgType: cycle}}}");
  const Hinge& hinge = model.frame.hinges().at(0);
  EXPECT_EQ(hinge.yield_moment, 150e3);
  EXPECT_EQ(hinge.hogging_moment, 100e3);
  EXPECT_EQ(hinge.stiffness, 37.5e6);
  const auto& law = std::get<hysteresis::Pinching4>(hinge.law);
  EXPECT_EQ(law.s3p, 210e3);
  EXPECT_EQ(law.e4p, 0.04);
  EXPECT_EQ(law.s2n, -120e3);
  EXPECT_EQ(law.gKLim, 0.9);
  EXPECT_TRUE(law.by_cycles);
  refused("{beams: {at: both, hysteretic: {yield_moment: 1, hardening: 0.1}}}", at("4:58", "hinges.beams.hysteretic"),
          mentions({"hardening"}));
  refused("{beams: {at: both, hysteretic: {yield_moment: 1}}}", at("4:40", "hinges.beams.hysteretic"),
          mentions({"s2p: 200000 N m"}));
}

TEST(HingeInput, ReportsErrors) {
  refused("{beam x 1.1: {at: both, yield_moment: 1}}", at("4:10"),
          mentions({"beam x 1.1", "beam x 1.0", "hinges.beam"}));
  refused("{beams: {yield_moment: 1}}", at("4:17", "hinges.beams"), mentions({"at: both"}));
  refused("{beams: {at: both, imk_bilinear: {yield_moment: 1, theta_pc: 0.1}}}",
          at("4:42", "hinges.beams.imk_bilinear"), mentions({"theta_p: 0.06"}));
  refused("{beams: {at: middle, yield_moment: 1}}", at("4:22", "hinges.beams.at"),
          mentions({"middle", "start", "end", "both"}));
  refused("{beams: {at: both}}", at("4:17", "hinges.beams"), mentions({"yield_moment: 210 kN m"}));
  refused("{beams: {at: both, yield_moment: 0}}", at("4:42", "hinges.beams.yield_moment"), mentions({"12 kN m", "0"}));
  refused("{beams: {at: both, yield_moment: 210 kN}}", at("4:42", "hinges.beams.yield_moment"),
          mentions({"12 kN m", "210 kN"}));
  refused("{beams: {at: both, yield_moment: [1 kN m, 2 kN m]}}", at("4:51", "hinges.beams.yield_moment[1]"),
          mentions({"[210 kN m, -260 kN m]"}));
  refused("{beams: {at: both, yield_moment: [1, -2, 3]}}", at("4:42", "hinges.beams.yield_moment"),
          mentions({"[sagging, -hogging]", "[210 kN m, -260 kN m]", "3"}));
  refused("{beams: {at: both, yield_moment: 1, hardening: 100 %}}", at("4:56", "hinges.beams.hardening"),
          mentions({"5 %", "100 %", "[0, 1)"}));
  refused("{beams: {at: both, yield_moment: 1, hardning: 0.1}}", at("4:45", "hinges.beams"),
          mentions({"hardning", "hardening"}));
  for (const char* law : {"bouc_wen", "{bouc_wen: {yield_moment: 1}}"})
    refused("{beams: {at: both, law: " + std::string(law) + "}}", at("4:28", "hinges.beams"),
            mentions({"law", "bouc_wen: {yield_moment: 210 kN m}"}));
  refused("{beams: {at: both, bouc_wen: 210 kN m}}", at("4:38", "hinges.beams.bouc_wen"),
          mentions({"{yield_moment: 210 kN m}"}));
  refused("{beams: {at: feet, yield_moment: 1}}", at("4:22", "hinges.beams.at"), mentions({"at: start", "at: both"}));
  refused("{beams: {at: both, axis: z, yield_moment: 1}}", at("4:34", "hinges.beams.axis"));
  refused("{beams: {at: both, yield_moment: 1}}", at("4:17", "hinges.beams"), mentions({"axis: y", "axis: both"}),
          space);
  refused("{beams: 210 kN m}", at("4:17", "hinges.beams"),
          mentions({"{at: both, yield_moment: 210 kN m, hardening: 3 %}"}));
  refused("{beams: {at: both, yield_moment: 1, bilinear: {yield_moment: 1}}}", at("4:28", "hinges.beams.yield_moment"),
          mentions({"hinge"}));
  refused("{beams: {at: both, bilinear: {yield_moment: 1}, bouc_wen: {yield_moment: 1}}}",
          at("4:57", "hinges.beams.bouc_wen"), mentions({"hinge"}));
  refused("{beams: {at: both, bouc_wen: {yield_moment: [1, -2]}}}", at("4:53", "hinges.beams.bouc_wen.yield_moment"),
          mentions({"bouc_wen"}));
  refused("{beams: {at: both, bilinear: {yield_moment: 1, stiffness: 1, stiffness_factor: 2}}}",
          at("4:70", "hinges.beams.bilinear.stiffness_factor"), mentions({"stiffness_factor"}));
  refused("{beams: {at: both, bilinear: {yield_moment: 1, sharpness: 1}}}", at("4:56", "hinges.beams.bilinear"),
          mentions({"sharpness", "yield_moment", "stiffness", "stiffness_factor"}));
}

TEST(HingeInput, RejectsEndsThatCannotYield) {
  const std::string released = grid.substr(0, grid.find("grid:")) + "members: {beam x 1.0: {releases: {end: [ry]}}}\n" +
                               grid.substr(grid.find("grid:"));
  try {
    structure(released + "hinges: {beams: {at: both, yield_moment: 210 kN m}}");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"test.yaml:5:17", "hinges.beams", "1.0", "ry"}));
  }
  // 10 t at each node, 98 kN, on a cantilever of 1 m.
  const std::string bracket =
      "material: {E: 30 GPa}\nnodes: {a: [0, 0], b: [1 m, 0]}\nmembers: {arm: {between: [a, b], section: {rectangle: "
      "[0.4, 0.4]}}}\n";
  refused("{arm: {at: start, yield_moment: 90 kN m}}\nsupports: {a: fixed}\nmasses: {b: 10 t}\ngravity: true",
          at("4:15", "hinges.arm"), mentions({"-98.07 kN m", "-90 kN m"}), bracket);
  refused(
      "{arm: {at: start, yield_moment: 90 kN m}}\nsupports: {a: fixed}\nmasses: {b: 10 t}\ngravity: true\ngeometry: "
      "corotational",
      at("4:15", "hinges.arm"), mentions({"geometry: p_delta"}), bracket);
}

// The yield moments are 100 kN m and 400 kN m: 10 mm causes yielding in one direction only. The floor is held where it
// is displaced, and the top rotates less if the hinge at the foot yields.
TEST(HingeInput, AnInitialDisplacementMayYieldAHinge) {
  const auto displaced = [](const std::string& by) {
    return "structures:\n  a:\n    frame:\n      material: {E: 30 GPa}\n      nodes: {a: [0, 0], b: [0, 3 m]}\n      "
           "members: {c: {between: [a, b], section: {rectangle: [0.4, 0.4], shear: false}}}\n      supports: {a: "
           "fixed}\n      masses: {b: 10 t}\n      floors: [{nodes: [b]}]\n      hinges: {c: {at: start, yield_moment: "
           "[400 kN m, -100 kN m]}}\n    damping: 5 %\n    initial_displacement: " +
           by + "\nground_motion: {harmonic: {amplitude: 1, period: 0.5, duration: 1}}\nanalysis: {duration: 1}\n";
  };
  const auto shape = [&](const std::string& by) {
    const Model model = test::model_of(displaced(by));
    const Structure& s = model.structures[0];
    return std::pair(s.floors[0].motion[0].dot(s.initial_displacement), Eigen::VectorXd(s.initial_displacement));
  };
  int yielded = 0;
  for (const double sign : {1.0, -1.0}) {
    const auto [small, elastic] = shape(fmt::format("{} mm", 1 * sign));
    EXPECT_NEAR(small, 1e-3 * sign, 1e-15);
    for (const int by : {10, 50}) {
      const auto [held, found] = shape(fmt::format("{} mm", by * sign));
      EXPECT_NEAR(held, 1e-3 * by * sign, 1e-14);
      yielded += (found - by * elastic).norm() > 1e-6 * found.norm();
    }
  }
  EXPECT_EQ(yielded, 3);
}

TEST(HingeInput, AreInTheResolvedModel) {
  const Model model = test::model_of(
      "structures:\n  a:\n    frame:\n      material: {E: 30 GPa}\n      grid: {storeys: 1, bays: 1, storey_height: 3 "
      "m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 20 t}\n      "
      "hinges: {columns: {at: feet, yield_moment: 250 kN m, hardening: 2 %, ultimate_rotation: 0.04}}\n    damping: 5 "
      "%\nground_motion: {harmonic: {amplitude: 1, period: 0.5, duration: 1}}\nanalysis: {duration: 1}\n");
  const YAML::Node hinge = YAML::Load(resolved_yaml(model))["structures"]["a"]["hinges"]["column 1.1 start"];
  EXPECT_EQ(hinge["law"].as<std::string>(), "hinge");
  EXPECT_EQ(hinge["yield_moment"].as<double>(), 250e3);
  EXPECT_EQ(hinge["hardening"].as<double>(), 0.02);
  EXPECT_EQ(hinge["ultimate_rotation"].as<double>(), 0.04);
  const double k = hinge["member_stiffness"].as<double>();
  EXPECT_NEAR(hinge["yield_rotation"].as<double>(), 250e3 / k, 1e-15);
  EXPECT_TRUE(test::mentions(describe(model), {"250 kN m", "2"}));
}

const std::string steel =
    "material: S355\ngrid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {profile: HEB400, axis: "
    "weak},\n       beams: IPE300, beams_load: -25 kN/m, floor_mass: 20 t}\ngravity: false\n";

TEST(HingeInput, YieldMomentsFollowFromTheSectionAndTheStrength) {
  for (const std::string strength : {"355 MPa", "material"}) {
    const Structure s = structure(steel + "hinges: {beams: {at: both, strength: " + strength +
                                  "}, columns: {at: feet, strength: 235 MPa}}");
    ASSERT_EQ(s.yielding.size(), 4u);
    for (const YieldingPart& part : s.yielding) {
      const bool is_beam = part.name.starts_with("beam");
      const double expected = is_beam ? 628.4e-6 * 355e6 : 1104e-6 * 235e6;
      EXPECT_NEAR(part.parameter("yield_moment"), expected, 1e-3 * expected) << part.name;
    }
  }
  refused("{beams: {at: both, strength: 355 MPa, yield_moment: 1 MN m}}", "4:", mentions({"yield_moment", "strength"}));
  refused("{beams: {at: both, strength: material}}", "4:", mentions({"S355", "strength: 355 MPa"}));
}

// The hinges of a loaded beam start from its moment at rest.
TEST(HingeInput, HingesStartFromTheMomentAtRest) {
  const Structure s = structure(steel + "hinges: {beams: {at: both, strength: material}}");
  const double k = 8356e-8 / 10820e-8 * 3 / 6, moment = 25e3 * 36 / (6 * (k + 2));
  for (const YieldingPart& part : s.yielding)
    EXPECT_NEAR(std::abs(part.stiffness() * part.at_rest), moment, 0.02 * moment)
        << "Kleinlogel's portal, without axial and shear deformation";
}

}  // namespace hinge_input_test
}  // namespace pounding
