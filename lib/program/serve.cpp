#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/version.hpp>
#include <pounding/petsc/launch.hpp>
#include "commands.hpp"
#include "exit_code.hpp"
#include "serve.hpp"

namespace pounding::program {
namespace {

const petsc::Launch launched = petsc::launch().value_or(petsc::Launch{});

// Under mpirun all processes fail; the first one reports. MPI may not be initialized yet, or already finalized.
bool is_root() { return launched.rank == 0; }

// Otherwise each process would print the same text and write the same files.
void require_one_process(CLI::App& command) {
  command.parse_complete_callback([&command] {
    if (launched.size > 1)
      throw InputError(fmt::format("pounding {} runs in one process, but {} were started; type it without mpirun",
                                   command.get_name(), launched.size));
  });
}

// Message for an argument in the position of a command that is not one; empty if there is none.
std::string unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* level = &app;
  std::string before;
  for (const std::string& argument : arguments) {
    const auto commands = level->get_subcommands([](const CLI::App*) { return true; });
    if (commands.empty() || argument.starts_with('-')) return {};
    std::vector<std::string_view> names;
    level = nullptr;
    for (const CLI::App* command : commands) {
      names.push_back(command->get_name());
      if (command->get_name() == argument) level = command;
    }
    if (level == nullptr) {
      const bool is_model = argument.ends_with(".yaml") || argument.ends_with(".yml");
      return fmt::format("unknown command \"{}{}\".{}", before, excerpt(argument),
                         is_model ? fmt::format(" To run this model type pounding run {}", excerpt(argument))
                                  : suggestion(argument, names));
    }
    before += argument + " ";
  }
  return {};
}

// True if standard output is a pipe whose reader has closed it.
bool reader_is_gone() {
  pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

// Exit code of a successful command.
int printed() {
  if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || reader_is_gone()) return done;
  return report("the output could not be written", bad_input);
}

}  // namespace

int report(const char* text, int code) {
  if (is_root())
    print_failure(text);
  else
    // The launcher kills the other processes after the first failed one and may lose output that it has not yet
    // forwarded, so the reporting process must exit first.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  return code;
}

int serve(int argc, char** argv) {
  CLI::App app{"Seismic pounding of adjacent structures"};
  app.set_version_flag("--version", "pounding " POUNDING_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::help);
  add_run(app);
  add_modes(app);
  add_pushover(app);
  add_section(app);
  add_sensitivity(app);
  add_study(app);
  add_arguments(app);
  add_laws(app);
  add_calibrate(app);
  add_record(app);
  add_spectrum(app);
  add_plot(app);
  add_report(app);
  add_animate(app);
  add_view(app);
  add_export(app);
  add_reproduce(app);
  for (CLI::App* command : app.get_subcommands([](const CLI::App* each) { return each->get_name() != "run"; }))
    require_one_process(*command);
  app.get_subcommand("run")->parse_complete_callback(petsc::require_mpi_for_several);
  try {
    app.parse(argc, argv);
    return printed();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      if (is_root()) app.exit(error);
      std::cout.flush();
      return printed();
    }
    if (const std::string unknown = unknown_command(app, {argv + 1, argv + argc}); !unknown.empty())
      return report((unknown + "\nType pounding --help.").c_str(), bad_input);
    return report((std::string(error.what()) + "\nType pounding --help, or pounding COMMAND --help.").c_str(),
                  bad_input);
  } catch (const std::system_error&) {
    if (std::ferror(stdout)) return printed();  // fmt::print throws
    throw;
  }
}

}  // namespace pounding::program
