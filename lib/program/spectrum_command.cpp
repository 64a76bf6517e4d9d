/// `pounding spectrum RESULTS.h5 --floor left.3`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>
#include <pounding/ground/spectrum.hpp>
#include <pounding/results/hdf5.hpp>
#include "program/commands.hpp"
#include "program/spectrum_output.hpp"

namespace pounding::program {
namespace {

// Minimum number of output steps per period for linear interpolation between outputs.
constexpr double steps_in_a_period = 10;

struct FloorArguments {
  std::string results, floor, direction = "x";
  SpectrumArguments spectrum;
};

// Absolute acceleration of a floor at the output times.
struct FloorMotion {
  std::vector<double> times, accelerations;  // [s], [m/s^2]
  double tracked = 0;  // largest absolute value over all steps [m/s^2]; 0 if the file does not contain it
};

// "left.3" is the third floor from the ground of the structure "left", whose name may contain dots.
FloorMotion read_floor(hid_t file, const FloorArguments& arguments, const std::string& root) {
  const std::size_t point = arguments.floor.rfind('.');
  const std::string name = arguments.floor.substr(0, point),
                    number = point == std::string::npos ? "" : arguments.floor.substr(point + 1);
  double floor = 0;
  if (name.empty() || !parse_number(number, floor))
    throw InputError(
        fmt::format("--floor: type a structure and a floor counted from 1 at the lowest, such as left.3, not \"{}\"",
                    arguments.floor));
  const std::vector<std::string> structures = hdf5::members(file, (root + "structures").c_str());
  if (std::find(structures.begin(), structures.end(), name) == structures.end())
    throw InputError(
        fmt::format("--floor: no structure \"{}\"; the structures are {}", name, fmt::join(structures, ", ")));
  const std::string place = root + "structures/" + name + "/acceleration";
  const std::vector<std::size_t> shape = hdf5::shape(file, place.c_str());
  const std::size_t floors = shape.at(1), directions = shape.at(2);
  if (!(floor >= 1 && floor <= static_cast<double>(floors) && floor == std::floor(floor)))
    throw InputError(fmt::format("--floor: {} has floors 1 to {}, not \"{}\"", name, floors, arguments.floor));
  if (arguments.direction != "x" && (arguments.direction != "y" || directions < 2))
    throw InputError(fmt::format("--direction: {} moves along {}, not \"{}\"", name,
                                 directions > 1 ? "x and y" : "x only", arguments.direction));
  const std::size_t column = (static_cast<std::size_t>(floor) - 1) * directions + (arguments.direction == "y" ? 1 : 0);
  FloorMotion motion;
  std::vector<double> all, extremes;
  hdf5::read_array(file, (root + "time").c_str(), motion.times);
  hdf5::read_array(file, place.c_str(), all);
  for (std::size_t i = 0; i < motion.times.size(); ++i)
    motion.accelerations.push_back(all[i * floors * directions + column]);
  const std::string envelope = root + "envelopes/structures/" + name + "/acceleration";
  if (hdf5::has(file, (root + "envelopes").c_str())) {
    hdf5::read_array(file, envelope.c_str(), extremes);
    motion.tracked = std::max(-extremes[2 * column], extremes[2 * column + 1]);
  }
  return motion;
}

// Message that the outputs are too far apart, with the step to try.
std::string coarse_outputs(const FloorArguments& arguments, const FloorMotion& motion, const std::string& reason,
                           double shortest) {
  const double step = motion.times[1] - motion.times[0];
  return fmt::format(
      "the outputs every {:g} s are too far apart for this spectrum of {}: {}; run the model again with analysis: "
      "{{output_step: {:g}}}",
      step, arguments.floor, reason, std::min(step / 10, shortest / steps_in_a_period));
}

// Reason why the spectrum of these outputs is wrong: they miss the peak tracked by the run. Empty if they do not.
std::string missed_peak(const FloorArguments& arguments, const FloorMotion& motion, double shortest) {
  double seen = 0;
  for (const double a : motion.accelerations) seen = std::max(seen, std::abs(a));
  if (!(seen < enough_of_the_peak * motion.tracked)) return {};
  return coarse_outputs(arguments, motion,
                        fmt::format("they reach {:.4g} m/s^2 of the peak of {:.4g} m/s^2", seen, motion.tracked),
                        shortest);
}

// Shortest period that the outputs resolve [s].
double shortest_resolved(const FloorMotion& motion) {
  return steps_in_a_period * (motion.times[1] - motion.times[0]) * (1 - 1e-9);
}

// Removes periods that the outputs do not resolve from a picture. Returns a text for the warning; empty if none was
// removed.
std::string leave_out(std::vector<NamedSpectrum>& spectra, double shortest) {
  std::size_t count = 0;
  for (NamedSpectrum& spectrum : spectra)
    count = std::erase_if(spectrum.points, [&](const SpectrumPoint& point) { return point.period < shortest; });
  return count == 0 ? "" : fmt::format("; periods below {:.4g} s are not drawn", shortest);
}

std::vector<SpectrumPoint> spectrum_of(const FloorArguments& arguments, const FloorMotion& motion) {
  if (motion.times.size() < 2) throw InputError(fmt::format("{}: contains no time histories yet", arguments.results));
  const bool uniform = evenly_spaced(motion.times);
  return response_spectrum(GroundMotion(Samples{motion.times, motion.accelerations, uniform}),
                           arguments.spectrum.read_periods(), arguments.spectrum.read_damping());
}

// Shows the spectrum, or returns why it is wrong and not drawn. A table is printed with a warning instead.
std::string show_floor_spectrum(const FloorArguments& arguments) {
  const std::vector<double> periods = arguments.spectrum.read_periods();
  const double damping = arguments.spectrum.read_damping();
  FloorMotion with_links;
  std::optional<FloorMotion> without;
  try {
    hdf5::open_file(arguments.results, [&](hid_t file) {
      with_links = read_floor(file, arguments, "");
      if (hdf5::has(file, "no_pounding")) without = read_floor(file, arguments, "no_pounding/");
    });
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: not a results file, or a damaged one ({})", arguments.results, error.what()));
  }
  std::vector<NamedSpectrum> spectra{{without ? "with links" : arguments.floor, spectrum_of(arguments, with_links)}};
  if (without) spectra.push_back({"without links", spectrum_of(arguments, *without)});
  std::string wrong = missed_peak(arguments, with_links, periods.front());
  if (wrong.empty() && without) wrong = missed_peak(arguments, *without, periods.front());
  const bool draws = !arguments.spectrum.picture.empty();
  if (!wrong.empty() && draws) return wrong;
  const double shortest = shortest_resolved(with_links);
  if (wrong.empty() && periods.front() < shortest) {
    wrong = coarse_outputs(arguments, with_links,
                           fmt::format("a period of {:g} s needs {:g} of them", periods.front(), steps_in_a_period),
                           periods.front());
    if (draws && !(periods[periods.size() - 2] >= shortest)) return wrong;
    if (draws) wrong += leave_out(spectra, shortest);
  }
  if (!wrong.empty()) std::fprintf(stderr, "pounding: warning: %s\n", wrong.c_str());
  show_spectra(arguments.spectrum,
               fmt::format("Absolute acceleration of {}{}, outputs every {:g} s, damping {:g} %", arguments.floor,
                           arguments.direction == "y" ? " along y" : "", with_links.times[1] - with_links.times[0],
                           100 * damping),
               spectra);
  return {};
}

}  // namespace

void add_spectrum(CLI::App& app) {
  const auto arguments = std::make_shared<FloorArguments>();
  CLI::App* const command = app.add_subcommand("spectrum", "Response spectrum of the motion of a floor");
  command->add_option("results", arguments->results, "results file of `pounding run`")->required();
  command->add_option("--floor", arguments->floor, "Structure and floor, from 1 at the lowest: left.3")->required();
  command->add_option("--direction", arguments->direction, "x, or y in space")->capture_default_str();
  arguments->spectrum.add_to(*command);
  command->callback([arguments] {
    if (const std::string wrong = show_floor_spectrum(*arguments); !wrong.empty()) throw InputError(wrong);
    tell_written(arguments->spectrum);
  });
}

}  // namespace pounding::program
