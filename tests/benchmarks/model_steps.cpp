// Cost of a step of a model without recording: one JSON object.
//
//   model_steps MODEL.yaml
//
// Steps as `pounding run` does. Steps without an event are grouped by their length [s] and the number of active
// contacts at their ends; each group has its number of steps and the lower quartile of their times [s]. Groups of fewer
// than eight are omitted.

#include <petscts.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/model/model.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/reduction/reduced_solver.hpp>
#include <pounding/run/reduction_plan.hpp>
#include <pounding/run/ts_setup.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace {

using namespace pounding;
using petsc::check;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct StepClock {
  const Stepper& stepper;
  const System& system;
  std::map<std::pair<long, long>, std::vector<double>> taken{};  // by length [ns] and active contacts: seconds
  double begin = 0;                                              // of the step [s]
  long events = 0;
  Clock::time_point last = Clock::now();

  void take(double time) {
    const double seconds = seconds_since(last);
    const auto pressed = std::ranges::count_if(stepper.view().memory().contacts,
                                               [](const ContactMemory& contact) { return presses(contact.phase()); });
    if (stepper.view().events() == events) taken[{std::lround(1e9 * (time - begin)), pressed}].push_back(seconds);
    events = stepper.view().events();
    begin = time;
    last = Clock::now();
  }

  nlohmann::json sorts() {
    nlohmann::json all = nlohmann::json::array();
    for (auto& [sort, seconds] : taken) {
      if (seconds.size() < 8) continue;
      std::ranges::sort(seconds);
      all.push_back({{"length", 1e-9 * static_cast<double>(sort.first)},
                     {"pressed", sort.second},
                     {"count", seconds.size()},
                     {"seconds", seconds[seconds.size() / 4]}});
    }
    return all;
  }

  static PetscErrorCode after_step(TS ts) {
    StepClock* clock = nullptr;
    PetscReal time = 0;
    PetscFunctionBegin;
    PetscCall(TSGetApplicationContext(ts, &clock));
    PetscCall(TSGetTime(ts, &time));
    clock->take(time);
    PetscFunctionReturn(0);
  }
};

nlohmann::json measure(const std::string& file) {
  const Model model = read_model(Input::read_file(file), petsc::lowest_modes);
  const Clock::time_point start = Clock::now();
  const System system = assemble(model, true);
  const auto [u, v] = initial_state(model);
  const EffectiveSettings settings = effective_settings(model);
  const TsSetup setup = set_up_ts(settings, u, v, PETSC_COMM_SELF);
  const petsc::ReductionPlan plan =
      reduction_plan(model, requested_reductions(model), u, v, settings.stepper.tolerance);
  const std::unique_ptr<StructureSolver> solver = petsc::make_solver(system, settings.solver, plan, PETSC_COMM_SELF);
  Stepper stepper(system, *solver, settings.stepper);
  check(petsc::set_stepper(setup.ts, &stepper));
  check(petsc::set_lazy_vectors(setup.ts, PETSC_TRUE));
  stepper.start(0, u, v);
  stepper.prepare(stepper.view().step_towards(settings.first_step, settings.duration));
  const double seconds_setup = seconds_since(start);
  StepClock clock{stepper, system};
  check(TSSetApplicationContext(setup.ts, &clock));
  check(TSSetPostStep(setup.ts, StepClock::after_step));
  const Clock::time_point begin = Clock::now();
  check(TSSolve(setup.ts, nullptr));
  const double seconds = seconds_since(begin);
  PetscInt steps = 0;
  check(TSGetStepNumber(setup.ts, &steps));
  return {{"solver", solver->description()},   {"sorts", clock.sorts()}, {"steps", steps},
          {"events", stepper.view().events()}, {"seconds", seconds},     {"seconds_setup", seconds_setup}};
}

}  // namespace

int main(int argc, char** argv) {
  const petsc::Environment environment;
  try {
    if (argc != 2) throw std::invalid_argument("type: model_steps MODEL.yaml");
    std::cout << measure(argv[1]).dump() << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "model_steps: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
