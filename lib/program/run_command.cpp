#include <algorithm>
#include <csignal>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/run/implausible.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/ranks.hpp>
#include "commands.hpp"
#include "exit_code.hpp"

namespace pounding::program {
namespace {

struct RunArguments {
  std::string model, output, picture, resume;
  bool json = false, plot = false, report = false, quiet = false;
};

Model read(const Input& input) { return read_model(input, petsc::lowest_modes); }

std::string with_ending(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

void print_warnings(std::span<const std::string> warnings) {
  for (const std::string& text : warnings) std::fprintf(stderr, "pounding: warning: %s\n", text.c_str());
}

// Draws a progress bar on a terminal: one line, written over and over.
void show_progress(double time, double duration, int impacts) {
  const int width = 30;
  const int filled = static_cast<int>(width * time / duration);
  const std::string line = fmt::format("\r[{:#<{}}{:.<{}}] {:.2f} of {:.2f} s, {} impacts ", "", filled, "", width - filled,
                                       time, duration, impacts);
  std::fputs(line.c_str(), stderr);
}

void clear_progress() { std::fputs("\r\033[K", stderr); }

// As nohup leaves it, read before PETSc begins, which does not give it back.
const bool hangup_is_ignored = [] {
  struct sigaction given = {};
  return sigaction(SIGHUP, nullptr, &given) == 0 && given.sa_handler == SIG_IGN;
}();

// Ctrl-C (SIGINT), SIGTERM, a terminal that closes (SIGHUP) and a limit on processor time (SIGXCPU) end the run with its results so
// far in the file. A second Ctrl-C or SIGTERM ends the program at once; the kernel repeats SIGXCPU every second.
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

// Arguments that CLI11 does not know: MODEL, then PETSc's options, each with its value.
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
  for (const std::string& word : rest.options) {
    const bool option = word.rfind("-pounding_", 0) == 0 || word == "-log_view";
    if (!option && !value)
      throw InputError(fmt::format("unknown option \"{}\"; PETSc's options for the run start with -pounding_, the others "
                                   "are listed by pounding run --help",
                                   word));
    value = option;
  }
  return rest;
}

// Processes may work in different folders, where a file of the same name may be another one.
void require_one_model(const petsc::Ranks& ranks, const Model& model, const std::string& file) {
  if (!ranks.same(model.source_text))
    throw InputError(fmt::format("{}: the processes read different models; name a file that all of them see", file));
}

// Ends all processes: the others wait for this one.
void abort_all(const std::string& text, const std::exception& error) {
  print_failure(text.c_str());
  MPI_Abort(PETSC_COMM_WORLD, exit_code(error));
}

// Beside the standard picture: profiles, and of each structure the spectrum of the floor that is shaken hardest.
void draw_report(const Summary& summary, const std::string& results, std::vector<std::string>& pictures) {
  const std::string name = with_ending(results, "");
  pictures.push_back(name + "-profiles.png");
  draw_profiles(results, pictures.back());
  for (const StructureSummary& s : summary.structures) {
    const auto hardest = std::max_element(s.peak_acceleration.begin(), s.peak_acceleration.end());
    if (hardest == s.peak_acceleration.end()) continue;
    const std::string floor = fmt::format("{}.{}", s.name, hardest - s.peak_acceleration.begin() + 1);
    pictures.push_back(fmt::format("{}-spectrum-{}.png", name, floor));
    draw_floor_spectrum(results, floor, pictures.back());
  }
}

struct Task {
  std::string model_file;
  std::vector<std::string> options;
  InterruptedRun earlier;
};

void run_task(const RunArguments& words, const Task& task) {
  const auto& [model_file, options, earlier] = task;
  const bool resume = !words.resume.empty();
  const petsc::Ranks ranks(PETSC_COMM_WORLD);
  const Model model = read(model_file.empty() ? input_of(earlier) : Input::read_file(model_file));
  require_one_model(ranks, model, model_file.empty() ? words.resume : model_file);
  RunOptions run_options;
  const bool plot = words.plot || words.report || !words.picture.empty();
  const bool keep = !words.output.empty() || plot || resume;
  if (keep) run_options.output = resume ? words.resume : with_ending(std::filesystem::path(model_file).filename(), ".h5");
  if (!words.output.empty()) run_options.output = words.output;
  run_options.resume = words.resume;
  run_options.command = fmt::format("pounding run{}{}{}{}{}{}", model_file.empty() ? "" : " ", model_file,
                                    resume ? " --resume " : "", words.resume, options.empty() ? "" : " ",
                                    fmt::join(options, " "));
  const bool terminal = isatty(STDERR_FILENO) != 0 && !words.quiet && ranks.is_root();
  if (terminal) run_options.progress = show_progress;
  if (!words.json && !words.quiet && ranks.is_root()) std::fputs((describe(model) + "\n").c_str(), stdout);
  std::fflush(stdout);
  const std::vector<std::string> warnings = implausible(model);
  if (ranks.is_root()) print_warnings(warnings);

  const StopOnSignal signals;  // after PETSc, which takes and gives back signals of its own
  run_options.stop = [] { return StopOnSignal::stop != 0; };
  Outcome outcome;
  try {
    outcome = run(model, run_options);
  } catch (const FailedRun& failed) {
    if (terminal) clear_progress();
    if (words.json && ranks.is_root()) std::puts(to_json(failed.outcome().summary).c_str());
    if (!failed.outcome().resumable) throw;
    const std::string launcher = ranks.size() > 1 ? fmt::format("mpirun -n {} ", ranks.size()) : "";
    throw SolverError(fmt::format("{}\nTo go on: {}pounding run --resume {}", failed.what(), launcher, run_options.output));
  } catch (...) {
    if (terminal) clear_progress();
    throw;
  }
  if (terminal) clear_progress();
  if (!ranks.is_root()) return;
  if (const auto unread = petsc::Environment::unread_options(); !unread.empty())
    std::fprintf(stderr, "pounding: nothing read the option %s; the results do not depend on it\n", unread.front().c_str());
  print_warnings(std::span(outcome.summary.warnings).subspan(warnings.size()));
  if (words.json)
    std::puts(to_json(outcome.summary).c_str());
  else if (!words.quiet)
    std::fputs(to_table(outcome.summary).c_str(), stdout);
  if (!keep) return;
  if (!words.json && !words.quiet) std::printf("\nresults      %s\n", run_options.output.c_str());
  if (!plot) return;
  const std::string picture = words.picture.empty() ? with_ending(run_options.output, ".png") : words.picture;
  draw(run_options.output, picture);
  std::vector<std::string> pictures{picture};
  if (words.report) draw_report(outcome.summary, run_options.output, pictures);
  if (!words.json && !words.quiet)
    for (const std::string& each : pictures) std::printf("picture      %s\n", each.c_str());
}

void run_model(const RunArguments& words, const CLI::App& command) {
  auto [model_file, options] = rest_of(command);
  const bool resume = !words.resume.empty();
  if (model_file.empty() && !resume) throw InputError("MODEL is required; type pounding run MODEL.yaml");
  InterruptedRun earlier;
  if (resume) {
    earlier = read_interrupted_run(words.resume);
    add_earlier_options(earlier, options);
  }
  const petsc::Environment environment(options);
  petsc::run_collectively(PETSC_COMM_WORLD, [&] { run_task(words, {model_file, options, earlier}); }, abort_all);
}

}  // namespace

void add_run(CLI::App& app) {
  const auto words = std::make_shared<RunArguments>();
  CLI::App* run_command = app.add_subcommand("run", "Run MODEL, an input file (YAML), through time");
  names_a_file(run_command->add_option("--resume", words->resume,
                                       "Results file of a run that was killed, stopped or cut: goes on in it with the model that it "
                                       "holds; MODEL and the PETSc options of the beginning need not be named again"));
  names_a_file(run_command->add_option("-o,--output", words->output,
                                       "Results file (HDF5); without it --plot and --picture write MODEL.h5 in the current folder"));
  run_command->add_flag("--plot", words->plot, "Draw the standard picture beside the results file; -o OUT.h5 says where");
  run_command->add_flag("--report", words->report,
                        "Draw all pictures beside the results file: the standard one, the extremes over the height with and without "
                        "links, and of each structure the spectrum of the floor that is shaken hardest");
  names_a_file(run_command->add_option("--picture", words->picture, "Name of the picture"));
  run_command->add_flag("--json", words->json, "Print the summary as one JSON object");
  run_command->add_flag("-q,--quiet", words->quiet, "Print nothing but warnings and errors");
  run_command->allow_extras();
  run_command->footer("PETSc options with the prefix -pounding_ stand behind MODEL and reach the time stepping, for example\n"
                      "  -pounding_ts_rtol 1e-6  -pounding_ts_pounding_scheme generalized_alpha  -pounding_ts_view  -pounding_ts_monitor");
  run_command->callback([words, run_command] { run_model(*words, *run_command); });

  const auto check_words = std::make_shared<RunArguments>();
  CLI::App* check_command = app.add_subcommand("check", "Read and check a model without running it");
  check_command->add_option("MODEL", check_words->model, "Input file (YAML)")->required();
  check_command->add_flag("--json", check_words->json, "Print one JSON object");
  check_command->callback([check_words] {
    const petsc::Environment environment;
    const Model model = read(Input::read_file(check_words->model));
    const std::vector<std::string> warnings = implausible(model);
    print_warnings(warnings);
    if (check_words->json)
      std::puts(nlohmann::ordered_json{{"status", "ok"},
                                       {"structures", model.structures.size()},
                                       {"links", model.links.size()},
                                       {"warnings", warnings}}
                    .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                    .c_str());
    else
      std::fputs((describe(model) + "\n" + resolved_yaml(model)).c_str(), stdout);
  });
}

}  // namespace pounding::program
