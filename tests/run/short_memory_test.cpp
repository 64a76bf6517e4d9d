// Memory that ends while an interrupted run is read: all of it, or nothing.

#include <gtest/gtest.h>

#include <hdf5.h>
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

class ShortMemory : public testing::Test {
 protected:
  ShortMemory()
      : file_((std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_short_memory.h5")).string()) {
    petsc::check(PetscOptionsSetValue(nullptr, "-pounding_ts_rtol", "1e-6"));
  }
  ~ShortMemory() override {
    EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0) << "HDF5 holds what an exception has passed";
    PetscOptionsClearValue(nullptr, "-pounding_ts_rtol");
    std::filesystem::remove(file_);
  }

  // Runs this model until its link has pressed, or for some steps where it has none.
  void stop(const std::string& yaml) {
    const Model model = test::model_of(yaml);
    int looks = 0;
    const auto stops = [&] {
      return ++looks > 3 && (model.links.empty() || !model.links[0].contact->impacts().empty());
    };
    EXPECT_THROW(run(model, {.output = file_, .stop = stops}), FailedRun);
  }
  // Texts that are read of it.
  std::vector<std::string> found() const {
    InterruptedRun run = read_interrupted_run(file_);
    std::vector<std::string> all = run.checkpoint.options;
    for (const std::string& text : {run.resolved_yaml, run.histories, std::to_string(run.no_pounding.size())})
      all.push_back(text);
    return all;
  }

 private:
  std::string file_;
};

TEST_F(ShortMemory, IsReadWholeOrNotAtAllWhereMemoryEnds) {
  stop(
      "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}, initial_velocity: 1 m/s}}\nanalysis: "
      "{duration: 1, max_step: 1 ms}\n");
  EXPECT_EQ(found().front(), "-pounding_ts_rtol 1e-6");
  test::expect_right_answers_in_short_memory([&] { return found(); });
}

TEST_F(ShortMemory, IsReadWithItsRunWithoutLinksOrNotAtAllWhereMemoryEnds) {
  stop(
      "ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 2}}\n"
      "structures:\n  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n  right: {oscillator: {mass: 150 "
      "t, period: 0.4, damping: 5 %}}\n"
      "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]\n"
      "analysis: {duration: 2, max_step: 1 ms}\ncompare: no_pounding\n");
  EXPECT_GT(std::stoul(found().back()), 10'000u);
  test::expect_right_answers_in_short_memory([&] { return found(); });
}

}  // namespace short_memory_test
}  // namespace pounding
