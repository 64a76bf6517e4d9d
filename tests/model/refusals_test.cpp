// A model built by code says what it refuses, and what to give instead.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <pounding/elements.hpp>
#include "support/refusal.hpp"

namespace pounding {
namespace refusals_test {

using test::refusal;

Structure oscillator() { return make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}); }
Structure building() { return make_shear_building({.storeys = 2, .mass = 1e5, .stiffness = 1e8}); }
const laws::Hertz hertz{.stiffness = 1e9};

struct Pair {
  Model model;
  StructureHandle left = model.add("left", oscillator()), right = model.add("right", oscillator());
};

std::string refused_link(const LinkOptions& options, const ContactLaw& law = hertz) {
  Pair pair;
  return refusal([&] { pair.model.link(pair.left, pair.right, options, law); });
}

std::string refused_model(const std::function<void(Model&)>& change) {
  Pair pair;
  pair.model.analysis.duration = 1;
  change(pair.model);
  return refusal([&] { pair.model.complete(); });
}

TEST(StructuresByCode, SayWhatIsWrong) {
  EXPECT_EQ(refusal([] { make_body({}); }), "mass must be positive and finite");
  EXPECT_EQ(refusal([] { make_oscillator({.mass = 1}); }),
            "an oscillator takes its period or its stiffness, one of the two");
  EXPECT_EQ(refusal([] { make_oscillator({.mass = 1, .period = 1, .stiffness = 1}); }),
            "an oscillator takes its period or its stiffness, one of the two");
  EXPECT_EQ(refusal([] { make_oscillator({.mass = 1, .period = 1e-200}); }), "stiffness must be positive and finite");
  EXPECT_EQ(refusal([] { make_oscillator({.mass = 1, .period = 1, .damping_ratio = 1}); }),
            "the damping ratio must lie in [0, 1); 1 was given");
  EXPECT_EQ(refusal([] { make_oscillator({.mass = 1, .period = 1, .hardening = 0.1}); }),
            "hardening belongs to storeys that yield; give the yield_force beside it");
  EXPECT_EQ(refusal([] { make_shear_building({.storeys = 3, .mass = {1, 2}, .stiffness = 1}); }),
            "mass: give one value, or a list of 3; 2 were given");
  EXPECT_EQ(refusal([] { make_shear_building({.mass = 1, .stiffness = 1}); }), "storeys must be at least 1");
}

TEST(StructuresByCode, AreAddedOnceWithANameAndADamping) {
  Model model;
  model.add("a", oscillator());
  EXPECT_EQ(refusal([&] { model.add("a", oscillator()); }),
            "a structure \"a\" exists already; give this one another name");
  EXPECT_EQ(refusal([&] { model.add("b.1", oscillator()); }),
            "a name must not be empty or contain \".\" or \"/\"; type a name such as left_building");
  EXPECT_EQ(refusal([&] { model.add("b", building()); }),
            "damping is missing; type damping: 5 %, or damping: 0 for none");
  EXPECT_EQ(refusal([&] { model.add("b", oscillator(), {.damping = 0.05}); }),
            "the structure was made with its damping; keep one of the two");
  EXPECT_EQ(refusal([&] { model.add("w", make_wall(), {.damping = 0.05}); }),
            "a wall has no damping of its own; leave it out");
  EXPECT_EQ(refusal([&] { model.add("w", make_wall(), {.initial_velocity = 1}); }),
            "a wall moves with the ground; leave it out");
  EXPECT_EQ(
      refusal([&] { model.add("b", building(), {.damping = RayleighDamping{.ratio = 0.05, .modes = {{1, 3}}}}); }),
      "modes 1 and 3 of the damping: there are the modes 1 to 2");
  EXPECT_EQ(refusal([&] { model.add("b", building(), {.damping = 0.05, .initial_velocity = {1, 2, 3}}); }),
            "initial_velocity: give one value, or a list of 2; 3 were given");
  EXPECT_EQ(refusal([&] { model.add("b", building(), {.damping = 0.05, .delay = -1}); }),
            "delay must be finite and not negative");
  EXPECT_EQ(model.structures.size(), 1u) << "what was refused is not in the model";
}

TEST(LinksByCode, SayWhatIsWrong) {
  EXPECT_EQ(refused_link({}), "the gap is missing; give it, as in {.gap = 0.02}");
  EXPECT_EQ(refused_link({.gap = -0.01}),
            "gap must be finite and not negative; with preload: true a negative one presses from the start");
  EXPECT_EQ(refused_link({.gap = {0.01, 0.02}}), "gap: give one value, or a list of 1; 2 were given");
  EXPECT_EQ(refused_link({.gap = 0.01, .name = ""}),
            "a name must not be empty, \".\" or \"..\", or contain \"/\"; type a name such as third_floor");
  EXPECT_EQ(refused_link({.gap = 0.01, .points = 2}),
            "several points need floors of structures in space on both sides; leave it out");
  EXPECT_EQ(refused_link({.gap = 0.01, .friction = 0.3}),
            "needs a frame: the others move along x only and cannot slide; leave it out");
  EXPECT_EQ(refused_link({.gap = 0.01, .sliding_velocity = 0.3}),
            "belongs to friction; type friction: 0.3 beside it, or leave it out");
  EXPECT_EQ(refused_link({.gap = 0.01}, laws::Hertz{.stiffness = -1}),
            "stiffness is -1, but must be finite and positive");
  EXPECT_EQ(refused_link({.gap = 0.01}, laws::Settings{.law = "hertz_damp", .formula = {}}),
            "unknown law \"hertz_damp\". Did you mean \"hertz_damped\"?");
  EXPECT_EQ(refused_link({.gap = 0.01, .reduced_mass = 1e4},
                         laws::Jankowski{.stiffness = 1e9, .restitution = 0.5, .reduced_mass = 1e4}),
            "the reduced mass is given twice, by the law and by the link; keep one of the two");
}

TEST(LinksByCode, NameFloorsThatExist) {
  Pair pair;
  Model& model = pair.model;
  const StructureHandle tall = model.add("tall", building(), {.damping = 0.05});
  EXPECT_EQ(refusal([&] { model.link(tall, pair.left, {.gap = 0.01}, hertz); }),
            "which of the 2 floors of tall? Type tall.2, or add floors: all");
  EXPECT_EQ(refusal([&] { model.link(tall.floor(3), pair.left, {.gap = 0.01}, hertz); }),
            "\"tall.3\" names no floor of tall, which has the floors 1 to 2; type tall.2");
  EXPECT_EQ(refusal([&] { model.link(tall.floor(1), tall.floor(2), {.gap = 0.01}, hertz); }),
            "\"tall\" cannot hit itself; name two structures, the left one first");
  EXPECT_EQ(refusal([&] { model.link(tall.floor(1), pair.left, {.gap = 0.01, .floors = FacingFloors::all}, hertz); }),
            "names all floors, but \"between\" names one; keep one of the two");
  EXPECT_EQ(refusal([&] { model.link(tall.node("a"), pair.left, {.gap = 0.01}, hertz); }),
            "tall: it has no nodes; name a floor");
  EXPECT_EQ(refusal([&] { model.link(StructureHandle(7), pair.left, {.gap = 0.01}, hertz); }),
            "there is no structure 7 among 3; add() gives the one to link");
  model.link(tall.floor(1), pair.left, {.gap = 0.01}, hertz);
  EXPECT_EQ(refusal([&] { model.link(tall.floor(1), pair.left, {.gap = 0.01}, hertz); }),
            "a link \"tall.1-left\" exists already; give this one a name of its own, such as name: second");
}

TEST(ModelByCode, SaysWhatItLacks) {
  EXPECT_EQ(refused_model([](Model&) {}), "taken");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.duration = 0; }),
            "the duration is missing; type analysis: {duration: 10 s}");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.output_step = 1e-9; }),
            "1e+09 output times are too many; type analysis: {output_step: 0.0001}");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.most_steps = 0; }),
            "most_steps lies in [1, 2000000000]; 0 was given");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.most_steps = 10; }),
            "a run of 1 s takes 20 steps or more, and 10 are allowed: the period of 0.5 s of structure left makes them "
            "so short; look at the "
            "units, or type analysis: {duration: 0.5 s}, or {most_steps: 40} and some patience");
  EXPECT_EQ(refused_model([](Model& m) {
              m.analysis.most_steps = 1000;
              m.ground.components[0] = GroundMotion(Harmonic{1, 1e-3, 1});
            }),
            "a run of 1 s takes 1e+04 steps or more, and 1000 are allowed: the ground motion (harmonic, 1 m/s^2 at "
            "0.001 s for 1 s) makes "
            "them so short; look at the units, or type analysis: {duration: 0.1 s}, or {most_steps: 20000} and some "
            "patience");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.max_step = 1e-10; }),
            "a run of 1 s takes 1e+10 steps or more, and 100000000 are allowed: a max_step of 1e-10 s makes them so "
            "short; look at the units, or "
            "type analysis: {duration: 0.01 s}");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.output_step = 2; }),
            "the output_step of 2 s is longer than the duration of 1 s");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.tolerance = 1; }),
            "the tolerance lies in [1e-10, 0.1]; 1 was given");
  EXPECT_EQ(refused_model([](Model& m) { m.analysis.scheme.spectral_radius = 2; }),
            "the spectral_radius lies in [0, 1]; 2 was given");
  EXPECT_EQ(refused_model([](Model& m) { m.ground.components[1] = GroundMotion(Harmonic{1, 1, 1}); }),
            "no structure is in space; leave the motion along y out");
  EXPECT_EQ(refused_model([](Model& m) { m.ground.wave = TravellingWave{.velocity = 300}; }),
            "reaches all supports at once; give the frames an origin each, or leave it out");
  EXPECT_EQ(refused_model([](Model& m) { m.add("late", oscillator(), {.delay = 1}); }),
            "nothing moves the ground here; give a ground_motion, or leave the delay out");
  Model walls;
  walls.add("wall", make_wall());
  EXPECT_EQ(refusal([&] { walls.complete(); }),
            "no structure that can move; add a body, an oscillator, a shear_building or a frame");
}

TEST(ModelByCode, CanBeMendedAfterARefusal) {
  Pair pair;
  Model& model = pair.model;
  EXPECT_THROW(model.complete(), ModelError);
  model.analysis.duration = 2;
  model.complete();
  EXPECT_EQ(model.analysis.output_step, 0.002);
  model.complete();
  EXPECT_TRUE(model.is_complete());
}

TEST(ModelByCode, IsAssembledWhenItIsComplete) {
  Pair pair;
  EXPECT_THROW(assemble(pair.model), std::logic_error);
  pair.model.analysis.duration = 1;
  pair.model.complete();
  EXPECT_EQ(assemble(pair.model).size(), 2);
  EXPECT_THROW(pair.model.add("third", oscillator()), std::logic_error);
  EXPECT_THROW(pair.model.link(pair.left, pair.right, {.gap = 0.1}, hertz), std::logic_error);
}

TEST(FrameModel, SaysWhatItLacks) {
  FrameModel model{.frame = Frame(2)};
  model.frame.add_node({0, 0, 0}, "a");
  model.frame.add_node({0, 0, 3}, "b");
  model.frame.add_member(0, 1, rectangle_section(0.4, 0.4), isotropic(30e9));
  model.frame.add_mass(1, 1e3);
  EXPECT_EQ(
      refusal([&] { make_structure(model); }),
      "nothing holds the frame to the ground; type supports: {a: fixed}, or supports: none for a frame free in space");
  model.frame.fix(0);
  EXPECT_EQ(refusal([&] { make_structure(model); }), "taken");
  model.gravity = false;
  model.geometry = FrameGeometry::p_delta;
  EXPECT_EQ(refusal([&] { make_structure(model); }),
            "p_delta needs forces at rest, and nothing acts; type gravity: true, or give loads");
  model.geometry = FrameGeometry::linear;
  model.supports = {{.name = "a",
                     .nodes = {0},
                     .motion = GroundComponents{GroundMotion(), GroundMotion(Harmonic{1, 1, 1}), GroundMotion()}}};
  EXPECT_EQ(refusal([&] { make_structure(model); }), "support a: the frame is plane; leave the motion along y out");
  model.supports.clear();
  model.frame.add_node({3, 0, 3}, "c");
  EXPECT_EQ(refusal([&] { make_structure(model); }), "node c: no member, spring or constraint is connected to it");
}

}  // namespace refusals_test
}  // namespace pounding
