// The results file of a model built in code: its description of the input, and how its run resumes.

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <string>

#include <pounding/elements.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include "support/messages.hpp"
#include "support/same_runs.hpp"

namespace pounding {
namespace results_by_code_test {

class File {
 public:
  File() : path_(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_by_code.h5")) {}
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

Model ball_on_wall(double speed = 1) {
  Model model;
  const auto ball = model.add("ball", make_body({.mass = 60e3}), {.initial_velocity = speed});
  model.link(ball, model.add("wall", make_wall()), {.gap = 0.01},
             laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65});
  // Enough steps for a call of `stop` while the ball is in contact.
  model.analysis = {.duration = 0.2, .tolerance = 1e-8, .scheme = {.kind = Scheme::Kind::generalized_alpha}};
  return model;
}

// Writes the file of a run that was stopped while the ball was in contact.
void stop_in_contact(const File& file) {
  Model model = ball_on_wall();
  RunOptions options{.output = file.path()};
  options.stop = [](std::span<const ContactMemory> contacts) { return presses(contacts[0].phase()); };
  EXPECT_THROW(run(model, options), FailedRun);
}

std::string refusal_of(const std::function<void()>& act) {
  return test::refusal<InputError>([&] { act(); });
}

TEST(ResultsByCode, SayThatAProgramBuiltTheModel) {
  const File file;
  stop_in_contact(file);
  const InterruptedRun interrupted = read_interrupted_run(file.path());
  EXPECT_EQ(interrupted.model_yaml, built_by_code);
  EXPECT_NE(interrupted.resolved_yaml.find("name: ball-wall"), std::string::npos) << interrupted.resolved_yaml;
  EXPECT_TRUE(test::mentions(refusal_of([&] { input_of(interrupted); }), {file.path()}));
}

TEST(ResultsByCode, GoOnWithTheModelThatTheProgramBuildsAgain) {
  const File file;
  stop_in_contact(file);
  Model whole = ball_on_wall(), continued = ball_on_wall();
  const Outcome expected = run(whole);
  test::expect_same_run(expected, run(continued, {.resume = file.path()}));
  EXPECT_NEAR(expected.results.impacts.at(0).restitution, 0.65, 1e-4);
}

TEST(ResultsByCode, DoNotGoOnWithAnotherModel) {
  const File file;
  stop_in_contact(file);
  Model other = ball_on_wall(2);
  const std::string refusal = refusal_of([&] { run(other, {.resume = file.path()}); });
  EXPECT_TRUE(test::mentions(refusal, {file.path(), "resolved.yaml"}));
}

TEST(ResultsByCode, NeedACompleteModel) {
  const Model model = ball_on_wall();
  EXPECT_THROW(run(model), std::logic_error);
}

}  // namespace results_by_code_test
}  // namespace pounding
