// Contacts that are closed at the start: the initial equilibrium of the run, and error messages.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>

#include <pounding/elements.hpp>
#include <pounding/model/system.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace preload_test {

using test::refusal;

constexpr double k1 = 2e7, k2 = 5e7;

Structure spring(double stiffness) {
  return make_oscillator({.mass = 1e5, .stiffness = stiffness, .damping_ratio = 0.05});
}

struct Pair {
  Model model;
  StructureHandle left = model.add("left", spring(k1)), right = model.add("right", spring(k2));
  Pair() { model.analysis.duration = 1; }
};

// Force of a contact before the first step, for an approach of its ends [m].
double force_at(const Model& model, std::size_t link, double approach) {
  const System system = assemble(model);
  const ContactMemory& memory = system.initial_contacts[link];
  return system.contacts[link]->evaluate(memory, {memory.state.penetration(approach), 0}).force;
}

// F (1/k + 1/k1 + 1/k2) = gap: springs in series.
TEST(Preload, PressesWithTheForceOfSpringsInSeries) {
  test::Book book("Contacts closed at the start", "springs in series: F = overlap/(1/k + 1/k1 + 1/k2)", "rounding");
  const double k = 9.35e7, overlap = 2e-3, force = overlap / (1 / k + 1 / k1 + 1 / k2);
  Pair pair;
  pair.model.link(pair.left, pair.right, {.gap = -overlap, .preload = true}, laws::LinearSpring{.stiffness = k});
  pair.model.complete();
  const ContactMemory memory = assemble(pair.model).initial_contacts[0];
  EXPECT_EQ(memory.phase(), ContactPhase::approach);
  const auto [u, v] = initial_state(pair.model);
  book.near("displacement of the left one [m]", u[0], -force / k1, 1e-17);
  book.near("displacement of the right one [m]", u[1], force / k2, 1e-17);
  EXPECT_EQ(v.norm(), 0);
  book.near("force of the contact [N]", force_at(pair.model, 0, u[0] - u[1]), force, 1e-9);
  book.near("energy stored in the contact [J]", memory.log.work(), force * force / (2 * k), 1e-10);
  EXPECT_EQ(initial_state(pair.model, false).first.norm(), 0) << "no preload without links";
}

// Nonlinear springs: the residual of the equilibrium, for every law.
TEST(Preload, BalancesEveryLawThatHasAForceAtRest) {
  for (const ContactLaw& law : std::initializer_list<ContactLaw>{
           laws::Hertz{.stiffness = 2.75e9}, laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.5},
           laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.5, .impact_velocity = 0.3},
           laws::Elastoplastic{.stiffness = 2.75e9, .restitution = 0.5},
           laws::Komodromos{.stiffness = 9e7, .restitution = 0.5},
           laws::BilinearHertz{.initial_stiffness = 1.2e9, .secondary_stiffness = 1.5e8, .yield_penetration = 1e-4}}) {
    Pair pair;
    pair.model.link(pair.left, pair.right, {.gap = -3e-3, .preload = true}, law);
    pair.model.complete();
    const auto [u, v] = initial_state(pair.model);
    const double force = force_at(pair.model, 0, u[0] - u[1]);
    EXPECT_GT(force, 1e4) << pair.model.links[0].law;
    EXPECT_NEAR(k1 * u[0] + force, 0, 1e-8 * force) << pair.model.links[0].law;
    EXPECT_NEAR(k2 * u[1] - force, 0, 1e-8 * force) << pair.model.links[0].law;
  }
}

TEST(Preload, OfSeveralFloorsIsFoundTogether) {
  Model model;
  model.analysis.duration = 1;
  const StructureHandle a = model.add("a", make_shear_building({.storeys = 2, .mass = 1e5, .stiffness = 3e7}),
                                      {.damping = 0.05}),
                        b = model.add("b", make_shear_building({.storeys = 2, .mass = 1e5, .stiffness = 6e7}),
                                      {.damping = 0.05});
  model.link(a, b, {.gap = {-2e-3, -3e-3}, .preload = true, .floors = FacingFloors::all},
             laws::Hertz{.stiffness = 2.75e9});
  model.complete();
  const auto [u, v] = initial_state(model);
  for (int floor = 0; floor < 2; ++floor) {
    const double force = force_at(model, floor, u[floor] - u[2 + floor]);
    EXPECT_GT(force, 1e4);
    EXPECT_NEAR(model.structures[0].stiffness.row(floor).dot(u.head(2)), -force, 1e-8 * force);
    EXPECT_NEAR(model.structures[1].stiffness.row(floor).dot(u.tail(2)), force, 1e-8 * force);
  }
}

std::string refused(const std::function<void(Pair&)>& change,
                    const LinkOptions& options = {.gap = -2e-3, .preload = true},
                    const ContactLaw& law = laws::Hertz{.stiffness = 2.75e9}) {
  Pair pair;
  return refusal([&] {
    if (change) change(pair);
    pair.model.link(pair.left, pair.right, options, law);
    pair.model.complete();
  });
}

TEST(Preload, SaysWhatCannotBe) {
  EXPECT_EQ(refused({}), "taken");
  EXPECT_TRUE(test::mentions(refused({}, {.gap = 2e-3, .preload = true}), {"gap: -2 mm"}));
  EXPECT_TRUE(test::mentions(refused({}, {.gap = -2e-3}), {"gap"}));
  EXPECT_TRUE(test::mentions(refused({}, {.gap = -2e-3, .preload = true}, laws::Stereomechanical{.restitution = 0.5}),
                             {"gap"}));
  EXPECT_TRUE(test::mentions(
      refused({}, {.gap = -2e-3, .preload = true}, laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.5}),
      {"impact_velocity", "linear_spring", "hertz"}));
  EXPECT_TRUE(test::mentions(refused([](Pair& pair) { pair.left = pair.model.add("ball", make_body({.mass = 1e5})); }),
                             {"stiffness", "preload"}));
  EXPECT_TRUE(test::mentions(
      refused([](Pair& pair) { pair.left = pair.model.add("moved", spring(k1), {.initial_displacement = 0.01}); }),
      {"preload"}));
  EXPECT_TRUE(test::mentions(
      refused([](Pair& pair) {
        pair.left = pair.model.add(
            "weak", make_oscillator({.mass = 1e5, .stiffness = k1, .damping_ratio = 0.05, .yield_force = 1e3}));
      }),
      {"-1.137 mm", "0.05 mm"}));
  EXPECT_TRUE(test::mentions(refused([](Pair& pair) {
                               const StructureHandle wall = pair.model.add("w", make_wall());
                               pair.model.link(pair.right, wall, {.gap = 1e-4}, laws::Hertz{.stiffness = 1e9});
                             }),
                             {"preload: true", "0.3546 mm"}));
}

}  // namespace preload_test
}  // namespace pounding
