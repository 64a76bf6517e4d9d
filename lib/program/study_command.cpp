/// `study` and `separation`: done by Python, which has the plan, the processes and the statistics.

#include <string>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {
namespace {

// Words behind the command are Python's, its --help among them.
void add_python_command(CLI::App& app, const std::string& name, const std::string& meaning) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->set_help_flag();
  command->prefix_command();
  command->callback([command, name] {
    std::vector<std::string> words{name};
    for (const std::string& word : command->remaining()) words.push_back(word);
    become_python("studies.command", words);
  });
}

}  // namespace

void add_study(CLI::App& app) {
  add_python_command(app, "study", "Run a model many times: STUDY.yaml; check, show, merge, plot and export its table");
  add_python_command(app, "separation", "The gap that a model needs, by its records and by the rules of codes: MODEL.yaml");
}

}  // namespace pounding::program
