/// Response spectra of records and of motions that a run has computed.

#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <pounding/ground/record.hpp>
#include <pounding/ground/spectrum.hpp>
#include "bindings.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

std::vector<double> displacements(const GroundMotion& motion, const std::vector<double>& periods, double damping) {
  const py::gil_scoped_release free;
  std::vector<double> peaks;
  for (const SpectrumPoint& point : response_spectrum(motion, periods, damping)) peaks.push_back(point.sd);
  return peaks;
}

}  // namespace

void bind_spectra(py::module_& module) {
  module.attr("enough_of_the_peak") = enough_of_the_peak;
  module.def(
      "spectrum",
      [](std::vector<double> times, std::vector<double> accelerations, const std::vector<double>& periods, double damping) {
        const bool uniform = evenly_spaced(times);
        return displacements(GroundMotion(Samples{std::move(times), std::move(accelerations), uniform}), periods, damping);
      },
      "times"_a, "accelerations"_a, "periods"_a, "damping"_a);
  module.def(
      "record_spectrum",
      [](const std::string& file, const std::string& units, const std::string& channel, const std::vector<double>& periods,
         double damping) {
        const Record record = read_record(find_record(file, {}), {.units = units, .channel = channel});
        return py::make_tuple(record.summary(), displacements(scaled(record, 1), periods, damping), record.warnings);
      },
      "file"_a, "units"_a, "channel"_a, "periods"_a, "damping"_a);
  module.def(
      "record_measures",
      [](const std::string& file, const std::string& units, const std::string& channel) {
        const Record record = read_record(find_record(file, {}), {.units = units, .channel = channel});
        return py::make_tuple(record.points(), record.step(), record.samples.times.back(), record.measures.pga, record.warnings);
      },
      "file"_a, "units"_a, "channel"_a);
}

}  // namespace pounding::python
