// Collisions with an outcome that is known without integration.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <fmt/format.h>

#include <pounding/model/system.hpp>

#include "support/book.hpp"
#include "support/messages.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace collisions_test {

using test::model_of;
using test::run_text;

class TwoBodies : public testing::TestWithParam<const char*> {};

TEST_P(TwoBodies, KeepTheirMomentumAndObeyTheIdentitiesOfAnImpact) {
  test::Book book("Collisions with an outcome known without integration",
                  "two free bodies by any law: conservation of momentum, impulse m (1 + e) v, loss m v^2 (1 - e^2)/2",
                  "run at tolerance 1e-7; before the touch only round-off");
  const double m1 = 1e5, m2 = 1.5e5, v1 = 1.2, v2 = 0.2, m = m1 * m2 / (m1 + m2);
  const Outcome run = run_text(std::string("structures:\n"
                                           "  a: {body: {mass: 100 t}, initial_velocity: 1.2 m/s}\n"
                                           "  b: {body: {mass: 150 t}, initial_velocity: 0.2 m/s}\n"
                                           "links:\n  - {between: [a, b], gap: 10 mm, law: ") +
                               GetParam() + "}\nanalysis: {duration: 0.3, tolerance: 1e-7}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const ImpactRow& row = run.results.impacts[0];
  const double end1 = run.results.structures[0].velocity.back(), end2 = run.results.structures[1].velocity.back();
  book.near("momentum [N s]", m1 * end1 + m2 * end2, m1 * v1 + m2 * v2, 1e-9 * m1);
  book.near("touch [s]", row.t_start, 0.01, 1e-12);
  book.near("approach [m/s]", row.v_approach, 1.0, 1e-12);
  book.near("separation [m/s]", row.v_separation, end2 - end1, 1e-9);
  const double e = row.restitution;
  book.near("impulse [N s]", row.impulse, m * (1 + e), 1e-6 * m);
  book.near("energy lost [J]", row.energy_lost, 0.5 * m * (1 - e * e), 1e-6 * m);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, TwoBodies, testing::ValuesIn(test::every_law), test::law_name);

/// Two bodies that meet at 1 m/s after 10 ms with this law, in a run that ends during their impact.
Outcome ended_in_contact(const std::string& law, double duration) {
  return run_text(
      "structures:\n"
      "  a: {body: {mass: 100 t}, initial_velocity: 1.2 m/s}\n"
      "  b: {body: {mass: 150 t}, initial_velocity: 0.2 m/s}\n"
      "links:\n  - {between: [a, b], gap: 10 mm, law: " +
      law + "}\nanalysis: {duration: " + fmt::format("{}", duration) + ", tolerance: 1e-7}\n");
}

TEST(AContactThatStillPresses, OfASpringHasLostNothing) {
  for (const double share : {0.3, 1.0, 1.6}) {  // of the time until the reversal
    const double k = 93.5e6, m = 6e4, wait = share * std::acos(0.0) * std::sqrt(m / k);
    const Outcome run = ended_in_contact("linear_spring, stiffness: 93.5 MN/m", 0.01 + wait);
    const double d = std::sqrt(m / k) * std::sin(wait * std::sqrt(k / m));
    ASSERT_EQ(run.results.impacts.size(), 1u);
    EXPECT_NEAR(run.results.impacts[0].energy_stored, 0.5 * k * d * d, 1e-6 * m);
    EXPECT_NEAR(run.results.impacts[0].energy_lost, 0, 1e-6 * m);
    EXPECT_TRUE(run.summary.links[0].presses);
    EXPECT_EQ(run.summary.links[0].energy_stored, run.results.impacts[0].energy_stored);
    const std::string table = to_table(run.summary);
    EXPECT_NE(table.find("a-b"), table.rfind("a-b")) << "a row and a note";
  }
}

TEST(AContactThatStillPresses, SplitsTheWorkIntoWhatIsLostAndWhatComesBack) {
  const Outcome run = ended_in_contact("hertz_damped, stiffness: 2.75e9, restitution: 0.6", 0.02);
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const ImpactRow& row = run.results.impacts[0];
  const LinkHistory& link = run.results.links[0];
  EXPECT_NEAR(row.energy_stored, 2.75e9 * std::pow(link.penetration.back(), 2.5) / 2.5, 1e-10 * row.energy_stored);
  const double speed = link.velocity.back(), taken = 0.5 * 6e4 * (1 - speed * speed);
  EXPECT_NEAR(row.energy_lost + row.energy_stored, taken, 1e-6 * taken);
  EXPECT_GT(row.energy_lost, 0.05 * taken);
}

TEST(AnImpactThatIsOver, StoresNothing) {
  const Outcome run = ended_in_contact("hertz_damped, stiffness: 2.75e9, restitution: 0.6", 0.3);
  EXPECT_EQ(run.results.impacts[0].energy_stored, 0);
  EXPECT_FALSE(run.summary.links[0].presses);
  EXPECT_EQ(to_table(run.summary).find("still in contact"), std::string::npos);
}

TEST(MirroredOscillators, EqualOneOscillatorAgainstAWallOfHalfTheGap) {
  test::Book book("Collisions with an outcome known without integration",
                  "Code_Aster's SDND102: the mirror plane between two equal oscillators is a rigid wall, and a link "
                  "of stiffness k pressed from both sides one of 2 k",
                  "the same steps: round-off");
  const std::string oscillator = "{oscillator: {mass: 100 t, period: 0.5, damping: 5 %}, initial_velocity: ";
  const Outcome pair = run_text("structures:\n  a: " + oscillator + "1 m/s}\n  b: " + oscillator +
                                "-1 m/s}\nlinks:\n  - {between: [a, b], gap: 20 mm, law: kelvin_voigt_no_tension, "
                                "stiffness: 50 MN/m, restitution: 0.6}\nanalysis: {duration: 2, tolerance: 1e-5}\n");
  const Outcome alone = run_text("structures:\n  a: " + oscillator +
                                 "1 m/s}\n  w: {wall: {}}\nlinks:\n  - {between: [a, w], gap: 10 mm, law: "
                                 "kelvin_voigt_no_tension, stiffness: 100 MN/m, restitution: 0.6}\n"
                                 "analysis: {duration: 2, tolerance: 1e-5}\n");
  ASSERT_EQ(pair.results.impacts.size(), alone.results.impacts.size());
  ASSERT_GT(alone.results.impacts.size(), 2u);
  for (std::size_t i = 0; i < alone.results.impacts.size(); ++i) {
    book.near("touch [s]", pair.results.impacts[i].t_start, alone.results.impacts[i].t_start, 1e-12);
    book.near("peak force [N]", pair.results.impacts[i].peak_force, alone.results.impacts[i].peak_force,
              1e-11 * alone.results.impacts[0].peak_force);
  }
  const auto &a = pair.results.structures[0].displacement, &b = pair.results.structures[1].displacement,
             &single = alone.results.structures[0].displacement;
  ASSERT_EQ(a.size(), single.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    book.near("displacement [m]", a[i], single[i], 1e-12);
    book.near("displacement of the other oscillator [m]", a[i], -b[i], 1e-13);
  }
}

// Mirrored: the structures in the other order and every direction reversed.
class MirroredProblem : public testing::TestWithParam<const char*> {};

TEST_P(MirroredProblem, HasTheMirroredSolution) {
  const auto problem = [](double direction) {
    const std::string left = fmt::format(
                          "  left: {{oscillator: {{mass: 100 t, period: 0.8, damping: 5 %}}, initial_velocity: {}}}\n",
                          0.2 * direction),
                      right = "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n";
    return run_text(
        fmt::format("ground_motion: {{harmonic: {{amplitude: {}, period: 0.6, duration: 1.5}}}}\n", 3.0 * direction) +
        "structures:\n" + (direction > 0 ? left + right : right + left) +
        "links: [{between: " + (direction > 0 ? "[left, right]" : "[right, left]") +
        ", gap: 20 mm, law: " + GetParam() + "}]\nanalysis: {duration: 1.5, tolerance: 1e-4}\n");
  };
  const Outcome one = problem(1), other = problem(-1);
  ASSERT_EQ(one.results.impacts.size(), other.results.impacts.size());
  ASSERT_GT(one.results.impacts.size(), 1u);
  for (std::size_t i = 0; i < one.results.impacts.size(); ++i)
    EXPECT_NEAR(one.results.impacts[i].t_start, other.results.impacts[i].t_start, 1e-12);
  for (int k = 0; k < 2; ++k) {
    const auto &a = one.results.structures[k].displacement, &b = other.results.structures[1 - k].displacement;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], -b[i], 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, MirroredProblem, testing::ValuesIn(test::every_law), test::law_name);

TEST(IdenticalOscillators, NeverTouchAtZeroGap) {
  const Outcome run = run_text(
      "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
      "structures:\n"
      "  a: {oscillator: {mass: 100 t, period: 0.7, damping: 5 %}}\n"
      "  b: {oscillator: {mass: 100 t, period: 0.7, damping: 5 %}}\n"
      "links:\n  - {between: [a, b], gap: 0, law: hertz_damped, stiffness: 2.75e9, restitution: "
      "0.65}\nanalysis: {duration: 4}\n");
  EXPECT_TRUE(run.results.impacts.empty());
  EXPECT_GT(run.summary.structures[0].peak_displacement[0], 0.01);
}

// The gaps make the contacts act one after the other; this is required for the speed to pass on.
TEST(RowOfBodies, PassesTheSpeedOn) {
  test::Book book("Collisions whose outcome is known without integration",
                  "Newton's cradle with elastic links and gaps: equal bodies pass the speed to the last one",
                  "run at tolerance 1e-7");
  const Outcome run = run_text(
      "structures:\n"
      "  a: {body: {mass: 10 t}, initial_velocity: 1 m/s}\n"
      "  b: {body: {mass: 10 t}}\n"
      "  c: {body: {mass: 10 t}}\n"
      "links:\n"
      "  - {between: [a, b], gap: 50 mm, law: hertz, stiffness: 2.75e9}\n"
      "  - {between: [b, c], gap: 50 mm, law: hertz, stiffness: 2.75e9}\n"
      "analysis: {duration: 0.3, tolerance: 1e-7}\n");
  EXPECT_EQ(run.results.impacts.size(), 2u);
  book.near("speed of the first body [m/s]", run.results.structures[0].velocity.back(), 0, 1e-6);
  book.near("speed of the second body [m/s]", run.results.structures[1].velocity.back(), 0, 1e-6);
  book.near("speed of the third body [m/s]", run.results.structures[2].velocity.back(), 1, 1e-6);
}

// Naderpour, Barros & Khatami 2015, Eq. 2: [m1 0; 0 m2], [c1 + c, -c; -c, c2 + c], [k1 + s, -s; -s, k2 + s]. (The paper
// omits the contribution of the link in the lower right corner, where it prints c2 and k2; Newton's third law requires
// it.)
TEST(PaperEquation2, IsTheAssembledSystemWhileTheLinkPresses) {
  const Model model = model_of(
      "structures:\n"
      "  left:  {oscillator: {mass: 100 t, stiffness: 6 MN/m, damping: 5 %}}\n"
      "  right: {oscillator: {mass: 150 t, stiffness: 37 MN/m, damping: 3 %}}\n"
      "links:\n  - {between: [left, right], gap: 20 mm, law: kelvin_voigt, stiffness: 93.5 MN/m, "
      "damping_ratio: 0.14}\nanalysis: {duration: 1}\n");
  const System system = assemble(model);
  const double c1 = 0.1 * std::sqrt(6e6 * 1e5), c2 = 0.06 * std::sqrt(37e6 * 1.5e5);
  const double s = 93.5e6, c = 2 * 0.14 * std::sqrt(s * 6e4);
  const Contact& contact = *model.links[0].contact;
  ContactMemory memory = contact.initial();
  contact.on_event(memory, 0, 0.0, {0.0, 1.0});
  const laws::Response slopes = contact.evaluate(memory, {1e-3, 0.5});
  const Eigen::MatrixXd stiffness =
      system.stiffness + slopes.by_penetration * system.gap_jacobian * system.gap_jacobian.transpose();
  const Eigen::MatrixXd damping =
      system.damping + slopes.by_rate * system.gap_jacobian * system.gap_jacobian.transpose();
  const auto near = [](const Eigen::MatrixXd& a, const Eigen::Matrix2d& b) {
    return (a - b).norm() <= 1e-12 * b.norm();
  };
  EXPECT_TRUE(near(system.mass, Eigen::Matrix2d{{1e5, 0}, {0, 1.5e5}})) << system.mass;
  EXPECT_TRUE(near(stiffness, Eigen::Matrix2d{{6e6 + s, -s}, {-s, 37e6 + s}})) << stiffness;
  EXPECT_TRUE(near(damping, Eigen::Matrix2d{{c1 + c, -c}, {-c, c2 + c}})) << damping;
}

// A body pressed against a wall after a touch at 4 mm/s.
TEST(BilinearHertz, RefusesABodyAtRestOnAWallWithoutADesignSpeed) {
  const auto pressed = [](const std::string& more) {
    return test::run_text(
        "ground_motion: {pulse: {shape: rectangle, amplitude: -9.81, duration: 20}}\n"
        "structures: {a: {body: {mass: 60 t}}, w: {wall: {}}}\n"
        "links: [{between: [a, w], gap: 1e-6, law: bilinear_hertz, stiffness: 2.75e9, restitution: 0.5" +
        more +
        "}]\n"
        "analysis: {duration: 10, tolerance: 1e-4}\naccept: [penetration]\n");
  };
  try {
    pressed("");
    ADD_FAILURE() << "not rejected";
  } catch (const FailedRun& failed) {
    EXPECT_TRUE(test::mentions(failed.what(), {"a-w", "bilinear_hertz"}));
  }
  const Outcome run = pressed(", impact_velocity: 0.14 m/s");
  EXPECT_LT(run.summary.links[0].peak_penetration, 2e-2);
}

}  // namespace collisions_test
}  // namespace pounding
