/// The C interface is bitwise identical to the C++ laws, during a whole impact as well.

#include <cmath>
#include <cstring>
#include <random>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>
#include "ball_on_wall.h"
#include "made.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace contract_test {

struct State {
  double penetration, rate;
};

/// A path into and out of contact, with a second compression during restitution.
std::vector<State> random_path(std::mt19937& random) {
  std::uniform_real_distribution<double> deep(1e-3, 1e-2), speed(0.05, 1);
  const double depth = deep(random), v = speed(random);
  std::vector<State> path;
  for (int i = 1; i <= 60; ++i) path.push_back({depth * std::sin(i * 0.05), v * std::cos(i * 0.05)});
  path.insert(path.begin() + 45, {depth, 0.5 * v});
  return path;
}

TEST(CInterface, AnswersAsTheLawsToTheLastBit) {
  std::mt19937 random(11);
  int pressed = 0;
  for (const laws::Settings& s : test::every_setting()) {
    SCOPED_TRACE(test::text(s));
    const test::LawInC in_c = test::made_in_c(s);
    ASSERT_TRUE(in_c) << pnd_error_text();
    std::visit(
        [&](const auto& law) {
          const std::vector<State> path = random_path(random);
          laws::Impact impact = laws::touch(law, path[0].rate);
          pnd_contact contact{};
          ASSERT_EQ(pnd_touch(in_c.get(), path[0].rate, &contact), PND_OK);
          for (const auto& [d, v] : path) {
            const laws::Response expected = law.respond(d, v, impact);
            pnd_response r{};
            ASSERT_EQ(pnd_respond(in_c.get(), &contact, d, v, &r), PND_OK);
            EXPECT_EQ(r.force, expected.force);
            EXPECT_EQ(r.by_penetration, expected.by_penetration);
            EXPECT_EQ(r.by_rate, expected.by_rate);
            pressed += r.force > 0;
            if (laws::leaves_indentation<std::decay_t<decltype(law)>> && !(expected.force > 0)) return;
            laws::keep(law, d, v, impact);
            ASSERT_EQ(pnd_accept(in_c.get(), d, v, &contact), PND_OK);
            EXPECT_EQ(contact.closing_speed, impact.closing_speed);
            EXPECT_EQ(contact.damping, impact.damping);
            EXPECT_EQ(contact.largest_penetration, impact.largest_penetration);
            EXPECT_EQ(contact.slip, impact.slip);
          }
        },
        laws::make_law(s));
  }
  EXPECT_GT(pressed, 1000);
}

TEST(CInterface, CollidesAsTheLawsToTheLastBit) {
  for (const laws::Settings& s : test::every_setting()) {
    SCOPED_TRACE(test::text(s));
    const laws::FreeImpact expected = laws::free_impact(laws::make_law(s), 6e4, 0.8);
    pnd_free_impact r{};
    ASSERT_EQ(pnd_collide(test::made_in_c(s).get(), 6e4, 0.8, &r), PND_OK);
    EXPECT_EQ(r.restitution, expected.restitution);
    EXPECT_EQ(r.peak_force, expected.peak_force);
    EXPECT_EQ(r.peak_penetration, expected.peak_penetration);
    EXPECT_EQ(r.time_of_peak, expected.time_of_peak);
    EXPECT_EQ(r.duration, expected.duration);
    EXPECT_EQ(r.impulse, expected.impulse);
    EXPECT_EQ(r.energy_lost, expected.energy_lost);
  }
}

// Euler's steps are of first order: their error may reach the change of the largest force in one step.
TEST(CInterface, BallComesBackWithTheRestitutionThatWasAsked) {
  const double mass = laws::typical_reduced_mass, speed = 0.5;
  for (const laws::Entry& entry : laws::catalogue()) {
    if (entry.instantaneous) continue;
    SCOPED_TRACE(entry.name);
    const test::LawInC law = test::made_in_c(laws::typical_settings(entry));
    pnd_free_impact impact{};
    ASSERT_EQ(pnd_collide(law.get(), mass, speed, &impact), PND_OK);
    const double requested = entry.takes_restitution    ? laws::typical_restitution
                             : entry.leaves_indentation ? impact.restitution
                                                        : 1;
    for (const double step : {2e-6, 2e-7}) {
      pnd_contact contact{};
      const double after = speed_after(law.get(), mass, speed, step, &contact);
      EXPECT_NEAR(after / speed, requested, impact.peak_force * step / (mass * speed));
      EXPECT_EQ(contact.touching, 0);
    }
  }
}

test::LawInC typical(const char* name) { return test::made_in_c(laws::typical_settings(laws::find_law(name))); }

TEST(CInterface, NothingPressesBeforeAnImpactBeginsAndAfterItEnds) {
  const test::LawInC law = typical("hertz_damped");
  pnd_contact contact{};
  pnd_response r{1, 1, 1};
  ASSERT_EQ(pnd_respond(law.get(), &contact, 1e-3, 0.5, &r), PND_OK);
  EXPECT_EQ(r.force, 0);
  EXPECT_EQ(r.by_penetration, 0);
  EXPECT_EQ(r.by_rate, 0);
  ASSERT_EQ(pnd_accept(law.get(), -1e-3, 0.5, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 0);
  ASSERT_EQ(pnd_accept(law.get(), 1e-4, 0.5, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  EXPECT_EQ(contact.closing_speed, 0.5);
  ASSERT_EQ(pnd_respond(law.get(), &contact, 1e-3, 0.5, &r), PND_OK);
  EXPECT_GT(r.force, 0);
  ASSERT_EQ(pnd_accept(law.get(), 0, -0.3, &contact), PND_OK);
  const pnd_contact apart{};
  EXPECT_EQ(std::memcmp(&contact, &apart, sizeof apart), 0);
}

TEST(CInterface, BodiesThatAlreadyOpenWhenTheyAreSeenToOverlapTouchAtRest) {
  const test::LawInC law = typical("hertz_damped");
  pnd_contact contact{};
  ASSERT_EQ(pnd_accept(law.get(), 1e-4, -0.5, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  EXPECT_EQ(contact.closing_speed, 0);
}

// F = k d + c d' vanishes at d = -c d'/k: this depth remains in the gap, and the next touch is later by it.
TEST(CInterface, KomodromosLeavesItsIndentationInTheGap) {
  const test::LawInC law = typical("komodromos");
  pnd_contact contact{};
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  const double left = contact.damping * 0.3 / 9.35e7;
  ASSERT_EQ(pnd_accept(law.get(), 1.001 * left, -0.3, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  ASSERT_EQ(pnd_accept(law.get(), 0.999 * left, -0.3, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 0);
  EXPECT_EQ(contact.indentation, 0.999 * left);
  ASSERT_EQ(pnd_accept(law.get(), 0.99 * left, 0.3, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 0);
  ASSERT_EQ(pnd_accept(law.get(), 1.5 * left, 0.3, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  EXPECT_EQ(contact.largest_penetration, 1.5 * left - 0.999 * left);
  pnd_response r{};
  ASSERT_EQ(pnd_respond(law.get(), &contact, 1.5 * left, 0.0, &r), PND_OK);
  EXPECT_EQ(r.force, 9.35e7 * (1.5 * left - 0.999 * left));
  ASSERT_EQ(pnd_separate(law.get(), 1.2 * left, &contact), PND_OK);
  EXPECT_DOUBLE_EQ(contact.indentation, 1.2 * left);
}

// k d up to 5 mm, back at 1/e^2 = 4 times the slope: three quarters remain, and the next impact is elastic up to 5 mm.
TEST(CInterface, ElastoplasticRemembersWhatWasCrushed) {
  const test::LawInC law = test::made_in_c({.law = "elastoplastic",
                                            .formula = {},
                                            .restitution = 0.5,
                                            .reduced_mass = 6e4,
                                            .values = {{"stiffness", 1e8}, {"exponent", 1}}});
  ASSERT_TRUE(law) << pnd_error_text();
  pnd_contact contact{};
  ASSERT_EQ(pnd_accept(law.get(), 5e-3, 0.3, &contact), PND_OK);
  ASSERT_EQ(pnd_accept(law.get(), 4e-3, -0.1, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  ASSERT_EQ(pnd_accept(law.get(), 3.7e-3, -0.1, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 0);
  EXPECT_DOUBLE_EQ(contact.indentation, 0.75 * 5e-3);
  EXPECT_DOUBLE_EQ(contact.crushed, 5e-3);
  ASSERT_EQ(pnd_accept(law.get(), 3.7e-3, 0.1, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 0) << "inside the indentation";
  ASSERT_EQ(pnd_accept(law.get(), 4e-3, 0.1, &contact), PND_OK);
  EXPECT_EQ(contact.touching, 1);
  pnd_response r{};
  ASSERT_EQ(pnd_respond(law.get(), &contact, 4.5e-3, 0.1, &r), PND_OK);
  EXPECT_NEAR(r.force, 4e8 * (4.5e-3 - 3.75e-3), 1e-6);
  EXPECT_NEAR(r.by_penetration, 4e8, 1e-4);
  ASSERT_EQ(pnd_respond(law.get(), &contact, 6e-3, 0.1, &r), PND_OK);
  EXPECT_NEAR(r.force, 1e8 * 6e-3, 1e-6);
  EXPECT_NEAR(r.by_penetration, 1e8, 1e-4);
  ASSERT_EQ(pnd_separate(law.get(), 3.75e-3, &contact), PND_OK);
  EXPECT_DOUBLE_EQ(contact.indentation, 0.75 * 5e-3);
}

TEST(CInterface, LawsGivenByWhatTheyNeedTakeNoMass) {
  const auto made = [](const char* name, std::vector<pnd_value> values) {
    pnd_law* law = nullptr;
    pnd_create(name, "", values.data(), values.size(), &law);
    return test::LawInC(law);
  };
  const test::LawInC bilinear =
      made("bilinear_hertz", {{"initial_stiffness", 4e8}, {"secondary_stiffness", 1e8}, {"yield_penetration", 1e-3}});
  ASSERT_TRUE(bilinear) << pnd_error_text();
  const test::LawInC kelvin = made("kelvin_voigt", {{"stiffness", 1e8}, {"damping_coefficient", 2e5}});
  ASSERT_TRUE(kelvin) << pnd_error_text();
  pnd_contact contact{};
  pnd_response r{};
  ASSERT_EQ(pnd_touch(bilinear.get(), 0.5, &contact), PND_OK);
  ASSERT_EQ(pnd_respond(bilinear.get(), &contact, 3e-3, 0.2, &r), PND_OK);
  EXPECT_DOUBLE_EQ(r.force, 4e8 * 1e-3 + 1e8 * 2e-3);
  contact = {};
  ASSERT_EQ(pnd_touch(kelvin.get(), 0.5, &contact), PND_OK);
  ASSERT_EQ(pnd_respond(kelvin.get(), &contact, 3e-3, 0.2, &r), PND_OK);
  EXPECT_DOUBLE_EQ(r.force, 1e8 * 3e-3 + 2e5 * 0.2);
}

TEST(CInterface, CopyOfTheContactTakesAStepBack) {
  const test::LawInC law = typical("bilinear_hertz");
  pnd_contact contact{};
  ASSERT_EQ(pnd_accept(law.get(), 1e-4, 0.5, &contact), PND_OK);
  const pnd_contact kept = contact;
  pnd_response before{}, after{};
  ASSERT_EQ(pnd_respond(law.get(), &contact, 2e-3, 0.1, &before), PND_OK);
  ASSERT_EQ(pnd_accept(law.get(), 5e-3, 0.1, &contact), PND_OK);
  ASSERT_EQ(pnd_respond(law.get(), &contact, 2e-3, 0.1, &after), PND_OK);
  EXPECT_NE(before.force, after.force);
  contact = kept;
  ASSERT_EQ(pnd_respond(law.get(), &contact, 2e-3, 0.1, &after), PND_OK);
  EXPECT_EQ(before.force, after.force);
}

TEST(CInterface, RefusesAContactThatIsFarSofterThanItsDesign) {
  const pnd_value values[] = {{"stiffness", 2.75e9}, {"restitution", 0.65}, {"reduced_mass", 6e4}};
  pnd_law* made = nullptr;
  ASSERT_EQ(pnd_create("bilinear_hertz", "", values, 3, &made), PND_OK) << pnd_error_text();
  const test::LawInC law(made);
  pnd_contact contact{};
  ASSERT_EQ(pnd_touch(law.get(), 0, &contact), PND_OK);
  EXPECT_EQ(pnd_accept(law.get(), 1e-3, 0.1, &contact), PND_BAD_ARGUMENT);
  EXPECT_TRUE(test::mentions(pnd_error_text(), {"bilinear_hertz", "0 m/s"}));
  contact = {};
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  EXPECT_EQ(pnd_accept(law.get(), 1e-3, 0.1, &contact), PND_OK);
}

}  // namespace contract_test
}  // namespace pounding
