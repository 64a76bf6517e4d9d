/// Tests that run models: PETSc is initialised once for all of them.

#include <gtest/gtest.h>

#include <pounding/petsc/environment.hpp>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  const pounding::petsc::Environment environment;
  return RUN_ALL_TESTS();
}
