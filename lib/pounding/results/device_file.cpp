#include <pounding/results/parts_file.hpp>

#include <string>

namespace pounding {
namespace {

using namespace hdf5;

void write_device(hid_t parent, const DeviceHistory& device, std::size_t samples) {
  const Handle place = group(parent, device.name);
  write_ends(place, device);
  attribute(place, "stiffness", device.stiffness);
  attribute(place, "coefficient", device.coefficient);
  attribute(place, "exponent", device.exponent);
  const auto history = [&](const Label& label, const std::vector<double>& values) {
    check_length(values.size(), samples, device.name + ": " + label.name);
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
