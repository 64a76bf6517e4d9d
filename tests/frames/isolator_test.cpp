// Isolators under frames: their weight, their contribution to the matrices, and error messages.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/structures/isolators.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace isolator_test {

const IsolatorOptions slider{.law = {.law = "friction_pendulum", .values = {{"radius", 2}, {"friction", 0.06}}}};
const IsolatorOptions lead_rubber{
    .law = {.law = "lead_rubber",
            .values = {{"strength", 100e3}, {"post_yield_stiffness", 1e6}, {"yield_displacement", 0.01}}}};

// Two storeys and two bays on isolators, with a slab of 40 t at each foot.
FrameModel frame(const IsolatorOptions& isolator, bool has_slab = true) {
  GridFrame grid;
  grid.storeys = grid.bays_x = 2;
  grid.storey_height = {3.2};
  grid.bay_width_x = {6};
  grid.floor_mass = {60e3};
  grid.column = rectangle_section(0.5, 0.5);
  grid.beam = rectangle_section(0.3, 0.6);
  grid.material = {.young = 30e9, .shear = 12.5e9};
  FrameModel model;
  const GridParts parts = add_grid(model, grid);
  for (const int foot : parts.feet) {
    model.frame.fix(foot, {Dof::uz, Dof::ry});
    model.frame.add_mass(foot, 40e3);
    model.isolators.push_back({foot, isolator});
    if (has_slab && foot != parts.feet.front()) model.frame.tie(parts.feet.front(), foot, {Dof::ux});
  }
  model.gravity = true;
  return model;
}

std::string refusal_of(FrameModel model) {
  return test::refusal([&] { make_structure(std::move(model)); });
}

double parameter(const YieldingPart& part, const std::string& name) {
  const auto found = std::ranges::find(part.parameters, name, &YieldingPart::Parameter::name);
  return found == part.parameters.end() ? -1 : found->value;
}

TEST(FrameIsolators, CarryTheLoadAtRestOfTheirFoot) {
  const Structure s = make_structure(frame(slider));
  ASSERT_EQ(s.yielding.size(), 3u);
  EXPECT_EQ(s.yielding[0].name, "isolator 0.0");
  EXPECT_EQ(s.yielding[2].name, "isolator 0.2");
  double sum = 0;
  const int first_reaction = static_cast<int>(s.forces.members.size() * s.forces.components.size());
  for (int i = 0; i < 3; ++i) {
    const double weight = parameter(s.yielding[i], "weight");
    sum += weight;
    const int row = first_reaction + 3 * i + 1;  // x, z, ry of each foot
    EXPECT_NEAR(weight, (s.forces.rows * s.at_rest)[row] + s.forces.at_rest[row], 1e-9 * weight)
        << "the reported reaction";
  }
  EXPECT_NEAR(sum, (2 * 60e3 + 3 * 40e3) * 9.80665, 1e-9 * sum);
  EXPECT_NEAR(parameter(s.yielding[0], "weight"), parameter(s.yielding[2], "weight"), 1e-9 * sum);
  EXPECT_GT(parameter(s.yielding[1], "weight"), 1.1 * parameter(s.yielding[0], "weight"));
}

TEST(FrameIsolators, AreSpringsOfTheFrameAndTheirReactions) {
  FrameModel springs = frame(lead_rubber);
  const std::vector<FrameIsolator> isolators = springs.isolators;
  springs.isolators.clear();
  for (const FrameIsolator& isolator : isolators) springs.frame.add_spring(isolator.node, Dof::ux, 11e6);
  const Structure elastic = make_structure(springs), s = make_structure(frame(lead_rubber));
  EXPECT_EQ(Eigen::MatrixXd(s.stiffness), Eigen::MatrixXd(elastic.stiffness));
  EXPECT_EQ(Eigen::MatrixXd(s.forces.rows), Eigen::MatrixXd(elastic.forces.rows));
  ASSERT_EQ(s.forces.by_yielding.cols(), 3);
  EXPECT_EQ(Eigen::MatrixXd(s.forces.by_yielding).cwiseAbs().sum(), 3);
  const int first_reaction = static_cast<int>(s.forces.members.size() * s.forces.components.size());
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(s.forces.by_yielding.coeff(first_reaction + 3 * i, i), -1) << "the ground pushes back";
  // All isolators are under one slab.
  EXPECT_EQ(Eigen::VectorXd(s.yielding[0].deformation), Eigen::VectorXd(s.yielding[2].deformation));
}

TEST(FrameIsolators, StandBesideHinges) {
  FrameModel model = frame(lead_rubber);
  model.frame.add_hinge({.member = 0, .at = MemberEnd::end, .yield_moment = 1e6, .hardening = 0.03});
  const Structure s = make_structure(model);
  ASSERT_EQ(s.yielding.size(), 4u);
  EXPECT_FALSE(isolates(s.yielding[0]));
  EXPECT_TRUE(isolates(s.yielding[1]));
  EXPECT_EQ(s.yielding_flexibility.rows(), 4);
  EXPECT_EQ(s.forces.by_yielding.cols(), 4);
  for (const Floor& floor : s.floors)
    for (const Row& row : floor.storey_shear_by_yielding) EXPECT_EQ(row.size(), 4);
}

TEST(FrameIsolators, RefuseWhatCannotBe) {
  FrameModel model = frame(slider);
  model.gravity = false;
  EXPECT_TRUE(test::mentions(refusal_of(model), {"gravity: true", "weight: 500 kN", "0.0"}));
  model = frame(slider);
  model.geometry = FrameGeometry::corotational;
  EXPECT_TRUE(test::mentions(refusal_of(model), {"geometry: p_delta", "0.0"}));
  model = frame(slider);
  model.frame.fix(model.isolators[1].node, {Dof::ux});
  EXPECT_NE(refusal_of(model).find("0.1"), std::string::npos) << refusal_of(model);
  model = frame(slider);
  model.frame.add_load(model.isolators[0].node, Dof::uz, 1e7);
  EXPECT_TRUE(test::mentions(refusal_of(model), {"isolator 0.0", "-9311 kN"})) << refusal_of(model);
}

TEST(FrameIsolators, NeedMassAtTheirFeet) {
  GridFrame grid;
  grid.storeys = grid.bays_x = 1;
  grid.storey_height = {3};
  grid.bay_width_x = {6};
  grid.floor_mass = {60e3};
  grid.column = grid.beam = rectangle_section(0.5, 0.5);
  grid.material = {.young = 30e9, .shear = 12.5e9};
  FrameModel model;
  for (const int foot : add_grid(model, grid).feet) {
    model.frame.fix(foot, {Dof::uz, Dof::ry});
    model.isolators.push_back({foot, lead_rubber});
  }
  EXPECT_TRUE(test::mentions(refusal_of(model), {"0.0"}));
}

TEST(FrameIsolators, RefuseToSlideAtRest) {
  FrameModel model = frame(slider, false);
  model.frame.add_load(model.isolators[0].node, Dof::ux, 1e6);
  const std::string text = refusal_of(model);
  EXPECT_TRUE(test::mentions(text.substr(0, 64), {"0.0"})) << text;
  EXPECT_TRUE(test::mentions(text, {"ties: [{master: 0.0, nodes: [...], dofs: [ux]}]"}));
}

}  // namespace isolator_test
}  // namespace pounding
