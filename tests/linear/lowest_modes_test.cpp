// Modes of frames: sparse against dense, closed forms, equal frequencies and free motions.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/linear/mode_count.hpp>
#include <pounding/petsc/environment.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace lowest_modes_test {

using petsc::lowest_modes;
using petsc::sparse_modes;

// Bays and storeys differ, so that all frequencies are distinct; rotations have no mass.
AssembledFrame plane_frame(int storeys, int bays) {
  GridFrame grid;
  grid.storeys = storeys;
  grid.bays_x = bays;
  grid.storey_height = {3.2};
  grid.bay_width_x = {6.0};
  grid.column = Section{.area = 0.3, .inertia_y = 5e-3};
  grid.beam = Section{.area = 0.18, .inertia_y = 2.5e-3};
  grid.material = {.young = 25e9, .shear = 10e9};
  grid.floor_mass = {40e3 * bays};
  return make_frame(grid).assemble();
}

// In plan `bays` by `bays` of equal widths: symmetric in x and y if the sections are.
GridFrame tower(int storeys, int bays, bool rigid_floors, bool alike = true) {
  GridFrame grid;
  grid.storeys = storeys;
  grid.bays_x = grid.bays_y = bays;
  grid.storey_height = {3.2};
  grid.bay_width_x = {6.0};
  grid.bay_width_y = {alike ? 6.0 : 5.0};
  grid.column = Section{.area = 0.36, .inertia_y = 1.08e-2, .inertia_z = alike ? 1.08e-2 : 0.8e-2, .torsion = 1.8e-2};
  grid.beam = Section{.area = 0.18, .inertia_y = 5.4e-3, .inertia_z = 1.35e-3, .torsion = 4e-3};
  grid.material = {.young = 30e9, .shear = 12.5e9};
  grid.floor_mass = {36e3 * bays * bays};
  grid.rigid_floors = rigid_floors;
  return grid;
}

// Errors of M and K projected on the modes against 1 and w^2 on the diagonal, and of the residual K phi - w^2 M phi.
void expect_modes(const Eigenmodes& modes, const SparseMatrix& mass, const SparseMatrix& stiffness, double residual) {
  const Eigen::VectorXd squares = modes.frequencies.cwiseAbs2();
  const int count = static_cast<int>(squares.size());
  const Eigen::MatrixXd m = modes.shapes.transpose() * (mass * modes.shapes);
  EXPECT_LT((m - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::MatrixXd inertia = mass * modes.shapes * squares.asDiagonal();
  const Eigen::MatrixXd left = stiffness * modes.shapes - inertia;
  for (int j = 0; j < count; ++j) {
    const Eigen::VectorXd magnitudes = stiffness.cwiseAbs() * modes.shapes.col(j).cwiseAbs();
    EXPECT_LT(left.col(j).norm(), residual * magnitudes.norm()) << "mode " << j + 1;
    if (j > 0) {
      EXPECT_LE(modes.frequencies[j - 1], modes.frequencies[j]);
    }
  }
}

// Shapes may be rotated into each other only for equal frequencies: each must lie in the span of those of its
// frequency.
void expect_same(const Eigenmodes& modes, const Eigenmodes& expected, const SparseMatrix& mass, double tolerance) {
  ASSERT_EQ(modes.frequencies.size(), expected.frequencies.size());
  const int count = static_cast<int>(modes.frequencies.size());
  for (int j = 0; j < count; ++j)
    EXPECT_NEAR(modes.frequencies[j], expected.frequencies[j], tolerance * expected.frequencies[j]) << "mode " << j + 1;
  const Eigen::MatrixXd overlap = expected.shapes.transpose() * (mass * modes.shapes);
  for (int j = 0; j < count; ++j) {
    Eigen::VectorXd rest = modes.shapes.col(j);
    for (int i = 0; i < count; ++i)
      if (std::abs(expected.frequencies[i] / expected.frequencies[j] - 1) < 1e-5)
        rest -= overlap(i, j) * expected.shapes.col(i);
    EXPECT_LT(rest.lpNorm<Eigen::Infinity>(), tolerance * modes.shapes.col(j).lpNorm<Eigen::Infinity>())
        << "mode " << j + 1;
  }
}

TEST(SparseModes, AreTheDenseOnesOfAPlaneFrame) {
  const AssembledFrame frame = plane_frame(20, 9);
  ASSERT_EQ(frame.size(), 600);
  ASSERT_EQ(split_by_mass(frame.mass).dynamic.size(), 400u);
  const Eigenmodes dense = dense_modes(frame.mass, frame.stiffness, 20);
  const Eigenmodes sparse = sparse_modes(frame.mass, frame.stiffness, 20);
  expect_modes(dense, frame.mass, frame.stiffness, 1e-12);
  expect_modes(sparse, frame.mass, frame.stiffness, 1e-12);
  expect_same(sparse, dense, frame.mass, 1e-9);
  // All frequencies are distinct here, so that signs are unique.
  EXPECT_LT((sparse.shapes - dense.shapes).cwiseAbs().maxCoeff(), 1e-9 * dense.shapes.cwiseAbs().maxCoeff());
}

TEST(SparseModes, AreTheDenseOnesOfATowerWithRigidFloors) {
  for (const bool alike : {false, true}) {
    const AssembledFrame frame = make_frame(tower(12, 3, true, alike)).assemble();
    ASSERT_EQ(frame.size(), 12 * (3 + 16 * 3));
    const Eigenmodes dense = dense_modes(frame.mass, frame.stiffness, 15);
    const Eigenmodes sparse = sparse_modes(frame.mass, frame.stiffness, 15);
    expect_modes(sparse, frame.mass, frame.stiffness, 1e-12);
    expect_same(sparse, dense, frame.mass, 1e-9);
  }
}

TEST(SparseModes, AreTheDenseOnesOfConsistentMasses) {
  GridFrame grid = tower(5, 2, false, false);
  grid.mass = BeamMass::consistent;
  grid.material.density = 2500;
  const AssembledFrame frame = make_frame(grid).assemble();
  const Eigenmodes dense = dense_modes(frame.mass, frame.stiffness, 12);
  expect_same(sparse_modes(frame.mass, frame.stiffness, 12), dense, frame.mass, 1e-9);
}

TEST(SparseModes, AreAllOfThemWhenAllAreAskedFor) {
  const AssembledFrame frame = plane_frame(4, 2);
  const int all = static_cast<int>(split_by_mass(frame.mass).dynamic.size());
  ASSERT_EQ(all, 24);
  for (const int count : {1, all - 1, all})
    expect_same(sparse_modes(frame.mass, frame.stiffness, count), dense_modes(frame.mass, frame.stiffness, count),
                frame.mass, 1e-9);
}

// A column of n elements with consistent mass, in bending and axially; the elements are stiff in shear.
AssembledFrame column(int n, bool held = true) {
  Frame frame(2);
  for (int i = 0; i <= n; ++i) frame.add_node({0, 0, 10.0 * i / n});
  for (int i = 0; i < n; ++i)
    frame.add_member(i, i + 1, {.area = 0.01, .inertia_y = 1e-5}, {.young = 2e11, .shear = 8e10, .density = 7800},
                     {.mass = BeamMass::consistent});
  if (held) frame.fix(0);
  return frame.assemble();
}

// Roots of cos x cosh x = -1 (cantilever) and +1 (free beam): Blevins, Formulas for Natural Frequency and Mode Shape,
// table 8-1. The first axial frequency is far above these.
constexpr double of_cantilever[] = {1.87510406871196, 4.69409113297418, 7.85475743823761};
constexpr double of_free_beam[] = {4.73004074486270, 7.85320462409584, 10.9956078380017};
constexpr int elements = 110;

// Frequencies of cubic elements with consistent mass are too high by a relative (b h)^4 / 1440 (Hughes, The Finite
// Element Method, 7.3), here at most 7e-8.
double bending(double root) {
  const double exact = std::pow(root / 10, 2) * std::sqrt(2e11 * 1e-5 / (7800 * 0.01));
  return exact * (1 + std::pow(root / elements, 4) / 1440);
}

// Round-off: the highest squared frequency is 1e11 times the lowest.
constexpr double beam_tolerance = 1e-8;

TEST(LowestModes, AreThoseOfACantilever) {
  test::Book book("Modes of beams",
                  "Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1; cubic elements with consistent "
                  "mass are too high by a relative (b h)^4/1440 (Hughes, The Finite Element Method, 7.3)",
                  "round-off: the highest squared frequency is 1e11 times the lowest");
  const AssembledFrame frame = column(elements);
  ASSERT_GT(split_by_mass(frame.mass).dynamic.size(), 300u);
  for (const auto& solve : {dense_modes, lowest_modes}) {
    const Eigenmodes modes = solve(frame.mass, frame.stiffness, 3);
    for (int k = 0; k < 3; ++k)
      book.near("frequency of a cantilever over closed form [-]", modes.frequencies[k] / bending(of_cantilever[k]), 1,
                beam_tolerance);
  }
}

TEST(LowestModes, OfAFreeBeamStartWithItsMotionsAtRest) {
  test::Book book("Modes of beams",
                  "Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1; cubic elements with consistent "
                  "mass are too high by a relative (b h)^4/1440 (Hughes, The Finite Element Method, 7.3)",
                  "round-off: the highest squared frequency is 1e11 times the lowest");
  const AssembledFrame frame = column(elements, false);
  ASSERT_GT(split_by_mass(frame.mass).dynamic.size(), 300u);
  for (const auto& solve : {dense_modes, lowest_modes}) {
    testing::internal::CaptureStdout();
    const Eigenmodes modes = solve(frame.mass, frame.stiffness, 6);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(modes.frequencies[k], 0);
      book.near("frequency of a free beam over closed form [-]", modes.frequencies[k + 3] / bending(of_free_beam[k]), 1,
                beam_tolerance);
    }
    expect_modes(modes, frame.mass, frame.stiffness, 1e-12);
    // Only the rigid-body motions.
    EXPECT_EQ(solve(frame.mass, frame.stiffness, 2).frequencies.norm(), 0);
  }
}

// Eight unsupported floors of four by four nodes; node 0 has its own mass.
AssembledFrame free_frame(double mass_of_first) {
  const GridFrame grid = tower(1, 1, false, false);
  Frame frame(3);
  const auto node = [](int i, int j, int k) { return i + 4 * (j + 4 * k); };
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        frame.add_mass(frame.add_node({6.0 * i, 5.0 * j, 3.2 * k}), i + j + k ? 2e4 : mass_of_first);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        if (i < 3) frame.add_member(node(i, j, k), node(i + 1, j, k), grid.beam.at(1, 0), grid.material);
        if (j < 3) frame.add_member(node(i, j, k), node(i, j + 1, k), grid.beam.at(1, 0), grid.material);
        if (k < 7) frame.add_member(node(i, j, k), node(i, j, k + 1), grid.column.at(1, 0), grid.material);
      }
  return frame.assemble();
}

// A light node raises the highest frequency and leaves the lowest ones unchanged. (At one gram the shapes of the dense
// solver have errors of 2e-8.)
TEST(LowestModes, OfAFreeFrameHaveSixMotionsAtRest) {
  for (const double mass_of_first : {2e4, 1.0}) {
    const AssembledFrame frame = free_frame(mass_of_first);
    ASSERT_EQ(frame.size(), 768);
    ASSERT_EQ(split_by_mass(frame.mass).dynamic.size(), 384u);
    testing::internal::CaptureStdout();
    const Eigenmodes modes = lowest_modes(frame.mass, frame.stiffness, 12);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    const Eigenmodes dense = dense_modes(frame.mass, frame.stiffness, 12);
    EXPECT_EQ(modes.frequencies.head(6).norm(), 0);
    EXPECT_EQ(dense.frequencies.head(6).norm(), 0);
    EXPECT_GT(modes.frequencies[6], 1);
    expect_modes(modes, frame.mass, frame.stiffness, 1e-12);
    const auto elastic = [](const Eigenmodes& all) {
      return Eigenmodes{all.frequencies.tail(6), all.shapes.rightCols(6)};
    };
    expect_same(elastic(modes), elastic(dense), frame.mass, 1e-9);
  }
}

// Equal columns in parallel: each frequency has the multiplicity of the columns, but one starting vector spans one
// shape of each.
TEST(EqualFrequencies, AreFoundAsOftenAsTheyAre) {
  constexpr int copies = 7;
  const AssembledFrame one = column(20);
  const int n = one.size();
  std::vector<Eigen::Triplet<double>> mass, stiffness;
  for (int copy = 0; copy < copies; ++copy)
    for (int j = 0; j < n; ++j) {
      for (SparseMatrix::InnerIterator it(one.mass, j); it; ++it)
        mass.emplace_back(copy * n + it.row(), copy * n + j, it.value());
      for (SparseMatrix::InnerIterator it(one.stiffness, j); it; ++it)
        stiffness.emplace_back(copy * n + it.row(), copy * n + j, it.value());
    }
  SparseMatrix m(copies * n, copies * n), k(copies * n, copies * n);
  m.setFromTriplets(mass.begin(), mass.end());
  k.setFromTriplets(stiffness.begin(), stiffness.end());
  const Eigenmodes single = dense_modes(one.mass, one.stiffness, 3);
  for (const int count : {1, 5, copies, copies + 1, 2 * copies + 3}) {
    const Eigenmodes modes = lowest_modes(m, k, count);
    for (int j = 0; j < count; ++j)
      EXPECT_NEAR(modes.frequencies[j] / single.frequencies[j / copies], 1, beam_tolerance) << j << " of " << count;
    expect_modes(modes, m, k, 1e-12);
  }
}

TEST(LargeTower, TakesSeconds) {
  const AssembledFrame frame = make_frame(tower(34, 6, false)).assemble();
  ASSERT_EQ(frame.size(), 9996);
  const auto begin = std::chrono::steady_clock::now();
  const Eigenmodes modes = lowest_modes(frame.mass, frame.stiffness, 12);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("seconds", std::to_string(seconds));
  std::printf("             12 modes of %d unknowns in %.2f s\n", frame.size(), seconds);
  // The bound allows for busy machines and sanitizers.
  EXPECT_LT(seconds, 60);
  expect_modes(modes, frame.mass, frame.stiffness, 1e-12);
  // Symmetric in x and y: sways 1 and 2 have the same frequency, followed by a rotation.
  EXPECT_NEAR(modes.frequencies[1] / modes.frequencies[0], 1, 1e-9);
  EXPECT_GT(modes.frequencies[2] / modes.frequencies[1], 1.01);
  EXPECT_NEAR(modes.frequencies[4] / modes.frequencies[3], 1, 1e-9);
}

TEST(LowestModes, AreTheSameBitsTwice) {
  const AssembledFrame frame = make_frame(tower(10, 3, false)).assemble();
  ASSERT_GT(split_by_mass(frame.mass).dynamic.size(), 300u);
  const Eigenmodes first = lowest_modes(frame.mass, frame.stiffness, 10);
  lowest_modes(frame.mass, frame.stiffness, 3);
  const Eigenmodes again = lowest_modes(frame.mass, frame.stiffness, 10);
  EXPECT_EQ(first.frequencies, again.frequencies);
  EXPECT_EQ(first.shapes, again.shapes);
}

TEST(LowestModes, HaveTheirLargestComponentPositive) {
  for (const int storeys : {3, 20}) {
    const AssembledFrame frame = plane_frame(storeys, 9);
    const Eigenmodes modes = lowest_modes(frame.mass, frame.stiffness, 8);
    for (int j = 0; j < 8; ++j)
      EXPECT_GE(modes.shapes.col(j).maxCoeff(), (1 - 1e-6) * modes.shapes.col(j).lpNorm<Eigen::Infinity>()) << j;
  }
}

template <class Exception>
std::string text_of(const ModeSolver& solve, const SparseMatrix& mass, const SparseMatrix& stiffness, int count) {
  try {
    solve(mass, stiffness, count);
  } catch (const Exception& error) {
    return error.what();
  }
  return "no exception was thrown";
}

TEST(Modes, RefuseWhatHasNone) {
  const AssembledFrame frame = plane_frame(4, 2);
  for (const ModeSolver& solve : {ModeSolver(dense_modes), ModeSolver(sparse_modes), ModeSolver(lowest_modes)}) {
    EXPECT_TRUE(test::mentions(text_of<std::invalid_argument>(solve, frame.mass, frame.stiffness, 25), {"25", "24"}));
    EXPECT_EQ(solve(frame.mass, frame.stiffness, 0).shapes.rows(), frame.size());

    SparseMatrix loose = frame.stiffness;  // rotations 2 and 5 are free to turn together
    for (const int i : {2, 5})
      for (SparseMatrix::InnerIterator it(loose, i); it; ++it) {
        it.valueRef() = 0;
        loose.coeffRef(i, it.row()) = 0;
      }
    for (const auto& [i, j, value] : {std::tuple(2, 2, 1e8), {5, 5, 1e8}, {2, 5, -1e8}, {5, 2, -1e8}})
      loose.coeffRef(i, j) = value;
    const std::string text = text_of<std::invalid_argument>(solve, frame.mass, loose, 3);
    EXPECT_TRUE(test::mentions(text, {"massless", "2"}) || test::mentions(text, {"massless", "5"})) << text;

    SparseMatrix negative = frame.mass;
    negative.coeffRef(0, 0) *= -1;
    EXPECT_TRUE(test::mentions(text_of<std::invalid_argument>(solve, negative, frame.stiffness, 3), {"mass"}));

    const double first = std::pow(solve(frame.mass, frame.stiffness, 1).frequencies[0], 2);
    for (const double part : {1.001, 2.0, 100.0}) {
      const SparseMatrix buckled = frame.stiffness - part * first * frame.mass;
      const std::string words = text_of<std::invalid_argument>(solve, frame.mass, buckled, 1);
      EXPECT_TRUE(words.ends_with("the structure buckles")) << part << ": " << words;
    }
  }
}

class Option {
 public:
  Option(std::string name, const char* value) : name_(std::move(name)) {
    petsc::check(PetscOptionsSetValue(nullptr, name_.c_str(), value));
  }
  ~Option() { PetscOptionsClearValue(nullptr, name_.c_str()); }

 private:
  std::string name_;
};

// PETSc without MUMPS chooses other pivots; a limit lies between every two neighbouring modes.
TEST(SparseModes, AreCountedAlikeByBothFactors) {
  const AssembledFrame frame = plane_frame(20, 9);
  const Eigenmodes modes = sparse_modes(frame.mass, frame.stiffness, 8);
  for (int count = 1; count < 8; ++count) {
    const double limit = 0.5 * (std::pow(modes.frequencies[count - 1], 2) + std::pow(modes.frequencies[count], 2));
    SparseMatrix shifted = frame.stiffness - limit * frame.mass;
    shifted.makeCompressed();
    EXPECT_EQ(petsc::count_modes_by_sequence(shifted, limit), count);
    EXPECT_EQ(petsc::count_modes_below(shifted, limit, "pounding_modes_"), count);
  }
}

TEST(SparseModes, ThatNoPivotCountsAreAnError) {
  SparseMatrix zero(1, 1);
  zero.insert(0, 0) = 0;
  zero.makeCompressed();
  try {
    petsc::count_modes_by_sequence(zero, 4.0);
    FAIL() << "a zero pivot was counted";
  } catch (const SolverError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"2 rad/s", "pivot"}));
  }
}

#ifdef PETSC_HAVE_MUMPS
TEST(SparseModes, ReadTheirOptions) {
  const AssembledFrame frame = plane_frame(20, 9);
  const Eigenmodes expected = sparse_modes(frame.mass, frame.stiffness, 6);
  const Option tolerance("-pounding_modes_eps_tol", "1e-11"),
      factor("-pounding_modes_pc_factor_mat_solver_type", "mumps"),
      count("-pounding_modes_count_mat_mumps_icntl_14", "50");
  EXPECT_EQ(petsc::Environment::unread_options().size(), 3u);
  expect_same(sparse_modes(frame.mass, frame.stiffness, 6), expected, frame.mass, 1e-9);
  EXPECT_EQ(petsc::Environment::unread_options(), std::vector<std::string>{});
}
#endif

TEST(SparseModes, TellWhatToChangeWhenTooFewAreFound) {
  const AssembledFrame frame = plane_frame(20, 9);
  const Option once("-pounding_modes_eps_max_it", "1"), small("-pounding_modes_eps_ncv", "13");
  const std::string text = text_of<SolverError>(sparse_modes, frame.mass, frame.stiffness, 12);
  EXPECT_TRUE(test::mentions(text, {"-pounding_modes_eps_max_it", "-pounding_modes_eps_ncv", "12", "100", "78"}));
}

}  // namespace lowest_modes_test
}  // namespace pounding
