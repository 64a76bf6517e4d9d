#pragma once
/// Options and output that `record spectrum` and `spectrum` have in common.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pounding/ground/spectrum.hpp>

namespace pounding::program {

/// How a spectrum is computed and where it goes.
struct SpectrumArguments {
  std::string damping = "5 %", periods = "0.02:4:50", csv, picture;

  /// Adds --damping, --periods, --csv and --picture.
  void add_to(CLI::App& command);
  /// Periods [s] and damping ratio [-]; throws InputError.
  std::vector<double> read_periods() const;
  double read_damping() const;
};

/// One spectrum and what a table or a picture calls it; several have the same periods.
struct NamedSpectrum {
  std::string name;
  std::vector<SpectrumPoint> points;
};

/// Prints the names of the files that show_spectra has written.
void tell_written(const SpectrumArguments& arguments);

/// Writes the file and the picture that were asked for; where there are none, prints `title` and a table. Throws
/// InputError.
void show_spectra(const SpectrumArguments& arguments, const std::string& title,
                  const std::vector<NamedSpectrum>& spectra);

}  // namespace pounding::program
