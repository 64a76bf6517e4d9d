/// `study` and `separation`: done by Python, which has the plan, the processes and the statistics.

#include <string>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {
namespace {

// Words behind the command are Python's; a --help behind another word is, too.
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
                     "All options: pounding study run --help; those of the other verbs: pounding study check --help, "
                     "show, merge, plot, export");
  add_python_command(app, "separation",
                     "The gap that a model needs, by its records and by the rules of codes: MODEL.yaml",
                     "All options: pounding separation MODEL.yaml --help");
}

}  // namespace pounding::program
