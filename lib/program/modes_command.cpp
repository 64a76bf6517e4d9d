#include <cstdio>
#include <memory>
#include <string>

#include <pounding/input.hpp>
#include <pounding/modes.hpp>
#include <pounding/structures.hpp>
#include "commands.hpp"

namespace pounding::program {

void add_modes(CLI::App& app) {
  struct Words {
    std::string model;
    bool json = false;
  };
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("modes", "Periods, damping ratios, participation and shapes of every structure");
  command->add_option("MODEL", words->model, "Input file (YAML)")->required();
  command->add_flag("--json", words->json, "Print one JSON object");
  command->callback([words] {
    const Model model = read_model(Input::read_file(words->model), kinds());
    const std::string text = words->json ? modes_json(model) + "\n" : modes_table(model);
    std::fputs(text.c_str(), stdout);
  });
}

}  // namespace pounding::program
