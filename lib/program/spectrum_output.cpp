#include "program/spectrum_output.hpp"

#include <cmath>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>
#include <pounding/results/replaced_file.hpp>
#include "program/commands.hpp"

namespace pounding::program {
namespace {

constexpr std::string_view first_column = "period (s)";
const FileKind spectrum_files{"table of spectra", "--csv spectrum.csv", [](std::string_view start) {
                                return start.starts_with(std::string(first_column) + ",");
                              }};

void write_spectra(const std::vector<NamedSpectrum>& spectra, const std::string& path) {
  std::string file(first_column);
  for (const NamedSpectrum& s : spectra) {
    const std::string of = spectra.size() > 1 ? s.name + " " : "";
    file += fmt::format(",{0}sd (m),{0}psv (m/s),{0}psa (m/s^2)", of);
  }
  file += '\n';
  for (std::size_t i = 0; i < spectra.front().points.size(); ++i) {
    file += fmt::format("{:.10g}", spectra.front().points[i].period);
    for (const NamedSpectrum& s : spectra)
      file += fmt::format(",{:.10g},{:.10g},{:.10g}", s.points[i].sd, s.points[i].psv, s.points[i].psa);
    file += '\n';
  }
  ReplacedFile(path, spectrum_files).replace(std::as_bytes(std::span(file)));
}

void print_spectra(const std::string& title, const std::vector<NamedSpectrum>& spectra) {
  fmt::print("{}\n", title);
  if (spectra.size() > 1) {
    fmt::print("{:>10}", "");
    for (const NamedSpectrum& s : spectra) fmt::print(" {:^38}", s.name);
    fmt::print("\n");
  }
  fmt::print("{:>10}", "T [s]");
  for (std::size_t i = 0; i < spectra.size(); ++i)
    fmt::print(" {:>12} {:>12} {:>12}", "SD [m]", "PSV [m/s]", "PSA [g]");
  fmt::print("\n");
  for (std::size_t i = 0; i < spectra.front().points.size(); ++i) {
    fmt::print("{:>10.4f}", spectra.front().points[i].period);
    for (const NamedSpectrum& s : spectra)
      fmt::print(" {:>12.4e} {:>12.4e} {:>12.4e}", s.points[i].sd, s.points[i].psv, s.points[i].psa / standard_gravity);
    fmt::print("\n");
  }
}

}  // namespace

std::string spectra_json(const std::string& title, double damping, const std::vector<NamedSpectrum>& spectra) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const NamedSpectrum& s : spectra) {
    nlohmann::ordered_json one{{"name", s.name}};
    constexpr std::pair<const char*, double SpectrumPoint::*> columns[] = {{"period", &SpectrumPoint::period},
                                                                           {"sd", &SpectrumPoint::sd},
                                                                           {"psv", &SpectrumPoint::psv},
                                                                           {"psa", &SpectrumPoint::psa}};
    for (const auto& [name, value] : columns) {
      nlohmann::ordered_json values = nlohmann::ordered_json::array();
      for (const SpectrumPoint& p : s.points) values.push_back(p.*value);
      one[name] = std::move(values);
    }
    all.push_back(std::move(one));
  }
  const nlohmann::ordered_json whole{{"title", title}, {"damping", damping}, {"spectra", all}};
  return whole.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void SpectrumArguments::add_to(CLI::App& command) {
  command.add_option("--damping", damping, "Damping ratio")->capture_default_str();
  command.add_option("--periods", periods,
                     "first:last:count [s], in geometric progression (default: 0.02:4:50, with --picture 0.02:4:200)");
  names_a_file(command.add_option("--csv", csv, "Write to this file, in SI, instead of printing"));
  names_a_file(command.add_option("--picture", picture, "Draw to this file, .png, .pdf or .svg, instead of printing"));
}

std::vector<double> SpectrumArguments::read_periods() const {
  const std::string text = periods ? *periods : picture.empty() ? "0.02:4:50" : "0.02:4:200";
  const auto fail = [&]() -> InputError {
    return InputError(
        fmt::format("--periods: type first:last:count with 0 < first < last and count from 2 to 10000, such as "
                    "0.02:4:50, not \"{}\"",
                    excerpt(text)));
  };
  const std::size_t one = text.find(':'), two = text.find(':', one == std::string::npos ? one : one + 1);
  if (two == std::string::npos) throw fail();
  double first = 0, last = 0, count = 0;
  if (!parse_number(text.substr(0, one), first) || !parse_number(text.substr(one + 1, two - one - 1), last) ||
      !parse_number(text.substr(two + 1), count))
    throw fail();
  if (!(first > 0 && last > first && count >= 2 && count <= 10000 && count == std::floor(count))) throw fail();
  std::vector<double> all;
  for (double i = 0; i < count; ++i) all.push_back(first * std::pow(last / first, i / (count - 1)));
  all.back() = last;
  return all;
}

double SpectrumArguments::read_damping() const {
  double ratio = 0;
  try {
    ratio = parse_quantity(damping, dimension::none);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--damping: {}", error.what()));
  }
  if (!(ratio >= 0 && ratio < 1))
    throw InputError(
        fmt::format("--damping: must be a number in [0, 1) such as \"5 %\", not \"{}\"", excerpt(damping)));
  return ratio;
}

void tell_written(const SpectrumArguments& arguments) {
  if (!arguments.csv.empty()) fmt::print("spectrum     {}\n", arguments.csv);
  if (!arguments.picture.empty()) fmt::print("picture      {}\n", arguments.picture);
}

void show_spectra(const SpectrumArguments& arguments, const std::string& title,
                  const std::vector<NamedSpectrum>& spectra) {
  if (!arguments.csv.empty()) write_spectra(spectra, arguments.csv);
  if (!arguments.picture.empty())
    draw_json("_spectra", spectra_json(title, arguments.read_damping(), spectra), arguments.picture);
  if (arguments.csv.empty() && arguments.picture.empty()) print_spectra(title, spectra);
}

}  // namespace pounding::program
