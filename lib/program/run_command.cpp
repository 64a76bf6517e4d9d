#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <csignal>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/yielding_report.hpp>
#include <pounding/results/replaced_file.hpp>
#include <pounding/run/implausible.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/ts_setup.hpp>
#include "commands.hpp"
#include "exit_code.hpp"

namespace pounding::program {
namespace {

struct RunArguments {
  std::string model, output, picture, report, resume;
  bool json = false, plot = false, quiet = false;
};

std::string with_ending(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

void print_warnings(std::span<const std::string> warnings) {
  for (const std::string& text : warnings) std::fprintf(stderr, "pounding: warning: %s\n", text.c_str());
}

// A progress line on the terminal: a bar and the estimated remaining time.
class RunProgress {
 public:
  void show(double time, double duration, int impacts) {
    if (time < begin_ || since_begin_ == Clock::time_point{}) restart(time);
    const int width = 30;
    const int filled = static_cast<int>(width * time / duration);
    const std::string line = fmt::format("\r[{:#<{}}{:.<{}}] {:.2f} of {:.2f} s, {} impacts{} \033[K", "", filled, "",
                                         width - filled, time, duration, impacts, rest(time, duration));
    std::fputs(line.c_str(), stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  // The second of two runs starts at zero again, and a resumed run starts later.
  void restart(double time) {
    begin_ = time;
    since_begin_ = Clock::now();
  }
  // Empty during the first second, in which an estimate is unreliable.
  std::string rest(double time, double duration) const {
    const double passed = std::chrono::duration<double>(Clock::now() - since_begin_).count();
    if (passed < 1 || !(time > begin_)) return "";
    const double left = passed * (duration - time) / (time - begin_);
    if (left < 100) return fmt::format(", {:.0f} s left", left);
    if (left < 6000) return fmt::format(", {:.0f} min left", left / 60);
    return left < 360000 ? fmt::format(", {:.0f} h left", left / 3600)
                         : fmt::format(", {:.3g} days left", left / 86400);
  }

  double begin_ = 0;  // simulated time of the first report [s]
  Clock::time_point since_begin_{};
};

void clear_progress() { std::fputs("\r\033[K", stderr); }

// SIGHUP as set by nohup, read before PETSc, which does not restore it, is initialized.
const bool hangup_is_ignored = [] {
  struct sigaction given = {};
  return sigaction(SIGHUP, nullptr, &given) == 0 && given.sa_handler == SIG_IGN;
}();

// Ctrl-C (SIGINT), SIGTERM, a closing terminal (SIGHUP) and a limit on processor time (SIGXCPU) end the run; the
// results up to that time are in the file. A second Ctrl-C or SIGTERM ends the program immediately; the kernel repeats
// SIGXCPU every second.
class StopOnSignal {
 public:
  StopOnSignal() {
    struct sigaction action = {}, ignore = {};
    action.sa_handler = [](int) { stop = 1; };
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXCPU, &action, nullptr);
    sigaction(SIGHUP, hangup_is_ignored ? &ignore : &action, nullptr);
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }
  static volatile std::sig_atomic_t stop;
};
volatile std::sig_atomic_t StopOnSignal::stop = 0;

// Arguments unknown to CLI11: MODEL, then PETSc options, each with its value.
struct Rest {
  std::string model;
  std::vector<std::string> options;
};

Rest rest_of(const CLI::App& command) {
  Rest rest;
  rest.options = command.remaining();
  if (!rest.options.empty() && rest.options[0][0] != '-') {
    rest.model = rest.options[0];
    rest.options.erase(rest.options.begin());
  }
  bool value = false;
  for (const std::string& argument : rest.options) {
    const bool option = argument.rfind("-pounding_", 0) == 0 || argument == "-log_view";
    // PETSc would parse the name of another option as such, not as a value.
    if (!option && (!value || petsc::is_option_name(argument)))
      throw InputError(
          fmt::format("unknown option \"{}\"; PETSc options for the run start with -pounding_, all others are listed "
                      "by pounding run --help",
                      excerpt(argument)));
    value = option;
  }
  return rest;
}

// Ends all processes, since the others wait for this one.
void abort_all(const std::string& text, const std::exception& error) {
  print_failure(text.c_str());
  MPI_Abort(PETSC_COMM_WORLD, exit_code(error));
}

struct Task {
  std::string model_file;
  std::vector<std::string> options;
  InterruptedRun earlier;
};

void run_task(const RunArguments& arguments, const Task& task) {
  const auto& [model_file, options, earlier] = task;
  const bool resume = !arguments.resume.empty();
  const petsc::Ranks ranks(PETSC_COMM_WORLD);
  const Model model =
      read_model(model_file.empty() ? input_of(earlier) : Input::read_file(model_file), petsc::lowest_modes);
  RunOptions run_options;
  const bool plot = arguments.plot || !arguments.picture.empty(), report = !arguments.report.empty();
  const bool keep = !arguments.output.empty() || plot || report || resume;
  if (keep)
    run_options.output = resume ? arguments.resume : with_ending(std::filesystem::path(model_file).filename(), ".h5");
  if (!arguments.output.empty()) run_options.output = arguments.output;
  run_options.resume = arguments.resume;
  run_options.command =
      fmt::format("pounding run{}{}{}{}{}{}", model_file.empty() ? "" : " ", model_file, resume ? " --resume " : "",
                  arguments.resume, options.empty() ? "" : " ", fmt::join(options, " "));
  const std::string picture = arguments.picture.empty() ? with_ending(run_options.output, ".png") : arguments.picture;
  if (plot) ReplacedFile(picture, picture_files).require_free();
  if (report) ReplacedFile(arguments.report, run_report_files).require_free();
  const bool terminal = isatty(STDERR_FILENO) != 0 && !arguments.quiet && ranks.is_root();
  RunProgress line;
  if (terminal)
    run_options.progress = [&](double time, double duration, int impacts) { line.show(time, duration, impacts); };
  if (!arguments.json && !arguments.quiet && ranks.is_root()) std::fputs((describe(model) + "\n").c_str(), stdout);
  std::fflush(stdout);
  const std::vector<std::string> warnings = implausible(model, effective_settings(model).stepper.tolerance);
  if (ranks.is_root()) print_warnings(warnings);
  const auto print_new_warnings = [&](const Outcome& ended) {
    const std::span<const std::string> all = ended.summary.warnings;
    if (ranks.is_root() && all.size() > warnings.size()) print_warnings(all.subspan(warnings.size()));
  };

  const StopOnSignal signals;  // after PETSc, which installs and restores its own signal handlers
  run_options.stop = [](std::span<const ContactMemory>) { return StopOnSignal::stop != 0; };
  Outcome outcome;
  try {
    outcome = run(model, run_options);
  } catch (const FailedRun& failed) {
    if (terminal) clear_progress();
    print_new_warnings(failed.outcome());
    if (arguments.json && ranks.is_root()) std::puts(to_json(failed.outcome().summary).c_str());
    if (!failed.outcome().resumable) throw;
    const std::string launcher = ranks.size() > 1 ? fmt::format("mpirun -n {} ", ranks.size()) : "";
    const long steps = failed.outcome().summary.solver.steps;
    const std::string more =
        steps >= model.analysis.max_steps ? fmt::format(" -pounding_ts_max_steps {}", 2 * steps) : "";
    throw SolverError(fmt::format("{}\nTo resume, type {}pounding run --resume {}{}", failed.what(), launcher,
                                  run_options.output, more));
  } catch (...) {
    if (terminal) clear_progress();
    throw;
  }
  if (terminal) clear_progress();
  if (!ranks.is_root()) return;
  if (const auto unread = petsc::Environment::unread_options(); !unread.empty())
    std::fprintf(stderr, "pounding: unused option %s; the results do not depend on it\n", unread.front().c_str());
  print_new_warnings(outcome);
  if (arguments.json)
    std::puts(to_json(outcome.summary).c_str());
  else if (!arguments.quiet)
    std::fputs(to_table(outcome.summary).c_str(), stdout);
  const bool prints = !arguments.json && !arguments.quiet;
  if (!keep) {
    if (prints)
      std::printf("\nresults      not kept; to keep them, add -o %s\n",
                  with_ending(std::filesystem::path(model_file).filename(), ".h5").c_str());
    return;
  }
  if (prints) std::printf("\nresults      %s\n", run_options.output.c_str());
  if (plot) {
    draw(run_options.output, picture);
    if (prints) std::printf("picture      %s\n", picture.c_str());
  }
  if (report) {
    write_report(run_options.output, arguments.report);
    if (prints) std::printf("report       %s\n", arguments.report.c_str());
  }
}

void run_model(const RunArguments& arguments, const CLI::App& command) {
  auto [model_file, options] = rest_of(command);
  const bool resume = !arguments.resume.empty();
  if (model_file.empty() && !resume) throw InputError("MODEL is required; type pounding run MODEL.yaml");
  InterruptedRun earlier;
  if (resume) {
    earlier = read_interrupted_run(arguments.resume);
    add_earlier_options(earlier, options);
  }
  const petsc::Environment environment(options);
  petsc::run_collectively(
      PETSC_COMM_WORLD, [&, &file = model_file, &given = options] { run_task(arguments, {file, given, earlier}); },
      abort_all);
}

}  // namespace

void add_run(CLI::App& app) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run_command = app.add_subcommand("run", "Time history analysis of MODEL, an input file (YAML)");
  names_a_file(run_command->add_option("--resume", arguments->resume,
                                       "Results file of an interrupted run: resumes it in the same file with the model "
                                       "stored there; MODEL and the original PETSc options need not be typed again"));
  names_a_file(run_command->add_option(
      "-o,--output", arguments->output,
      "Results file (HDF5); without it --plot, --picture and --report write MODEL.h5 in the current folder"));
  run_command->add_flag("--plot", arguments->plot, "Draw the standard picture next to the results file; see -o");
  is_report(run_command->add_option("--report", arguments->report,
                                    "Write a report of two pages: .pdf or .html; without -o the results are kept in "
                                    "MODEL.h5 in the current folder"));
  names_a_file(run_command->add_option("--picture", arguments->picture, "Name of the picture"));
  run_command->add_flag("--json", arguments->json, "Print the summary as one JSON object");
  run_command->add_flag("-q,--quiet", arguments->quiet, "Print only warnings and errors");
  run_command->allow_extras();
  run_command->footer(
      "PETSc options with the prefix -pounding_ follow MODEL and control the time stepping, for example\n"
      "  -pounding_ts_rtol 1e-6  -pounding_ts_pounding_scheme generalized_alpha  -pounding_ts_view  "
      "-pounding_ts_monitor");
  run_command->callback([arguments, run_command] { run_model(*arguments, *run_command); });

  const auto check_arguments = std::make_shared<RunArguments>();
  CLI::App* check_command = app.add_subcommand("check", "Read and check a model without running it");
  check_command->add_option("MODEL", check_arguments->model, "Input file (YAML)")->required();
  CLI::Option* json = check_command->add_flag("--json", check_arguments->json, "Print one JSON object");
  const auto resolved = std::make_shared<bool>(false);
  check_command
      ->add_flag("--resolved", *resolved,
                 "Print the model as YAML with every default and calibrated parameter in SI units")
      ->excludes(json);
  check_command->callback([check_arguments, resolved] {
    const petsc::Environment environment;
    const Model model = read_model(Input::read_file(check_arguments->model), petsc::lowest_modes);
    const std::vector<std::string> warnings = implausible(model);
    print_warnings(warnings);
    if (*resolved) {
      std::fputs(resolved_yaml(model).c_str(), stdout);
      return;
    }
    if (!check_arguments->json) {
      const std::string yielding = yielding_table(model);
      std::fputs((describe(model) + (yielding.empty() ? "" : "\n") + yielding).c_str(), stdout);
      return;
    }
    using Json = nlohmann::ordered_json;
    Json found{{"status", "ok"},
               {"structures", model.structures.size()},
               {"links", model.links.size()},
               {"devices", model.devices.size()},
               {"warnings", warnings}};
    if (Json yielding = Json::parse(yielding_json(model)); !yielding.empty()) found["yielding"] = std::move(yielding);
    std::puts(found.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
  });
}

}  // namespace pounding::program
