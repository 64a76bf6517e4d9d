// All unknowns of reduced structures, stepped through the impacts of a run, against runs in all natural modes from the
// same state.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/archive.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/reduction/reduce.hpp>
#include <pounding/reduction/reduced_modes.hpp>
#include <pounding/run/impact_windows.hpp>
#include <pounding/run/window_steps.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/models.hpp"

namespace pounding {
namespace window_steps_test {

constexpr double tolerance = 1e-7;

// Two plane frames of 96 unknowns with mass and as many rotations as nodes; the left one moves towards the right one
// and hits it at two floors.
struct Pair {
  std::string name, inside = "", devices = "";

  std::string text() const {
    const auto frame = [&](const std::string& of, double origin, double mass, const std::string& more,
                           const std::string& beside) {
      return fmt::format(
          "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: 12, bays: 3, storey_height: 3.2, "
          "bay_width: 6, columns: {{rectangle: [0.6, 0.6]}}, "
          "beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}{}}}, damping: 5 %{}}}\n",
          of, origin, mass, more, beside);
    };
    return "ground_motion: {harmonic: {amplitude: 3, period: 0.9, duration: 2}}\nstructures:\n" +
           frame("left", 0, 120, inside, ", initial_velocity: 0.3") + frame("right", 18.002, 60, "", "") +
           "links:\n  - {between: [left.12, right.12], gap: 2 mm, law: hertz_damped, stiffness: 2.75e9, restitution: "
           "0.65}\n"
           "  - {between: [left.6, right.6], gap: 2 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}\n" +
           devices + "analysis: {duration: 2}\n";
  }
};

std::vector<Pair> pairs() {
  return {{"Elastic"},
          {"Hinges", ", hinges: {columns: {at: feet, yield_moment: 20 kN m, hardening: 3 %}}"},
          {"Devices",
           ", devices: {brace: {between: [\"0.0\", \"1.1\"], bilinear: {stiffness: 200 MN/m, yield_force: 20 kN, "
           "hardening: 0.02}}}",
           "devices: {top: {between: [left.9, right.9], damper: {coefficient: 400 kN (s/m)^0.35, exponent: 0.35, "
           "stiffness: 60 MN/m}}}\n"}};
}

using Groups = std::vector<std::optional<ReducedGroup>>;

// All natural modes, as blocks that span every unknown.
ReducedGroup with_everything(const System& system, const Group& group) {
  const auto block = [&](const SparseMatrix& whole) {
    return SparseMatrix(whole.block(group.first, group.first, group.count, group.count));
  };
  petsc::ReducedInputs inputs;
  inputs.links.setIdentity(group.count, group.count);
  petsc::ReducedModes modes(block(system.mass), block(system.stiffness), inputs);
  return {.modes = std::make_shared<const GroupModes>(modes.modes({.links = 2, .ground = 0}))};
}

// A run with its windows.
struct Followed {
  Model model;
  System system;
  std::unique_ptr<ModalSolver> solver;
  std::unique_ptr<Stepper> stepper;
  std::unique_ptr<ImpactWindows> windows;
  std::vector<double> forces;           // maximum contact force in each step [N]
  double largest = 0;                   // displacement of all floors [m]
  std::vector<Eigen::VectorXd> floors;  // at the ends of steps
  std::vector<double> times;

  explicit Followed(const Pair& pair) : model(test::model_of(pair.text())), system(assemble(model)) {}

  Groups blocks(int links) const {
    const auto [u, v] = initial_state(model);
    const Reduction how{.kind = Reduction::Kind::blocks, .links = links, .ground = 12};
    return *petsc::reduced_groups(system, {{"left", "right"}, {how, how}, u, v, 1e-4});
  }
  Groups everything() const {
    Groups groups;
    for (const Group& group : system.groups) groups.emplace_back(with_everything(system, group));
    return groups;
  }

  void start(const Groups& groups, double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
    solver = std::make_unique<ModalSolver>(system, groups);
    stepper = std::make_unique<Stepper>(system, *solver, StepperOptions{.tolerance = tolerance, .max_step = 0.01});
    stepper->start(time, u, v);
    windows = std::make_unique<ImpactWindows>(
        stepper->view(), std::vector<bool>(static_cast<std::size_t>(system.contact_count()), true));
  }
  // Maximum forces in the first impact of every contact [N].
  Eigen::VectorXd first_peaks() const {
    Eigen::VectorXd first(system.contact_count());
    for (int i = 0; i < system.contact_count(); ++i) {
      const std::span<const ImpactRow> impacts =
          stepper->view().memory().contacts[static_cast<std::size_t>(i)].impacts();
      EXPECT_FALSE(impacts.empty());
      first[i] = impacts.empty() ? 0 : impacts[0].peak_force;
    }
    return first;
  }
  void follow(double end) {
    StepController controller(*stepper);
    ErrorControl policy(0.01);
    double h = 1e-5;
    while (stepper->view().time() < end) {
      h = controller.advance(h, end, policy);
      windows->step();
      floors.emplace_back(stepper->view().outputs_end_minus().motion.col(0));
      times.push_back(stepper->view().time());
      largest = std::max(largest, floors.back().cwiseAbs().maxCoeff());
      forces.push_back(0);
      for (int i = 0; i < system.contact_count(); ++i) {
        const LinkStep& step = stepper->view().link_step(i);
        forces.back() = std::max({forces.back(), step.force_begin, step.force_middle, step.force_end});
      }
    }
    windows->end();
  }
};

std::vector<int> all_outputs(const System& system) {
  std::vector<int> all(static_cast<std::size_t>(system.outputs.cols()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return all;
}

struct Found {
  Eigen::VectorXd forces;                    // maximum differences of peaks, by contact [N]
  double closing = 0, rate = 0, floors = 0;  // maximum differences [m], [m/s], [m]
};

Found differences(const Followed& run, const ImpactWindow& window) {
  const WindowDifferences left = differences_in_window(run.system, *run.solver, 0, all_outputs(run.system), window),
                          right = differences_in_window(run.system, *run.solver, 1, all_outputs(run.system), window);
  const Eigen::MatrixXd closings = left.closings + right.closings, rates = left.rates + right.rates;
  Eigen::VectorXd own = Eigen::VectorXd::Zero(run.system.contact_count()), of_all = own;
  for (std::size_t k = 0; k < window.steps.size(); ++k)
    for (const ImpactWindow::Force& f : window.steps[k].forces) {
      if (f.link >= run.system.contact_count()) continue;
      const auto at = static_cast<Eigen::Index>(k);
      own[f.link] = std::max(own[f.link], f.end);
      of_all[f.link] =
          std::max(of_all[f.link], f.end + f.by_penetration * closings(f.link, at) + f.by_rate * rates(f.link, at));
    }
  return {(of_all - own).cwiseAbs(), closings.cwiseAbs().maxCoeff(), rates.cwiseAbs().maxCoeff(),
          std::max(left.outputs.cwiseAbs().maxCoeff(), right.outputs.cwiseAbs().maxCoeff())};
}

class Windows : public testing::TestWithParam<Pair> {};

TEST_P(Windows, HoldNothingButRoundingWhereTheBasisHasEverything) {
  Followed run(GetParam());
  const auto [u, v] = initial_state(run.model);
  run.start(run.everything(), 0, u, v);
  run.follow(1.5);
  ASSERT_GE(run.windows->hardest().size(), 2u);
  const double hardest = *std::ranges::max_element(run.forces);
  EXPECT_GT(hardest, 1e5);
  for (const ImpactWindow& window : run.windows->hardest()) {
    const Found found = differences(run, window);
    EXPECT_LT(found.floors, 1e-9 * run.largest);
    EXPECT_LT(found.closing, 1e-9 * run.largest);
    EXPECT_LT(found.forces.maxCoeff(), 1e-6 * hardest);
  }
}

// The first impact, up to which all natural modes move as the run does, apart from the error of its basis. In the
// window the forces are given and the closings differ; in the full model the forces change as well. The two errors are
// of the same order of magnitude.
TEST_P(Windows, TellTheErrorOfTheirImpact) {
  constexpr double order =
      10;  // a peak may have a small error because the errors before and after it are equally large
  double last = 1;
  for (const int links : {1, 2, 3}) {
    Followed run(GetParam()), exact(GetParam());
    const auto [u, v] = initial_state(run.model);
    run.start(run.blocks(links), 0, u, v);
    exact.start(exact.everything(), 0, u, v);
    run.follow(0.08);
    ASSERT_EQ(run.windows->hardest().size(), 1u);
    const Found found = differences(run, run.windows->hardest()[0]);
    exact.follow(run.windows->hardest()[0].end());
    const double peak = exact.first_peaks().maxCoeff(),
                 truth = (run.first_peaks() - exact.first_peaks()).cwiseAbs().maxCoeff(),
                 reported = found.forces.maxCoeff();
    const auto after = std::ranges::find(run.times, exact.times.back());
    ASSERT_NE(after, run.times.end());
    const double floors =
        (run.floors[static_cast<std::size_t>(after - run.times.begin())] - exact.floors.back()).cwiseAbs().maxCoeff();
    RecordProperty(fmt::format("forces_{}", links), fmt::format("reported {:.2e}, true {:.2e}, ratio {:.2f}",
                                                                reported / peak, truth / peak, reported / truth));
    RecordProperty(fmt::format("floors_{}", links),
                   fmt::format("reported {:.2e}, true at the end {:.2e}, ratio {:.2f}", found.floors / run.largest,
                               floors / run.largest, found.floors / floors));
    EXPECT_LT(reported, order * truth) << links;
    EXPECT_GT(reported, truth / order) << links;
    EXPECT_LT(found.floors, order * floors) << links;
    EXPECT_GT(found.floors, floors / order) << links;
    EXPECT_LT(reported / peak, last) << links;
    last = reported / peak;
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, Windows, testing::ValuesIn(pairs()),
                         [](const testing::TestParamInfo<Pair>& test) { return test.param.name; });

TEST(ImpactWindowsOfARun, AreTheHardestOfAllInOrder) {
  Followed run(pairs()[0]);
  const auto [u, v] = initial_state(run.model);
  run.start(run.blocks(3), 0, u, v);
  run.follow(2);
  const std::vector<ImpactWindow>& hardest = run.windows->hardest();
  ASSERT_EQ(hardest.size(), ImpactWindows::maximum);
  const auto holds = [](const ImpactWindow& window, double time) {
    return window.begin() < time && time <= window.end();
  };
  for (std::size_t i = 0; i < hardest.size(); ++i) {
    if (i > 0) {
      EXPECT_LE(hardest[i].force, hardest[i - 1].force);
    }
    EXPECT_LT(hardest[i].end() - hardest[i].begin(), 0.1 + 0.01);
    for (std::size_t k = 1; k < hardest[i].steps.size(); ++k)
      EXPECT_EQ(hardest[i].steps[k].begin, hardest[i].steps[k - 1].end);
    double force = 0;
    for (std::size_t k = 0; k < run.times.size(); ++k)
      if (holds(hardest[i], run.times[k])) force = std::max(force, run.forces[k]);
    EXPECT_EQ(hardest[i].force, force);
  }
  // All other forces are smaller.
  for (std::size_t k = 0; k < run.times.size(); ++k) {
    if (run.forces[k] <= hardest.back().force) continue;
    EXPECT_TRUE(std::ranges::any_of(hardest, [&](const ImpactWindow& window) { return holds(window, run.times[k]); }))
        << run.times[k];
  }
}

// Windows restored in the middle of an impact continue unchanged.
TEST(ImpactWindowsOfARun, GoOnFromAnArchive) {
  Followed whole(pairs()[0]), parts(pairs()[0]);
  for (Followed* run : {&whole, &parts}) {
    const auto [u, v] = initial_state(run->model);
    run->start(run->blocks(2), 0, u, v);
  }
  const auto go = [](Followed& run, double end, double& h) {
    StepController controller(*run.stepper);
    ErrorControl policy(0.01);
    while (run.stepper->view().time() < end) {
      h = controller.advance(h, end, policy);
      run.windows->step();
    }
  };
  double h = 1e-5, other = 1e-5;
  go(whole, 0.012, h), go(parts, 0.012, other);
  ASSERT_TRUE(parts.stepper->view().in_contact());
  Archive saved;
  parts.windows->archive(saved);
  parts.windows = std::make_unique<ImpactWindows>(parts.stepper->view(), std::vector<bool>(2, true));
  Archive read(saved.bytes());
  parts.windows->archive(read);
  read.expect_end();
  go(whole, 0.2, h), go(parts, 0.2, other);
  whole.windows->end(), parts.windows->end();
  ASSERT_EQ(parts.windows->hardest().size(), whole.windows->hardest().size());
  Archive a, b;
  for (ImpactWindow window : whole.windows->hardest()) a(window);
  for (ImpactWindow window : parts.windows->hardest()) b(window);
  EXPECT_EQ(a.bytes(), b.bytes());
}

}  // namespace window_steps_test
}  // namespace pounding
