/// Runs of models and their resumption, with PETSc in the process of Python.

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/ts_setup.hpp>

#include "bindings.hpp"
#include "source.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

/// Progress callback of a run, which can stop it.
struct Listener {
  py::object progress;  ///< None, or called with time [s], duration [s] and impacts
  /// Exception of a signal handler or of `progress`, which ends the run.
  std::optional<py::error_already_set> raised = {};
  /// Message of that exception for the other processes; empty for Ctrl-C, which every process receives.
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

/// Result of a complete or incomplete run.
struct Ran {
  std::shared_ptr<const Results> results;  ///< in memory if the run used one process, else null
  std::vector<std::byte> image;            ///< of the results file if `results` is null
  std::string summary;                     ///< the object that --json prints
  std::string warning;
  std::vector<std::string> implausible;  ///< warnings about implausible values
  std::string failure;                   ///< empty for a complete run
  bool resumable = false;                ///< the output can be resumed
};

// The bytes of the results file on all processes; only the first one has whole histories.
std::vector<std::byte> image_for_all(const petsc::Ranks& ranks, const Results& results) {
  std::vector<std::byte> mine;
  if (ranks.is_root()) {
    const FileImage made = results_image(results);
    mine.assign(made.begin(), made.end());
  }
  return ranks.gather(mine).front();
}

Ran ran(const Model& model, Outcome outcome, std::string failure) {
  // The warning about energies, the last one, is reported separately.
  std::vector<std::string> warnings = outcome.summary.warnings;
  std::string of_energies = warning(outcome.summary, effective_settings(model).stepper.tolerance);
  std::erase(warnings, of_energies);
  if (!failure.empty()) of_energies.clear();
  Ran ran{.results = nullptr,
          .image = {},
          .summary = outcome.results.summary_json,
          .warning = std::move(of_energies),
          .implausible = std::move(warnings),
          .failure = std::move(failure),
          .resumable = outcome.resumable};
  // Several processes create the image collectively now; a single one creates it on demand.
  if (const petsc::Ranks ranks(PETSC_COMM_WORLD); ranks.size() > 1)
    ran.image = image_for_all(ranks, outcome.results);
  else
    ran.results = std::make_shared<const Results>(std::move(outcome.results));
  return ran;
}

Ran run_model(const Model& model, const RunOptions& options) {
  try {
    return ran(model, run(model, options), "");
  } catch (const FailedRun& failed) {
    return ran(model, failed.outcome(), failed.what());
  }
}

// An exception raised in Python on one process ends the run on all of them.
void share_exception(const petsc::Ranks& ranks, const Listener& listener, Ran& ran) {
  try {
    ranks.on_each([&] {
      if (!listener.failure.empty()) throw std::runtime_error(listener.failure);
    });
  } catch (const std::runtime_error& error) {
    ran.failure = error.what();
  }
}

Ran run_together(const Model& model, const RunOptions& options, const Listener& listener) {
  Ran ran;
  petsc::run_collectively(
      options.comm, [&] { ran = run_model(model, options); },
      [](const std::string&, const std::exception&) { leave_the_others(); });
  share_exception(petsc::Ranks(options.comm), listener, ran);
  return ran;
}

// In different working folders the same name may be a different file.
void require_one_run(const petsc::Ranks& ranks, const Model& model, const std::vector<std::string>& options,
                     const std::string& name) {
  if (!ranks.same(fmt::format("{}\n{}", model.source_text, fmt::join(options, " "))))
    throw InputError(fmt::format("{}: the processes run different models or options; give all of them the same", name));
}

/// Throws InputError with this text on all processes if there are several.
void refuse(const std::string& text) {
  if (petsc::launch().value_or(petsc::Launch{}).size > 1)
    with_petsc([&] { petsc::Ranks(PETSC_COMM_WORLD).on_each([&] { throw InputError(text); }); });
}

/// A run as returned to Python.
struct RunOutcome {
  std::shared_ptr<const Results> results;
  std::vector<std::byte> bytes;
  std::string summary;  ///< the object that --json prints
  std::string warning, failure;
  std::vector<std::string> implausible;
  bool resumable = false;
  py::object raised;  ///< by a signal handler or `progress`; None

  /// Bytes of the results file.
  py::bytes image() const {
    FileImage made;
    if (results) {
      const py::gil_scoped_release free;
      made = results_image(*results);
    }
    const std::span<const std::byte> whole = results ? std::span<const std::byte>(made) : bytes;
    return {reinterpret_cast<const char*>(whole.data()), whole.size()};
  }
};

RunOutcome for_python(Ran ran, const Listener& listener) {
  return {.results = std::move(ran.results),
          .bytes = std::move(ran.image),
          .summary = std::move(ran.summary),
          .warning = ran.warning,
          .failure = ran.failure,
          .implausible = ran.implausible,
          .resumable = ran.resumable,
          .raised = listener.raised ? py::object(listener.raised->value()) : py::none()};
}

RunOptions run_options(const std::string& output, const std::string& command, Listener& listener) {
  return {.output = output,
          .command = command,
          .progress = [&](double time, double duration, int impacts) { listener.report(time, duration, impacts); },
          .stop = [&](std::span<const ContactMemory>) { return listener.stops(); }};
}

/// Runs the model from `read_input`, which also activates the PETSc options of the run.
RunOutcome run_read(
    const std::string& name, const std::string& output, std::vector<std::string> words, const std::string& command,
    const std::string& resumed, const py::object& progress, PetscUse use,
    const std::function<Input(std::vector<std::string>& words, std::optional<OptionsOfRun>& given)>& read_input) {
  Listener listener{progress};
  Ran ran = with_petsc(
      [&] {
        const petsc::Ranks ranks(PETSC_COMM_WORLD);
        std::optional<OptionsOfRun> given;
        std::optional<Model> model;
        ranks.on_each([&] { model.emplace(read(read_input(words, given))); });
        require_one_run(ranks, *model, words, name);
        RunOptions options = run_options(output, command, listener);
        options.resume = resumed;
        return run_together(*model, options, listener);
      },
      use);
  return for_python(std::move(ran), listener);
}

RunOutcome run_source(const Source& source, const std::string& output, const std::vector<std::string>& options,
                      const std::string& command, const py::object& progress) {
  const PetscUse use = options.empty() ? PetscUse::shared : PetscUse::alone;
  return run_read(source.name, output, options, command, "", progress, use, [&](auto& words, auto& given) {
    given.emplace(words);
    return source.input();
  });
}

RunOutcome resume(const std::string& file, const std::string& output, const std::vector<std::string>& options,
                  const std::string& command, const py::object& progress) {
  return run_read(file, output.empty() ? file : output, options, command, file, progress, PetscUse::alone,
                  [&](auto& words, auto& given) {
                    const InterruptedRun earlier = read_interrupted_run(file);
                    add_earlier_options(earlier, words);
                    given.emplace(words);
                    return input_of(earlier);
                  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<RunOutcome>(module, "RunOutcome")
      .def_property_readonly("image", &RunOutcome::image)
      .def_readonly("summary", &RunOutcome::summary)
      .def_readonly("warning", &RunOutcome::warning)
      .def_readonly("failure", &RunOutcome::failure)
      .def_readonly("implausible", &RunOutcome::implausible)
      .def_readonly("resumable", &RunOutcome::resumable)
      .def_readonly("raised", &RunOutcome::raised);
  module.def("run", &run_source, "source"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("resume", &resume, "file"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("run_alone", &run_alone);
  module.def(
      "given_options",
      [] {
        const PetscForThisThread mine;
        start_petsc();
        return petsc::Environment::given_options();
      },
      py::call_guard<py::gil_scoped_release>());
  module.def("refuse", &refuse, "text"_a);
  module.def("end_petsc", &end_petsc, "failed"_a);
}

}  // namespace pounding::python
