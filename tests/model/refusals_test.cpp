// Error messages of a model built in code.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <pounding/elements.hpp>
#include <pounding/model/system.hpp>
#include "support/messages.hpp"

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
  EXPECT_TRUE(test::mentions(refusal([] { make_body({}); }), {"mass"}));
  EXPECT_TRUE(test::mentions(refusal([] { make_oscillator({.mass = 1}); }), {"stiffness"}));
  EXPECT_TRUE(
      test::mentions(refusal([] { make_oscillator({.mass = 1, .period = 1, .stiffness = 1}); }), {"stiffness"}));
  EXPECT_TRUE(test::mentions(refusal([] { make_oscillator({.mass = 1, .period = 1e-200}); }), {"stiffness"}));
  EXPECT_TRUE(
      test::mentions(refusal([] { make_oscillator({.mass = 1, .period = 1, .damping_ratio = 1}); }), {"[0, 1)"}));
  EXPECT_TRUE(
      test::mentions(refusal([] { make_oscillator({.mass = 1, .period = 1, .hardening = 0.1}); }), {"yield_force"}));
  EXPECT_TRUE(
      test::mentions(refusal([] { make_shear_building({.storeys = 3, .mass = {1, 2}, .stiffness = 1}); }), {"3", "2"}));
  EXPECT_TRUE(test::mentions(refusal([] { make_shear_building({.mass = 1, .stiffness = 1}); }), {"storeys"}));
}

TEST(StructuresByCode, AreAddedOnceWithANameAndADamping) {
  Model model;
  model.add("a", oscillator());
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("a", oscillator()); }), {"a"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("b.1", oscillator()); }), {".", "/", "left_building"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("b", building()); }), {"damping: 5 %", "damping: 0"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("b", oscillator(), {.damping = 0.05}); }), {"damping"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("w", make_wall(), {.damping = 0.05}); }), {"damping", "wall"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.add("w", make_wall(), {.initial_velocity = 1}); }), {"wall", "ground"}));
  EXPECT_TRUE(test::mentions(
      refusal([&] { model.add("b", building(), {.damping = RayleighDamping{.ratio = 0.05, .modes = {{1, 3}}}}); }),
      {"3", "2"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.add("b", building(), {.damping = 0.05, .initial_velocity = {1, 2, 3}}); }),
                     {"initial_velocity", "2", "3"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.add("b", building(), {.damping = 0.05, .delay = -1}); }), {"delay"}));
  EXPECT_EQ(model.structures.size(), 1u) << "the rejected object is not in the model";
}

TEST(LinksByCode, SayWhatIsWrong) {
  EXPECT_TRUE(test::mentions(refused_link({}), {"{.gap = 0.02}"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = -0.01}), {"gap"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = {0.01, 0.02}}), {"2"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = 0.01, .name = ""}), {"..", "/", "third_floor"}));
  EXPECT_NE(refused_link({.gap = 0.01, .points = 2}), "taken");
  EXPECT_NE(refused_link({.gap = 0.01, .friction = 0.3}), "taken");
  EXPECT_TRUE(test::mentions(refused_link({.gap = 0.01, .sliding_velocity = 0.3}), {"friction: 0.3"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = 0.01}, laws::Hertz{.stiffness = -1}), {"-1", "stiffness"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = 0.01}, laws::Settings{.law = "hertz_damp", .formula = {}}),
                             {"hertz_damp", "hertz_damped"}));
  EXPECT_TRUE(test::mentions(refused_link({.gap = 0.01, .reduced_mass = 1e4},
                                          laws::Jankowski{.stiffness = 1e9, .restitution = 0.5, .reduced_mass = 1e4}),
                             {"mass"}));
}

TEST(LinksByCode, NameFloorsThatExist) {
  Pair pair;
  Model& model = pair.model;
  const StructureHandle tall = model.add("tall", building(), {.damping = 0.05});
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.link(tall, pair.left, {.gap = 0.01}, hertz); }), {"floors: all", "tall.2"}));
  EXPECT_TRUE(test::mentions(refusal([&] { model.link(tall.floor(3), pair.left, {.gap = 0.01}, hertz); }),
                             {"tall.3", "tall.2", "1"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.link(tall.floor(1), tall.floor(2), {.gap = 0.01}, hertz); }), {"tall"}));
  EXPECT_TRUE(test::mentions(
      refusal([&] { model.link(tall.floor(1), pair.left, {.gap = 0.01, .floors = FacingFloors::all}, hertz); }),
      {"between"}));
  EXPECT_NE(refusal([&] { model.link(tall.node("a"), pair.left, {.gap = 0.01}, hertz); }), "taken");
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.link(StructureHandle(7), pair.left, {.gap = 0.01}, hertz); }), {"7", "3"}));
  model.link(tall.floor(1), pair.left, {.gap = 0.01}, hertz);
  EXPECT_TRUE(test::mentions(refusal([&] { model.link(tall.floor(1), pair.left, {.gap = 0.01}, hertz); }),
                             {"tall.1-left", "name: second"}));
}

TEST(ModelByCode, SaysWhatItLacks) {
  EXPECT_EQ(refused_model([](Model&) {}), "taken");
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.duration = 0; }), {"analysis: {duration: 10 s}"}));
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.output_step = 1e-9; }),
                             {"analysis: {output_step: 0.0001}", "1e+09"}));
  EXPECT_TRUE(
      test::mentions(refused_model([](Model& m) { m.analysis.max_steps = 0; }), {"[1, 2000000000]", "most_steps"}));
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.max_steps = 10; }),
                             {"analysis: {duration: 0.5 s}", "{most_steps: 40}", "1 s", "20", "10"}));
  EXPECT_TRUE(
      test::mentions(refused_model([](Model& m) {
                       m.analysis.max_steps = 1000;
                       m.ground.components[0] = GroundMotion(Harmonic{1, 1e-3, 1});
                     }),
                     {"analysis: {duration: 0.1 s}", "{most_steps: 20000}", "1 m/s^2", "0.001 s", "1e+04", "1000"}));
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.max_step = 1e-10; }),
                             {"analysis: {duration: 0.01 s}", "max_step", "1 s", "1e-10 s", "1e+10", "100000000"}));
  EXPECT_TRUE(
      test::mentions(refused_model([](Model& m) { m.analysis.output_step = 2; }), {"output_step", "2 s", "1 s"}));
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.tolerance = 1; }), {"[1e-10, 0.1]"}));
  EXPECT_TRUE(test::mentions(refused_model([](Model& m) { m.analysis.scheme.spectral_radius = 2; }),
                             {"[0, 1]", "spectral_radius", "2"}));
  EXPECT_NE(refused_model([](Model& m) { m.ground.components[1] = GroundMotion(Harmonic{1, 1, 1}); }), "taken");
  EXPECT_TRUE(
      test::mentions(refused_model([](Model& m) { m.ground.wave = TravellingWave{.velocity = 300}; }), {"origin"}));
  EXPECT_TRUE(
      test::mentions(refused_model([](Model& m) { m.add("late", oscillator(), {.delay = 1}); }), {"ground_motion"}));
  Model walls;
  walls.add("wall", make_wall());
  EXPECT_TRUE(test::mentions(refusal([&] { walls.complete(); }), {"shear_building"}));
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
  EXPECT_TRUE(test::mentions(refusal([&] { make_structure(model); }), {"supports: {a: fixed}", "supports: none"}));
  model.frame.fix(0);
  EXPECT_EQ(refusal([&] { make_structure(model); }), "taken");
  model.gravity = false;
  model.geometry = FrameGeometry::p_delta;
  EXPECT_TRUE(test::mentions(refusal([&] { make_structure(model); }), {"gravity: true", "p_delta"}));
  model.geometry = FrameGeometry::linear;
  model.supports = {{.name = "a",
                     .nodes = {0},
                     .motion = GroundComponents{GroundMotion(), GroundMotion(Harmonic{1, 1, 1}), GroundMotion()}}};
  EXPECT_TRUE(test::mentions(refusal([&] { make_structure(model); }), {"a"}));
  model.supports.clear();
  model.frame.add_node({3, 0, 3}, "c");
  EXPECT_TRUE(test::mentions(refusal([&] { make_structure(model); }), {"c"}));
}

}  // namespace refusals_test
}  // namespace pounding
