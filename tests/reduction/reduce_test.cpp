// Systems with reduced structures: which are reduced, how deep, and the contact force of two frames.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/linear/damping_matrix.hpp>
#include <pounding/linear/equal_groups.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/model/model.hpp>
#include <pounding/reduction/reduce.hpp>
#include <pounding/reduction/reduced_solver.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace reduce_test {

using petsc::reduced_groups;
using petsc::ReductionPlan;
using petsc::SolverKind;
using Kind = Reduction::Kind;

// Two plane frames of twenty storeys with contacts at three floors. Each has 160 unknowns with mass, and as many
// massless rotations.
struct Pair {
  Model model;
  System system;
  Eigen::VectorXd u, v;

  explicit Pair(int storeys = 20, int bays = 3) : model(test::model_of(text(storeys, bays))), system(assemble(model)) {
    std::tie(u, v) = initial_state(model);
  }

  static std::string text(int storeys, int bays) {
    const auto frame = [&](const std::string& name, double origin, double mass) {
      return fmt::format(
          "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: {}, bays: {}, storey_height: 3.2, "
          "bay_width: 6, columns: "
          "{{rectangle: [0.6, 0.6]}}, beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}}}, damping: 5 %}}\n",
          name, origin, storeys, bays, mass);
    };
    std::string links = "links:\n";
    for (const int floor : {storeys, 3 * storeys / 4, storeys / 2})
      links += fmt::format(
          "  - {{between: [left.{0}, right.{0}], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: "
          "0.65}}\n",
          floor);
    return "ground_motion: {harmonic: {amplitude: 3, period: 1.5, duration: 4}}\nstructures:\n" +
           frame("left", 0, 40.0 * bays) + frame("right", 6.0 * bays + 0.02, 20.0 * bays) + links +
           "analysis: {duration: 4}\n";
  }

  ReductionPlan plan(const Reduction& left, const Reduction& right, double tolerance = 1e-5) const {
    return {{"left", "right"}, {left, right}, u, v, tolerance};
  }
};

struct Seen {
  double peak = 0;  // of all forces [N]
  std::size_t impacts = 0;
  Eigen::MatrixXd floors;  // displacements of all floors at 40 times
  std::string description;
  Energies energies;
};

Seen follow(const Reduction& left, const Reduction& right) {
  Pair pair;
  const std::unique_ptr<StructureSolver> solver =
      petsc::make_solver(pair.system, SolverKind::automatic, pair.plan(left, right), PETSC_COMM_SELF);
  Stepper stepper(pair.system, *solver, {.tolerance = 1e-5, .max_step = 0.01});
  stepper.start(0, pair.u, pair.v);
  StepController controller(stepper);
  ErrorControl policy(0.01);
  Seen seen;
  seen.floors.resize(pair.system.outputs.cols(), 40);
  double h = 1e-4;
  for (int sample = 0; sample < 40; ++sample) {
    while (stepper.view().time() < 0.1 * (sample + 1)) h = controller.advance(h, 0.1 * (sample + 1), policy);
    seen.floors.col(sample) = stepper.view().outputs().motion.col(0);
  }
  for (const ContactMemory& contact : stepper.view().memory().contacts) {
    seen.impacts += contact.impacts().size();
    for (const ImpactRow& row : contact.impacts()) seen.peak = std::max(seen.peak, row.peak_force);
  }
  seen.description = solver->description();
  seen.energies = stepper.view().energies();
  return seen;
}

Seen follow(const Reduction& both) { return follow(both, both); }

constexpr Reduction blocks{.kind = Kind::blocks, .links = 5, .ground = 20};

class ReducedPair : public testing::Test {
 protected:
  static const Seen& exact() {
    static const Seen seen = follow({});
    return seen;
  }
  static double force_error(const Seen& seen) { return std::abs(seen.peak - exact().peak) / exact().peak; }
  static double floor_error(const Seen& seen) {
    return (seen.floors - exact().floors).cwiseAbs().maxCoeff() / exact().floors.cwiseAbs().maxCoeff();
  }
};

TEST_F(ReducedPair, HitsAsHardAsAllModes) {
  const Seen reduced = follow(blocks);
  ASSERT_GT(exact().impacts, 3u);
  EXPECT_EQ(reduced.impacts, exact().impacts);
  // Ten times the tolerance of the steps.
  EXPECT_LT(force_error(reduced), 1e-4);
  EXPECT_LT(floor_error(reduced), 1e-4);
  EXPECT_NE(exact().peak, reduced.peak) << "all modes were selected";
  EXPECT_NE(reduced.description.find("left: "), std::string::npos) << reduced.description;
  EXPECT_TRUE(test::mentions(reduced.description, {"240", "5", "3", "20"}));
}

TEST_F(ReducedPair, KeepsItsEnergyInBalance) {
  const Energies e = follow(blocks).energies;
  EXPECT_LT(std::abs(e.imbalance()), 1e-3 * std::abs(e.input));
}

// The lowest modes miss the local flexibility of the struck floors, even with their static responses.
TEST_F(ReducedPair, IsBetterByBlocksThanByAsManyModes) {
  const Seen by_modes = follow({.kind = Kind::lowest, .modes = 30});
  EXPECT_GT(force_error(by_modes), 3 * force_error(follow(blocks)));
}

TEST_F(ReducedPair, KeepsItsBitsWhereNothingIsReduced) {
  for (const Kind kind : {Kind::automatic, Kind::all_modes}) {
    const Seen same = follow({.kind = kind});
    EXPECT_EQ(same.peak, exact().peak);
    EXPECT_EQ(same.floors, exact().floors);
  }
}

TEST_F(ReducedPair, MayLeaveOneStructureWhole) {
  const Seen mixed = follow({}, blocks);
  EXPECT_LT(force_error(mixed), 1e-3);
  EXPECT_EQ(mixed.description.find("left: "), std::string::npos) << mixed.description;
  EXPECT_NE(mixed.description.find("right: "), std::string::npos) << mixed.description;
}

TEST(ReducedGroups, AreDeeperForASmallerTolerance) {
  const Pair pair(30, 9);  // 600 unknowns with mass
  const Reduction automatic{.kind = Kind::automatic};
  int last = 0;
  for (const double tolerance : {1e-2, 1e-3}) {
    const auto made = reduced_groups(pair.system, pair.plan(automatic, automatic, tolerance));
    ASSERT_TRUE(made && made->at(0) && made->at(1));
    const int count = static_cast<int>(made->at(0)->modes->squares.size());
    // Up to three directions per block of three links; some are already in the chain of the ground.
    EXPECT_GT(count, last == 0 ? 30 : last);
    EXPECT_LE(count, last == 0 ? 4 * 3 + 20 + 3 : last + 2 * 3);
    last = count;
  }
}

// One large unreduced structure leaves the system to factorizations, unless the depth of the other one was specified.
TEST(ReducedGroups, LeaveTheSystemToFactorsWhereALargeOneIsNotReduced) {
  const Pair pair(30, 9);
  const Reduction automatic{.kind = Kind::automatic};
  EXPECT_FALSE(reduced_groups(pair.system, pair.plan(automatic, {})));
  EXPECT_TRUE(reduced_groups(pair.system, pair.plan(blocks, {.kind = Kind::all_modes})));
  EXPECT_NE(petsc::make_solver(pair.system, SolverKind::automatic, pair.plan(automatic, {}), PETSC_COMM_SELF)
                ->description()
                .find("factor"),
            std::string::npos);
}

// Light damping requires unlimited blocks: 600 modes per structure cost less than factorizations.
TEST(ModalDamping, HasTheSameMatrixWhoeverFormsIt) {
  const Model model = test::model_of(
      "structures:\n  a: {shear_building: {storeys: 4, mass: 100 t, stiffness: 1.5e5 kN/m}, damping: {modal: {ratio: 5 "
      "%}}}\n"
      "  b: {shear_building: {storeys: 3, mass: 100 t, stiffness: 1.5e5 kN/m}, damping: {modal: {ratio: 3 "
      "%}}}\nanalysis: {duration: 1}\n");
  const System formed = assemble(model);
  System bare = formed;
  bare.modal_damping = {};
  ASSERT_GT(Eigen::MatrixXd(formed.modal_damping).norm(), 0);
  EXPECT_EQ(Eigen::MatrixXd(bare.formed_damping()).norm(), 0);
  EXPECT_EQ(Eigen::MatrixXd(petsc::damping_matrix(bare)), Eigen::MatrixXd(petsc::damping_matrix(formed)));
  EXPECT_EQ(Eigen::MatrixXd(petsc::damping_matrix(formed)), Eigen::MatrixXd(formed.modal_damping));
  // The other group has its matrix.
  bare.modal_damping = formed.modal_damping;
  bare.modal_damping.prune([](int i, int, double) { return i < 4; });
  EXPECT_EQ(Eigen::MatrixXd(petsc::damping_matrix(bare)), Eigen::MatrixXd(formed.modal_damping));
}

TEST(ModalDamping, IsTheSameInAllModesByItsMatrixAndByItsRatio) {
  const Model model = test::model_of(
      "structures:\n  a: {shear_building: {storeys: 4, mass: 100 t, stiffness: 1.5e5 kN/m}, damping: {modal: {ratio: 5 "
      "%}}}\nanalysis: {duration: 1}\n");
  const System formed = assemble(model);
  System bare = formed;
  bare.modal_damping = {};
  const auto damping = [](const System& system) {
    Eigen::MatrixXd kx(4, 4), cx(4, 4);
    const ModalSolver solver(system);
    solver.stiffness_times(Eigen::MatrixXd::Identity(4, 4), kx);
    solver.damping_times(Eigen::MatrixXd::Identity(4, 4), kx, cx);
    EXPECT_LT((cx.diagonal() - 0.1 * kx.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(), 1e-9 * cx(0, 0));
    return cx;
  };
  EXPECT_LT((damping(formed) - damping(bare)).cwiseAbs().maxCoeff(), 1e-9 * damping(formed)(0, 0));
  EXPECT_NE(ModalSolver(bare).description().find("decoupled"), std::string::npos);
}

TEST(ModalDamping, OfALargeStructureThatIsNotReducedIsRefused) {
  System system;
  constexpr int large = 1501;
  system.mass.resize(large + 1, large + 1);
  system.mass.setIdentity();
  system.stiffness = system.mass;
  system.damping.resize(large + 1, large + 1);
  system.gap_jacobian.resize(large + 1, 0);
  system.outputs.resize(large + 1, 0);
  system.load.resize(large + 1, 0);
  system.groups = {{.first = 0, .count = 1}, {.first = 1, .count = large, .modal_ratio = 0.05}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(large + 1);
  const ReductionPlan plan{{"small", "large"}, {{.kind = Kind::automatic}, {}}, zero, zero};
  try {
    petsc::make_solver(system, SolverKind::automatic, plan, PETSC_COMM_SELF);
    ADD_FAILURE() << "not rejected";
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(std::string(error.what()), {"large", "damping: 5 %", "1501"}));
  }
}

TEST(ReducedGroups, AreAllModesWhereAnAutomaticBasisWouldBeTooLarge) {
  const Pair pair(30, 9);
  const Reduction automatic{.kind = Kind::automatic};
  petsc::ReductionPlan plan = pair.plan(automatic, automatic);
  plan.deeper = 200;
  const auto made = reduced_groups(pair.system, plan);
  ASSERT_TRUE(made);
  EXPECT_FALSE(made->at(0));
  EXPECT_FALSE(made->at(1));
  EXPECT_NE(petsc::make_solver(pair.system, SolverKind::automatic, plan, PETSC_COMM_SELF)
                ->description()
                .find("all 1200 modes"),
            std::string::npos);
}

// Five towers in a row, the fourth of which is heavier. The outer towers have contacts on one side, on opposite ones.
struct Row {
  Model model;
  System system;
  Eigen::VectorXd u, v;

  // `heavier`: mass of each floor of the fourth tower [t].
  explicit Row(double heavier = 70) : model(test::model_of(text(heavier))), system(assemble(model)) {
    std::tie(u, v) = initial_state(model);
  }

  static std::string text(double heavier) {
    std::string structures = "ground_motion: {harmonic: {amplitude: 3, period: 1.5, duration: 4}}\nstructures:\n",
                links = "links:\n";
    for (int i = 0; i < 5; ++i) {
      structures += fmt::format(
          "  t{}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: 20, bays: 3, storey_height: 3.2, "
          "bay_width: 6, "
          "columns: {{rectangle: [0.6, 0.6]}}, beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}}}, damping: 5 "
          "%}}\n",
          i, 18.02 * i, i == 3 ? heavier : 60);
      if (i > 0)
        for (const int floor : {20, 15, 10})
          links += fmt::format(
              "  - {{between: [t{0}.{2}, t{1}.{2}], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: "
              "0.65}}\n",
              i - 1, i, floor);
    }
    return structures + links + "analysis: {duration: 4}\n";
  }

  ReducedGroups groups(const std::vector<Reduction>& how) const {
    return *reduced_groups(system, {{"t0", "t1", "t2", "t3", "t4"}, how, u, v, 1e-4});
  }
};

// Modes of each tower in a system of its type, in which it is unique.
TEST(EqualStructures, ShareModesWhereTheyAreDrivenAlikeAndKeepTheBitsOfEachByItself) {
  const Reduction blocks{.kind = Kind::blocks, .links = 2, .ground = 6};
  const Row row;
  const ReducedGroups made = row.groups({blocks, blocks, blocks, blocks, blocks});
  for (const auto& group : made) ASSERT_TRUE(group && group->shadow);
  EXPECT_EQ(made[1]->modes, made[2]->modes);
  EXPECT_EQ(made[1]->shadow, made[2]->shadow);
  EXPECT_EQ(made[2]->made.name, "t2");
  for (const int other : {0, 3, 4}) EXPECT_NE(made[1]->modes, made[static_cast<std::size_t>(other)]->modes) << other;
  EXPECT_NE(made[0]->modes, made[4]->modes);
  for (int k = 0; k < 5; ++k) {
    std::vector<Reduction> alone(5);
    alone[static_cast<std::size_t>(k)] = blocks;
    const ReducedGroups one = row.groups(alone);
    const auto at = static_cast<std::size_t>(k);
    EXPECT_EQ(made[at]->modes->shapes, one[at]->modes->shapes) << k;
    EXPECT_EQ(made[at]->modes->squares, one[at]->modes->squares) << k;
    EXPECT_EQ(made[at]->shadow->in_modes, one[at]->shadow->in_modes) << k;
    EXPECT_EQ(made[at]->shadow->squares, one[at]->shadow->squares) << k;
    EXPECT_EQ(made[at]->made.coordinates, one[at]->made.coordinates) << k;
  }
}

// A changed modification time shows that a file was used.
TEST(CachedModes, AreThoseThatAreMade) {
  namespace fs = std::filesystem;
  const Reduction blocks{.kind = Kind::blocks, .links = 2, .ground = 6}, lowest{.kind = Kind::lowest, .modes = 10};
  const Row row;
  const fs::path folder = fs::temp_directory_path() / fmt::format("kept_of_a_row_{}", getpid());
  const auto groups = [&](const std::string& cache_folder) {
    ReductionPlan plan{{"t0", "t1", "t2", "t3", "t4"}, {blocks, blocks, blocks, blocks, lowest}, row.u, row.v, 1e-4};
    plan.cache_folder = cache_folder;
    return *reduced_groups(row.system, plan);
  };
  const ReducedGroups made = groups(""), kept = groups(folder);
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  int files = 0;
  for (const auto& file : fs::directory_iterator(folder)) fs::last_write_time(file.path(), long_ago), ++files;
  EXPECT_EQ(files, 4) << "two of five are equal";
  const ReducedGroups found = groups(folder);
  for (const auto& file : fs::directory_iterator(folder))
    EXPECT_GT(fs::last_write_time(file.path()), long_ago + std::chrono::minutes(1));
  fs::remove_all(folder);
  for (const ReducedGroups* other : {&kept, &found})
    for (std::size_t k = 0; k < 5; ++k) {
      const ReducedGroup &a = *made[k], &b = *other->at(k);
      EXPECT_EQ(a.modes->shapes, b.modes->shapes) << k;
      EXPECT_EQ(a.modes->squares, b.modes->squares) << k;
      ASSERT_EQ(a.shadow != nullptr, b.shadow != nullptr) << k;
      if (a.shadow) {
        EXPECT_EQ(a.shadow->in_modes, b.shadow->in_modes) << k;
      }
      EXPECT_EQ(a.made.size_text(), b.made.size_text()) << k;
      EXPECT_EQ(a.made.flexibility_error, b.made.flexibility_error) << k;
    }
}

TEST(EqualStructures, DoNotShareWhatTheyWereNotAsked) {
  const Reduction blocks{.kind = Kind::blocks, .links = 2, .ground = 6},
      deeper{.kind = Kind::blocks, .links = 3, .ground = 6};
  const ReducedGroups made = Row().groups({blocks, blocks, deeper, blocks, blocks});
  EXPECT_NE(made[1]->modes, made[2]->modes);
  EXPECT_GT(made[2]->made.coordinates, made[1]->made.coordinates);
}

TEST(EqualStructures, AreThoseWithTheSameMassAndStiffness) {
  EXPECT_EQ(first_equal_groups(Row().system), (std::vector<int>{0, 0, 0, 3, 0}));
  EXPECT_EQ(first_equal_groups(Row(60 + 1e-13).system), (std::vector<int>{0, 0, 0, 3, 0})) << "the last bits matter";
}

// Also all natural modes.
TEST(EqualStructures, MoveAsTheyDoByThemselves) {
  const Row row;
  const ModalSolver solver(row.system);
  for (int k = 0; k < 5; ++k) {
    System one = row.system;
    for (int other = 0; other < 5; ++other)
      if (other != k) one.mass.coeffRef(one.groups[other].first, one.groups[other].first) *= 1 + 0.1 * (other + 1);
    const ModalSolver alone(one);
    const StructureSolver::Segment own = solver.layout().segments[k];
    Eigen::VectorXd x = Eigen::VectorXd::Zero(solver.size()), u, expected;
    x.segment(own.first, own.count).setLinSpaced(-1, 1);
    u = solver.physical(x);
    expected = alone.physical(x);
    EXPECT_EQ(u, expected) << k;
    EXPECT_EQ(solver.coordinates(u).segment(own.first, own.count), alone.coordinates(u).segment(own.first, own.count))
        << k;
    EXPECT_EQ(solver.layout().load.middleRows(own.first, own.count),
              alone.layout().load.middleRows(own.first, own.count))
        << k;
    Eigen::MatrixXd closings, of_alone;
    solver.gather(x, closings);
    alone.gather(x, of_alone);
    EXPECT_EQ(closings, of_alone) << k;
  }
}

// Solvers of other systems with some of the structures use the modes that exist.
TEST(NaturalModes, AreSharedBySolversOfSeveralSystems) {
  const Row row, lighter(30);
  const auto shared = std::make_shared<NaturalModes>();
  const auto of = [&](const Row& any, int k) { return shared->of(any.system, any.system.groups[k]); };
  EXPECT_EQ(of(row, 0), of(row, 4));
  EXPECT_NE(of(row, 0), of(row, 3));
  EXPECT_EQ(of(lighter, 4), of(row, 0));
  EXPECT_NE(of(lighter, 3), of(row, 3));
  const ModalSolver all(row.system, {}, {.groups = {}, .natural = shared}), own(row.system);
  EXPECT_EQ(all.layout().load, own.layout().load);
}

// The solvers of two sets of structures add up to the solver of all.
TEST(ModalSolver, OfSomeStructuresMovesThemAsAmongAll) {
  const Row row;
  const ModalSolver all(row.system), some(row.system, {}, {.groups = std::vector{1, 3}}),
      others(row.system, {}, {.groups = std::vector{0, 2, 4}});
  EXPECT_EQ(some.size() + others.size(), all.size());
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(row.system.size(), -1, 1);
  EXPECT_EQ(some.physical(some.coordinates(u)) + others.physical(others.coordinates(u)),
            all.physical(all.coordinates(u)));
  for (const StructureSolver::Segment& own : some.layout().segments) {
    const StructureSolver::Segment& among = all.layout().segments[static_cast<std::size_t>(own.group)];
    EXPECT_EQ(some.layout().load.middleRows(own.first, own.count),
              all.layout().load.middleRows(among.first, among.count));
    EXPECT_EQ(some.layout().group_masses[static_cast<std::size_t>(own.group)],
              all.layout().group_masses[static_cast<std::size_t>(own.group)]);
  }
  Eigen::MatrixXd by_some, by_others, by_all;
  some.gather(some.coordinates(u), by_some);
  others.gather(others.coordinates(u), by_others);
  all.gather(all.coordinates(u), by_all);
  EXPECT_LT((by_some + by_others - by_all).norm(), 1e-12 * by_all.norm());
}

TEST(ReducedGroups, RefuseNumbersThatMakeTheBasisTooLarge) {
  const Pair pair(30, 9);
  const Reduction deep{.kind = Kind::blocks, .links = 100, .ground = 20};
  try {
    reduced_groups(pair.system, pair.plan({}, deep));
    ADD_FAILURE() << "this one was accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(std::string(error.what()), {"right", "{links: 100, ground: 20}", "325", "600"}));
  }
}

// Hertz at 1 m/s: the stiffness 1.5 k sqrt(d) over the masses of both ends, which are a few nodes of a floor.
TEST(ReducedGroups, ShiftToTheFrequencyOfAContact) {
  const Pair pair;
  const double shift = petsc::contact_shift(pair.system, pair.system.groups[0]);
  EXPECT_EQ(std::log2(shift), std::round(std::log2(shift)));
  const double frequency = std::sqrt(shift) / (2 * M_PI);
  EXPECT_GT(frequency, 5);
  EXPECT_LT(frequency, 100);
}

}  // namespace reduce_test
}  // namespace pounding
