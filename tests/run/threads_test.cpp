// Runs in several threads of one process: bitwise identical results, steps computed in parallel, separate files.
// `make test-threads` runs this program under the thread sanitizer.

#include <gtest/gtest.h>

#include <petscsys.h>
#include <unistd.h>

#include <array>
#include <barrier>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/elements.hpp>
#include <pounding/run/run.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace threads_test {

constexpr int thread_count = 8;

std::string file_name(const std::string& name) {
  return (std::filesystem::temp_directory_path() / fmt::format("threads_{}_{}.h5", name, getpid())).string();
}

// Calls task(0) ... task(count - 1) at the same time.
void in_threads(int count, const std::function<void(int)>& task) {
  std::barrier start(count);
  std::vector<std::jthread> threads;
  for (int i = 0; i < count; ++i)
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      task(i);
    });
}

// Every history of a run by its path in the results file.
using Histories = std::map<std::string, std::vector<double>>;

Histories histories_of(Outcome outcome) {
  Histories histories;
  visit_histories(outcome.results,
                  [&](const std::string& path, std::vector<double>& values) { histories[path] = values; });
  histories["impacts"] = {};
  for (const ImpactRow& impact : outcome.results.impacts)
    for (const double value : {impact.t_start, impact.t_end, impact.peak_force, impact.impulse})
      histories["impacts"].push_back(value);
  for (const LinkSummary& link : outcome.summary.links) histories["peak/" + link.name] = {link.peak_force};
  return histories;
}

// Path of the first history whose bits differ; empty if all are equal.
std::string first_difference(const Histories& one, const Histories& other) {
  if (one.size() != other.size()) return "the number of histories";
  for (const auto& [path, values] : one) {
    const auto found = other.find(path);
    if (found == other.end() || found->second.size() != values.size() ||
        std::memcmp(values.data(), found->second.data(), values.size() * sizeof(double)) != 0)
      return path;
  }
  return "";
}

// A PETSc option during its lifetime.
class Option {
 public:
  Option(const char* name, const char* value) : name_(name) { PetscOptionsSetValue(nullptr, name, value); }
  ~Option() { PetscOptionsClearValue(nullptr, name_); }
  Option(const Option&) = delete;
  Option& operator=(const Option&) = delete;

 private:
  const char* name_;
};

std::string frames(int storeys, const std::string& hinges, const std::string& analysis) {
  const auto frame = [&](const char* name, double origin, int height, int mass) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}, 0], material: {{E: 30 GPa}}, grid: {{storeys: {}, bays: 3, storey_height: 3.2, "
        "bay_width: 6, columns: {{rectangle: [0.5, 0.5]}}, beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}{}}}, "
        "damping: 5 %}}\n",
        name, origin, height, mass, hinges);
  };
  return "ground_motion: {harmonic: {amplitude: 4, period: 0.9, duration: 4}}\nstructures:\n" +
         frame("left", 0, storeys, 120) + frame("right", 18.005, storeys - 2, 60) +
         "links: [{between: [left, right], floors: all, gap: 5 mm, law: hertz_damped, stiffness: 2.75e9, "
         "restitution: 0.65}]\nanalysis: {" +
         analysis + "}\n";
}

struct Case {
  const char* name;
  std::string yaml;
  const char* solver;
};

const std::string hinges =
    ", hinges: {beams: {at: both, yield_moment: 260 kN m, hardening: 3 %, ultimate_rotation: 0.03}, columns: {at: "
    "feet, yield_moment: 420 kN m, hardening: 3 %, ultimate_rotation: 0.03}}";

const std::array cases{
    Case{"oscillators", test::two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65", 1e-6), "automatic"},
    Case{"hinges_modal", frames(5, hinges, "duration: 2, tolerance: 1e-4"), "modal"},
    Case{"hinges_sparse", frames(5, hinges, "duration: 1, tolerance: 1e-3"), "sparse"},
    Case{"reduced_towers", frames(20, "", "duration: 2, tolerance: 1e-4, reduction: {links: 5, ground: 20}"),
         "automatic"},
};

class Threads : public testing::TestWithParam<Case> {};

TEST_P(Threads, RunOneModelWithIdenticalResults) {
  const Option solver("-pounding_ts_pounding_base", GetParam().solver);
  const Model model = test::model_of(GetParam().yaml);
  const auto run_model = [&](const std::string& output) {
    return histories_of(run(model, {.comm = PETSC_COMM_SELF, .output = output}));
  };
  const Histories alone = run_model("");
  ASSERT_GT(alone.at("impacts").size(), 0u);
  std::array<Histories, thread_count> found;
  in_threads(thread_count, [&](int i) {
    const std::string output = i % 2 ? file_name(fmt::format("{}_{}", GetParam().name, i)) : "";
    found[i] = run_model(output);
    if (!output.empty()) std::filesystem::remove(output);
  });
  for (const Histories& histories : found) EXPECT_EQ(first_difference(alone, histories), "");
}

INSTANTIATE_TEST_SUITE_P(Models, Threads, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& test) { return std::string(test.param.name); });

// Two threads arrive here before either leaves.
class Meeting {
 public:
  void arrive() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    if (!changed_.wait_for(lock, std::chrono::seconds(20), [&] { return arrived_ >= 2; })) missed_ = true;
  }
  bool met() const { return arrived_ >= 2 && !missed_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
  bool missed_ = false;
};

// A linear spring whose first evaluation in a step of the run takes place in two threads simultaneously.
struct MeetingSpring {
  static constexpr std::string_view name = "meeting_spring";
  Meeting* meeting = nullptr;
  bool* has_arrived = nullptr;  // of this thread

  void check() const {}
  laws::Response contact(double d, double, const laws::Impact&) const noexcept {
    constexpr double stiffness = 50e6;
    if (d > 0 && !std::exchange(*has_arrived, true)) meeting->arrive();
    return {.force = stiffness * d, .by_penetration = stiffness, .by_rate = 0};
  }
};

TEST(Threads, ComputeStepsInParallel) {
  Meeting meeting;
  in_threads(2, [&](int) {
    bool has_arrived = false;
    Model model;
    const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
    const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
    model.link(left, right, {.gap = 0.02}, MeetingSpring{&meeting, &has_arrived});
    model.ground = Harmonic{.amplitude = 3.0, .period = 0.6, .duration = 3.0};
    model.analysis = {.duration = 3.0, .tolerance = 1e-4};
    EXPECT_GT(run(model, {.comm = PETSC_COMM_SELF}).summary.links[0].impacts, 0);
    EXPECT_TRUE(has_arrived);
  });
  EXPECT_TRUE(meeting.met()) << "a step excludes the steps of other threads";
}

const std::string& oscillators = cases[0].yaml;

// The other run begins and ends while this one is between two steps.
TEST(Threads, WriteSeparateFiles) {
  const std::string file = file_name("output");
  std::string refused, other_status;
  bool looked = false;
  const auto stop = [&](std::span<const ContactMemory>) {
    if (std::exchange(looked, true)) return false;
    in_threads(1, [&](int) {
      const Model same = test::model_of(oscillators), other = test::model_of(oscillators);
      refused = test::refusal<InputError>([&] { run(same, {.comm = PETSC_COMM_SELF, .output = file}); });
      other_status = run(other, {.comm = PETSC_COMM_SELF}).results.status;
    });
    return false;
  };
  const Model model = test::model_of(oscillators);
  EXPECT_EQ(run(model, {.comm = PETSC_COMM_SELF, .output = file, .stop = stop}).results.status, "done");
  EXPECT_TRUE(test::mentions(refused, {file, "another run"}));
  EXPECT_EQ(other_status, "done");
  std::filesystem::remove(file);
}

TEST(Threads, AreStoppedSeparately) {
  const Model reference = test::model_of(oscillators);
  const Histories alone = histories_of(run(reference, {.comm = PETSC_COMM_SELF}));
  std::array<Histories, thread_count> found;
  std::array<std::string, thread_count> failures;
  in_threads(thread_count, [&](int i) {
    const Model model = test::model_of(oscillators);
    try {
      found[i] = histories_of(
          run(model, {.comm = PETSC_COMM_SELF, .stop = [i](std::span<const ContactMemory>) { return i % 2 == 1; }}));
    } catch (const FailedRun& failed) {
      failures[i] = failed.what();
    }
  });
  for (int i = 0; i < thread_count; ++i) {
    if (i % 2 == 1)
      EXPECT_NE(failures[i].find("stopped"), std::string::npos) << failures[i];
    else
      EXPECT_EQ(first_difference(alone, found[i]), "") << failures[i];
  }
}

}  // namespace threads_test
}  // namespace pounding
