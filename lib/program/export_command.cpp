/// `export`: written by Python.

#include <filesystem>
#include <memory>
#include <string>

#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {

void add_export(CLI::App& app) {
  struct Options {
    std::string results, output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write a results file for ParaView");
  command->add_option("results", options->results, "results file that `pounding run` wrote")->required();
  command->add_option("-o,--output", options->output, "file: .xdmf (default: RESULTS with .xdmf)");
  command->callback([options] {
    const std::string output = options->output.empty()
                                   ? std::filesystem::path(options->results).replace_extension(".xdmf").string()
                                   : options->output;
    run_python({.module = "export", .product = "export"}, {"-o", output}, {options->results});
  });
}

}  // namespace pounding::program
