// The sparse matrices against the modes of the same frames, on one process and on two.

#include <gtest/gtest.h>

#include <petscsys.h>

#include <cmath>
#include <functional>
#include <memory>
#include <tuple>

#include <pounding/frames/frame.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/dense.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace structure_solvers_test {

using petsc::SparseOptions;
using petsc::SparseSolver;

int processes() {
  int count = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

// Two plane frames that face each other with a link at every common floor; rotations have no mass.
struct Pair {
  System system;
  std::vector<std::unique_ptr<const Contact>> contacts;

  explicit Pair(bool consistent = false, int frames = 2, double gap = 5e-4) {
    std::vector<AssembledFrame> parts;
    std::vector<GridFrame> grids;
    for (int k = 0; k < frames; ++k) {
      GridFrame grid;
      grid.storeys = 4 - k;
      grid.bays_x = 2;
      grid.storey_height = {3.2};
      grid.bay_width_x = {6.0};
      grid.column = Section{.area = 0.3, .inertia_y = (1 + 0.7 * k) * 5e-3};
      grid.beam = Section{.area = 0.18, .inertia_y = (1 + 0.7 * k) * 2.5e-3};
      grid.material = {.young = 25e9, .shear = 10e9, .density = consistent ? 2500.0 : 0.0};
      grid.mass = consistent ? BeamMass::consistent : BeamMass::lumped;
      grid.floor_mass = {72e3};
      grids.push_back(grid);
      parts.push_back(make_frame(grid).assemble());
    }
    int n = 0;
    std::vector<Eigen::Triplet<double>> mass, stiffness, jacobian;
    for (const AssembledFrame& part : parts) {
      for (int j = 0; j < part.size(); ++j) {
        for (SparseMatrix::InnerIterator it(part.mass, j); it; ++it) mass.emplace_back(n + it.row(), n + j, it.value());
        for (SparseMatrix::InnerIterator it(part.stiffness, j); it; ++it)
          stiffness.emplace_back(n + it.row(), n + j, it.value());
      }
      system.groups.push_back({n, part.size(), 1e-6, 1e-5, 0.3, 3e-3});
      n += part.size();
    }
    system.mass.resize(n, n);
    system.mass.setFromTriplets(mass.begin(), mass.end());
    system.stiffness.resize(n, n);
    system.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
    system.damping.resize(n, n);
    system.load.resize(n, 1);
    for (int k = 0; k < frames; ++k)
      system.load.col(0).segment(system.groups[k].first, parts[k].size()) = parts[k].load.col(0);
    if (frames == 2) {
      for (int floor = 1; floor <= 3; ++floor) {
        const auto end = [&](int frame, int line, double sign) {
          const Eigen::SparseVector<double> row = parts[frame].motion(grids[frame].node(floor, line), Dof::ux);
          for (Eigen::SparseVector<double>::InnerIterator it(row); it; ++it)
            jacobian.emplace_back(system.groups[frame].first + it.row(), floor - 1, sign * it.value());
        };
        end(0, 2, 1);
        end(1, 0, -1);
        contacts.push_back(std::make_unique<GapContact<laws::HertzDamped>>(
            laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, gap, floor - 1));
        system.contacts.push_back(contacts.back().get());
      }
    }
    system.gap_jacobian.resize(n, static_cast<int>(contacts.size()));
    system.gap_jacobian.setFromTriplets(jacobian.begin(), jacobian.end());
    system.outputs.resize(n, 0);
    system.grounds = {GroundMotion(Harmonic{3.0, 0.6, 10.0})};
  }
};

// The ground motion of the right frame is delayed, contacts have friction, and displacements of nodes are observed,
// including one massless rotation.
Pair rubbing_on_delayed_ground() {
  Pair pair;
  System& s = pair.system;
  const int n = s.size(), contacts = s.contact_count();
  s.grounds.push_back(s.grounds[0].delayed(0.08));
  s.load.conservativeResize(n, 2);
  s.load.col(1).setZero();
  const Group right = s.groups[1];
  s.load.col(1).segment(right.first, right.count).swap(s.load.col(0).segment(right.first, right.count));
  const Eigen::MatrixXd jacobian = s.gap_jacobian;
  Eigen::MatrixXd wider = Eigen::MatrixXd::Zero(n, 2 * contacts);
  wider.leftCols(contacts) = jacobian;
  for (int i = 0; i < contacts; ++i) {
    for (int k = 0; k + 1 < n; ++k)
      if (jacobian(k, i) != 0) wider(k + 1, contacts + i) = jacobian(k, i);  // uz of the same node
    s.frictions.push_back({.contact = i, .first = contacts + i, .count = 1, .coefficient = 0.4, .sliding = 0.02});
  }
  s.gap_jacobian = wider.sparseView();
  s.gap_by_ground = Eigen::MatrixXd::Zero(2 * contacts, 2);
  s.gap_by_ground.topRows(contacts).rowwise() = Eigen::RowVector2d(1, -1);
  s.gravity_offset = 1e-5 * Eigen::VectorXd::LinSpaced(2 * contacts, 0, 1);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, 5);
  rows(0, 0) = 1, rows(2, 1) = 1, rows(right.first + 4, 2) = -2, rows(n - 1, 3) = 1;
  rows(3, 4) = 1, rows(right.first, 4) = -1;
  s.outputs = rows.sparseView();
  return pair;
}

// Smooth and nonzero.
Eigen::VectorXd some_vector(int size, double phase) {
  Eigen::VectorXd x(size);
  for (int i = 0; i < size; ++i) x[i] = 1 + 0.6 * std::sin(0.9 * i + phase);
  return x;
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

// Matrix of the whole system for a shift, with explicit Rayleigh damping.
Eigen::MatrixXd whole(const System& system, const EffectiveMatrix& s) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(system.size(), system.size());
  const Eigen::MatrixXd m = system.mass, k = system.stiffness;
  for (const Group& g : system.groups)
    a.block(g.first, g.first, g.count, g.count) =
        (s.mass + s.damping * g.by_mass) * m.block(g.first, g.first, g.count, g.count) +
        (s.stiffness + s.damping * g.by_stiffness) * k.block(g.first, g.first, g.count, g.count);
  return a + s.damping * Eigen::MatrixXd(system.damping);
}

EffectiveMatrix of_step(double h) { return {0.5, 0.25 * h, 0.125 * h * h}; }

class SparseMatrices : public testing::TestWithParam<bool> {
 protected:
  Pair pair{GetParam()};
  const System& system = pair.system;
  int n = system.size();
};

TEST_P(SparseMatrices, MultiplyLikeDenseOnes) {
  const SparseSolver base(PETSC_COMM_WORLD, system);
  Eigen::MatrixXd x(n, 5), local(base.size(), 5), kx(base.size(), 5), cx(base.size(), 5);
  for (int j = 0; j < 5; ++j) local.col(j) = base.coordinates(x.col(j) = some_vector(n, j));
  Eigen::VectorXd u;
  for (const int columns : {1, 2, 3, 4, 5}) {
    base.stiffness_times(local.leftCols(columns), kx.leftCols(columns));
    base.damping_times(local.leftCols(columns), kx.leftCols(columns), cx.leftCols(columns));
    for (int j = 0; j < columns; ++j) {
      u = base.physical(kx.col(j));
      EXPECT_LT(difference(u, whole(system, {0, 0, 1}) * x.col(j)), 1e-13);
      u = base.physical(cx.col(j));
      EXPECT_LT(difference(u, whole(system, {0, 1, 0}) * x.col(j)), 1e-13);
    }
  }
  Eigen::VectorXd mx(base.size());
  base.mass_times(local.col(1), mx);
  u = base.physical(mx);
  EXPECT_LT(difference(u, whole(system, {1, 0, 0}) * x.col(1)), 1e-13);
}

// By a factorization at a step level, by conjugate gradients elsewhere; the condition number of these matrices is 1e5.
TEST_P(SparseMatrices, SolveOnAndOffTheStepLevels) {
  SparseSolver base(PETSC_COMM_WORLD, system, {.direct_below = 0});
  const Eigen::VectorXd b = some_vector(n, 1);
  const auto residual = [&](const EffectiveMatrix& shift, std::optional<int> step_level) {
    base.set_matrix(shift, step_level);
    Eigen::VectorXd x = base.coordinates(b), u;
    EXPECT_TRUE(base.solve(x));
    u = base.physical(x);
    return difference(u, test::dense::solve(whole(system, shift), b));
  };
  EXPECT_LT(residual(of_step(0.01), 0), 1e-10);
  EXPECT_EQ(base.iterations(), 0);
  for (const double h : {0.0095, 0.0063, 0.0011, 3e-5}) EXPECT_LT(residual(of_step(h), std::nullopt), 1e-10) << h;
  EXPECT_GT(base.iterations(), 4);
  EXPECT_LT(base.iterations(), 200);
  EXPECT_LT(residual(of_step(0.005), 1), 1e-10);
}

TEST_P(SparseMatrices, GiveTheSameFlexibilityAndResponseByEveryWay) {
  if (GetParam()) GTEST_SKIP() << "the same code path";
  const EffectiveMatrix shift = of_step(0.006);
  const std::vector<int> links{0, 2};
  const Eigen::MatrixXd b = Eigen::MatrixXd(system.gap_jacobian)(Eigen::all, links);
  const Eigen::MatrixXd z = test::dense::solve_columns(whole(system, shift), b);
  const Eigen::MatrixXd expected = b.transpose() * z;
  const Eigen::VectorXd f = Eigen::Vector2d(2, -3);
  const auto expect_same = [&](SparseSolver& base, const char* way) {
    Eigen::MatrixXd g;
    ASSERT_TRUE(base.flexibility(links, g)) << way;
    EXPECT_LT((g - expected).norm(), 1e-10 * expected.norm()) << way;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(base.size()), u;
    base.add_response(-0.5, links, f, y);
    u = base.physical(y);
    EXPECT_LT(difference(u, -0.5 * z * f), 1e-10) << way;
  };
  SparseSolver gradients(PETSC_COMM_WORLD, system, {.direct_below = 0}), direct(PETSC_COMM_WORLD, system);
  for (SparseSolver* base : {&gradients, &direct}) base->set_matrix(of_step(0.01), 0);
  gradients.set_matrix(shift, std::nullopt);
  expect_same(gradients, "conjugate gradients");
  EXPECT_GT(gradients.iterations(), 0);
  direct.set_matrix(shift, std::nullopt);
  expect_same(direct, "factor off the step levels");
  EXPECT_EQ(direct.iterations(), 0);
  direct.set_matrix(shift, 3);
  expect_same(direct, "factor at a step level");
}

// Frames of two storeys in a row, two links between neighbours: roofs first, then the floors below.
System row_of_frames(int frames) {
  GridFrame grid;
  grid.storeys = 2;
  grid.bays_x = 1;
  grid.storey_height = {3.2};
  grid.bay_width_x = {6.0};
  grid.column = Section{.area = 0.3, .inertia_y = 5e-3};
  grid.beam = Section{.area = 0.18, .inertia_y = 2.5e-3};
  grid.material = {.young = 25e9, .shear = 10e9};
  grid.floor_mass = {72e3};
  const AssembledFrame one = make_frame(grid).assemble();
  const int size = one.size(), n = frames * size;
  System s;
  std::vector<Eigen::Triplet<double>> mass, stiffness, jacobian;
  for (int k = 0; k < frames; ++k) {
    for (int j = 0; j < size; ++j) {
      for (SparseMatrix::InnerIterator it(one.mass, j); it; ++it)
        mass.emplace_back(k * size + it.row(), k * size + j, it.value());
      for (SparseMatrix::InnerIterator it(one.stiffness, j); it; ++it)
        stiffness.emplace_back(k * size + it.row(), k * size + j, (1 + 0.2 * k) * it.value());
    }
    s.groups.push_back({k * size, size, 1e-6, 1e-5, 0.3, 3e-3});
  }
  for (int i = 0; i < 2 * (frames - 1); ++i) {
    const int storey = i < frames - 1 ? 2 : 1, left = i % (frames - 1);
    for (const auto& [frame, line, sign] : {std::tuple(left, 1, 1.0), {left + 1, 0, -1.0}}) {
      const Eigen::SparseVector<double> row = one.motion(grid.node(storey, line), Dof::ux);
      for (Eigen::SparseVector<double>::InnerIterator it(row); it; ++it)
        jacobian.emplace_back(frame * size + it.row(), i, sign * it.value());
    }
  }
  s.mass.resize(n, n);
  s.mass.setFromTriplets(mass.begin(), mass.end());
  s.stiffness.resize(n, n);
  s.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  s.damping.resize(n, n);
  s.load = Eigen::MatrixXd::Zero(n, 1);
  s.gap_jacobian.resize(n, 2 * (frames - 1));
  s.gap_jacobian.setFromTriplets(jacobian.begin(), jacobian.end());
  return s;
}

// Links that share no frame share a solve; their displacements must remain separate.
TEST(RowOfFrames, KeepsLinksApartThatAreSolvedTogether) {
  const System system = row_of_frames(5);
  ASSERT_GE(static_cast<int>(system.groups.size()), processes());
  const EffectiveMatrix off = of_step(0.006), on = of_step(0.01);
  for (const std::vector<int>& links : {std::vector<int>{0, 2}, {1, 3}, {0, 1, 2, 3, 6}, {0, 1, 2, 3, 4, 5, 6, 7}})
    for (const int direct_below : {0, 1000000})
      for (const bool at_level : {true, false}) {
        SparseSolver base(PETSC_COMM_WORLD, system, {.direct_below = direct_below});
        base.set_matrix(on, 0);
        if (!at_level) base.set_matrix(off, std::nullopt);
        const Eigen::MatrixXd b = Eigen::MatrixXd(system.gap_jacobian)(Eigen::all, links);
        const Eigen::MatrixXd z = test::dense::solve_columns(whole(system, at_level ? on : off), b),
                              expected = b.transpose() * z;
        Eigen::MatrixXd g;
        ASSERT_TRUE(base.flexibility(links, g));
        EXPECT_LT((g - expected).norm(), 1e-10 * expected.norm());
        EXPECT_EQ((g.array() == 0).count(), (expected.array() == 0).count());
        const Eigen::VectorXd f = some_vector(static_cast<int>(links.size()), 2);
        Eigen::VectorXd y = Eigen::VectorXd::Zero(base.size()), u;
        base.add_response(-0.5, links, f, y);
        u = base.physical(y);
        EXPECT_LT(difference(u, -0.5 * z * f), 1e-10);
      }
}

// A column of A^-1 B for each link would make memory quadratic in the length of a row of buildings.
TEST(RowOfFrames, NeedsMemoryInProportionToItsLength) {
  if (processes() > 1) GTEST_SKIP() << "only the frames of one process count";
  const auto columns = [](int frames) {
    const System system = row_of_frames(frames);
    SparseSolver base(PETSC_COMM_WORLD, system);
    base.set_matrix(of_step(0.01), 0);
    const double factor = base.memory();
    std::vector<int> links(system.links());
    for (int i = 0; i < system.links(); ++i) links[i] = i;
    Eigen::MatrixXd g;
    EXPECT_TRUE(base.flexibility(links, g));
    return (base.memory() - factor) / frames;
  };
  EXPECT_LT(columns(32), 2 * columns(8));
}

// A factorization reuses only the symbolic pattern of an earlier one.
TEST(OffTheStepLevels, AFactorDoesNotDependOnTheOneBefore) {
  const Pair pair;
  const Eigen::VectorXd b = some_vector(pair.system.size(), 1);
  const auto solved = [&](std::initializer_list<double> steps) {
    SparseSolver base(PETSC_COMM_WORLD, pair.system, {.direct_below = 1000000});
    base.set_matrix(of_step(0.01), 0);
    Eigen::VectorXd x;
    for (const double h : steps) {
      base.set_matrix(of_step(h), std::nullopt);
      x = base.coordinates(b);
      EXPECT_TRUE(base.solve(x));
    }
    return x;
  };
  EXPECT_EQ(solved({0.006}), solved({0.0097, 0.0011, 0.006}));
}

TEST_P(SparseMatrices, AccelerateAndFollowAsTheStiffnessAsks) {
  const SparseSolver base(PETSC_COMM_WORLD, system);
  const Eigen::VectorXd masses = system.mass.diagonal();
  const Eigen::MatrixXd k = system.stiffness;
  Eigen::VectorXd r = base.coordinates(some_vector(n, 2)), u;
  base.accelerate(r);
  u = base.physical(r);
  const Eigen::VectorXd back = system.mass * u;
  for (int i = 0; i < n; ++i) {
    if (masses[i] > 0) {
      EXPECT_NEAR(back[i], some_vector(n, 2)[i], 1e-9);
    } else {
      EXPECT_EQ(u[i], 0);
    }
  }
  Eigen::VectorXd x = base.coordinates(some_vector(n, 3));
  base.recover(x);
  u = base.physical(x);
  const Eigen::VectorXd pull = k * u;
  int followed = 0;
  for (int i = 0; i < n; ++i)
    if (masses[i] == 0) {
      EXPECT_NEAR(pull[i], 0, 1e-10 * k.cwiseAbs().maxCoeff());
      ++followed;
    } else {
      EXPECT_EQ(u[i], some_vector(n, 3)[i]);
    }
  EXPECT_EQ(followed > 0, !GetParam());
}

TEST_P(SparseMatrices, GatherAndPushAtTheEndsOfLinks) {
  const SparseSolver base(PETSC_COMM_WORLD, system);
  const Eigen::VectorXd x = some_vector(n, 4);
  Eigen::MatrixXd relative;
  base.gather(base.coordinates(x), relative);
  EXPECT_LT(difference(relative.col(0), system.gap_jacobian.transpose() * x), 1e-14);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(base.size()), u;
  base.add_forces(-2, Eigen::Vector3d(1, 5, 0), y);
  u = base.physical(y);
  EXPECT_LT(difference(u, -2 * system.gap_jacobian * Eigen::Vector3d(1, 5, 0)), 1e-15);
}

TEST(SeveralGrounds, AreLoadsOfTheRowsHere) {
  const Pair pair = rubbing_on_delayed_ground();
  const SparseSolver sparse(PETSC_COMM_WORLD, pair.system);
  const ModalSolver modal(pair.system);
  for (int k = 0; k < 2; ++k) {
    Eigen::VectorXd u;
    u = sparse.physical(sparse.layout().load.col(k));
    EXPECT_EQ((u - pair.system.load.col(k)).norm(), 0);
    Eigen::VectorXd a = modal.layout().load.col(k), expected = sparse.layout().load.col(k), b;
    sparse.accelerate(expected);
    sparse.recover(expected);
    b = sparse.physical(expected);
    u = modal.physical(a);
    EXPECT_LT(difference(u, b), 1e-10);
  }
}

TEST(OutputQuantities, IsTheSameByModesAndBySparseMatrices) {
  const Pair pair = rubbing_on_delayed_ground();
  const SparseSolver sparse(PETSC_COMM_WORLD, pair.system);
  const ModalSolver modal(pair.system);
  const int n = pair.system.size();
  Eigen::MatrixXd x(n, 3), local(sparse.size(), 3), modes(modal.size(), 3), seen, by_modes;
  for (int j = 0; j < 3; ++j) {
    Eigen::VectorXd part = sparse.coordinates(some_vector(n, j)), u;
    sparse.recover(part);
    u = sparse.physical(part);
    x.col(j) = u;
    local.col(j) = part;
    modes.col(j) = modal.coordinates(u);
  }
  sparse.observe(local, seen);
  modal.observe(modes, by_modes);
  const Eigen::MatrixXd expected = pair.system.outputs.transpose() * x;
  EXPECT_LT((seen - expected).norm(), 1e-15 * expected.norm());
  EXPECT_LT((by_modes - expected).norm(), 1e-10 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Frames, SparseMatrices, testing::Bool(),
                         [](const auto& test) { return test.param ? "consistent" : "lumped"; });

// Without a second structure, two processes share one factorization.
TEST(OneFrame, IsSharedByAllProcesses) {
  const Pair pair(false, 1);
  const System& system = pair.system;
  SparseSolver base(PETSC_COMM_WORLD, system, {.direct_below = 0});
  const Eigen::VectorXd b = some_vector(system.size(), 1);
  base.set_matrix(of_step(0.01), 0);
  for (const auto& [h, step_level] : {std::pair(0.01, std::optional<int>(0)), {0.007, std::nullopt}}) {
    base.set_matrix(of_step(h), step_level);
    Eigen::VectorXd x = base.coordinates(b), u;
    ASSERT_TRUE(base.solve(x));
    u = base.physical(x);
    EXPECT_LT(difference(u, test::dense::solve(whole(system, of_step(h)), b)), 1e-10);
  }
  EXPECT_NE(base.description().find(processes() > 1 ? "mumps" : "petsc"), std::string::npos) << base.description();
  Eigen::VectorXd x = base.coordinates(b), u;
  base.recover(x);
  u = base.physical(x);
  const Eigen::VectorXd pull = system.stiffness * u;
  for (int i = 0; i < system.size(); ++i)
    if (system.mass.coeff(i, i) == 0) {
      EXPECT_NEAR(pull[i], 0, 1e-10 * system.stiffness.coeffs().cwiseAbs().maxCoeff());
    }
}

// The result of a trial must not depend on the previous trials.
TEST(OffTheStepLevels, ASolveDependsOnItsStepAlone) {
  const Pair pair;
  const System& system = pair.system;
  const auto solved = [&](bool others) {
    SparseSolver base(PETSC_COMM_WORLD, system, {.direct_below = 0});
    Eigen::MatrixXd g;
    base.set_matrix(of_step(0.01), 0);
    if (others)
      for (const double h : {0.0071, 0.002, 0.0063}) {
        base.set_matrix(of_step(h), std::nullopt);
        EXPECT_TRUE(base.flexibility(std::vector{1}, g));
      }
    base.set_matrix(of_step(0.0063), std::nullopt);
    Eigen::VectorXd x = base.coordinates(some_vector(system.size(), 1)), u;
    EXPECT_TRUE(base.solve(x));
    EXPECT_TRUE(base.flexibility(std::vector{0, 1}, g));
    base.add_response(1, std::vector{0, 1}, Eigen::Vector2d(1e3, 2e3), x);
    u = base.physical(x);
    return u;
  };
  EXPECT_EQ((solved(true) - solved(false)).lpNorm<Eigen::Infinity>(), 0);
}

// Step lengths that end at a corner of the ground motion differ in their last digits.
TEST(OffTheStepLevels, ARungButForRoundingNeedsNoFactorOfItsOwn) {
  const Pair pair;
  SparseSolver base(PETSC_COMM_WORLD, pair.system, {.direct_below = 0});
  const Eigen::VectorXd b = some_vector(pair.system.size(), 1);
  for (const double part : {1.0, 1 + 3e-10, 1 - 2e-10, 1.0}) {
    base.set_matrix(of_step(0.005 * part), 1);
    Eigen::VectorXd x = base.coordinates(b), u;
    ASSERT_TRUE(base.solve(x));
    u = base.physical(x);
    EXPECT_LT(difference(u, test::dense::solve(whole(pair.system, of_step(0.005 * part)), b)), 1e-11) << part;
  }
  EXPECT_EQ(base.factors(), 1);
  EXPECT_EQ(base.factorizations(), 1);
  EXPECT_GT(base.iterations(), 0);
  EXPECT_LE(base.iterations(), 8);
}

TEST(Memory, IsKeptByDroppingTheLeastRecentlyUsedRung) {
  const Pair pair;
  SparseSolver roomy(PETSC_COMM_WORLD, pair.system);
  for (int k = 0; k < 6; ++k) roomy.set_matrix(of_step(0.01 / (1 << k)), k);
  EXPECT_EQ(roomy.factors(), 6);
  SparseSolver tight(PETSC_COMM_WORLD, pair.system, {.memory = 0.6 * roomy.memory()});
  for (int k = 0; k < 6; ++k) tight.set_matrix(of_step(0.01 / (1 << k)), k);
  EXPECT_GE(tight.factors(), 2);
  EXPECT_LE(tight.factors(), 3);
  EXPECT_LE(tight.memory(), 0.6 * roomy.memory());
  const long before = tight.factorizations();
  tight.set_matrix(of_step(0.01 / 32), 5);
  EXPECT_EQ(tight.factorizations(), before);
  tight.set_matrix(of_step(0.01), 0);
  EXPECT_EQ(tight.factorizations(), before + 1);
}

TEST(SparseSolver, RefusesWhatCannotMove) {
  const auto text_of = [](Pair& pair, bool follow = false) {
    try {
      const SparseSolver base(PETSC_COMM_WORLD, pair.system);
      Eigen::VectorXd x = Eigen::VectorXd::Ones(base.size());
      if (follow) base.recover(x);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Pair on_rotation;
  on_rotation.system.gap_jacobian.coeffRef(2, 1) = 1;
  EXPECT_TRUE(test::mentions(text_of(on_rotation), {"1", "2"}));
  Pair loose;
  loose.system.stiffness.coeffRef(5, 5) = 0;
  EXPECT_TRUE(test::mentions(text_of(loose), {"5"}));
  Pair joined;
  joined.system.stiffness.coeffRef(0, joined.system.size() - 1) = 1;
  EXPECT_NE(text_of(joined), "");
  Pair mechanism;  // rotations 2 and 5 are free to turn together
  for (const int i : {2, 5})
    for (SparseMatrix::InnerIterator it(mechanism.system.stiffness, i); it; ++it) {
      it.valueRef() = 0;
      mechanism.system.stiffness.coeffRef(i, it.row()) = 0;
    }
  for (const auto& [i, j, value] : {std::tuple(2, 2, 1e8), {5, 5, 1e8}, {2, 5, -1e8}, {5, 2, -1e8}})
    mechanism.system.stiffness.coeffRef(i, j) = value;
  const std::string text = text_of(mechanism, true);
  EXPECT_TRUE(test::mentions(text, {"massless", "stiffness"}));
  EXPECT_TRUE(text.find("unknown 2 ") != std::string::npos || text.find("unknown 5 ") != std::string::npos) << text;
}

struct Trajectory {
  State end;
  std::vector<double> peaks;
  int impacts = 0;
  double imbalance = 0;  // energy imbalance as a fraction of the input
  Eigen::VectorXd seen;  // observed displacements
};

// The longest dyadic step, with shorter ones around events.
Trajectory march(Pair& pair, StructureSolver& base, Scheme scheme, double until) {
  constexpr double h = 2e-3;
  Stepper stepper(pair.system, base, {.tolerance = 1e-4, .scheme = scheme, .max_step = h});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(pair.system.size());
  stepper.start(0, zero, zero);
  Trajectory run;
  StepController controller(stepper);
  FixedSteps policy;
  while (stepper.view().time() < until - 1e-9)
    controller.advance(h, std::min(until, h * (std::floor(stepper.view().time() / h + 1e-6) + 1)), policy);
  run.end = stepper.view().state();
  run.seen = stepper.view().outputs().motion.col(0);
  const Energies e = stepper.view().energies();
  run.imbalance = 1 - (e.kinetic + e.strain + e.damping + e.impact) / e.input;
  for (const ContactMemory& contact : stepper.view().memory().contacts)
    for (const ImpactRow& row : contact.impacts()) {
      run.peaks.push_back(row.peak_force);
      ++run.impacts;
    }
  return run;
}

// On two processes the modes are those of one process: the same trajectory in parallel and in serial.
void expect_to_move_alike(const std::function<Pair()>& make) {
  constexpr auto second_order = Scheme::Kind::generalized_alpha;
  for (const Scheme scheme : {Scheme{.kind = second_order}, Scheme{.kind = second_order, .spectral_radius = 0.8},
                              Scheme{.kind = Scheme::Kind::esdirk4}}) {
    Pair of_modes = make(), of_factors = make(), of_gradients = make();
    ModalSolver modal(of_modes.system);
    SparseSolver direct(PETSC_COMM_WORLD, of_factors.system);
    SparseSolver gradients(PETSC_COMM_WORLD, of_gradients.system, {.direct_below = 0});
    const Trajectory expected = march(of_modes, modal, scheme, 1.0);
    EXPECT_GT(expected.impacts, 3);
    for (const auto& [pair, base] :
         {std::pair<Pair*, SparseSolver*>(&of_factors, &direct), {&of_gradients, &gradients}}) {
      const Trajectory run = march(*pair, *base, scheme, 1.0);
      EXPECT_EQ(run.impacts, expected.impacts);
      EXPECT_EQ(run.end.time, expected.end.time);
      EXPECT_LT(difference(run.end.u, expected.end.u), 1e-9) << base->description();
      EXPECT_LT(difference(run.end.v, expected.end.v), 1e-8) << base->description();
      EXPECT_NEAR(run.imbalance, expected.imbalance, 1e-6);
      EXPECT_LT(std::abs(run.imbalance), 1e-3);
      EXPECT_LT((run.seen - pair->system.outputs.transpose() * run.end.u).norm(), 1e-14);
      ASSERT_EQ(run.peaks.size(), expected.peaks.size());
      for (std::size_t i = 0; i < run.peaks.size(); ++i)
        EXPECT_NEAR(run.peaks[i], expected.peaks[i], 1e-8 * expected.peaks[i]);
    }
    EXPECT_EQ(direct.iterations(), 0);
    EXPECT_GT(gradients.iterations(), 0);
  }
}

TEST(TwoFrames, MoveAlikeInModesAndInSparseMatrices) {
  expect_to_move_alike([] { return Pair(); });
}

TEST(TwoFramesThatRubOnDelayedGround, MoveAlikeInModesAndInSparseMatrices) {
  expect_to_move_alike(rubbing_on_delayed_ground);
}

}  // namespace structure_solvers_test
}  // namespace pounding
