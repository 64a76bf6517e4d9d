#include <pounding/input/device_input.hpp>

#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/link_input.hpp>

namespace pounding {
namespace {

std::variant<Bar, BarSection> read_bar(const Input& node) {
  node.only_keys();
  const auto stiffness = node.find("stiffness"), young = node.find("E"), area = node.find("area");
  if (stiffness && (young || area)) (young ? young : area)->fail_at_key("and stiffness say the same; keep one of the two");
  if (stiffness) return Bar{stiffness->as_quantity()};
  if (!young && !area) node.fail("says nothing of its stiffness; type stiffness: 50 MN/m, or E: 210 GPa and area: 20 cm^2");
  return BarSection{node.at("E").as_quantity(), node.at("area").as_quantity()};
}

Damper read_damper(const Input& node) {
  node.only_keys();
  Damper damper;
  damper.exponent = node.quantity("exponent");
  const double a = damper.exponent;
  const Input coefficient = node.at("coefficient");
  try {
    damper.coefficient = coefficient.as_quantity({1, 1 - a, -2 + a});
  } catch (const InputError&) {
    if (damper.is_linear() || !coefficient.is_scalar()) throw;
    coefficient.fail(fmt::format("beside the exponent {0:g} takes a force for 1 m/s such as \"200 kN (s/m)^{0:g}\"; \"{1}\" is none", a,
                                 excerpt(coefficient.as_text())));
  }
  if (const auto rounding = node.find("rounding_velocity")) {
    if (damper.is_linear()) rounding->fail_at_key("rounds a power of the velocity; type an exponent such as exponent: 0.35 beside it, or leave it out");
    damper.rounding_velocity = rounding->as_quantity();
  }
  return damper;
}

// Fails at the place of the option that the model has refused.
[[noreturn]] void fail(const ModelError& error, const Input& device, const Input& between) {
  switch (error.option()) {
    case ModelOption::device_name: device.fail_at_key(error.what());
    case ModelOption::between: between.fail(error.what());
    case ModelOption::left: between.items()[0].fail(error.what());
    case ModelOption::right: between.items()[1].fail(error.what());
    case ModelOption::bar: device.at("bar").fail(error.what());
    case ModelOption::damper: device.at("damper").fail(error.what());
    default: device.fail(error.what());
  }
}

}  // namespace

void read_device(const std::string& name, const Input& node, Model& model) {
  node.only_keys();
  const Input between = node.at("between");
  const auto [left, right] = read_ends(between, model);
  DeviceOptions options;
  if (const auto bar = node.find("bar")) options.bar = read_bar(*bar);
  if (const auto damper = node.find("damper")) options.damper = read_damper(*damper);
  try {
    model.connect(name, left, right, options);
  } catch (const ModelError& error) {
    fail(error, node, between);
  }
}

}  // namespace pounding
