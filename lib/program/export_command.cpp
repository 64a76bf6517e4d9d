/// `export`: written by Python.

#include <memory>
#include <string>
#include <vector>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {

void add_export(CLI::App& app) {
  struct Options {
    std::string results, output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write a results file for ParaView");
  command->add_option("results", options->results, "results file of `pounding run`")->required();
  names_a_file(
      command->add_option("-o,--output", options->output, "file: .xdmf (default: RESULTS.xdmf in the current folder)"));
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->output.empty()) arguments = {"-o", options->output};
    run_python({.module = "export", .product = "export", .prints = true}, arguments, {options->results});
  });
}

}  // namespace pounding::program
