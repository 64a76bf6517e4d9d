// A model built in code and the same model read from YAML give bitwise identical results.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>

#include <pounding/core/units.hpp>
#include <pounding/elements.hpp>
#include "support/runs.hpp"
#include "support/same_runs.hpp"

namespace pounding {
namespace by_code_test {

void expect_as(const std::string& yaml, Model model, bool meets = true) {
  const Outcome by_text = test::run_text(yaml), by_code = run(model);
  test::expect_same_run(by_text, by_code);
  EXPECT_EQ(by_text.results.impacts.empty(), !meets) << "a run without an impact proves little";
}

// The benchmark, with this law in its link.
Model two_oscillators(const ContactLaw& law) {
  Model model;
  const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
  const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
  model.link(left, right, {.gap = 0.02}, law);
  model.ground = Harmonic{.amplitude = 3.0, .period = 0.6, .duration = 3.0};
  model.analysis = {.duration = 1.5, .tolerance = 1e-6};
  return model;
}

laws::Settings settings_of(const laws::Entry& entry) {
  laws::Settings settings{.law = std::string(entry.name), .formula = {}};
  for (const laws::ParameterInfo& parameter : entry.parameters) {
    if (parameter.name == "stiffness") settings.values["stiffness"] = parameter.unit == "N/m" ? 9.35e7 : 2.75e9;
    if (parameter.name == "depth") settings.values["depth"] = 1e-3;
  }
  for (const std::string_view name : {laws::Backfill::name, laws::ElasticPlasticGap::name, laws::Tabulated::name})
    if (entry.name == name) settings.values = laws::typical_settings(entry).values;
  if (entry.takes_restitution) settings.restitution = 0.65;
  return settings;
}

class EveryLaw : public testing::TestWithParam<const char*> {
 protected:
  const laws::Entry& entry() const { return laws::find_law(test::law_of(GetParam())); }
  std::string yaml() const { return test::two_oscillators(GetParam(), 1e-6, 1.5); }
};

TEST_P(EveryLaw, ByItsNameIsThatOfTheInput) { expect_as(yaml(), two_oscillators(settings_of(entry()))); }

TEST_P(EveryLaw, AsAValueIsThatOfTheInput) {
  laws::Settings settings = settings_of(entry());
  settings.reduced_mass = 1;
  std::visit(
      [&](auto law) {
        if constexpr (requires { law.reduced_mass; }) law.reduced_mass = 0;  // left to the link
        expect_as(yaml(), two_oscillators(law));
      },
      laws::make_law(settings));
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::ValuesIn(test::every_law), test::law_name);

TEST(ModelByCode, NamesFloorsAndMassesAsTheInputDoes) {
  Model model;
  const auto left =
      model.add("left", make_oscillator({.mass = 100e3, .stiffness = 6e6}), {.damping = 0, .initial_velocity = 0.5});
  const auto right = model.add("right", make_body({.mass = 150e3}), {.initial_displacement = 0.01});
  model.link(left.floor(1), right.floor(1), {.gap = 0.02, .reduced_mass = 50e3},
             laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65});
  model.link(left, right, {.gap = 0.03, .name = "second"}, laws::Hertz{.stiffness = 2.75e9});
  model.title = "pair";
  model.analysis = {.duration = 0.4, .output_step = 0.01, .scheme = {.kind = Scheme::Kind::esdirk4}, .max_step = 0.01};
  model.checkpoint = {.every_simulated = 1};
  expect_as(
      "title: pair\n"
      "structures:\n"
      "  left: {oscillator: {mass: 100 t, stiffness: 6e6}, damping: 0, initial_velocity: 0.5}\n"
      "  right: {body: {mass: 150 t}, initial_displacement: 10 mm}\n"
      "links:\n"
      "  - {between: [left.1, right.1], gap: 20 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65, "
      "reduced_mass: 50 t}\n"
      "  - {between: [left, right], gap: 30 mm, name: second, law: hertz, stiffness: 2.75e9}\n"
      "analysis: {duration: 0.4, output_step: 0.01, integrator: esdirk4, max_step: 0.01}\n"
      "checkpoint: {every_simulated: 1}\n",
      std::move(model));
}

TEST(ModelByCode, OfBuildingsThatYieldBesideAWallIsThatOfTheInput) {
  Model model;
  const auto left = model.add("left",
                              make_shear_building({.storeys = 3,
                                                   .mass = 250e3,
                                                   .stiffness = {5e8, 4e8, 3e8},
                                                   .height = 3.0,
                                                   .yield_force = 1.5e6,
                                                   .hardening = 0.05}),
                              {.damping = RayleighDamping{.ratio = 0.05, .modes = {{1, 3}}}});
  const auto middle =
      model.add("middle", make_shear_building({.storeys = 2, .mass = {150e3, 140e3}, .stiffness = 9e8, .height = 3.0}),
                {.damping = ModalDamping{.ratio = 0.03}, .delay = 0.05});
  const auto right = model.add(
      "right", make_shear_building({.storeys = 1, .mass = 150e3, .stiffness = 9e8}),
      {.damping = 0.05,
       .ground_motion =
           GroundComponents{GroundMotion(Pulse{.shape = Pulse::Shape::sine, .amplitude = 2, .duration = 0.5})}});
  const auto wall = model.add("wall", make_wall());
  const laws::Settings law{
      .law = "hertz_damped", .formula = "hu_guo", .restitution = 0.6, .values = {{"stiffness", 2.75e9}}};
  model.link(left, wall, {.gap = {0.01, 0.02, 0.03}, .floors = FacingFloors::all, .name = "bumper"}, law);
  model.link(middle.floor(1), right, {.gap = 0.004}, law);
  model.ground = synthetic_motion({.seed = 7, .duration = 2, .pga = 0.6 * standard_gravity, .step = 0.02});
  model.compare_no_pounding = true;
  const std::string rest = ", law: hertz_damped, formula: hu_guo, stiffness: 2.75e9, restitution: 0.6}\n";
  expect_as(
      "ground_motion: {synthetic: {seed: 7, duration: 2 s, step: 0.02, pga: 0.6 g}}\n"
      "structures:\n"
      "  left: {shear_building: {storeys: 3, mass: 250 t, stiffness: [5e8, 4e8, 3e8], height: 3, yield_force: 1.5e6, "
      "hardening: 0.05},\n"
      "         damping: {rayleigh: {ratio: 5 %, modes: [1, 3]}}}\n"
      "  middle: {shear_building: {storeys: 2, mass: [150 t, 140 t], stiffness: 9e8, height: 3}, damping: {modal: "
      "{ratio: 3 %}},\n"
      "           delay: 0.05}\n"
      "  right: {shear_building: {storeys: 1, mass: 150 t, stiffness: 9e8}, damping: 5 %,\n"
      "          ground_motion: {pulse: {shape: sine, amplitude: 2, duration: 0.5}}}\n"
      "  wall: {wall: {}}\n"
      "links:\n"
      "  - {between: [left, wall], gap: [10 mm, 20 mm, 30 mm], floors: all, name: bumper" +
          rest + "  - {between: [middle.1, right], gap: 4 mm" + rest + "compare: no_pounding\n",
      std::move(model));
}

TEST(ModelByCode, TakesForcesAsTheInputDoes) {
  Model model;
  const auto left =
      model.add("left", make_shear_building({.storeys = 2, .mass = 100e3, .stiffness = 90e6}),
                {.damping = 0.05,
                 .forces = {{.floor = 2, .history = GroundMotion(Harmonic{400e3, 0.5, 2, 0.1}, dimension::force)},
                            {.floor = 1, .history = GroundMotion(Step{50e3, 0, 0.2}, dimension::force)}}});
  const auto right = model.add("right", make_body({.mass = 150e3, .gravity = -0.2}));
  model.link(left.floor(2), right, {.gap = 0.01}, laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65});
  model.analysis = {.duration = 1};
  expect_as(
      "structures:\n"
      "  left: {shear_building: {storeys: 2, mass: 100 t, stiffness: 90 MN/m}, damping: 5 %,\n"
      "         forces: [{floor: 2, harmonic: {amplitude: 400 kN, period: 0.5, duration: 2, start: 0.1}},\n"
      "                  {floor: 1, step_force: {amplitude: 50 kN, rise: 0.2}}]}\n"
      "  right: {body: {mass: 150 t, gravity: -0.2}}\n"
      "links: [{between: [left.2, right], gap: 10 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}]\n"
      "analysis: {duration: 1}\n",
      std::move(model));
}

const Material concrete = isotropic(30e9);

GridFrame plane(int storeys, double depth, double origin) {
  return {.storeys = storeys,
          .bays_x = 2,
          .storey_height = {3.0},
          .bay_width_x = {5.0, 6.0},
          .column = rectangle_section(depth, depth),
          .beam = rectangle_section(0.3, 0.5),
          .material = concrete,
          .floor_mass = {60e3},
          .origin = {origin, 0, 0}};
}

TEST(ModelByCode, OfPlaneGridsWithFrictionUnderAWaveIsThatOfTheInput) {
  Model model;
  FrameModel heavy = make_frame_model(plane(3, 0.4, 0));
  heavy.geometry = FrameGeometry::p_delta;
  heavy.reported_members = {0, 1};
  const auto left = model.add("left", make_structure(heavy), {.damping = 0.05});
  const auto right = model.add("right", make_structure(plane(2, 0.5, 11.01)),
                               {.damping = RayleighDamping{.ratio = 0.03, .periods = {{0.5, 0.1}}}});
  model.link(left, right, {.gap = 0.01, .floors = FacingFloors::all, .friction = 0.3},
             laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.5});
  model.link(left.node("2.2"), right.node("2.0"), {.gap = 0.01}, laws::LinearSpring{.stiffness = 9e7});
  model.ground = GroundComponents{GroundMotion(Harmonic{.amplitude = 4, .period = 0.5, .duration = 1}), GroundMotion(),
                                  GroundMotion(Harmonic{.amplitude = 1, .period = 0.2, .duration = 1})};
  model.ground.wave = TravellingWave{.velocity = 300};
  model.analysis.tolerance = 1e-5;
  const auto frame = [](const char* rest) { return std::string("frame: {material: {E: 30 GPa}, ") + rest; };
  expect_as(
      "ground_motion:\n"
      "  components: {x: {harmonic: {amplitude: 4, period: 0.5, duration: 1}}, z: {harmonic: {amplitude: 1, period: "
      "0.2, duration: 1}}}\n"
      "  wave: {velocity: 300}\n"
      "structures:\n"
      "  left: {" +
          frame("geometry: p_delta, report: {members: [column 1.0, beam x 1.0]}, grid: {storeys: 3, bays: 2, "
                "storey_height: 3,\n"
                "         bay_width: [5, 6], columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, "
                "floor_mass: 60 t}}, damping: 5 %}\n") +
          "  right: {" +
          frame("origin: [11.01 m], grid: {storeys: 2, bays: 2, storey_height: 3,\n"
                "         bay_width: [5, 6], columns: {rectangle: [0.5, 0.5]}, beams: {rectangle: [0.3, 0.5]}, "
                "floor_mass: 60 t}},\n"
                "         damping: {rayleigh: {ratio: 3 %, periods: [0.5, 0.1]}}}\n") +
          "links:\n"
          "  - {between: [left, right], gap: 10 mm, floors: all, friction: 0.3, law: hertz_damped, stiffness: 2.75e9, "
          "restitution: 0.5}\n"
          "  - {between: [{structure: left, node: '2.2'}, {structure: right, node: '2.0'}], gap: 10 mm, law: "
          "linear_spring, stiffness: 9e7}\n"
          "analysis: {tolerance: 1e-5}\n",
      std::move(model));
}

TEST(ModelByCode, OfRigidFloorsInSpaceIsThatOfTheInput) {
  GridFrame grid{.storeys = 2,
                 .bays_x = 1,
                 .bays_y = 1,
                 .storey_height = {3.2, 3.0},
                 .bay_width_x = {6.0},
                 .bay_width_y = {5.0},
                 .column = rectangle_section(0.4, 0.4),
                 .beam = rectangle_section(0.3, 0.5),
                 .material = concrete,
                 .floor_mass = {60e3, 50e3},
                 .rigid_floors = true};
  Model model;
  const auto left = model.add("left", make_structure(grid), {.damping = 0.05, .initial_velocity = 0.5});
  grid.origin = {6.01, 1.0, 0};
  const auto right = model.add("right", make_structure(grid), {.damping = 0.05});
  model.link(left.floor(2), right.floor(2), {.gap = 0.01, .points = 3, .friction = 0.2, .sliding_velocity = 0.01},
             laws::ModifiedKelvin{.stiffness = 9.35e7, .restitution = 0.6});
  model.analysis.duration = 0.3;
  const std::string body =
      "grid: {storeys: 2, bays: [1, 1], storey_height: [3.2, 3], bay_width: {x: 6, y: 5}, columns: {rectangle: [0.4, "
      "0.4]},\n"
      "    beams: {rectangle: [0.3, 0.5]}, floor_mass: [60 t, 50 t]}}, damping: 5 %";
  expect_as(
      "structures:\n"
      "  left: {frame: {material: {E: 30 GPa}, " +
          body +
          ", initial_velocity: 0.5}\n"
          "  right: {frame: {material: {E: 30 GPa}, origin: [6.01, 1], " +
          body +
          "}\n"
          "links:\n"
          "  - {between: [left.2, right.2], gap: 10 mm, points: 3, friction: 0.2, sliding_velocity: 0.01, law: "
          "modified_kelvin,\n"
          "     stiffness: 9.35e7, restitution: 0.6}\n"
          "analysis: {duration: 0.3}\n",
      std::move(model));
}

TEST(ModelByCode, LinksNeighboursAsTheInputDoes) {
  GridFrame grid{.storeys = 2,
                 .bays_x = 1,
                 .bays_y = 1,
                 .storey_height = {3.2, 3.0},
                 .bay_width_x = {6.0},
                 .bay_width_y = {5.0},
                 .column = rectangle_section(0.4, 0.4),
                 .beam = rectangle_section(0.3, 0.5),
                 .material = concrete,
                 .floor_mass = {60e3, 50e3},
                 .rigid_floors = true};
  Model model;
  model.add("corner", make_structure(grid), {.damping = 0.05, .initial_velocity = 0.5});
  grid.origin = {6.01, 0, 0};
  model.add("south", make_structure(grid), {.damping = 0.05});
  grid.origin = {0, 5.02, 0};
  model.add("west", make_structure(grid), {.damping = 0.05});
  link_neighbours(model, {.points = 2}, laws::ModifiedKelvin{.stiffness = 9.35e7, .restitution = 0.6});
  EXPECT_EQ(model.links.size(), 8u);
  model.analysis.duration = 0.3;
  const std::string body =
      "grid: {storeys: 2, bays: [1, 1], storey_height: [3.2, 3], bay_width: {x: 6, y: 5}, columns: {rectangle: [0.4, "
      "0.4]},\n"
      "    beams: {rectangle: [0.3, 0.5]}, floor_mass: [60 t, 50 t]}}, damping: 5 %";
  expect_as(
      "structures:\n"
      "  corner: {frame: {material: {E: 30 GPa}, " +
          body +
          ", initial_velocity: 0.5}\n"
          "  south: {frame: {material: {E: 30 GPa}, origin: [6.01, 0], " +
          body +
          "}\n"
          "  west: {frame: {material: {E: 30 GPa}, origin: [0, 5.02], " +
          body +
          "}\n"
          "links: [{between: neighbours, points: 2, law: modified_kelvin, stiffness: 9.35e7, restitution: 0.6}]\n"
          "analysis: {duration: 0.3}\n",
      std::move(model));
}

TEST(ModelByCode, OfAFrameByItsNodesIsThatOfTheInput) {
  FrameModel portal{.frame = Frame(2)};
  Frame& frame = portal.frame;
  for (const auto& [name, x, z] : {std::tuple("a", 0.0, 0.0), {"b", 0.0, 3.0}, {"c", 6.0, 3.0}, {"d", 6.0, 0.0}})
    frame.add_node({x, 0, z}, name);
  const Section section = rectangle_section(0.4, 0.4);
  frame.set_name(frame.add_member(0, 1, section, concrete), "left");
  frame.set_name(frame.add_member(1, 2, section, concrete), "beam");
  frame.set_name(frame.add_member(3, 2, section, concrete), "right");
  frame.add_mass(1, 10e3);
  frame.add_mass(2, 10e3);
  for (const int node : {2, 3}) frame.add_mass(node, Dof::ry, 100);
  frame.add_load(1, Dof::uz, -1e4);
  frame.fix(0);
  frame.fix(3, {Dof::ux, Dof::uz});
  frame.add_spring(1, Dof::ux, 1e6);
  frame.add_spring(1, 2, Dof::ux, 2e6);
  portal.supports = {{.name = "d", .nodes = {3}, .delay = 0.02}};
  portal.floors = {{.label = "1", .nodes = {1, 2}, .elevation = 3}};
  Model model;
  const auto left = model.add("portal", make_structure(portal), {.damping = 0.02});
  model.link(left.at(2), model.add("wall", make_wall()), {.gap = 0.005},
             laws::KelvinVoigt{.stiffness = 9e7, .restitution = 0.6});
  model.ground = Pulse{.shape = Pulse::Shape::half_sine, .amplitude = -6, .duration = 0.3};
  model.analysis.duration = 0.5;
  expect_as(
      "ground_motion: {pulse: {shape: half_sine, amplitude: -6, duration: 0.3}}\n"
      "structures:\n"
      "  portal:\n"
      "    frame:\n"
      "      material: {E: 30 GPa}\n"
      "      sections: {s: {rectangle: [0.4, 0.4]}}\n"
      "      nodes: {a: [0, 0], b: [0, 3], c: [6, 3], d: [6, 0]}\n"
      "      members: {left: {between: [a, b], section: s}, beam: {between: [b, c], section: s}, right: {between: [d, "
      "c], section: s}}\n"
      "      masses: {b: 10 t, c: {ux: 10 t, uz: 10 t, ry: 100}, d: {ry: 100}}\n"
      "      loads: {b: {uz: -10 kN}}\n"
      "      springs: [{node: b, dof: ux, stiffness: 1e6}, {between: [b, c], dof: ux, stiffness: 2e6}]\n"
      "      supports: {a: fixed, d: {fix: pinned, delay: 0.02}}\n"
      "      floors: [{nodes: [b, c]}]\n"
      "    damping: 2 %\n"
      "  wall: {wall: {}}\n"
      "links: [{between: [{structure: portal, elevation: 2}, wall], gap: 5 mm, law: kelvin_voigt, stiffness: 9e7, "
      "restitution: 0.6}]\n"
      "analysis: {duration: 0.5}\n",
      std::move(model));
}

// A user's law: twice the force of a linear spring of half the stiffness.
struct DoubledSpring {
  static constexpr std::string_view name = "doubled_spring";
  double half_stiffness = 0;
  void check() const {
    if (!(half_stiffness > 0)) throw std::invalid_argument("half_stiffness must be positive");
  }
  laws::Response contact(double penetration, double, const laws::Impact&) const noexcept {
    return {2 * half_stiffness * penetration, 2 * half_stiffness, 0};
  }
};

TEST(ModelByCode, TakesALawOfItsUser) {
  Model own = two_oscillators(DoubledSpring{.half_stiffness = 4.675e7});
  Model library = two_oscillators(laws::LinearSpring{.stiffness = 9.35e7});
  EXPECT_EQ(own.links[0].law, "doubled_spring");
  EXPECT_EQ(own.links[0].reduced_mass, 60e3);
  const Outcome a = run(own), b = run(library);
  ASSERT_FALSE(a.results.impacts.empty());
  EXPECT_EQ(a.results.links[0].force, b.results.links[0].force);
}

TEST(ModelByCode, ConnectsStructuresAsTheInputDoes) {
  Model model;
  const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
  const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
  const auto wall = model.add("wall", make_wall());
  model.link(left, right, {.gap = 0.02}, laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65});
  model.connect("both", left.floor(1), right,
                {.bar = Bar{.stiffness = 1e6}, .damper = Damper{.coefficient = 2e4, .exponent = 0.5}});
  model.connect("ground", right, wall, {.damper = Damper{.coefficient = 1e4}});
  model.ground = Harmonic{.amplitude = 3.0, .period = 0.6, .duration = 3.0};
  model.analysis = {.duration = 1.5, .tolerance = 1e-6};
  expect_as(R"(
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
structures:
  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
  wall: {wall: {}}
links: [{between: [left, right], gap: 20 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}]
devices:
  both: {between: [left, right], bar: {stiffness: 1 MN/m}, damper: {coefficient: 20 kN (s/m)^0.5, exponent: 0.5}}
  ground: {between: [right, wall], damper: {coefficient: 10 kN s/m}}
analysis: {duration: 1.5, tolerance: 1e-6}
)",
            std::move(model));
}

TEST(ModelByCode, RefusesDevicesThatCannotBe) {
  Model model;
  const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
  const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
  const auto option_of = [&](const std::string& name, const ContactLocation& end, const DeviceOptions& options) {
    try {
      model.connect(name, left, end, options);
    } catch (const ModelError& error) {
      return error.option();
    }
    ADD_FAILURE() << name << " was accepted";
    return ModelOption::structures;
  };
  EXPECT_EQ(option_of("none", right, {}), ModelOption::device);
  EXPECT_EQ(option_of("soft", right, {.bar = Bar{}}), ModelOption::bar);
  EXPECT_EQ(option_of("drawn", right, {.bar = BarSection{2e11, 1e-3}}), ModelOption::bar);
  EXPECT_EQ(option_of("steep", right, {.damper = Damper{.coefficient = 1, .exponent = 3}}), ModelOption::damper);
  EXPECT_EQ(option_of("itself", left, {.bar = Bar{1e6}}), ModelOption::between);
  EXPECT_EQ(option_of("high", right.floor(2), {.bar = Bar{1e6}}), ModelOption::right);
  EXPECT_EQ(option_of("", right, {.bar = Bar{1e6}}), ModelOption::device_name);
  model.connect("tie", left, right, {.bar = Bar{1e6}});
  EXPECT_EQ(option_of("tie", right, {.bar = Bar{1e6}}), ModelOption::device_name);
}

TEST(ModelByCode, KeepsTheReducedMassThatItsLawWasGiven) {
  const Model model = two_oscillators(laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65, .reduced_mass = 50e3});
  EXPECT_EQ(model.links[0].reduced_mass, 50e3);
  EXPECT_TRUE(model.links[0].reduced_mass_given);
}

}  // namespace by_code_test
}  // namespace pounding
