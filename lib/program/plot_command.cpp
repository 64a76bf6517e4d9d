/// `plot`, and the pictures of other commands: drawn by Python.

#include <memory>
#include <string>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"
#include "program/temporary_file.hpp"

namespace pounding::program {

void draw(const std::string& results, const std::string& picture, const std::string& kind) {
  run_python({.module = "_plots", .product = "picture"}, {"-o", picture, "--picture=" + kind}, {results});
}

void draw_json(const char* module, const std::string& json, const std::string& picture, const std::string& title) {
  const TemporaryFile file(json);
  std::vector<std::string> options{"-o", picture};
  if (!title.empty()) options.push_back("--title=" + title);
  run_python({.module = module, .product = "picture"}, options, {file.name()});
}

void add_plot(CLI::App& app) {
  struct Options {
    std::string results, picture, title, kind = "run", floors;
    bool compare = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plot", "Draw a results file");
  command->add_option("results", options->results, "results file of `pounding run` or `pounding pushover`")->required();
  names_a_file(command->add_option("-o,--output", options->picture,
                                   "picture: .png, .pdf or .svg (default: RESULTS.png in the current folder; for other "
                                   "pictures RESULTS-model.png ...)"));
  command->add_option("--title", options->title, "title (default: that of the run)");
  command
      ->add_option(
          "--picture", options->kind,
          "run (histories and impacts), model (structures at rest), profiles (extremes over the height), plan "
          "(a map of drifts and impacts of frames in space), loops (force over deformation of the six parts "
          "with the largest dissipation, or of contacts if there are none), hinges (a map of yielded parts "
          "and impacts), worst (members and yielding parts with the largest increases by contact), or one panel")
      ->check(CLI::IsMember({"run", "model", "profiles", "plan", "loops", "hinges", "worst", "displacement", "rotation",
                             "gap", "force", "energy", "contact_loops"}));
  command->add_option("--floors", options->floors, "floors whose displacements `--picture run` shows, such as A.3,B.2");
  command->add_flag("--compare", options->compare,
                    "also draw the run without links, dashed; profiles and plan always do if the file contains it");
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->picture.empty()) arguments = {"-o", options->picture};
    if (!options->title.empty()) arguments.push_back("--title=" + options->title);
    if (options->kind != "run") arguments.push_back("--picture=" + options->kind);
    if (options->compare) arguments.push_back("--compare");
    if (!options->floors.empty()) arguments.push_back("--floors=" + options->floors);
    run_python({.module = "_plots", .product = "picture", .prints = true}, arguments, {options->results});
  });
}

}  // namespace pounding::program
