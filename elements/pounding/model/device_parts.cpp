#include <pounding/model/device_parts.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

#include <pounding/model/refuse_option.hpp>

namespace pounding {
namespace {

Bar bar_of(const std::variant<Bar, BarSection>& given, std::optional<double> length) {
  if (const Bar* bar = std::get_if<Bar>(&given)) return *bar;
  const BarSection& section = std::get<BarSection>(given);
  if (!(section.young > 0 && section.area > 0))
    refuse(ModelOption::bar, "Young's modulus and area of a bar must be positive");
  if (!length.value_or(0))
    refuse(ModelOption::bar, "E and area need the length of the bar, which is drawn between frames that stand apart; type bar: "
                             "{stiffness: 50 MN/m}");
  return {section.young * section.area / *length};
}

template <class Check>
void checked(ModelOption option, const Check& check) {
  try {
    check();
  } catch (const ModelError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    refuse(option, error.what());
  }
}

}  // namespace

Eigen::Vector3d unit_vector(const Eigen::Vector3d& line) {
  constexpr double square = 1e-9;
  Eigen::Vector3d direction = line.normalized();
  for (double& component : direction)
    if (std::abs(component) < square) component = 0;
  return direction.normalized();
}

DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length) {
  if (!options.bar && !options.law && !options.damper)
    refuse(ModelOption::device, "is neither a bar nor a damper, and follows no law of yielding; type bar: {stiffness: 50 MN/m}, "
                                "bilinear: {stiffness: 50 MN/m, yield_force: 600 kN} or damper: {coefficient: 200 kN s/m}");
  if (options.bar && options.law)
    refuse(ModelOption::device_law, "a device has a bar or a law of yielding, and a bar is given too; keep one of the two");
  DeviceParts parts;
  checked(ModelOption::bar, [&] {
    if (!options.bar) return;
    parts.bar = bar_of(*options.bar, length);
    parts.bar->check();
  });
  parts.law = options.law;
  checked(ModelOption::device_law, [&] {
    if (parts.law) DeviceParts{.law = parts.law}.check();
  });
  parts.damper = options.damper;
  checked(ModelOption::damper, [&] {
    if (parts.damper) parts.damper->check();
  });
  return parts;
}

}  // namespace pounding
