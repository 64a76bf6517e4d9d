// Memory that ends while an interrupted run is read: all of it, or nothing.

#include <gtest/gtest.h>

#include <petscsys.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include <pounding/petsc/environment.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include "support/models.hpp"
#include "support/short_memory.hpp"

namespace pounding {
namespace short_memory_test {

TEST(InterruptedRun, IsReadWholeOrNotAtAllWhereMemoryEnds) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_short_memory.h5");
  petsc::check(PetscOptionsSetValue(nullptr, "-pounding_ts_rtol", "1e-6"));
  const Model model = test::model_of(
      "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}, initial_velocity: 1 m/s}}\nanalysis: {duration: 1, max_step: 1 ms}\n");
  int looks = 0;
  EXPECT_THROW(run(model, {.output = file.string(), .stop = [&] { return ++looks > 3; }}), FailedRun);
  test::expect_right_answers_in_short_memory([&] {
    InterruptedRun found = read_interrupted_run(file.string());
    found.checkpoint.options.push_back(found.resolved_yaml);
    return found.checkpoint.options;
  });
  EXPECT_EQ(read_interrupted_run(file.string()).checkpoint.options, std::vector<std::string>{"-pounding_ts_rtol 1e-6"});
  petsc::check(PetscOptionsClearValue(nullptr, "-pounding_ts_rtol"));
  std::filesystem::remove(file);
}

}  // namespace short_memory_test
}  // namespace pounding
