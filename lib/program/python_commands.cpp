/// `animate`, `view`, `export`, `study`, `suite`, `separation` and `screen`: done by Python.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {
namespace {

// All arguments after the command belong to Python, including --help.
void add_python_command(CLI::App& app, const std::string& name, const std::string& meaning) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->set_help_flag();
  command->prefix_command();
  command->callback([command, name] {
    std::vector<std::string> arguments{name};
    for (const std::string& argument : command->remaining()) arguments.push_back(argument);
    become_python("_studies.command", arguments);
  });
}

}  // namespace

void add_study(CLI::App& app) {
  add_python_command(app, "study", "Run a model many times: STUDY.yaml; check, show, merge, plot and export its table");
  add_python_command(app, "suite", "Run a model under each of its records: MODEL.yaml with records");
  add_python_command(app, "separation", "Required gap of a model by its records and by the rules of codes: MODEL.yaml");
  add_python_command(app, "screen",
                     "Screen the gaps of a model by rules for existing buildings, without a run: MODEL.yaml");
}

void add_animate(CLI::App& app) {
  struct Options {
    std::string results, film, scale, frames, from, to, title;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("animate", "Animate a results file");
  command->add_option("results", options->results, "results file of `pounding run`")->required();
  names_a_file(command->add_option(
      "-o,--output", options->film,
      "file: .gif, .mp4 (needs ffmpeg), or .png for one file per frame (default: RESULTS.gif in the current folder)"));
  // Numbers are passed on as typed; a conversion could change them.
  command->add_option("--scale", options->scale, "magnification of displacements and gaps")->check(CLI::Number);
  command->add_option("--frames", options->frames, "number of frames (default: 15 per second, 30 to 240)")
      ->check(CLI::TypeValidator<int>("INT"));
  command->add_option("--from", options->from, "time of the first frame [s]")->check(CLI::Number);
  command->add_option("--to", options->to, "time of the last frame [s]")->check(CLI::Number);
  command->add_option("--title", options->title, "title (default: that of the run)");
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->film.empty()) arguments = {"-o", options->film};
    for (const auto& [name, value] : {std::pair{"--scale=", &options->scale},
                                      {"--frames=", &options->frames},
                                      {"--from=", &options->from},
                                      {"--to=", &options->to},
                                      {"--title=", &options->title}})
      if (!value->empty()) arguments.push_back(name + *value);
    run_python({.module = "animation", .product = "animation", .shows_progress = true, .prints = true}, arguments,
               {options->results});
  });
}

void add_view(CLI::App& app) {
  struct Options {
    std::string file, page, modes, frames, scale, title;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("view", "Interactive view of a run or a model: one HTML file");
  command->footer("Needs plotly: python3 -m pip install plotly. The file contains everything and works offline.");
  command->add_option("FILE", options->file, "results file (.h5) of `pounding run`, or input file (YAML)")->required();
  names_a_file(
      command->add_option("-o,--output", options->page, "file: .html (default: FILE.html in the current folder)"));
  command->add_option("--modes", options->modes, "number of mode shapes per structure (default: none)")
      ->check(CLI::TypeValidator<int>("INT"));
  command->add_option("--frames", options->frames, "number of instants of the film (default: as many as suit 20 MB)")
      ->check(CLI::TypeValidator<int>("INT"));
  command->add_option("--scale", options->scale, "magnification of displacements and gaps")->check(CLI::Number);
  command->add_option("--title", options->title, "title (default: that of the run)");
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->page.empty()) arguments = {"-o", options->page};
    for (const auto& [name, value] : {std::pair{"--modes=", &options->modes},
                                      {"--frames=", &options->frames},
                                      {"--scale=", &options->scale},
                                      {"--title=", &options->title}})
      if (!value->empty()) arguments.push_back(name + *value);
    arguments.insert(arguments.end(), {"--", options->file});
    // Models need the compiled part of the package.
    become_python("_view_command", arguments);
  });
}

void add_export(CLI::App& app) {
  struct Options {
    std::string results, output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write a results file for ParaView");
  command->add_option("results", options->results, "results file that `pounding run` wrote")->required();
  names_a_file(
      command->add_option("-o,--output", options->output, "file: .xdmf (default: RESULTS.xdmf in the current folder)"));
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->output.empty()) arguments = {"-o", options->output};
    run_python({.module = "_export", .product = "export", .prints = true}, arguments, {options->results});
  });
}

}  // namespace pounding::program
