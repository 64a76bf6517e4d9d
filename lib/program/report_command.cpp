/// `report` of runs and suites, and the reports of `run`: written by Python.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/results/checked_file.hpp>
#include <pounding/results/hdf5.hpp>
#include <pounding/results/replaced_file.hpp>
#include "program/commands.hpp"
#include "program/python_process.hpp"
#include "program/spectrum_output.hpp"
#include "program/temporary_file.hpp"

namespace pounding::program {
namespace {

// Damping ratio and number of periods of the spectra in a report.
constexpr double report_damping = 0.05;
constexpr const char* report_periods = "0.02:4:200";

// Spectra of the ground motion at the output times, one per direction in which the ground moves.
std::vector<NamedSpectrum> ground_spectra(const std::string& results) {
  std::vector<double> times;
  std::vector<std::pair<std::string, std::vector<double>>> motions;
  try {
    hdf5::open_file(results, [&](hid_t file) {
      if (!hdf5::has(file, "ground")) return;  // a pushover, which Python refuses
      hdf5::read_array(file, "time", times);
      for (const char* name : {"acceleration", "acceleration_y", "acceleration_z"}) {
        const std::string place = std::string("ground/") + name;
        if (!hdf5::has(file, place.c_str())) continue;
        hdf5::read_array(file, place.c_str(), motions.emplace_back(name, std::vector<double>{}).second);
      }
    });
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: not a results file, or a damaged one ({})", results, error.what()));
  }
  SpectrumArguments arguments;
  arguments.periods = report_periods;
  const std::vector<double> periods = arguments.read_periods();
  std::vector<NamedSpectrum> spectra;
  for (const auto& [name, values] : motions) {
    if (times.size() < 2 || std::ranges::all_of(values, [](double a) { return a == 0; })) continue;
    const GroundMotion motion(Samples{times, values, evenly_spaced(times)});
    const std::string axis = name.size() > 2 && name[name.size() - 2] == '_' ? name.substr(name.size() - 1) : "x";
    spectra.push_back({axis, response_spectrum(motion, periods, report_damping)});
  }
  return spectra;
}

bool is_pdf(const std::string& name) { return std::filesystem::path(name).extension() == ".pdf"; }
bool is_html(const std::string& name) { return std::filesystem::path(name).extension() == ".html"; }

}  // namespace

CLI::Option* is_report(CLI::Option* option) {
  return option->check(
      [](const std::string& name) {
        return is_pdf(name) || is_html(name) ? ""
                                             : fmt::format(
                                                   "\"{}\" is not the name of a report; type a name that ends "
                                                   "in .pdf or .html, such as report.pdf",
                                                   excerpt(name));
      },
      "");
}

void write_report(const std::string& results, const std::string& report) {
  const TemporaryFile spectra(spectra_json("Ground motion", report_damping, ground_spectra(results)));
  run_python({.module = "_report", .product = "report"}, {"-o", report, "--spectra=" + spectra.name()}, {results});
}

void add_report(CLI::App& app) {
  struct Options {
    std::string results, report;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("report", "Write a report of a run or a suite: .pdf or .html");
  command->add_option("results", options->results, "results file of `pounding run`, or table of `pounding suite`")
      ->required();
  is_report(command->add_option("-o,--output", options->report,
                                "report: .pdf or .html (default: RESULTS.pdf in the current folder)"));
  command->callback([options] {
    std::string report = options->report;
    if (report.empty()) report = std::filesystem::path(options->results).filename().replace_extension(".pdf").string();
    ReplacedFile(report, run_report_files).require_free();
    // Suites need the compiled part of the package.
    if (is_study_table(options->results)) become_python("_report", {"-o", report, "--", options->results});
    write_report(options->results, report);
    fmt::print("report       {}\n", report);
  });
}

}  // namespace pounding::program
