/// Models from their text: reading, checking, modes, runs.

#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <pounding/run/run.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/ranks.hpp>
#include "bindings.hpp"
#include "host.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

// PETSc and its options are one for the process: one thread at a time.
std::mutex petsc_in_use;

/// The text of a model and the file that it stands for.
struct Source {
  std::string text, name;
};

Model read(const Input& input) { return read_model(input, petsc::lowest_modes); }
Model read(const Source& source) { return read(Input::read_text(source.text, source.name)); }

/// Runs `task` without holding the interpreter, with PETSc started.
template <class Task>
auto with_petsc(Task&& task) {
  const py::gil_scoped_release free;
  const std::lock_guard one_at_a_time(petsc_in_use);
  start_petsc();
  return task();
}

py::object plain(const Input& input) {
  if (input.is_map()) {
    py::dict values;
    for (const auto& [key, value] : input.entries()) values[py::str(key)] = plain(value);
    return values;
  }
  if (input.is_list()) {
    py::list values;
    for (const Input& item : input.items()) values.append(plain(item));
    return values;
  }
  if (!input.is_scalar()) return py::none();
  return py::str(input.as_text());
}

std::pair<std::string, std::string> checked(const Source& source) {
  return with_petsc([&] {
    const Model model = read(source);
    return std::pair(describe(model), resolved_yaml(model));
  });
}

std::string modes(const Source& source, int count) {
  return with_petsc([&] { return modes_json(read(source), count, petsc::lowest_modes, true); });
}

/// What a run reports to and may be ended by.
struct Listener {
  py::object progress;  ///< None, or called with time [s], duration [s] and impacts
  /// What a signal handler or `progress` raised; it ends the run.
  std::optional<py::error_already_set> raised = {};
  /// That for the other processes, which know by themselves when the user stops the run.
  std::string failure = {};

  void report(double time, double duration, int impacts) {
    const py::gil_scoped_acquire hold;
    if (raised || progress.is_none()) return;
    try {
      progress(time, duration, impacts);
    } catch (py::error_already_set& error) {
      keep(std::move(error));
    }
  }
  bool stops() {
    const py::gil_scoped_acquire hold;
    if (!raised && PyErr_CheckSignals() != 0) keep(py::error_already_set());
    return raised.has_value();
  }
  void keep(py::error_already_set&& error) {
    if (!error.matches(PyExc_KeyboardInterrupt))
      failure = py::str("{}: {}").format(error.type().attr("__name__"), error.value());
    raised.emplace(std::move(error));
  }
};

/// What there is of a run, whether it came to its end or not.
struct Ran {
  std::vector<std::byte> image;  ///< of the results file
  std::string warning;
  std::string failure;     ///< empty: none
  bool resumable = false;  ///< the output can go on
};

// The histories are whole on the first process.
std::vector<std::byte> image_for_all(const Results& results) {
  const petsc::Ranks ranks(PETSC_COMM_WORLD);
  return ranks.gather(ranks.is_root() ? results_image(results) : std::vector<std::byte>{}).front();
}

Ran ran(const Outcome& outcome, std::string failure, double tolerance) {
  return {image_for_all(outcome.results), failure.empty() ? warning(outcome.summary, tolerance) : "",
          failure, outcome.results.checkpoint.has_value()};
}

Ran run_alike(const Model& model, const RunOptions& options) {
  try {
    return ran(run(model, options), "", model.analysis.tolerance);
  } catch (const FailedRun& failed) {
    return ran(failed.outcome(), failed.what(), model.analysis.tolerance);
  }
}

// What Python raised on one process only has ended the run of all.
void tell_what_was_raised(const petsc::Ranks& ranks, const Listener& listener, Ran& ran) {
  try {
    ranks.on_each([&] {
      if (!listener.failure.empty()) throw std::runtime_error(listener.failure);
    });
  } catch (const std::runtime_error& error) {
    ran.failure = error.what();
  }
}

// One that fails in the middle of a run leaves the others waiting for a message that never comes; what it fails with after
// that, or before, is what all fail with.
Ran run_together(const Model& model, const RunOptions& options, const Listener& listener) {
  const petsc::Ranks ranks(PETSC_COMM_WORLD);
  const petsc::CollectiveExit leaving(ranks.comm());
  Ran ran;
  std::exception_ptr failure;
  try {
    ran = run_alike(model, options);
  } catch (const std::exception& error) {
    if (!leaving.together(petsc::CollectiveExit::patience)) {
      leave_the_others();
      throw SolverError(ranks.alone(error.what()));
    }
    failure = std::current_exception();
  }
  if (!failure) leaving.together(std::numeric_limits<double>::infinity());
  ranks.on_each([&] {
    if (failure) std::rethrow_exception(failure);
  });
  tell_what_was_raised(ranks, listener, ran);
  return ran;
}

// A file of the same name may be another one in the folder of another process.
void require_one_run(const petsc::Ranks& ranks, const Model& model, const std::vector<std::string>& options,
                     const std::string& name) {
  if (!ranks.same(fmt::format("{}\n{}", model.source_text, fmt::join(options, " "))))
    throw InputError(fmt::format("{}: the processes run different models or options; give all of them the same", name));
}

/// What this process cannot run is what none runs. Nothing where there are no others.
void refuse(const std::string& text) {
  if (petsc::launch().value_or(petsc::Launch{}).size > 1)
    with_petsc([&] { petsc::Ranks(PETSC_COMM_WORLD).on_each([&] { throw InputError(text); }); });
}

py::dict dict_of(const Ran& ran, const Listener& listener) {
  const auto* image = reinterpret_cast<const char*>(ran.image.data());
  return py::dict("image"_a = py::bytes(image, ran.image.size()), "warning"_a = ran.warning,
                  "failure"_a = ran.failure, "resumable"_a = ran.resumable,
                  "raised"_a = listener.raised ? py::object(listener.raised->value()) : py::none());
}

RunOptions run_options(const std::string& output, const std::string& command, Listener& listener) {
  return {.output = output,
          .command = command,
          .progress = [&](double time, double duration, int impacts) { listener.report(time, duration, impacts); },
          .stop = [&] { return listener.stops(); }};
}

/// Runs what `read` makes of the words of PETSc's options; these hold from where it hands them over.
py::dict run_read(const std::string& name, const std::string& output, std::vector<std::string> words, const std::string& command,
                  const std::string& resumed, const py::object& progress,
                  const std::function<Input(std::vector<std::string>& words, std::optional<OptionsOfRun>& given)>& read_input) {
  Listener listener{progress};
  const Ran ran = with_petsc([&] {
    const petsc::Ranks ranks(PETSC_COMM_WORLD);
    std::optional<OptionsOfRun> given;
    std::optional<Model> model;
    ranks.on_each([&] { model.emplace(read(read_input(words, given))); });
    require_one_run(ranks, *model, words, name);
    RunOptions options = run_options(output, command, listener);
    options.resume = resumed;
    return run_together(*model, options, listener);
  });
  return dict_of(ran, listener);
}

py::dict run_source(const Source& source, const std::string& output, const std::vector<std::string>& options,
                    const std::string& command, const py::object& progress) {
  return run_read(source.name, output, options, command, "", progress, [&](auto& words, auto& given) {
    given.emplace(words);
    return Input::read_text(source.text, source.name);
  });
}

py::dict resume(const std::string& file, const std::string& output, const std::vector<std::string>& options,
                const std::string& command, const py::object& progress) {
  return run_read(file, output.empty() ? file : output, options, command, file, progress, [&](auto& words, auto& given) {
    const InterruptedRun earlier = read_interrupted_run(file);
    add_earlier_options(earlier, words);
    given.emplace(words);
    return input_of(earlier);
  });
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<Source>(module, "Source").def(py::init<std::string, std::string>(), "text"_a, "name"_a)
      .def_readonly("name", &Source::name);
  module.def("read_file", [](const std::string& path) { return Input::read_file(path).text(); });
  module.def("parse", [](const Source& source) { return plain(Input::read_text(source.text, source.name)); });
  module.def("check", &checked);
  module.def("modes", &modes);
  module.def("run", &run_source, "source"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("resume", &resume, "file"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("refuse", &refuse, "text"_a);
  module.def("end_petsc", &end_petsc, "failed"_a);
}

}  // namespace pounding::python
