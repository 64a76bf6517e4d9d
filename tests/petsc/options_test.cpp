// The PETSc options that a run records.

#include <gtest/gtest.h>

#include <petscsys.h>

#include <string>
#include <vector>

#include <pounding/petsc/environment.hpp>

namespace pounding::petsc {
namespace options_test {

class Options : public testing::Test {
 protected:
  Options() {
    set("-pounding_ts_rtol", "1e-6");
    set("-pounding_ts_monitor", nullptr);
    set("-other_option_of_a_host", "3");
  }
  ~Options() override {
    for (const char* name : {"-pounding_ts_rtol", "-pounding_ts_monitor", "-other_option_of_a_host"})
      PetscOptionsClearValue(nullptr, name);
  }

 private:
  static void set(const char* name, const char* value) { check(PetscOptionsSetValue(nullptr, name, value)); }
};

TEST_F(Options, AreThoseOfOurPrefixWithTheirValues) {
  EXPECT_EQ(Environment::given_options(), (std::vector<std::string>{"-pounding_ts_monitor", "-pounding_ts_rtol 1e-6"}));
}

// Options that the library sets to start PETSc are excluded.
TEST_F(Options, InForceAreThoseOfAHostAsWell) {
  EXPECT_EQ(Environment::all_options(),
            (std::vector<std::string>{"-other_option_of_a_host 3", "-pounding_ts_monitor", "-pounding_ts_rtol 1e-6"}));
}

}  // namespace options_test
}  // namespace pounding::petsc
