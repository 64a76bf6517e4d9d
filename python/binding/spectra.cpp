/// Response spectra of records and of motions that a run has computed.

#include <optional>
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

/// A record in a file, or in `content` if the file was read before.
Record record_in(const std::string& file, const RecordOptions& options, const std::optional<std::string>& content) {
  return content ? read_record_text(*content, file, options) : read_record(find_record(file, {}), options);
}

}  // namespace

void bind_spectra(py::module_& module) {
  module.attr("enough_of_the_peak") = enough_of_the_peak;
  module.def(
      "spectrum",
      [](std::vector<double> times, std::vector<double> accelerations, const std::vector<double>& periods,
         double damping) {
        const bool uniform = evenly_spaced(times);
        return displacements(GroundMotion(Samples{std::move(times), std::move(accelerations), uniform}), periods,
                             damping);
      },
      "times"_a, "accelerations"_a, "periods"_a, "damping"_a);
  module.def(
      "record_spectrum",
      [](const std::string& file, const std::string& units, const std::string& channel,
         const std::vector<double>& periods, double damping, double step, const std::optional<std::string>& content) {
        const Record record = record_in(file, {.units = units, .channel = channel, .step = step}, content);
        return py::make_tuple(record.summary(), displacements(scaled(record, 1), periods, damping), record.warnings);
      },
      "file"_a, "units"_a, "channel"_a, "periods"_a, "damping"_a, "step"_a = 0.0, "content"_a = py::none());
  module.def(
      "record_measures",
      [](const std::string& file, const std::string& units, const std::string& channel, double step,
         const std::optional<std::string>& content) {
        const Record record = record_in(file, {.units = units, .channel = channel, .step = step}, content);
        return py::make_tuple(record.points(), record.step(), record.samples.times.back(), record.measures.pga,
                              record.warnings);
      },
      "file"_a, "units"_a, "channel"_a, "step"_a = 0.0, "content"_a = py::none());
}

}  // namespace pounding::python
