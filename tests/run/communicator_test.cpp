// Simultaneous runs of models on communicators without common processes. On one process there is only one half; CMake
// also runs this program on two processes.

#include <gtest/gtest.h>

#include <petscsys.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include <pounding/run/run.hpp>
#include "support/models.hpp"

namespace pounding {
namespace communicator_test {

// One half of all processes.
class Half {
 public:
  Half() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    number_ = rank % 2;
    MPI_Comm_split(MPI_COMM_WORLD, number_, rank, &comm_);
  }
  ~Half() { MPI_Comm_free(&comm_); }
  Half(const Half&) = delete;
  Half& operator=(const Half&) = delete;
  int number() const { return number_; }
  MPI_Comm comm() const { return comm_; }

 private:
  int number_ = 0;
  MPI_Comm comm_ = MPI_COMM_NULL;
};

// A PETSc option for the duration of a test.
class Option {
 public:
  Option(const char* name, const char* value) : name_(name) { PetscOptionsSetValue(nullptr, name, value); }
  ~Option() { PetscOptionsClearValue(nullptr, name_); }
  Option(const Option&) = delete;
  Option& operator=(const Option&) = delete;

 private:
  const char* name_;
};

// Models of different size, duration and number of impacts: halves that waited for each other would deadlock or mix
// their data.
std::string model_of_half(int number) {
  const std::string law = "law: jankowski, stiffness: 2.75e9, restitution: 0.65";
  if (number == 0) return test::two_oscillators(law.substr(5), 1e-4, 1.2);
  return "ground_motion: {harmonic: {amplitude: 4.0, period: 0.5, duration: 2.0}}\n"
         "structures:\n"
         "  left: {shear_building: {storeys: 4, mass: 100 t, stiffness: 1.5e5 kN/m, damping: {modal: {ratio: 5 %}}}}\n"
         "  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 9e5 kN/m, damping: {modal: {ratio: 5 %}}}}\n"
         "links: [{between: [left, right], floors: all, gap: 5 mm, " +
         law +
         "}]\n"
         "compare: no_pounding\n"
         "analysis: {duration: 2}\n";
}

void expect_same(const Results& one, const Results& other) {
  EXPECT_EQ(one.status, "done");
  EXPECT_EQ(one.time, other.time);
  ASSERT_EQ(one.structures.size(), other.structures.size());
  for (std::size_t k = 0; k < one.structures.size(); ++k) {
    EXPECT_EQ(one.structures[k].displacement, other.structures[k].displacement);
    EXPECT_EQ(one.structures[k].acceleration, other.structures[k].acceleration);
  }
  ASSERT_EQ(one.impacts.size(), other.impacts.size());
  for (std::size_t i = 0; i < one.impacts.size(); ++i)
    EXPECT_EQ(one.impacts[i].peak_force, other.impacts[i].peak_force);
}

class TwoHalves : public testing::TestWithParam<const char*> {};

TEST_P(TwoHalves, RunDifferentModelsAtOnce) {
  const Option solver("-pounding_ts_pounding_base", GetParam());
  const Half half;
  int rank = 0, processes = 0, size = 0;
  MPI_Comm_rank(half.comm(), &rank);
  MPI_Comm_size(half.comm(), &size);
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  const std::string name =
      "half_" + std::to_string(half.number()) + "_of_" + std::to_string(processes) + "_" + GetParam() + ".h5";
  const auto file = std::filesystem::temp_directory_path() / name;
  if (rank == 0) std::filesystem::remove(file);
  const std::string yaml = model_of_half(half.number());
  const Model model = test::model_of(yaml);
  const Outcome together = run(model, {.comm = half.comm(), .output = file.string()});
  if (rank == 0) {
    EXPECT_TRUE(std::filesystem::exists(file)) << "the first process of each half writes the file";
    std::filesystem::remove(file);
  }
  // Both halves still run concurrently, each process on its own.
  const Model again = test::model_of(yaml);
  const Outcome alone = run(again, {.comm = PETSC_COMM_SELF});
  if (size == 1) expect_same(together.results, alone.results);
  EXPECT_GT(together.results.impacts.size(), 0u);
  EXPECT_EQ(together.summary.structures.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Solvers, TwoHalves, testing::Values("modal", "sparse"),
                         [](const testing::TestParamInfo<const char*>& test) { return std::string(test.param); });

TEST(TwoHalves, StopByThemselves) {
  const Half half;
  const Model model = test::model_of(model_of_half(half.number()));
  const RunOptions options{.comm = half.comm(),
                           .stop = [&](std::span<const ContactMemory>) { return half.number() == 1; }};
  if (half.number() == 1)
    EXPECT_THROW(run(model, options), FailedRun);
  else
    EXPECT_EQ(run(model, options).results.status, "done");
}

// Its collective calls would have no order relative to those of the first run.
TEST(SeveralProcesses, RefuseASecondRunDuringTheFirst) {
  int processes = 0, refused = 0, looks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  const auto stop = [&](std::span<const ContactMemory>) {
    if (++looks > 1) return false;
    const Model second = test::model_of(model_of_half(0));
    try {
      run(second);
    } catch (const std::logic_error&) {
      ++refused;
    }
    return false;
  };
  const Model first = test::model_of(model_of_half(0));
  EXPECT_EQ(run(first, {.stop = stop}).results.status, "done");
  EXPECT_GT(looks, 0);
  EXPECT_EQ(refused, processes > 1 ? 1 : 0);
}

TEST(RunOptions, MadeBeforePetscStartsAreRefused) {
  const Model model = test::model_of(model_of_half(0));
  EXPECT_THROW(run(model, {.comm = MPI_COMM_NULL}), std::logic_error);
}

}  // namespace communicator_test
}  // namespace pounding
