#include <pounding/model/devices/device_parts.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/model/refuse_option.hpp>
#include <pounding/structures/device_spring.hpp>

namespace pounding {
namespace {

Bar bar_of(const std::variant<Bar, BarSection>& given, std::optional<double> length) {
  if (const Bar* bar = std::get_if<Bar>(&given)) return *bar;
  const BarSection& section = std::get<BarSection>(given);
  if (!(section.young > 0 && section.area > 0))
    refuse(ModelOption::bar, "Young's modulus and area of a bar must be positive");
  if (!length.value_or(0))
    refuse(ModelOption::bar,
           "E and area require the length of the bar, which is defined only between drawn frames that are apart; type "
           "bar: "
           "{stiffness: 50 MN/m}");
  return {section.young * section.area / *length};
}

}  // namespace

Eigen::Vector3d unit_vector(const Eigen::Vector3d& line) {
  constexpr double square = 1e-9;
  Eigen::Vector3d direction = line.normalized();
  for (double& component : direction)
    if (std::abs(component) < square) component = 0;
  return direction.normalized();
}

double against(const SparseMatrix& matrix, const Row& motion) {
  const double square = motion.squaredNorm();
  return square > 0 ? motion.dot(Row(matrix * motion)) / square : 0;
}

void require_digits(const DeviceParts& parts, double stiffness, double mass) {
  // Forces keep six significant digits.
  constexpr double largest_ratio = 1e10;
  // A body has no stiffness; slow structures have about this circular frequency [rad/s].
  constexpr double slow = 1;
  stiffness = std::max(stiffness, mass * slow * slow);
  const auto require = [&](ModelOption option, const char* what, double value, double of_structures, const char* unit) {
    if (of_structures > 0 && value > largest_ratio * of_structures)
      refuse(option,
             fmt::format("{} is far too stiff: {:.3g} {}, and the structures at its ends have {:.3g} {}; beyond {:g} "
                         "times that, its force is round-off. Check the unit, or type at most {:.3g} {}",
                         what, value, unit, of_structures, unit, largest_ratio, largest_ratio * of_structures, unit));
  };
  if (parts.bar) require(ModelOption::bar, "the bar", parts.bar->stiffness, stiffness, "N/m");
  if (parts.law)
    require(ModelOption::device_law, "the device", DeviceSpring({.law = parts.law}).first_slope(), stiffness, "N/m");
  if (!parts.damper || parts.damper->has_stiffness()) return;
  const double rate = parts.damper->exponent > 1 ? 1 : 0;  // velocity at which slopes are compared [m/s]
  require(ModelOption::damper, "the damper", parts.damper->slope(rate), std::sqrt(stiffness * mass), "N s/m");
}

DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length) {
  if (!options.bar && !options.law && !options.damper)
    refuse(ModelOption::device,
           "has no bar, damper or hysteretic law; type bar: {stiffness: 50 MN/m}, "
           "bilinear: {stiffness: 50 MN/m, yield_force: 600 kN} or damper: {coefficient: 200 kN s/m}");
  if (options.bar && options.law)
    refuse(ModelOption::device_law, "a device has either a bar or a hysteretic law; keep one of the two");
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
