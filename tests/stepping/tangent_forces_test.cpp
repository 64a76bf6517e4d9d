// Structures with tangent forces: the same motion as by other methods, energy, restart, purity of a trial.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <pounding/linear/make_solver.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/stepping/stepper.hpp>
#include "support/direct.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace tangent_forces_test {

using Eigen::VectorXd;

// Elastic forces without a memory, as tangent forces.
class Remembered final : public TangentForces {
 public:
  explicit Remembered(const ElasticForces& forces) : forces_(forces) {}

  const VectorXd& at_rest() const override { return forces_.at_rest(); }
  std::unique_ptr<Motion> start() const override { return std::make_unique<Nothing>(); }
  void begin_step(Motion&) const override {}
  double linearize(Motion&, const VectorXd& u, VectorXd& force, Eigen::SparseMatrix<double>& tangent) const override {
    force = forces_.force(u);
    tangent = forces_.tangent(u);
    return 0;
  }
  void record_stage(Motion&, const VectorXd&, double) const override {}
  bool accept(Motion&, double) const override { return false; }
  VectorXd member_forces(const Motion&, double) const override { return {}; }
  Energy energy(const Motion&, const VectorXd& u) const override { return {forces_.energy(u), 0}; }

 private:
  struct Nothing final : Motion {
    void archive(Archive&) override {}
  };

  const ElasticForces& forces_;
};

// A mast that is thrown, and a wall or an oscillator that it may hit.
std::string mast(bool heavy, const std::string& damping, const std::string& others, const std::string& links) {
  return fmt::format(
      "structures:\n  mast: {{frame: {{geometry: corotational, gravity: {}, material: {{E: 1e10}},\n"
      "    sections: {{s: {{area: 2e-4, inertia_y: 4e-6}}}},\n"
      "    nodes: {{a: [0, 0], b: [0, 1], c: [0, 2], d: [0, 3], e: [0, 4]}},\n"
      "    members: {{1: {{between: [a, b], section: s}}, 2: {{between: [b, c], section: s}}, 3: {{between: [c, d], "
      "section: s}},\n"
      "      4: {{between: [d, e], section: s}}}},\n"
      "    supports: {{a: fixed}}, masses: {{b: 50, c: 50, d: 50, e: 50}}, floors: [{{nodes: [c]}}, {{nodes: "
      "[e]}}]}},\n"
      "    damping: {}, initial_velocity: 6}}\n{}links: {}\nanalysis: {{duration: 1}}\n",
      heavy, damping, others, links);
}

// A stepper on a model whose elastic forces are replaced by tangent forces, or not.
struct Motion {
  Model model;
  System system;
  std::vector<std::unique_ptr<Remembered>> forces;
  std::unique_ptr<StructureSolver> solver;
  std::unique_ptr<Stepper> stepper;

  Motion(const std::string& yaml, double tolerance, bool tangent) : model(test::model_of(yaml)) {
    system = assemble(model, true);
    if (tangent)
      for (Group& group : system.groups)
        if (group.elastic) {
          forces.push_back(std::make_unique<Remembered>(*group.elastic));
          group.tangent = forces.back().get();
          group.elastic = nullptr;
        }
    solver = petsc::make_solver(system, petsc::SolverKind::automatic, PETSC_COMM_SELF);
    stepper = std::make_unique<Stepper>(
        system, *solver,
        StepperOptions{.tolerance = tolerance, .scheme = {.kind = Scheme::Kind::esdirk4}, .max_step = 0.02});
    const auto [u, v] = initial_state(model);
    stepper->start(0, u, v);
  }
  const State& state() const { return stepper->view().state(); }
  double imbalance() const {
    const Energies e = stepper->view().energies();
    return std::abs(e.input - e.kinetic - e.strain - e.damping - e.impact - e.hysteretic) / e.input;
  }
};

constexpr const char* damped = "{rayleigh: {alpha: 0.3, beta: 0.0005}}";

TEST(TangentForces, MoveAsElasticForcesDo) {
  for (const bool heavy : {false, true})
    for (const std::string damping : {"0", damped}) {
      const std::string yaml = mast(heavy, damping, "", "[]");
      Motion tangent(yaml, 1e-8, true), elastic(yaml, 1e-8, false);
      test::march(*tangent.stepper, 1, 0.02);
      test::march(*elastic.stepper, 1, 0.02);
      EXPECT_LT((tangent.state().u - elastic.state().u).cwiseAbs().maxCoeff(), 2e-6) << heavy << damping;
      EXPECT_LT((tangent.state().v - elastic.state().v).cwiseAbs().maxCoeff(), 2e-5) << heavy << damping;
      EXPECT_LT(tangent.imbalance(), 1e-7) << heavy << damping;
    }
}

TEST(TangentForces, HitAsElasticForcesDo) {
  for (const std::string law :
       {"kelvin_voigt_no_tension, stiffness: 1e5, restitution: 0.7", "hertz_damped, stiffness: 1e6, restitution: 0.6",
        "stereomechanical, restitution: 0.5"}) {
    const std::string yaml = mast(true, damped, "  ball: {oscillator: {mass: 80, period: 0.9}, damping: 2 %}\n",
                                  fmt::format("[{{between: [mast.2, ball], gap: 0.4, law: {}}}]", law));
    Motion tangent(yaml, 1e-7, true), elastic(yaml, 1e-7, false);
    test::march(*tangent.stepper, 1, 0.02);
    test::march(*elastic.stepper, 1, 0.02);
    EXPECT_LT((tangent.state().u - elastic.state().u).cwiseAbs().maxCoeff(), 2e-5) << law;
    EXPECT_GE(tangent.stepper->view().events(), 1) << law;
    EXPECT_EQ(tangent.stepper->view().events(), elastic.stepper->view().events()) << law;
    EXPECT_LT(tangent.imbalance(), 1e-6) << law;
  }
}

TEST(TangentForces, TrialIsPureAndRestoredStateGoesTheSameWay) {
  const std::string yaml = mast(true, damped, "", "[]");
  Motion one(yaml, 1e-6, true), other(yaml, 1e-6, true);
  test::march(*one.stepper, 0.5, 0.02);
  other.stepper->restore(one.stepper->save());
  EXPECT_TRUE(one.stepper->try_step(0.01));
  EXPECT_TRUE(one.stepper->try_step(0.003));
  test::march(*one.stepper, 1, 0.02);
  test::march(*other.stepper, 1, 0.02);
  EXPECT_EQ(one.state().u, other.state().u);
  EXPECT_EQ(one.state().v, other.state().v);
}

}  // namespace tangent_forces_test
}  // namespace pounding
