#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/petsc/environment.hpp>
#include "commands.hpp"

namespace pounding::program {

void add_modes(CLI::App& app) {
  struct Arguments {
    std::string model, picture;
    int count = 12;
    bool json = false, plot = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("modes", "Periods, damping ratios, participation and shapes of every structure");
  command->add_option("MODEL", arguments->model, "Input file (YAML)")->required();
  is_positive(command->add_option("--count", arguments->count, "Number of modes of a frame; other structures list all"))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->add_flag("--plot", arguments->plot, "Draw the shapes: MODEL_modes.png in the current folder");
  names_a_file(command->add_option("-o,--output", arguments->picture, "Name of the picture"));
  command->callback([arguments] {
    const petsc::Environment environment;
    const Model model = read_model(Input::read_file(arguments->model), petsc::lowest_modes);
    const std::string text = arguments->json
                                 ? modes_json(model, arguments->count, petsc::lowest_modes) + "\n"
                                 : modes_table(model, arguments->count, petsc::lowest_modes) + describe_joined(model);
    std::fputs(text.c_str(), stdout);
    if (!arguments->plot && arguments->picture.empty()) return;
    const std::string picture = arguments->picture.empty()
                                    ? std::filesystem::path(arguments->model).stem().string() + "_modes.png"
                                    : arguments->picture;
    draw_json("_mode_shapes", modes_json(model, arguments->count, petsc::lowest_modes, true), picture, model.title);
    if (!arguments->json) std::printf("picture      %s\n", picture.c_str());
  });
}

}  // namespace pounding::program
