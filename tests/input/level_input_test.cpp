// Nearly level floors form one pair for every choice of floors, and no column is hit there.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include "support/models.hpp"

namespace pounding {
namespace level_input_test {

using test::at, test::mentions, test::model_of, test::refused;

// Two frames of three storeys; the floors of the second are raised by `higher`.
std::string pair(double higher, const std::string& rest, const std::string& between = "[a, b]", double beam = 0.5) {
  const auto frame = [&](const std::string& name, const std::string& origin, double first) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}], mass: consistent, material: {{E: 30 GPa, density: 2500}}, grid: {{storeys: 3, "
        "bays: 1, storey_height: [{}, 3.2, 3.2], bay_width: 6 m, columns: {{rectangle: [0.5, 0.5]}}, beams: "
        "{{rectangle: [0.3, {}]}}, floor_mass: 60 t}}}}, damping: 5 %}}\n",
        name, origin, first, beam);
  };
  return "structures:\n" + frame("a", "0 m", 3.2) + frame("b", "6.02 m", 3.2 + higher) +
         "links: [{between: " + between + ", " + rest + ", law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
}

std::vector<std::string> names(const std::string& yaml) {
  std::vector<std::string> all;
  for (const Link& link : model_of(yaml).links) all.push_back(link.name);
  return all;
}

using Names = std::vector<std::string>;
const Names level{"a.1-b.1", "a.2-b.2", "a.3-b.3"};

TEST(LevelFloors, AreOnePairWithinTheDepthOfTheDeeperBeam) {
  for (const double higher : {0.0, 0.0005, 0.01, 0.05, 0.45, -0.01, -0.45})
    for (const char* floors : {"floors: any", "floors: all", "floors: level"})
      EXPECT_EQ(names(pair(higher, floors)), level) << higher << ' ' << floors;
  for (const char* floors : {"floors: any", "floors: level", "within: 1 m"})
    EXPECT_EQ(names(pair(0.01, floors, "neighbours")), level) << floors;
  EXPECT_EQ(names(pair(0.04, "floors: any", "[a, b]", 0.03)), level) << "at least 50 mm";
  EXPECT_EQ(names(pair(0.06, "floors: any", "[a, b]", 0.03)).size(), 5u);
  EXPECT_EQ(names(pair(0.7, "floors: all", "[a, b]", 0.8)), level) << "beams may be deeper than half a metre";
  EXPECT_EQ(names(pair(0.7, "floors: all", "neighbours", 0.8)), level);
  EXPECT_EQ(names(pair(0.6, "floors: all", "[a, b]", 0.6)), level) << "up to the depth of the beam";
  EXPECT_EQ(names(pair(0.55, "floors: any")),
            (Names{"a.1-b@3.2m", "a@3.75m-b.1", "a.2-b@6.4m", "a@6.95m-b.2", "a.3-b@9.6m"}));
}

TEST(LevelFloors, AreNotPairedByBeamsThatModelRigidFloors) {
  EXPECT_EQ(names(pair(0.04, "floors: any", "[a, b]", 10)), level);
  EXPECT_EQ(names(pair(1, "floors: any", "[a, b]", 10)).size(), 5u) << "1 m apart, and a beam of 10 m";
  EXPECT_EQ(names(pair(1, "floors: any", "[a, b]", 1.1)), level);
}

TEST(LevelFloors, AreThoseOfAGivenDifference) {
  EXPECT_EQ(names(pair(0.55, "floors: any, level_within: 0.6 m")), level);
  EXPECT_EQ(names(pair(0.55, "floors: any, level_within: 0.6 m", "neighbours")), level);
  EXPECT_EQ(names(pair(0.01, "floors: any, level_within: 5 mm")).size(), 5u);
  EXPECT_EQ(names(pair(0.01, "floors: any, level_within: 0", "neighbours")).size(), 5u);
  EXPECT_EQ(names(pair(0, "floors: any, level_within: 0")), level);
  refused(pair(0.01, "floors: level, level_within: 5 mm"), at("4:19", "links[0].between"), mentions({"floors: any"}));
  refused(pair(0, "floors: any, level_within: -1 mm"), at("4:54", "links[0].level_within"),
          mentions({"20 mm", "-1 mm"}));
  const std::vector<std::string> warnings = implausible(model_of(pair(0, "floors: any, level_within: 50")));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(mentions(warnings[0], {"accept: [height]", "[0]", "2 m", "50 mm"}));
}

// A floor belongs to one pair: the nearest two are paired, the other one hits the column.
TEST(LevelFloors, ArePairedWithTheNearest) {
  const std::string low =
      "  {}: {{frame: {{origin: [{}], mass: consistent, material: {{E: 30 GPa, density: 2500}}, grid: {{storeys: {}, "
      "bays: 1, storey_height: {}, bay_width: 6 m, columns: {{circle: 0.3}}, beams: {{rectangle: [0.3, 0.6]}}, "
      "floor_mass: 60 t}}}}, damping: 5 %}}\n";
  const std::string yaml =
      "structures:\n" + fmt::format(fmt::runtime(low), "a", "0 m", 3, "[3, 0.5, 3]") +
      fmt::format(fmt::runtime(low), "b", "6.02 m", 2, "[3.3, 3.2]") +
      "links: [{between: [a, b], floors: any, law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
  EXPECT_EQ(names(yaml), (Names{"a.1-b@3m", "a.2-b.1", "a.3-b.2"}));
}

TEST(LevelFloors, OfShearBuildingsAreWithin50Millimetres) {
  const auto sticks = [](double height, const std::string& floors) {
    return fmt::format(
        "structures:\n  a: {{shear_building: {{storeys: 2, mass: 100 t, stiffness: 100 MN/m, height: 3}}, damping: 5 "
        "%}}\n  b: {{shear_building: {{storeys: 2, mass: 100 t, stiffness: 100 MN/m, height: {}}}, damping: 5 "
        "%}}\nlinks: [{{between: [a, b], floors: {}, gap: 20 mm, law: hertz, stiffness: 2.75e9}}]\nanalysis: "
        "{{duration: 1}}\n",
        height, floors);
  };
  for (const char* floors : {"any", "all", "level"})
    EXPECT_EQ(names(sticks(3.02, floors)), (Names{"a.1-b.1", "a.2-b.2"})) << floors;
  EXPECT_THROW(model_of(sticks(3.1, "all")), InputError);
}

TEST(LevelFloors, AreReportedWithTheirDifference) {
  EXPECT_TRUE(mentions(describe(model_of(pair(0.01, "floors: any"))), {"20 mm", "10 mm", "hertz", "a.1-b.1"}));
  EXPECT_FALSE(mentions(describe(model_of(pair(0, "floors: any"))), {"10 mm"}));
}

TEST(Joints, CauseAWarningIfAColumnIsHitWithinItsDepth) {
  const std::vector<std::string> warnings = implausible(model_of(pair(0.01, "floors: any, level_within: 0")));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(mentions(warnings[0], {"accept: [joint]", "level_within: 10 mm", "a.1", "500 mm", "3.2m", "4"}));
  EXPECT_TRUE(implausible(model_of(pair(0.6, "floors: any"))).empty());
  EXPECT_TRUE(implausible(model_of(pair(0.01, "floors: any"))).empty());
  // Also for a subdivided column, and for a given elevation.
  std::string cut = pair(0.01, "gap: 20 mm", "[a.1, {structure: b, elevation: 3.2 m}]");
  EXPECT_EQ(implausible(model_of(cut)).size(), 1u);
  cut.replace(cut.find("}, grid", cut.find("  b:")), 1, "}, members: {columns: {parts: 4}}");
  EXPECT_EQ(implausible(model_of(cut)).size(), 1u);
}

}  // namespace level_input_test
}  // namespace pounding
