// Structures built from numbers and from inputs, against closed forms.

#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <pounding/input/resolved.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/oscillators.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace oscillators_test {

using test::model_of;

double damping_ratio(const Structure& s, int mode) { return modes(s)[mode].damping_ratio; }

// Eigen 3.4 copies a sparse matrix on a move. An exception thrown from a noexcept move would terminate the process.
static_assert(!std::is_nothrow_move_constructible_v<Structure> || std::is_nothrow_move_constructible_v<SparseMatrix>);
static_assert(!std::is_nothrow_move_assignable_v<Structure> || std::is_nothrow_move_assignable_v<SparseMatrix>);

TEST(Oscillator, HasTheMatricesOfItsMassAndSpring) {
  test::Book book("Oscillators and shear buildings", "oscillator: 2 pi sqrt(m/k)", "rounding");
  const Structure s = make_oscillator({.mass = 1e5, .stiffness = 4e6, .damping_ratio = 0.05});
  EXPECT_EQ(s.mass.coeff(0, 0), 1e5);
  EXPECT_EQ(s.stiffness.coeff(0, 0), 4e6);
  EXPECT_DOUBLE_EQ(s.damping.coeff(0, 0), 2 * 0.05 * std::sqrt(4e6 * 1e5));
  book.near("period [s]", modes(s)[0].period, 2 * M_PI * std::sqrt(1e5 / 4e6), 1e-12);
  book.near("damping ratio [-]", damping_ratio(s, 0), 0.05, 1e-14);
}

TEST(Oscillator, FollowsFromItsPeriod) {
  const Model model = model_of(
      "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}\n"
      "analysis: {duration: 1}\n");
  const Structure& s = model.structures[0];
  EXPECT_NEAR(modes(s)[0].period, 0.8, 1e-14);
  EXPECT_NEAR(damping_ratio(s, 0), 0.05, 1e-14);
}

TEST(Oscillator, RefusesWhatCannotBe) {
  EXPECT_THROW(make_oscillator({.mass = 0, .stiffness = 1}), std::invalid_argument);
  EXPECT_THROW(make_oscillator({.mass = 1, .stiffness = -1}), std::invalid_argument);
  EXPECT_THROW(make_oscillator({.mass = 1, .stiffness = 1, .damping_ratio = -0.1}), std::invalid_argument);
  EXPECT_THROW(make_body({.mass = std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(make_shear_building({.storeys = 2, .mass = {1, 2}, .stiffness = {1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(make_shear_building({}), std::invalid_argument);
  EXPECT_NO_THROW(make_shear_building({.storeys = 2, .mass = {1, 2}, .stiffness = {1, 1e9}}));
  EXPECT_THROW(make_shear_building({.storeys = 2, .mass = {1, 2}, .stiffness = {1e22, 9e7}}), std::invalid_argument);
}

TEST(ShearBuilding, HasTheMatricesOfItsStoreysFromTheGroundUp) {
  const Structure s = make_shear_building({.storeys = 3, .mass = {10, 20, 30}, .stiffness = {400, 500, 600}});
  Eigen::Matrix3d stiffness, mass;
  stiffness << 400 + 500, -500, 0, -500, 500 + 600, -600, 0, -600, 600;
  mass << 10, 0, 0, 0, 20, 0, 0, 0, 30;
  EXPECT_EQ(Eigen::MatrixXd(s.stiffness), stiffness);
  EXPECT_EQ(Eigen::MatrixXd(s.mass), mass);
  ASSERT_EQ(s.floors.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(s.floors[i].label, std::to_string(i + 1));
}

TEST(ShearBuilding, OfEqualStoreysHasTheFrequenciesOfTheClosedForm) {
  test::Book book("Oscillators and shear buildings",
                  "Chopra, Dynamics of Structures: w_j = 2 sqrt(k/m) sin((2j-1) pi/(2(2N+1)))",
                  "round-off of the largest eigenvalue");
  for (const int storeys : {1, 2, 7, 40}) {
    const double m = 2.5e5, k = 2.2e8;
    const Structure s = make_shear_building({.storeys = storeys, .mass = m, .stiffness = k});
    const std::vector<Mode> found = modes(s);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(storeys));
    for (int j = 1; j <= storeys; ++j) {
      const double w = 2 * std::sqrt(k / m) * std::sin((2 * j - 1) * M_PI / (2 * (2 * storeys + 1)));
      book.near("squares of the frequencies, " + std::to_string(storeys) + " equal storeys [1/s^2]",
                std::pow(2 * M_PI / found[j - 1].period, 2), w * w, 1e-12 * 4 * k / m);
    }
  }
}

TEST(ShearBuilding, HasEffectiveMassesThatAddUpToItsMass) {
  test::Book book("Oscillators and shear buildings",
                  "completeness of the modes: effective masses add up to the mass, participations reproduce a unit "
                  "displacement",
                  "rounding");
  const Structure s =
      make_shear_building({.storeys = 4, .mass = {3e5, 2.5e5, 2e5, 1e5}, .stiffness = {4e8, 1e8, 3e8, 2e8}});
  double effective = 0;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(4);
  for (const Mode& mode : modes(s)) {
    effective += mode.effective_mass[0];
    moved += mode.participation[0] * mode.shape.col(0);
    EXPECT_DOUBLE_EQ(mode.shape(3, 0), 1) << "shapes are normalized at the top floor";
  }
  book.near("sum of the effective masses [kg]", effective, 8.5e5, 1e-9 * 8.5e5);
  // Participation factors times shapes reproduce the unit displacement of every floor.
  for (const double floor : moved) book.near("sum of participation times shape [-]", floor, 1, 1e-11);
}

TEST(Modes, OfABodyIsOneOfInfinitePeriodAndAWallHasNone) {
  EXPECT_TRUE(std::isinf(modes(make_body({.mass = 10})).at(0).period));
  EXPECT_DOUBLE_EQ(modes(make_body({.mass = 10})).at(0).effective_mass[0], 10);
  EXPECT_TRUE(modes(make_wall()).empty());
}

Structure building(const std::string& damping) {
  Model model = model_of(
      "structures:\n  a: {shear_building: {storeys: 4, mass: [300 t, 250 t, 200 t, 100 t], stiffness: "
      "[400 MN/m, 100 MN/m, 300 MN/m, 200 MN/m]}, damping: " +
      damping + "}\nanalysis: {duration: 1}\n");
  return std::move(model.structures[0]);
}

TEST(RayleighDamping, HasItsRatioInItsTwoModes) {
  test::Book book("Oscillators and shear buildings", "Rayleigh damping: the requested ratio in modes 1 and 3",
                  "rounding");
  const Structure s = building("{rayleigh: {ratio: 3 %, modes: [1, 3]}}");
  book.near("damping ratio of mode 1 [-]", damping_ratio(s, 0), 0.03, 1e-12);
  book.near("damping ratio of mode 3 [-]", damping_ratio(s, 2), 0.03, 1e-12);
  EXPECT_LT(damping_ratio(s, 1), 0.03) << "between the two modes it is less";
  EXPECT_GT(damping_ratio(s, 3), 0.03) << "beyond them it is more";
}

TEST(RayleighDamping, IsWhatAPlainRatioMeansWithModesOneAndTwo) {
  const Structure plain = building("3 %");
  for (const char* same : {"{rayleigh: {ratio: 3 %, modes: [1, 2]}}", "{rayleigh: {ratio: 3 %}}"}) {
    EXPECT_EQ(plain.by_mass, building(same).by_mass);
    EXPECT_EQ(plain.by_stiffness, building(same).by_stiffness);
  }
  EXPECT_NEAR(damping_ratio(building("3 %"), 1), 0.03, 1e-12);
}

TEST(RayleighDamping, MayBeGivenByPeriods) {
  const Structure by_modes = building("{rayleigh: {ratio: 3 %, modes: [1, 2]}}");
  const std::vector<Mode> m = modes(by_modes);
  const Structure by_periods = building("{rayleigh: {ratio: 3 %, periods: [" + std::to_string(m[0].period) + ", " +
                                        std::to_string(m[1].period) + "]}}");
  // Six decimals of a period of about 0.1 s.
  EXPECT_NEAR(by_periods.by_mass, by_modes.by_mass, 1e-4 * by_modes.by_mass);
  EXPECT_NEAR(by_periods.by_stiffness, by_modes.by_stiffness, 1e-4 * by_modes.by_stiffness);
}

TEST(ModalDamping, HasItsRatioInEveryMode) {
  test::Book book("Oscillators and shear buildings", "modal damping: the requested ratio in every mode", "rounding");
  const Structure s = building("{modal: {ratio: 3 %}}");
  for (int i = 0; i < 4; ++i) book.near("damping ratio of each mode [-]", damping_ratio(s, i), 0.03, 1e-12);
  const Eigen::MatrixXd damping = s.whole_damping();
  EXPECT_LT((damping - damping.transpose()).norm(), 1e-12 * damping.norm());
}

TEST(ModalDamping, IsTheSameWithAndWithoutItsMatrix) {
  Structure s = building("{modal: {ratio: 3 %}}");
  ASSERT_GT(s.modal_damping.nonZeros(), 0);
  const Eigen::MatrixXd damping = s.whole_damping();
  const std::vector<Mode> with = modes(s);
  s.modal_damping = {};
  EXPECT_EQ(Eigen::MatrixXd(s.whole_damping()), damping);
  EXPECT_EQ(s.formed_damping().norm(), 0);
  for (std::size_t i = 0; i < with.size(); ++i)
    EXPECT_NEAR(modes(s)[i].damping_ratio, with[i].damping_ratio, 1e-12) << i;
}

TEST(ModalDamping, OfTooManyModesHasNoMatrix) {
  SparseMatrix one(1501, 1501);
  one.setIdentity();
  try {
    modal_damping_matrix(one, one, 0.05);
    ADD_FAILURE() << "a dense matrix of 1501 modes was formed";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(
        test::mentions(std::string(error.what()), {"damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}", "1501"}));
  }
}

TEST(Damping, OfZeroIsNone) { EXPECT_EQ(building("0").whole_damping().norm(), 0); }

const std::string two_structures =
    "structures:\n"
    "  left:  {shear_building: {storeys: 2, mass: [10, 20], stiffness: [300, 500], damping: 0}, initial_velocity: [1, "
    "2]}\n"
    "  w:     {wall: {}}\n"
    "  right: {oscillator: {mass: 40, stiffness: 600, damping: 0}, initial_displacement: 1 mm}\n";

TEST(Assembly, PutsStructuresBesideEachOtherAndLinksBetweenThem) {
  const Model model = model_of("ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\n" + two_structures +
                               "links:\n"
                               "  - {between: [left.2, right], gap: 20 mm, law: hertz, stiffness: 1e9}\n"
                               "  - {between: [w, left.1], gap: 30 mm, law: hertz, stiffness: 1e9}\n"
                               "analysis: {duration: 1}\n");
  const System system = assemble(model);
  Eigen::Matrix3d stiffness;
  stiffness << 800, -500, 0, -500, 500, 0, 0, 0, 600;
  EXPECT_EQ(Eigen::MatrixXd(system.stiffness), stiffness);
  EXPECT_EQ(Eigen::Vector3d(system.mass.diagonal()), Eigen::Vector3d(10, 20, 40));
  EXPECT_EQ(Eigen::Vector3d(system.load), Eigen::Vector3d(10, 20, 40));
  Eigen::Matrix<double, 3, 2> closing;
  closing << 0, -1, 1, 0, -1, 0;
  EXPECT_EQ(Eigen::MatrixXd(system.gap_jacobian), closing);
  EXPECT_EQ(system.contacts.size(), 2u);
  const auto [u, v] = initial_state(model);
  EXPECT_EQ(Eigen::Vector3d(u), Eigen::Vector3d(0, 0, 0.001));
  EXPECT_EQ(Eigen::Vector3d(v), Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(assemble(model, false).links(), 0) << "without pounding";
}

TEST(Links, OfAllFloorsAreNamedFromTheGroundUp) {
  const Model model = model_of(
      "structures:\n"
      "  a: {shear_building: {storeys: 3, mass: 1, stiffness: 1, height: 3 m}, damping: 0}\n"
      "  b: {shear_building: {storeys: 2, mass: 1, stiffness: 1, height: 3 m}, damping: 0}\n"
      "  w: {wall: {}}\n"
      "links:\n"
      "  - {between: [a, b], floors: all, gap: [10 mm, 20 mm], law: hertz, stiffness: 1e9}\n"
      "  - {between: [b, w], floors: all, gap: 5 mm, law: hertz, stiffness: 1e9, name: moat}\n"
      "analysis: {duration: 1}\n");
  ASSERT_EQ(model.links.size(), 4u);
  EXPECT_EQ(model.links[0].name, "a.1-b.1");
  EXPECT_EQ(model.links[1].name, "a.2-b.2");
  EXPECT_EQ(model.links[1].gap, 0.02);
  EXPECT_EQ(model.links[2].name, "moat.1");
  EXPECT_EQ(model.links[3].name, "moat.2");
  EXPECT_EQ(model.links[3].right.floor, -1);
}

double reduced_mass(const std::string& link) {
  return model_of(two_structures + "links:\n  - {gap: 20 mm, law: kelvin_voigt, stiffness: 1e9, restitution: 0.5, " +
                  link + "}\nanalysis: {duration: 1}\n")
      .links[0]
      .reduced_mass;
}

TEST(ReducedMass, IsThatOfTheTwoFloorsUnlessItIsGiven) {
  EXPECT_DOUBLE_EQ(reduced_mass("between: [left.2, right]"), 20.0 * 40 / 60);
  EXPECT_DOUBLE_EQ(reduced_mass("between: [left.1, right]"), 10.0 * 40 / 50);
  EXPECT_DOUBLE_EQ(reduced_mass("between: [w, right]"), 40) << "a wall has infinite mass";
  EXPECT_DOUBLE_EQ(reduced_mass("between: [left.1, w]"), 10);
  EXPECT_DOUBLE_EQ(reduced_mass("between: [left.1, right], reduced_mass: 7 kg"), 7);
}

TEST(ReducedMass, CalibratesTheDamping) {
  // c = 2 zeta sqrt(k m) with the given mass, not with that of the floors.
  const Model model = model_of(two_structures +
                               "links:\n  - {between: [left.1, right], gap: 0, law: kelvin_voigt, stiffness: 100, "
                               "damping_ratio: 0.25, reduced_mass: 9}\nanalysis: {duration: 1}\n");
  const Contact& contact = *model.links[0].contact;
  ContactMemory memory = contact.initial();
  contact.on_event(memory, 0, 0, {0, 1});
  EXPECT_DOUBLE_EQ(contact.evaluate(memory, {0.1, 0}).by_rate, 2 * 0.25 * 30);
  EXPECT_TRUE(model.links[0].reduced_mass_given);
}

TEST(ResolvedInput, SaysEveryDefaultAndCalibratedValue) {
  const Model model = model_of(
      "structures:\n"
      "  a: {oscillator: {mass: 100 t, stiffness: 4 MN/m, damping: 5 %}}\n"
      "  w: {wall: {}}\n"
      "links:\n"
      "  - {between: [a, w], gap: 20 mm, law: kelvin_voigt_no_tension, stiffness: 93500 kN/m, "
      "restitution: 0.65}\n"
      "analysis: {duration: 2}\n");
  const YAML::Node resolved = YAML::Load(resolved_yaml(model));
  const YAML::Node link = resolved["links"][0];
  EXPECT_EQ(link["name"].as<std::string>(), "a-w");
  EXPECT_EQ(link["between"][0].as<std::string>(), "a.1");
  EXPECT_EQ(link["between"][1].as<std::string>(), "w");
  EXPECT_EQ(link["gap"].as<double>(), 0.02);
  EXPECT_EQ(link["formula"].as<std::string>(), "exact");
  EXPECT_EQ(link["reduced_mass"].as<double>(), 1e5);
  EXPECT_NE(link["reduced_mass_from"].as<std::string>(), "");
  EXPECT_EQ(link["parameters"]["stiffness"].as<double>(), 9.35e7);
  // For contact until F = 0 a damping ratio z gives e = exp(-2 z arccos z/sqrt(1 - z^2)).
  const double z = link["parameters"]["damping_ratio"].as<double>();
  EXPECT_NEAR(std::exp(-2 * z * std::acos(z) / std::sqrt(1 - z * z)), 0.65, 1e-12);
  EXPECT_EQ(resolved["analysis"]["tolerance"].as<double>(), 1e-4);
  EXPECT_EQ(resolved["analysis"]["output_step"].as<double>(), 0.002);
  EXPECT_NEAR(resolved["structures"]["a"]["damping_matrix"][0].as<double>(), 2 * 0.05 * std::sqrt(4e6 * 1e5), 1e-6);
}

}  // namespace oscillators_test
}  // namespace pounding
