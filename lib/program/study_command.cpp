/// `study` and `separation`: implemented in Python, which has the plan, the processes and the statistics.

#include <string>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {
namespace {

// Arguments after the command are passed to Python, including --help after another argument.
void add_python_command(CLI::App& app, const std::string& name, const std::string& meaning, const std::string& more) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->footer(more);
  command->prefix_command();
  command->callback([command, name] {
    std::vector<std::string> arguments{name};
    for (const std::string& argument : command->remaining()) arguments.push_back(argument);
    become_python("studies.command", arguments);
  });
}

}  // namespace

void add_study(CLI::App& app) {
  add_python_command(app, "study", "Run a model many times: STUDY.yaml; check, show, merge, plot and export its table",
                     "All options: pounding study run --help; of the other subcommands: pounding study check --help, "
                     "show, merge, plot, export");
  add_python_command(app, "separation", "Required gap of MODEL.yaml from its records and by code rules",
                     "All options: pounding separation MODEL.yaml --help");
}

}  // namespace pounding::program
