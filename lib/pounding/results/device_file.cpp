#include <pounding/results/device_file.hpp>

#include <stdexcept>
#include <string>

#include <pounding/results/ends_file.hpp>
#include <pounding/results/hdf5.hpp>

namespace pounding {
namespace {

using hdf5::array;
using hdf5::attribute;
using hdf5::group;
using hdf5::Handle;
using hdf5::Label;

void write_device(hid_t parent, const DeviceHistory& device, std::size_t samples) {
  const Handle place = group(parent, device.name);
  write_ends(place, device);
  attribute(place, "stiffness", device.stiffness);
  attribute(place, "coefficient", device.coefficient);
  attribute(place, "exponent", device.exponent);
  const auto history = [&](const Label& label, const std::vector<double>& values) {
    if (values.size() != samples)
      throw std::invalid_argument(device.name + ": " + label.name + " has " + std::to_string(values.size()) +
                                  " values; " + std::to_string(samples) + " are expected");
    array(place, label, values, {samples});
  };
  history({"elongation", "m", "elongation, positive when longer"}, device.elongation);
  history({"force", "N", "force, positive in tension"}, device.force);
  const Handle envelope = group(place, "envelope");
  const Extremes& e = device.extremes;
  const auto extremes = [&](std::size_t i, const Label& values, const Label& times) {
    array(envelope, values, {e.min[i], e.max[i]}, {2});
    array(envelope, times, {e.t_min[i], e.t_max[i]}, {2});
  };
  extremes(0, {"elongation", "m", "minimum and maximum elongation"}, {"elongation_time", "s", "times of elongation"});
  extremes(1, {"force", "N", "minimum and maximum force"}, {"force_time", "s", "times of force"});
}

}  // namespace

void write_devices(hid_t file, const std::vector<DeviceHistory>& devices, std::size_t samples) {
  if (devices.empty()) return;
  const Handle place = group(file, "devices");
  for (const DeviceHistory& device : devices) write_device(place, device, samples);
}

}  // namespace pounding
