/// `pounding pushover MODEL.yaml --structure NAME --to "2 % roof"`.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/pushover_input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/results/pushover_file.hpp>
#include <pounding/results/replaced_file.hpp>
#include "program/commands.hpp"

namespace pounding::program {
namespace {

struct PushoverArguments {
  std::string model, output, picture;
  PushoverInput arguments;
  bool json = false, plot = false;
};

void push_over(const PushoverArguments& given) {
  const petsc::Environment environment;
  const Model model = read_model(Input::read_file(given.model), petsc::lowest_modes);
  if (!given.picture.empty()) ReplacedFile(given.picture, picture_files).require_free();
  const Pushover found = pushover(model, given.arguments, petsc::lowest_modes);
  std::fputs(given.json ? (pushover_json(found) + "\n").c_str() : pushover_table(found).c_str(), stdout);
  if (!given.output.empty()) {
    write_pushover(given.output, found, model.source_text);
    if (!given.json) std::printf("results       %s\n", given.output.c_str());
  }
  if (given.plot || !given.picture.empty()) {
    // Each structure of a model has a separate picture.
    const std::string of = model.structures.size() > 1 ? '_' + found.structure : "";
    // A picture of named results has their name and folder.
    std::string picture = given.picture;
    if (picture.empty() && !given.output.empty())
      picture = std::filesystem::path(given.output).replace_extension(".png").string();
    if (picture.empty()) picture = std::filesystem::path(given.model).stem().string() + of + "_pushover.png";
    draw_json("_pushover_curve", pushover_json(found), picture, model.title);
    if (!given.json) std::printf("picture       %s\n", picture.c_str());
  }
  if (!found.path.collapse.empty())
    throw SolverError(fmt::format("{}: {} collapses {}; the results end there. Type a smaller --to", model.source_file,
                                  found.structure, found.path.collapse));
}

}  // namespace

void add_pushover(CLI::App& app) {
  const auto given = std::make_shared<PushoverArguments>();
  CLI::App* const command =
      app.add_subcommand("pushover", "Push a yielding structure: curve, order of hinges, mechanism");
  command->add_option("MODEL", given->model, "Input file (YAML)")->required();
  command->add_option("--structure", given->arguments.structure,
                      "Name of the structure; optional if only one structure of the model yields");
  command
      ->add_option("--load", given->arguments.load,
                   "triangular, uniform or mode1, or a file with one force per floor, from the ground up")
      ->capture_default_str();
  command->add_option("--direction", given->arguments.direction, "x, or y in space")->capture_default_str();
  command->add_option("--to", given->arguments.to,
                      "Displacement of the roof: \"250 mm\", or \"2 % roof\" of its height");
  command->add_option("--cyclic", given->arguments.cyclic,
                      "Displacements to reach first, in this order: \"1 %, -1 %, 2 %\"");
  command->add_flag("--json", given->json, "Print one JSON object");
  command->add_flag(
      "--plot", given->plot,
      "Draw the curve: next to the results of -o and with their name, otherwise MODEL_pushover.png in the current "
      "folder, with several structures MODEL_NAME_pushover.png");
  names_a_file(command->add_option("--picture", given->picture, "Name of the picture: .png, .pdf or .svg"));
  names_a_file(command->add_option("-o,--output", given->output, "Results file: .h5"));
  command->callback([given] { push_over(*given); });
}

}  // namespace pounding::program
