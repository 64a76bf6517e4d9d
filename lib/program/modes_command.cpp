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
  const auto words = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("modes", "Periods, damping ratios, participation and shapes of every structure");
  command->add_option("MODEL", words->model, "Input file (YAML)")->required();
  is_positive(command->add_option("--count", words->count, "Modes of a frame; of other structures all are told"))
      ->capture_default_str();
  command->add_flag("--json", words->json, "Print one JSON object");
  command->add_flag("--plot", words->plot, "Draw the shapes: MODEL_modes.png in the current folder");
  names_a_file(command->add_option("-o,--output", words->picture, "Name of the picture"));
  command->callback([words] {
    const petsc::Environment environment;
    const Model model = read_model(Input::read_file(words->model), petsc::lowest_modes);
    const std::string text = words->json
                                 ? modes_json(model, words->count, petsc::lowest_modes) + "\n"
                                 : modes_table(model, words->count, petsc::lowest_modes) + describe_joined(model);
    std::fputs(text.c_str(), stdout);
    if (!words->plot && words->picture.empty()) return;
    const std::string picture =
        words->picture.empty() ? std::filesystem::path(words->model).stem().string() + "_modes.png" : words->picture;
    draw_modes(modes_json(model, words->count, petsc::lowest_modes, true), picture, model.title);
    if (!words->json) std::printf("picture      %s\n", picture.c_str());
  });
}

}  // namespace pounding::program
