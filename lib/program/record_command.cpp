/// `pounding record info FILE` and `pounding record spectrum FILE`.

#include "program/commands.hpp"
#include "program/spectrum_output.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/ground/spectrum.hpp>

namespace pounding::program {
namespace {

struct RecordArguments {
  std::string file, units, channel, step;
  bool displacement = false;
  SpectrumArguments spectrum;
  bool json = false;
};

double read_step(const std::string& text) {
  if (text.empty()) return 0;
  double step = 0;
  try {
    step = parse_quantity(text, dimension::time);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--step: {}", error.what()));
  }
  if (!(step > 0))
    throw InputError(fmt::format("--step: must be a time > 0 such as \"0.01 s\", not \"{}\"", excerpt(text)));
  return step;
}

/// Reads the record and prints its warnings.
Record read(const RecordArguments& arguments) {
  Record record = read_record(find_record(arguments.file, {}), {.units = arguments.units,
                                                                .channel = arguments.channel,
                                                                .step = read_step(arguments.step),
                                                                .displacement = arguments.displacement});
  for (const std::string& text : record.warnings)
    std::fprintf(stderr, "pounding: warning: %s: %s\n", excerpt(record.file).c_str(), text.c_str());
  return record;
}

nlohmann::json as_json(const Record& record) {
  const RecordMeasures& m = record.measures;
  return {{"file", record.file},
          {"format", record.format},
          {"title", record.title},
          {"station", record.station},
          {"channel", record.channel},
          {"remark", record.remark},
          {"unit", record.unit},
          {"npts", record.points()},
          {"dt", record.samples.uniform ? nlohmann::json(record.step()) : nlohmann::json(nullptr)},
          {"duration", record.samples.times.back()},
          {"pga", m.pga},
          {"pgv", m.pgv},
          {"pgd", m.pgd},
          {"arias", m.arias},
          {"t5", m.t5},
          {"t95", m.t95},
          {"significant_duration", m.significant_duration()},
          {"warnings", record.warnings}};
}

void print_info(const Record& record, bool is_displacement) {
  const RecordMeasures& m = record.measures;
  const auto stated = [](const std::string& text) { return text.empty() ? "not stated" : text; };
  const auto line = [](const char* name, const std::string& value) { fmt::print("{:<22} {}\n", name, value); };
  line("file", excerpt(record.file));
  if (!record.title.empty()) line("title", record.title);
  line("station", stated(record.station));
  line("channel", stated(record.channel));
  line("format", fmt::format("{}, in {}", record.format, record.unit));
  if (!record.remark.empty()) line("remark", record.remark);
  line("points", fmt::format("{}, {}", record.points(),
                             record.samples.uniform ? fmt::format("every {:g} s", record.step()) : "unevenly spaced"));
  line("duration", fmt::format("{:g} s", record.samples.times.back()));
  line("PGA", fmt::format("{:.4g} m/s^2 ({:.4g} g)", m.pga, m.pga / standard_gravity));
  line("PGV", fmt::format("{:.4g} m/s", m.pgv));
  line("PGD", fmt::format("{:.4g} m{}", m.pgd, is_displacement ? "" : " (baseline not corrected)"));
  line("Arias intensity", fmt::format("{:.4g} m/s", m.arias));
  line("significant duration",
       fmt::format("{:.4g} s (5 % at {:.4g} s, 95 % at {:.4g} s)", m.significant_duration(), m.t5, m.t95));
}

void show_record_spectrum(const RecordArguments& arguments) {
  const double damping = arguments.spectrum.read_damping();
  const std::vector<double> periods = arguments.spectrum.read_periods();
  const Record record = read(arguments);
  show_spectra(arguments.spectrum, fmt::format("{}, damping {:g} %", record.summary(), 100 * damping),
               {{"", response_spectrum(scaled(record, 1), periods, damping)}});
}

}  // namespace

void add_record(CLI::App& app) {
  const auto arguments = std::make_shared<RecordArguments>();
  CLI::App* const record = app.add_subcommand("record", "Information on an accelerogram, and its spectrum");
  record->require_subcommand(1);

  const auto add = [&](const char* name, const char* what) {
    CLI::App* const command = record->add_subcommand(name, what);
    command
        ->add_option(
            "file", arguments->file,
            "PEER AT2, K-NET, ESM, COSMOS, CSMIP, USC, GeoNet, BHRC, AFAD, UNAM, USGS SMC, or columns of numbers")
        ->required();
    command->add_option("--units", arguments->units,
                        "Unit if the file states none: g, m/s^2, cm/s^2, gal; for displacements m, cm, mm, in");
    command->add_option("--channel", arguments->channel,
                        "Number or component, as in the file, if it has several channels");
    command->add_option("--step", arguments->step, "Time step of a file without times, such as 0.01 s");
    command->add_flag("--displacement", arguments->displacement, "The file contains displacements");
    return command;
  };
  CLI::App* const info = add("info", "Points, spacing, peaks, Arias intensity, significant duration");
  info->add_flag("--json", arguments->json, "One JSON object, in SI");
  info->callback([arguments] {
    const Record read_now = read(*arguments);
    // File names are not always UTF-8, which JSON requires.
    constexpr auto on_bad_text = nlohmann::json::error_handler_t::replace;
    if (arguments->json)
      fmt::print("{}\n", as_json(read_now).dump(2, ' ', false, on_bad_text));
    else
      print_info(read_now, arguments->displacement);
  });

  CLI::App* const spectrum = add("spectrum", "Elastic response spectrum");
  arguments->spectrum.add_to(*spectrum);
  spectrum->callback([arguments] {
    show_record_spectrum(*arguments);
    tell_written(arguments->spectrum);
  });
}

}  // namespace pounding::program
