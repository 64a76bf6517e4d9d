// Springs at massless degrees of freedom, which respond to their forces without inertia: hinges of a frame.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include "support/dense.hpp"
#include "support/hinge_frame.hpp"
#include "support/without_range.hpp"

namespace pounding {
namespace hinges_test {

using test::HingeFrame;
using test::HingeFrameRun;
using test::run_hinge_frame;

constexpr Scheme esdirk{.kind = Scheme::Kind::esdirk4};
constexpr Scheme alpha{.kind = Scheme::Kind::generalized_alpha};
constexpr Scheme damped{.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 0.8};

// About three periods in which all hinges yield.
const GroundMotion shake(Harmonic{4.0, 0.7, 2.0});
constexpr double end = 2.5;

bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

HingeFrameRun run(HingeFrame& frame, const Scheme& scheme, double tolerance) {
  ModalSolver solver(frame.system);
  return run_hinge_frame(frame, solver, {.tolerance = tolerance, .scheme = scheme, .max_step = 0.02}, end);
}

class Hinges : public testing::TestWithParam<Scheme> {};

INSTANTIATE_TEST_SUITE_P(Schemes, Hinges, testing::Values(esdirk, alpha, damped),
                         [](const auto& test) { return "scheme" + std::to_string(test.index); });

// K with softened yielding springs against K with forces: the same deformations and displacements under the same load.
TEST(HingesAtRest, GiveWayAsASofterStiffnessSays) {
  HingeFrame frame;
  const System& system = frame.system;
  const ModalSolver solver(system);
  const SpringRelief& relief = solver.layout().relief;
  const Eigen::MatrixXd k(system.stiffness), b(system.gap_jacobian), s(relief.flexibility());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  for (int i = 0; i < system.size(); ++i)
    if (system.mass.coeff(i, i) > 0) load[i] = 1e4 * std::sin(1 + i);
  Eigen::VectorXd slope(frame.hinges());
  for (int i = 0; i < frame.hinges(); ++i) slope[i] = -frame.spring_stiffness[i] * (0.1 + 0.1 * i);
  const Eigen::MatrixXd softer = k + b * slope.asDiagonal() * b.transpose();
  const Eigen::VectorXd expected = test::dense::solve(softer, load), deformation = b.transpose() * expected;
  const Eigen::VectorXd force = slope.cwiseProduct(deformation);
  // The coordinates contain the unknowns with mass only; relief() adds the deflection of the massless ones.
  Eigen::VectorXd x = solver.coordinates(expected), u, push = Eigen::VectorXd::Zero(solver.size());
  u = solver.physical(x);
  EXPECT_LT((u - expected).norm(), 2 * expected.norm());
  EXPECT_GT((u - expected).norm(), 1e-3 * expected.norm()) << "otherwise no spring would yield";
  Eigen::MatrixXd relative;
  solver.gather(x, relative);
  EXPECT_LT((relative.col(0) - s * force - deformation).norm(), 1e-12 * deformation.norm());
  relief.add_way(-1, force, u);
  EXPECT_LT((u - expected).norm(), 1e-12 * expected.norm());
  solver.add_forces(1, force, push);
  Eigen::MatrixXd kx(solver.size(), 1), loads = Eigen::MatrixXd::Zero(solver.size(), 1);
  solver.stiffness_times(x, kx);
  Eigen::VectorXd physical = Eigen::VectorXd::Zero(solver.size());
  solver.add_physical_forces(load, physical);
  EXPECT_LT((kx.col(0) + push - physical).norm(), 1e-11 * physical.norm());
}

TEST_P(Hinges, CloseTheirEnergies) {
  for (const double tolerance : {1e-4, 1e-5}) {
    HingeFrame frame({}, shake);
    const HingeFrameRun done = run(frame, GetParam(), tolerance);
    EXPECT_LT(std::abs(done.imbalance()), tolerance);
    EXPECT_GT(done.energy.hysteretic, 0.2 * done.energy.input);
    for (const double ductility : done.ductility) EXPECT_GT(ductility, 2);
  }
}

// The reference is the other scheme at a very small tolerance.
TEST_P(Hinges, KeepTheTolerance) {
  HingeFrame exact_frame({}, shake);
  const bool by_alpha = GetParam().kind == esdirk.kind;
  const HingeFrameRun exact = run(exact_frame, by_alpha ? alpha : esdirk, by_alpha ? 1e-6 : 1e-7);
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    HingeFrame frame({}, shake);
    const HingeFrameRun done = run(frame, GetParam(), tolerance);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(done.peak_floor[i], exact.peak_floor[i], tolerance * exact.peak_floor[i]) << tolerance;
      EXPECT_NEAR(done.end_floor[i], exact.end_floor[i], tolerance * exact.peak_floor[2]) << tolerance;
    }
  }
}

TEST_P(Hinges, ThatNeverYieldCostNoBit) {
  HingeFrame strong({.strength = 1e3}, shake), elastic({.elastic = true}, shake);
  const HingeFrameRun a = run(strong, GetParam(), 1e-4), b = run(elastic, GetParam(), 1e-4);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.trials, b.trials);
  EXPECT_TRUE(same_bits(a.end.u, b.end.u));
  EXPECT_TRUE(same_bits(a.end.v, b.end.v));
  EXPECT_TRUE(same_bits(a.end.a, b.end.a));
  EXPECT_EQ(a.iterations, 0);
}

// Steps in which every hinge stays in its elastic range, before the first yield and between two yields, with and
// without gravity.
TEST_P(Hinges, ThatStayInTheirRangesMoveToTheBitAsByTheLongWay) {
  for (const bool bears : {false, true}) {
    HingeFrame quick({.frames = 2, .mirrored = true}, shake), slow({.frames = 2, .mirrored = true}, shake);
    std::vector<std::unique_ptr<test::WithoutRange>> hidden;
    for (const Element*& element : slow.system.elements)
      element = hidden.emplace_back(std::make_unique<test::WithoutRange>(static_cast<const Spring&>(*element))).get();
    for (HingeFrame* frame : {&quick, &slow}) {
      frame->add_contact(std::make_unique<GapContact<laws::HertzDamped>>(
          laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, 0.02, 0));
      if (!bears) continue;
      frame->system.gravity_offset.setZero(frame->system.links());
      for (int i = 0; i < frame->hinges(); ++i)
        frame->system.gravity_offset[1 + i] = 0.2 * std::sin(1 + i) * frame->springs[i]->yield_deformation();
    }
    const auto run = [](HingeFrame& frame, std::vector<double>& numbers, long& stayed) {
      ModalSolver solver(frame.system);
      return run_hinge_frame(
          frame, solver, {.tolerance = 1e-4, .scheme = GetParam(), .max_step = 0.02}, end, 4,
          [&](StepController& controller) {
            if (controller.stepper().view().springs_stayed()) ++stayed;
            for (const LinkStep& step : controller.stepper().view().link_steps())
              for (const double value :
                   {step.motion_begin.penetration, step.motion_begin.rate, step.motion_middle.penetration,
                    step.motion_middle.rate, step.motion_end.penetration, step.motion_end.rate, step.force_begin,
                    step.force_middle, step.force_end, step.acceleration_begin, step.acceleration_end})
                numbers.push_back(value);
          });
    };
    std::vector<double> seen, expected;
    long quickly = 0, slowly = 0;
    const HingeFrameRun a = run(quick, seen, quickly), b = run(slow, expected, slowly);
    EXPECT_GT(quickly, 20);
    EXPECT_LT(quickly, a.steps - 100);
    EXPECT_EQ(slowly, 0);
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(a.trials, b.trials);
    EXPECT_TRUE(same_bits(a.end.u, b.end.u));
    EXPECT_TRUE(same_bits(a.end.v, b.end.v));
    EXPECT_TRUE(same_bits(a.end.a, b.end.a));
    EXPECT_TRUE(same_bits(a.end.force, b.end.force));
    EXPECT_EQ(a.slip, b.slip);
    EXPECT_EQ(a.hinge_work, b.hinge_work);
    EXPECT_EQ(a.base_shear, b.base_shear);
    EXPECT_EQ(a.energy.strain, b.energy.strain);
    EXPECT_EQ(a.energy.hysteretic, b.energy.hysteretic);
    EXPECT_GT(a.energy.hysteretic, 0);
  }
}

TEST_P(Hinges, OfTwoMirroredFramesMoveAlike) {
  HingeFrame frames({.frames = 2, .mirrored = true}, shake);
  const HingeFrameRun done = run(frames, GetParam(), 1e-5);
  const Eigen::VectorXd& u = done.end.u;
  for (int i = 0; i < frames.unknowns; i += 6)
    for (int j = 0; j < 6 && i + j < 18; ++j) {
      // Mirrored across the bay: x and rotations change sign, z does not.
      const int across = frames.unknowns + i + (j + 3) % 6;
      const double sign = j % 3 == 1 ? 1 : -1;
      EXPECT_NEAR(u[i + j], sign * u[across], 1e-9 * u.cwiseAbs().maxCoeff());
    }
  EXPECT_LT(std::abs(done.imbalance()), 1e-5);
}

TEST_P(Hinges, BesideAContactCloseTheirEnergies) {
  HingeFrame frames({.frames = 2, .mirrored = true}, shake);
  frames.add_contact(std::make_unique<GapContact<laws::HertzDamped>>(
      laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, 0.02, 0));
  const HingeFrameRun done = run(frames, GetParam(), 1e-5);
  EXPECT_GT(done.impacts, 1u);
  EXPECT_GT(done.energy.hysteretic, 0.2 * done.energy.input);
  EXPECT_LT(std::abs(done.imbalance()), 1e-5);
}

// Static equilibrium of the massless unknowns including springs, also inside steps.
TEST_P(Hinges, AreInEquilibriumInsideSteps) {
  HingeFrame frame({}, shake);
  ModalSolver solver(frame.system);
  double worst = 0, size = 0;
  const auto look = [&](StepController& controller) {
    const Stepper& stepper = controller.stepper();
    Eigen::VectorXd u, v, f;
    const double begin = stepper.view().begin().time, h = stepper.view().end_minus().time - begin;
    for (const double part : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      stepper.view().interpolate(begin + part * h, u, v);
      stepper.view().interpolate_springs(begin + part * h, f);
      const Eigen::VectorXd force = frame.system.stiffness * u + frame.system.gap_jacobian * f;
      for (int i = 0; i < frame.system.size(); ++i)
        if (frame.system.mass.coeff(i, i) == 0) worst = std::max(worst, std::abs(force[i]));
      for (int i = 0; i < frame.hinges(); ++i)
        size = std::max(size, std::abs(frame.spring_stiffness[i] * frame.system.gap_jacobian.col(i).dot(u) + f[i]));
    }
  };
  run_hinge_frame(frame, solver, {.tolerance = 1e-5, .scheme = GetParam(), .max_step = 0.02}, end, 1, look);
  EXPECT_LT(worst, 1e-6 * size);
}

TEST_P(Hinges, GoOnToTheBit) {
  HingeFrame whole({}, shake), first({}, shake), second({}, shake);
  const StepperOptions options{.tolerance = 1e-4, .scheme = GetParam(), .max_step = 0.02};
  ModalSolver of_whole(whole.system), of_first(first.system), of_second(second.system);
  const auto march = [](StepController& controller, double until, double& h) {
    ErrorControl policy(0.02);
    while (controller.stepper().view().time() < until) h = controller.advance(h, until, policy);
  };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(whole.system.size());
  Stepper a(whole.system, of_whole, options), b(first.system, of_first, options), c(second.system, of_second, options);
  a.start(0, zero, zero);
  b.start(0, zero, zero);
  c.start(0, zero, zero);
  StepController all(a), one(b), other(c);
  double h = 1e-3, h2 = 1e-3;
  for (const double until : {0.4, 0.8, 1.2, 2.0}) {
    march(all, until, h);
    march(one, until, h2);
    Archive archive;
    one.archive(archive);
    Archive copy(archive.bytes());
    other.archive(copy);
    archive = Archive();
    other.archive(archive);
    Archive back(archive.bytes());
    one.archive(back);
    EXPECT_TRUE(same_bits(all.stepper().view().state().u, one.stepper().view().state().u)) << until;
    EXPECT_TRUE(same_bits(all.stepper().view().state().v, other.stepper().view().state().v)) << until;
    EXPECT_TRUE(same_bits(all.stepper().view().state().force, one.stepper().view().state().force)) << until;
  }
  EXPECT_GT(a.view().energies().hysteretic, 0);
}

TEST_P(Hinges, MoveAlikeInModesAndInSparseMatrices) {
  HingeFrame of_modes({.frames = 2}, shake), of_factors({.frames = 2}, shake);
  ModalSolver modal(of_modes.system);
  petsc::SparseSolver sparse(PETSC_COMM_WORLD, of_factors.system);
  const auto march = [&](HingeFrame& frame, StructureSolver& solver) {
    constexpr double h = 2e-3;
    Stepper stepper(frame.system, solver, {.tolerance = 1e-4, .scheme = GetParam(), .max_step = h});
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(frame.system.size());
    stepper.start(0, zero, zero);
    StepController controller(stepper);
    FixedSteps policy;
    while (stepper.view().time() < 1.5 - 1e-9)
      controller.advance(h, std::min(1.5, h * (std::floor(stepper.view().time() / h + 1e-6) + 1)), policy);
    EXPECT_GT(stepper.view().energies().hysteretic, 0.2 * stepper.view().energies().input);
    return stepper.view().state();
  };
  const State a = march(of_modes, modal), b = march(of_factors, sparse);
  // Corners are located within 1e-6 times the step.
  EXPECT_LT((a.u - b.u).norm(), 1e-8 * a.u.norm());
  EXPECT_LT((a.v - b.v).norm(), 1e-6 * a.v.norm());
  EXPECT_LT((a.force - b.force).norm(), 1e-8 * a.force.norm());
}

// A step that ends at a corner would need its own factorization: here the error alone limits the steps.
TEST_P(Hinges, OfFramesWithFactorsKeepTheToleranceWithoutStepsThatEndAtCorners) {
  constexpr double longest = 0.016;
  const auto run_with = [&](auto&& make, double tolerance) {
    HingeFrame frame({.frames = 2}, shake);
    const auto solver = make(frame.system);
    int off_levels = 0;
    const HingeFrameRun done =
        run_hinge_frame(frame, *solver, {.tolerance = tolerance, .scheme = GetParam(), .max_step = longest}, end, 4,
                        [&](StepController& controller) {
                          const double h = controller.stepper().view().instant_end_minus().time -
                                           controller.stepper().view().instant_begin().time;
                          const double level = std::log2(longest / h);
                          if (std::abs(level - std::round(level)) > 1e-6) ++off_levels;
                        });
    return std::pair(done, off_levels);
  };
  const auto modal = [](const System& system) { return std::make_unique<ModalSolver>(system); };
  const auto sparse = [](const System& system) {
    return std::make_unique<petsc::SparseSolver>(PETSC_COMM_WORLD, system);
  };
  const HingeFrameRun truth = run_with(modal, 1e-6).first;
  for (const double tolerance : {1e-3, 1e-4}) {
    const auto [done, off_levels] = run_with(sparse, tolerance);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(done.peak_floor[i], truth.peak_floor[i], tolerance * truth.peak_floor[2]) << tolerance;
      EXPECT_NEAR(done.end_floor[i], truth.end_floor[i], tolerance * truth.peak_floor[2]) << tolerance;
    }
    EXPECT_LT(std::abs(done.imbalance()), tolerance);
    EXPECT_LT(off_levels, 4) << "breakpoints of the ground and the end of the run";
    EXPECT_GT(done.energy.hysteretic, 0.2 * done.energy.input);
  }
}

}  // namespace hinges_test
}  // namespace pounding
