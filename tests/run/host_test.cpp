// A host program that has started PETSc or SLEPc itself: the library uses both and finalizes neither.

#include <gtest/gtest.h>

#include <slepceps.h>

#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/environment.hpp>

namespace pounding {
namespace host_test {

// Equal masses in a row between springs, fixed at one end: w = 2 sin((2j - 1) pi / (4n + 2)) in normalized units.
void expect_modes_of_chain() {
  constexpr int n = 50;
  Eigen::SparseMatrix<double> mass(n, n), stiffness(n, n);
  for (int i = 0; i < n; ++i) {
    mass.insert(i, i) = 1;
    stiffness.insert(i, i) = i + 1 < n ? 2 : 1;
    if (i > 0) stiffness.insert(i - 1, i) = stiffness.insert(i, i - 1) = -1;
  }
  const Eigenmodes modes = petsc::sparse_modes(mass, stiffness, 4);
  for (int j = 1; j <= 4; ++j)
    EXPECT_NEAR(modes.frequencies[j - 1] / (2 * std::sin((2 * j - 1) * M_PI / (4 * n + 2))), 1, 1e-11);
}

struct Running {
  PetscBool petsc = PETSC_FALSE, slepc = PETSC_FALSE;
  Running() {
    PetscInitialized(&petsc);
    SlepcInitialized(&slepc);
  }
};

TEST(Host, ThatOwnsPetscKeepsIt) {
  ASSERT_FALSE(Running().slepc);
  for (int time = 0; time < 2; ++time) {
    {
      const petsc::Environment environment;
      EXPECT_TRUE(Running().slepc);
      expect_modes_of_chain();
    }
    EXPECT_TRUE(Running().petsc);
    EXPECT_FALSE(Running().slepc);
  }
}

TEST(Host, ThatOwnsSlepcKeepsIt) {
  ASSERT_EQ(SlepcInitialize(nullptr, nullptr, nullptr, nullptr), 0);
  {
    const petsc::Environment environment;
    expect_modes_of_chain();
  }
  EXPECT_TRUE(Running().slepc);
  ASSERT_EQ(SlepcFinalize(), 0);
  EXPECT_TRUE(Running().petsc);
}

}  // namespace host_test
}  // namespace pounding

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  const int failed = RUN_ALL_TESTS();
  return PetscFinalize() == 0 ? failed : 1;
}
