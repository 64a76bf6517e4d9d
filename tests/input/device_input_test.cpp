// Devices in the input: their models, and the location and text of errors.

#include <gtest/gtest.h>

#include <string>

#include <pounding/input/resolved.hpp>
#include <pounding/reports/describe.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace device_input_test {

std::string inside(const std::string& device) {
  return "ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 3}}\nstructures: {a: {shear_building: "
         "{storeys: 3, mass: 100 t, stiffness: 90 MN/m, damping: 5 %, devices: {brace: " +
         device + "}}}}\n";
}

std::string in_frame(const std::string& device) {
  return "ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 3}}\nstructures: {a: {frame: {material: {E: "
         "30 GPa}, damping: 5 %, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 4 m, columns: {rectangle: "
         "[0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 40 t}, devices: {brace: " +
         device + "}}}}\n";
}

std::string between(const std::string& device) {
  return "ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 3}}\nstructures:\n  left: {oscillator: "
         "{mass: 100 t, period: 0.5, damping: 5 %}}\n  right: {oscillator: {mass: 100 t, period: 0.7, damping: 5 "
         "%}}\ndevices: {tie: {between: [left, right], " +
         device + "}}\n";
}

std::string refusal(const std::string& yaml) {
  return test::refusal<std::exception>([&] { test::model_of(yaml); });
}

TEST(DeviceInput, BecomesAPartThatYields) {
  const Model model =
      test::model_of(inside("{between: [1, 3], bouc_wen: {stiffness: 80 MN/m, yield_force: 600 kN, hardening: 0.02}}"));
  const Structure& s = model.structures[0];
  ASSERT_EQ(s.yielding.size(), 1u);
  const YieldingPart& part = s.yielding[0];
  EXPECT_EQ(part.name, "brace");
  EXPECT_EQ(part.law, "bouc_wen");
  EXPECT_EQ(Eigen::Vector3d(part.deformation), Eigen::Vector3d(-1, 0, 1));
  EXPECT_DOUBLE_EQ(part.first_slope(), 80e6);
  EXPECT_DOUBLE_EQ(part.yield_deformation(), 600e3 / 80e6);
  EXPECT_EQ(s.members_that_yield(), 0u);
  EXPECT_TRUE(test::mentions(describe(model), {"bouc_wen", "80 MN/m", "600 kN", "1", "3"}));
  // The device carries the shear of the two storeys that it spans.
  EXPECT_EQ(s.floors[0].storey_shear_by_yielding[0].sum(), 0);
  EXPECT_EQ(s.floors[1].storey_shear_by_yielding[0].sum(), 1);
  EXPECT_EQ(s.floors[2].storey_shear_by_yielding[0].sum(), 1);
}

// Forces of such devices would be round-off, and runs would be slow or never end.
TEST(DeviceInput, HasALimitedStiffness) {
  const auto expect = [](const std::string& yaml, const test::Facts& facts) {
    EXPECT_TRUE(test::mentions(refusal(yaml), facts));
  };
  for (const char* stiffness : {"4.0e19", "1e300", "1e16 MN/m"}) {
    expect(between(std::string("damper: {coefficient: 2e6, exponent: 0.5, stiffness: ") + stiffness + "}"),
           {"tie.damper", "stiffness"});
    expect(inside(std::string("{storey: 2, damper: {coefficient: 2e6, exponent: 0.5, stiffness: ") + stiffness + "}}"),
           {"brace.damper", "stiffness"});
    expect(in_frame(std::string("{between: [\"0.0\", \"1.1\"], damper: {coefficient: 2e6, stiffness: ") + stiffness +
                    "}}"),
           {"brace.damper", "stiffness"});
  }
  expect(between("bar: {stiffness: 1e25}"), {"tie.bar", "1e+25 N/m", "1.58e+07 N/m"});
  expect(inside("{between: [1, 3], bar: {stiffness: 1e20}}"), {"brace.bar"});
  expect(in_frame("{between: [\"0.0\", \"1.1\"], bar: {stiffness: 1e25}}"), {"brace.bar"});
  expect(between("damper: {coefficient: 1e19, exponent: 0.3}"), {"tie.damper"});
  expect(inside("{storey: 1, damper: {coefficient: 1e25}}"), {"brace.damper"});
  expect(between("bilinear: {stiffness: 1e20, yield_force: 600 kN}"), {"tie.bilinear"});
  for (const char* device :
       {"bar: {stiffness: 1e12}", "bar: {stiffness: 1e17}", "damper: {coefficient: 1e12}",
        "damper: {coefficient: 1e12, exponent: 0.3}", "damper: {coefficient: 2e6, exponent: 0.5, stiffness: 4e12}",
        "bilinear: {stiffness: 1e12, yield_force: 600 kN}"})
    EXPECT_EQ(refusal(between(device)), "taken") << device;
}

TEST(DeviceInput, OfAFrameIsNotAHinge) {
  const std::string resolved =
      resolved_yaml(test::model_of(in_frame("{between: [\"0.0\", \"1.1\"], bar: {stiffness: 1 MN/m}}")));
  EXPECT_NE(resolved.find("devices:"), std::string::npos) << resolved;
  EXPECT_EQ(resolved.find("hinges:"), std::string::npos) << resolved;
}

TEST(DeviceInput, ActsAlongTheLineOfItsNodesOrAnAxis) {
  const Model along =
      test::model_of(in_frame("{between: [\"0.0\", \"1.1\"], bilinear: {stiffness: 80 MN/m, yield_force: 600 kN}}"));
  const Structure& s = along.structures[0];
  // The line rises 3 m over 4 m.
  const auto along_x = [](const Structure& of) {
    const Eigen::VectorXd whole = of.supports[0].influence.col(0);
    return of.yielding[0].deformation.dot(whole);
  };
  EXPECT_NEAR(along_x(s), 0.8, 1e-12);
  EXPECT_NEAR(s.floors[0].storey_shear_by_yielding[0].coeff(0), 0.8, 1e-12);
  EXPECT_EQ(s.floors[1].storey_shear_by_yielding[0].sum(), 0);
  const Model level =
      test::model_of(in_frame("{between: [\"0.0\", \"1.1\"], axis: x, damper: {coefficient: 200 kN s/m}}"));
  EXPECT_NEAR(along_x(level.structures[0]), 1, 1e-12);
  const Model grounded = test::model_of(in_frame("{between: [\"1.1\", ground], bar: {stiffness: 1 MN/m}}"));
  EXPECT_NEAR(along_x(grounded.structures[0]), -1, 1e-12) << "it shortens if the node moves away along x";
}

TEST(DeviceInput, ReportsTheLocationOfErrors) {
  const auto expect = [](const std::string& yaml, const test::Facts& facts) {
    const std::string text = refusal(yaml);
    EXPECT_NE(text, "taken") << yaml;
    EXPECT_TRUE(test::mentions(text, facts));
  };
  expect(inside("{storey: 1}"), {"bar: {stiffness: 50 MN/m}"});
  expect(inside("{bar: {stiffness: 1 MN/m}}"), {"between: [ground, 2]", "storey: 1"});
  expect(inside("{storey: 4, bar: {stiffness: 1 MN/m}}"), {"1", "3", "4"});
  expect(inside("{storey: 1, between: [1, 2], bar: {stiffness: 1 MN/m}}"), {"storey", "between"});
  expect(inside("{between: [2, 2], bar: {stiffness: 1 MN/m}}"), {"2"});
  expect(inside("{storey: 1, axis: y, bar: {stiffness: 1 MN/m}}"), {});
  expect(inside("{storey: 1, axis: along, bar: {stiffness: 1 MN/m}}"), {"axis: x"});
  expect(inside("{storey: 1, bilinear: {yield_force: 600 kN}}"), {"stiffness: 10 MN/m", "brace.bilinear"});
  expect(inside("{storey: 1, bilinear: {stiffness: 1 MN/m, yield_force: 0 kN}}"), {"brace.bilinear.yield_force", "0"});
  expect(inside("{storey: 1, bouc_wen: {stiffness: 1 MN/m, yield_force: 1 kN, gamma_share: 2}}"), {"bouc_wen"});
  expect(inside("{storey: 1, bar: {stiffness: 1 MN/m}, bilinear: {stiffness: 1 MN/m, yield_force: 1 kN}}"), {"bar"});
  expect(inside("{storey: 1, bouc_wen: {stiffness: 1 MN/m, yield_force: 1 kN}, bilinear: {stiffness: 1 MN/m, "
                "yield_force: 1 kN}}"),
         {});
  expect(inside("{storey: 1, damper: {coefficient: 2e5, exponent: 2.5, stiffness: 40 MN/m}}"), {"exponent", "2"});
  expect(
      inside("{storey: 1, damper: {coefficient: 2e5, exponent: 0.5, stiffness: 40 MN/m, rounding_velocity: 1 mm/s}}"),
      {"damper.rounding_velocity"});
  expect(inside("{storey: 1, damper: {coefficient: 2e5, stiffness: 0}}"), {"stiffness"});
  expect(in_frame("{storey: 1, bar: {stiffness: 1 MN/m}}"), {});
  expect(in_frame("{between: [\"0.0\", \"9.9\"], bar: {stiffness: 1 MN/m}}"), {"9.9"});
  expect(in_frame("{between: [\"0.0\", \"0.1\"], bar: {stiffness: 1 MN/m}}"), {"0.0", "0.1"});
  expect(between("bilinear: {stiffness: 1 MN/m}"), {"yield_force: 150 kN", "devices.tie.bilinear"});
  expect(between("bilinear: {stiffness: 1 MN/m, yield_force: 1 kN, hardening: 1.2}"), {"hardening"});
}

}  // namespace device_input_test
}  // namespace pounding
