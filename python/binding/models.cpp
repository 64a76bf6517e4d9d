/// Models from their text: reading, checking, modes, runs.

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/input/pushover_input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/model/describe.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/model/plausible.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/results/pushover_file.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include "bindings.hpp"
#include "host.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

/// The text of a model, the file that it stands for, and contents of files that it names.
struct Source {
  std::string text, name;
  std::map<std::string, std::string> files = {};

  Input input() const {
    return Input::read_text(text, name, std::make_shared<const std::map<std::string, std::string>>(files));
  }
};

Model read(const Input& input) { return read_model(input, petsc::lowest_modes); }
Model read(const Source& source) { return read(source.input()); }

/// Runs `task` without holding the interpreter, with PETSc started.
template <class Task>
auto with_petsc(Task&& task) {
  const py::gil_scoped_release free;
  const PetscForThisThread mine;
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

std::tuple<std::string, std::string, std::vector<std::string>> checked(const Source& source) {
  return with_petsc([&] {
    const Model model = read(source);
    return std::tuple(describe(model), resolved_yaml(model), implausible(model));
  });
}

/// Quantities that a structure has: those of floors, of storeys, and of rigid floors in space.
struct MovingStructure {
  std::string name;
  std::size_t floors = 0;
  bool has_storeys = false, has_plans = false;
};

/// Structures that move, links as (name, is rigid), and the latest arrival of the model's ground motion [s].
struct Layout {
  std::vector<MovingStructure> structures;
  std::vector<std::pair<std::string, bool>> links;
  double last_arrival = 0;
};

Layout layout(const Source& source) {
  return with_petsc([&] {
    const Model model = read(source);
    Layout found;
    for (const Structure& s : model.structures)
      if (!s.is_rigid())
        found.structures.push_back(
            {s.name, s.floors.size(), s.has_storeys(),
             std::ranges::any_of(s.floors, [](const Floor& floor) { return floor.plan.has_value(); })});
    for (const Link& link : model.links) found.links.emplace_back(link.name, link.contact->is_rigid());
    found.last_arrival = ground_plan(model).last_arrival;
    return found;
  });
}

/// The modes of one structure, and how it is drawn.
struct StructureModes {
  std::string name;
  std::vector<Mode> modes;                        ///< longest period first
  bool is_frame = false;                          ///< motion in x and z or in space; else along x only
  std::vector<std::optional<double>> elevations;  ///< [floor] [m]
  std::vector<Eigen::Vector3d> nodes;             ///< at rest [m]; none without geometry
  std::vector<std::array<int, 2>> members;        ///< numbers of their nodes
  std::vector<Eigen::MatrixX3d> node_shapes;      ///< [mode] displacements of the nodes, to the scale of the mode
};

StructureModes modes_of(const Structure& structure, int count) {
  StructureModes found;
  found.name = structure.name;
  found.is_frame = structure.dimension > 1;
  // An oscillator or a shear building shows all its modes.
  found.modes = modes(structure, found.is_frame ? count : std::numeric_limits<int>::max(), petsc::lowest_modes);
  for (const Floor& floor : structure.floors) found.elevations.push_back(floor.elevation);
  if (!structure.node_translations) return found;
  found.nodes = structure.geometry.positions;
  found.members = structure.geometry.members;
  for (const Mode& mode : found.modes) found.node_shapes.push_back(structure.node_translations(mode.unknowns));
  return found;
}

std::vector<StructureModes> modes_of_all(const Source& source, int count) {
  return with_petsc([&] {
    const Model model = read(source);
    std::vector<StructureModes> found;
    for (const Structure& structure : model.structures) found.push_back(modes_of(structure, count));
    return found;
  });
}

/// The results of a pushover as JSON; written to `output` unless that is empty.
std::string pushed_over(const Source& source, const PushoverWords& words, const std::string& output) {
  return with_petsc([&] {
    const Model model = read(source);
    const Pushover found = pushover(model, words, petsc::lowest_modes);
    if (!output.empty()) write_pushover(output, found, model.source_text);
    return pushover_json(found);
  });
}

/// Receives the progress of a run, and may end it.
struct Listener {
  py::object progress;  ///< None, or called with time [s], duration [s] and impacts
  /// Exception of a signal handler or of `progress`; it ends the run.
  std::optional<py::error_already_set> raised = {};
  /// Text of that exception for the other processes; empty for Ctrl-C, which each process sees by itself.
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

/// Result of a run that was completed or not.
struct Ran {
  std::shared_ptr<const Results> results;  ///< in memory, of a run in this process alone; else null
  std::vector<std::byte> image;            ///< of the results file, where `results` are not there
  std::string summary;                     ///< the object that --json prints
  std::string warning;
  std::vector<std::string> implausible;  ///< warnings of what the model and the run hold
  std::string failure;                   ///< empty for a run that came to its end
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
  // The last one may be of energies, which is a warning of its own here.
  std::vector<std::string> doubts = outcome.summary.warnings;
  std::string of_energies = warning(outcome.summary, model.analysis.tolerance);
  std::erase(doubts, of_energies);
  if (!failure.empty()) of_energies.clear();
  Ran ran{.results = nullptr,
          .image = {},
          .summary = outcome.results.summary_json,
          .warning = std::move(of_energies),
          .implausible = std::move(doubts),
          .failure = std::move(failure),
          .resumable = outcome.resumable};
  // Many processes make the image together, and now; one makes it when somebody asks for a history.
  if (const petsc::Ranks ranks(PETSC_COMM_WORLD); ranks.size() > 1)
    ran.image = image_for_all(ranks, outcome.results);
  else
    ran.results = std::make_shared<const Results>(std::move(outcome.results));
  return ran;
}

Ran run_alike(const Model& model, const RunOptions& options) {
  try {
    return ran(model, run(model, options), "");
  } catch (const FailedRun& failed) {
    return ran(model, failed.outcome(), failed.what());
  }
}

// An exception that Python raised on one process has ended the run of all.
void tell_what_was_raised(const petsc::Ranks& ranks, const Listener& listener, Ran& ran) {
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
      options.comm, [&] { ran = run_alike(model, options); },
      [](const std::string&, const std::exception&) { leave_the_others(); });
  tell_what_was_raised(petsc::Ranks(options.comm), listener, ran);
  return ran;
}

// Processes may work in different folders, where a file of the same name may be another one.
void require_one_run(const petsc::Ranks& ranks, const Model& model, const std::vector<std::string>& options,
                     const std::string& name) {
  if (!ranks.same(fmt::format("{}\n{}", model.source_text, fmt::join(options, " "))))
    throw InputError(fmt::format("{}: the processes run different models or options; give all of them the same", name));
}

/// Raises InputError with this text on every process; does nothing where there is only one.
void refuse(const std::string& text) {
  if (petsc::launch().value_or(petsc::Launch{}).size > 1)
    with_petsc([&] { petsc::Ranks(PETSC_COMM_WORLD).on_each([&] { throw InputError(text); }); });
}

/// A run as Python gets it.
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
      // HDF5 works for one thread at a time; a function that shows the progress of another run has the right already.
      std::optional<PetscForThisThread> mine;
      if (!PetscForThisThread::holds()) mine.emplace();
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

/// Value in SI of a number with or without a unit, and its SI unit; no unit for a bare number.
std::pair<double, std::string> value_in_si(const std::string& text) {
  const char* const end = text.data() + text.size();
  const char* begin = text.data();
  while (begin != end && (*begin == ' ' || *begin == '+')) ++begin;
  double number = 0;
  const char* const rest = std::from_chars(begin, end, number).ptr;
  const Unit unit = rest == begin ? Unit{} : parse_unit({rest, end});
  return {parse_quantity(text, unit.dimension), unit_text(unit.dimension)};
}

RunOptions run_options(const std::string& output, const std::string& command, Listener& listener) {
  return {.output = output,
          .command = command,
          .progress = [&](double time, double duration, int impacts) { listener.report(time, duration, impacts); },
          .stop = [&] { return listener.stops(); }};
}

/// Runs what `read` makes of the words of PETSc's options; these hold from where it hands them over.
RunOutcome run_read(
    const std::string& name, const std::string& output, std::vector<std::string> words, const std::string& command,
    const std::string& resumed, const py::object& progress,
    const std::function<Input(std::vector<std::string>& words, std::optional<OptionsOfRun>& given)>& read_input) {
  Listener listener{progress};
  Ran ran = with_petsc([&] {
    const petsc::Ranks ranks(PETSC_COMM_WORLD);
    std::optional<OptionsOfRun> given;
    std::optional<Model> model;
    ranks.on_each([&] { model.emplace(read(read_input(words, given))); });
    require_one_run(ranks, *model, words, name);
    RunOptions options = run_options(output, command, listener);
    options.resume = resumed;
    return run_together(*model, options, listener);
  });
  return for_python(std::move(ran), listener);
}

RunOutcome run_source(const Source& source, const std::string& output, const std::vector<std::string>& options,
                      const std::string& command, const py::object& progress) {
  return run_read(source.name, output, options, command, "", progress, [&](auto& words, auto& given) {
    given.emplace(words);
    return source.input();
  });
}

RunOutcome resume(const std::string& file, const std::string& output, const std::vector<std::string>& options,
                  const std::string& command, const py::object& progress) {
  return run_read(file, output.empty() ? file : output, options, command, file, progress,
                  [&](auto& words, auto& given) {
                    const InterruptedRun earlier = read_interrupted_run(file);
                    add_earlier_options(earlier, words);
                    given.emplace(words);
                    return input_of(earlier);
                  });
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<Source>(module, "Source")
      .def(py::init<std::string, std::string, std::map<std::string, std::string>>(), "text"_a, "name"_a,
           "files"_a = py::dict())
      .def_readonly("name", &Source::name);
  py::class_<Mode>(module, "Mode")
      .def_readonly("period", &Mode::period)
      .def_readonly("damping_ratio", &Mode::damping_ratio)
      .def_readonly("participation", &Mode::participation)
      .def_readonly("effective_mass", &Mode::effective_mass)
      .def_readonly("shape", &Mode::shape);
  py::class_<StructureModes>(module, "StructureModes")
      .def_readonly("name", &StructureModes::name)
      .def_readonly("modes", &StructureModes::modes)
      .def_readonly("is_frame", &StructureModes::is_frame)
      .def_readonly("elevations", &StructureModes::elevations)
      .def_readonly("nodes", &StructureModes::nodes)
      .def_readonly("members", &StructureModes::members)
      .def_readonly("node_shapes", &StructureModes::node_shapes);
  py::class_<RunOutcome>(module, "RunOutcome")
      .def_property_readonly("image", &RunOutcome::image)
      .def_readonly("summary", &RunOutcome::summary)
      .def_readonly("warning", &RunOutcome::warning)
      .def_readonly("failure", &RunOutcome::failure)
      .def_readonly("implausible", &RunOutcome::implausible)
      .def_readonly("resumable", &RunOutcome::resumable)
      .def_readonly("raised", &RunOutcome::raised);
  module.def("read_file", [](const std::string& path) { return Input::read_file(path).text(); });
  module.def("parse", [](const Source& source) { return plain(source.input()); });
  module.def("check", &checked);
  py::class_<MovingStructure>(module, "MovingStructure")
      .def_readonly("name", &MovingStructure::name)
      .def_readonly("floors", &MovingStructure::floors)
      .def_readonly("has_storeys", &MovingStructure::has_storeys)
      .def_readonly("has_plans", &MovingStructure::has_plans);
  py::class_<Layout>(module, "Layout")
      .def_readonly("structures", &Layout::structures)
      .def_readonly("links", &Layout::links)
      .def_readonly("last_arrival", &Layout::last_arrival);
  module.def("layout", &layout, "source"_a);
  module.def("modes", &modes_of_all, "source"_a, "count"_a);
  module.def(
      "pushover",
      [](const Source& source, const std::string& structure, const std::string& load, const std::string& direction,
         const std::string& to, const std::string& cyclic, const std::string& output) {
        return pushed_over(
            source,
            {.structure = structure, .load = load, .direction = direction, .to = to, .cyclic = cyclic, .mark = ""},
            output);
      },
      "source"_a, "structure"_a, "load"_a, "direction"_a, "to"_a, "cyclic"_a, "output"_a);
  module.def("run", &run_source, "source"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("resume", &resume, "file"_a, "output"_a, "options"_a, "command"_a, "progress"_a);
  module.def("si_value", &value_in_si, "text"_a);
  module.def(
      "find_record",
      [](const std::string& name, const std::string& folder) { return find_record(name, folder).string(); }, "name"_a,
      "folder"_a);
  module.def("read_record", [](const std::string& path) { return py::bytes(read_text_of_record(path)); }, "path"_a);
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
