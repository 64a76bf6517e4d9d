#pragma once
/// The subcommands of the program. Each function adds one to the command line. Callbacks may throw InputError,
/// SolverError or std::invalid_argument, which main() converts to a message and an exit code.

#include <string>

#include <CLI/CLI.hpp>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>

namespace pounding::program {

void add_run(CLI::App& app);          ///< `run` and `check`
void add_laws(CLI::App& app);         ///< `laws [NAME]`
void add_calibrate(CLI::App& app);    ///< `calibrate --law ... --restitution ...`
void add_record(CLI::App& app);       ///< `record info|spectrum`
void add_spectrum(CLI::App& app);     ///< `spectrum RESULTS.h5`
void add_modes(CLI::App& app);        ///< `modes MODEL.yaml`
void add_pushover(CLI::App& app);     ///< `pushover MODEL.yaml`
void add_section(CLI::App& app);      ///< `section MODEL.yaml [NAME]`
void add_sensitivity(CLI::App& app);  ///< `sensitivity MODEL.yaml`
void add_study(CLI::App& app);        ///< `study`, `suite`, `separation` and `screen`
void add_plot(CLI::App& app);         ///< `plot RESULTS.h5`
void add_report(CLI::App& app);       ///< `report RESULTS.h5`
void add_animate(CLI::App& app);      ///< `animate RESULTS.h5`
void add_view(CLI::App& app);         ///< `view RESULTS.h5` and `view MODEL.yaml`
void add_export(CLI::App& app);       ///< `export RESULTS.h5`
void add_reproduce(CLI::App& app);    ///< `reproduce`
void add_arguments(CLI::App& app);    ///< `words [NAME]`

/// Refuses an empty file name, as in -o "" from an unset variable of a script.
inline CLI::Option* names_a_file(CLI::Option* option) {
  return option->check([](const std::string& name) { return name.empty() ? "the name of the file is empty" : ""; }, "");
}

/// Refuses option values that are not positive numbers.
inline CLI::Option* is_positive(CLI::Option* option) {
  return option->check(
      [](const std::string& text) {
        double value = 0;
        return parse_number(text, value) && value > 0 ? "" : "must be a positive number, not \"" + excerpt(text) + "\"";
      },
      "");
}

/// Draws a picture of a results file, such as "profiles"; throws InputError when Python or its packages are missing.
void draw(const std::string& results, const std::string& picture, const std::string& kind = "run");

/// Refuses names of reports that end in neither .pdf nor .html.
CLI::Option* is_report(CLI::Option* option);

/// Writes the report of a results file, .pdf or .html. Throws as `draw`.
void write_report(const std::string& results, const std::string& report);

/// Draws a JSON object by python/pounding/MODULE.py: "_mode_shapes", "_pushover_curve", "_section_curves" or
/// "_spectra". Throws as `draw`.
void draw_json(const char* module, const std::string& json, const std::string& picture, const std::string& title = {});

}  // namespace pounding::program
