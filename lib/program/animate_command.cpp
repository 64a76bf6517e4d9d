/// `animate`: drawn by Python.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {

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

}  // namespace pounding::program
