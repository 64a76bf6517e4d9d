// Damping models against the ratios of their closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/input/resolved.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/isolators.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace damping_models_test {

using test::at, test::mentions;

const std::string isolator =
    ", isolator: {lead_rubber: {strength: 375 kN, yield_displacement: 12 mm, post_yield_stiffness: 3.5 MN/m}}";

std::string yaml_of(const std::string& damping, const std::string& more = "") {
  return "structures:\n  a: {shear_building: {storeys: 4, mass: [300 t, 250 t, 200 t, 100 t], stiffness: " +
         std::string(more.empty() ? "[400 MN/m, 100 MN/m, 300 MN/m, 200 MN/m]" : "[100 MN/m, 300 MN/m, 200 MN/m]") +
         more + "}, damping: " + damping + "}\nanalysis: {duration: 1}\n";
}

Structure building(const std::string& damping, const std::string& more = "") {
  Model model = test::model_of(yaml_of(damping, more));
  return std::move(model.structures[0]);
}

double ratio(const Structure& s, int mode) { return modes(s)[mode - 1].damping_ratio; }
double frequency(const Structure& s, int mode) { return 2 * M_PI / modes(s)[mode - 1].period; }

void refused(const std::string& damping, const std::string& location, const test::Facts& facts,
             const std::string& more = "", std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal<InputError>([&] { building(damping, more); }), "test.yaml:" + location, facts,
                       line);
}

TEST(DampingModels, FactorsGiveTheRatioOfEveryMode) {
  test::Book book("Oscillators and shear buildings", "Rayleigh damping: ratio alpha/(2 w) + beta w/2", "rounding");
  const Structure s = building("{rayleigh: {alpha: 0.3, beta: 0.002 s}}");
  EXPECT_EQ(s.by_mass, 0.3);
  EXPECT_EQ(s.by_stiffness, 0.002);
  for (int mode = 1; mode <= 4; ++mode) {
    const double w = frequency(s, mode);
    book.near("damping ratio of each mode [-]", ratio(s, mode), 0.3 / (2 * w) + 0.002 * w / 2, 1e-12);
  }
  EXPECT_EQ(building("{rayleigh: {beta: 0.002}}").by_mass, 0);
  EXPECT_EQ(building("{mass_proportional: {alpha: 0.6 1/s}}").by_mass, 0.6);
  EXPECT_EQ(building("{stiffness_proportional: {beta: 4 ms}}").by_stiffness, 0.004);
}

TEST(DampingModels, ProportionalDampingHasItsRatioInOneMode) {
  for (const int mode : {1, 3}) {
    const std::string text = "ratio: 5 %, mode: " + std::to_string(mode);
    const Structure by_mass = building("{mass_proportional: {" + text + "}}");
    const Structure by_stiffness = building("{stiffness_proportional: {" + text + "}}");
    EXPECT_EQ(by_mass.by_stiffness, 0);
    EXPECT_EQ(by_stiffness.by_mass, 0);
    for (int other = 1; other <= 4; ++other) {
      const double times = frequency(by_mass, other) / frequency(by_mass, mode);
      EXPECT_NEAR(ratio(by_mass, other), 0.05 / times, 1e-12);
      EXPECT_NEAR(ratio(by_stiffness, other), 0.05 * times, 1e-12);
    }
  }
  const Structure at_period = building("{stiffness_proportional: {ratio: 5 %, period: 0.8 s}}");
  EXPECT_NEAR(at_period.by_stiffness, 0.05 * 0.8 / M_PI, 1e-15);
  EXPECT_NEAR(building("{mass_proportional: {ratio: 5 %, period: 0.8 s}}").by_mass, 0.05 * 4 * M_PI / 0.8, 1e-12);
}

TEST(DampingModels, ModalRatiosAreThoseOfTheirModes) {
  const Structure s = building("{modal: {ratios: [5 %, 3 %], others: 2 %}}");
  const std::vector<double> expected{0.05, 0.03, 0.02, 0.02};
  for (int mode = 1; mode <= 4; ++mode) EXPECT_NEAR(ratio(s, mode), expected[mode - 1], 1e-12);
  const Eigen::MatrixXd damping = s.whole_damping();
  const Eigenmodes all = dense_modes(s.mass, s.stiffness, 4);
  const Eigen::MatrixXd modal = all.shapes.transpose() * damping * all.shapes;
  EXPECT_LT((modal - Eigen::MatrixXd(modal.diagonal().asDiagonal())).cwiseAbs().maxCoeff(), 1e-9 * modal.norm());
  const Structure same = building("{modal: {ratios: [4 %, 4 %, 4 %, 4 %]}}");
  const Structure one = building("{modal: {ratio: 4 %}}");
  EXPECT_LT((Eigen::MatrixXd(same.whole_damping()) - Eigen::MatrixXd(one.whole_damping())).norm(),
            1e-10 * one.whole_damping().norm());
  EXPECT_TRUE(mentions(s.damping_note, {"5, 3 %", "2 %", "1 to 2"}));
}

TEST(DampingModels, OfTheSuperstructureLeavesIsolatorsUndamped) {
  const Structure plain = building("2 %", isolator);
  const Structure same = building("{stiffness_proportional: {ratio: 2 %, mode: 1}}", isolator);
  const Structure named = building("{stiffness_proportional: {ratio: 2 %}, of: superstructure}", isolator);
  EXPECT_EQ(Eigen::MatrixXd(plain.whole_damping()), Eigen::MatrixXd(same.whole_damping()));
  EXPECT_EQ(Eigen::MatrixXd(plain.whole_damping()), Eigen::MatrixXd(named.whole_damping()));
  for (const char* damping : {"{rayleigh: {beta: 0.004}}", "{modal: {ratios: [5 %, 2 %], others: 2 %}}"}) {
    const Eigen::MatrixXd matrix = building(damping, isolator).whole_damping();
    EXPECT_LT((matrix * Eigen::Vector4d::Ones()).norm(), 1e-9 * matrix.norm()) << damping;
  }
}

TEST(DampingModels, OfTheInitialStiffnessDampsIsolatorsAsWell) {
  const Structure s = building("{rayleigh: {ratio: 2 %, modes: [1, 2]}, of: initial}", isolator);
  EXPECT_NEAR(ratio(s, 1), 0.02, 1e-12);
  EXPECT_NEAR(ratio(s, 2), 0.02, 1e-12);
  EXPECT_GT((Eigen::MatrixXd(s.whole_damping()) * Eigen::Vector4d::Ones()).norm(), 1e5);
  const Structure modal = building("{modal: {ratio: 2 %}, of: initial}", isolator);
  for (int mode = 1; mode <= 4; ++mode) EXPECT_NEAR(ratio(modal, mode), 0.02, 1e-12);
  const Structure mass = building("{mass_proportional: {ratio: 2 %}, of: initial}", isolator);
  EXPECT_NEAR(ratio(mass, 1), 0.02, 1e-12);
}

TEST(DampingModels, RefuseContradictions) {
  refused("{rayleigh: {ratio: 5 %, alpha: 0.3}}", "2:", {"alpha", "ratio"});
  refused("{rayleigh: {}}", "2:", {"alpha: 0.3"});
  refused("{rayleigh: {alpha: -0.3}}", "2:", {"-0.3"});
  refused("{stiffness_proportional: {ratio: 5 %, mode: 1, period: 1 s}}", "2:", {"mode", "period"});
  refused("{stiffness_proportional: {ratio: 5 %, mode: 5}}", "2:", {"[1, 4]"});
  refused("{modal: {ratios: [5 %, 3 %]}}", "2:", {"others: 2 %", "4"});
  refused("{modal: {ratios: [5 %, 3 %, 3 %, 3 %, 3 %]}}", "2:", {"4", "5"});
  refused("{modal: {ratio: 5 %}, rayleigh: {ratio: 5 %}}", "2:", {"rayleigh", "modal"});
  refused("{modal: {ratio: 5 %}, of: superstructure}", "2:", {"of: initial"});
  refused("{mass_proportional: {ratio: 5 %}}", "2:", {"of: initial", "damping: 2 %"}, isolator);
  refused("{rayleigh: {alpha: 0.3, beta: 0.002}}", "2:", {"of: initial"}, isolator);
}

TEST(DampingModels, CheckPrintsTheRatiosOfTheLowestModes) {
  const Model model = test::model_of(yaml_of("{modal: {ratios: [5 %, 3 %], others: 2 %}}"));
  const std::vector<double> ratios = damping_ratios(model.structures[0]);
  ASSERT_EQ(ratios.size(), 4u);
  EXPECT_NEAR(ratios[1], 0.03, 1e-12);
  EXPECT_NE(resolved_yaml(model).find("damping_ratios: ["), std::string::npos);
  const Structure rayleigh = building("{rayleigh: {alpha: 0.3, beta: 0.002 s}}");
  const std::vector<double> closed = damping_ratios(rayleigh);
  for (int mode = 1; mode <= 4; ++mode) EXPECT_NEAR(closed[mode - 1], ratio(rayleigh, mode), 1e-12);
}

}  // namespace damping_models_test
}  // namespace pounding
