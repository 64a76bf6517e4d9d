#pragma once
/// Options and output shared by `record spectrum` and `spectrum`.

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pounding/ground/spectrum.hpp>

namespace pounding::program {

/// Computation and destination of a spectrum.
struct SpectrumArguments {
  std::string damping = "5 %", csv, picture;
  std::optional<std::string> periods{};  ///< default: 0.02:4:50, with a picture 0.02:4:200

  /// Adds --damping, --periods, --csv and --picture.
  void add_to(CLI::App& command);
  /// Periods [s] and damping ratio [-]; throws InputError.
  std::vector<double> read_periods() const;
  double read_damping() const;
};

/// A spectrum and its name in tables and pictures; several spectra have the same periods.
struct NamedSpectrum {
  std::string name;
  std::vector<SpectrumPoint> points;
};

/// JSON object of spectra for Python: "title", "damping" and "spectra".
std::string spectra_json(const std::string& title, double damping, const std::vector<NamedSpectrum>& spectra);

/// Prints the names of the files written by show_spectra.
void tell_written(const SpectrumArguments& arguments);

/// Writes the requested file and picture; if there are none, prints `title` and a table. Throws InputError.
void show_spectra(const SpectrumArguments& arguments, const std::string& title,
                  const std::vector<NamedSpectrum>& spectra);

}  // namespace pounding::program
