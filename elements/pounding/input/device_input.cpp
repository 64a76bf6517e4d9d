#include <pounding/input/device_input.hpp>

#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/hysteresis/all.hpp>
#include <pounding/input/link_input.hpp>
#include <pounding/input/spring_input.hpp>

namespace pounding {
namespace {

std::variant<Bar, BarSection> read_bar(const Input& node) {
  node.only_keys();
  if (node.chosen() == "E") return BarSection{node.quantity("E"), node.at("area").as_quantity()};
  if (const auto area = node.find("area"))
    area->fail_at_key("and stiffness both define the stiffness; keep one of the two");
  return Bar{node.quantity("stiffness")};
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
    coefficient.fail(
        fmt::format("takes a force at 1 m/s with the exponent {0:g}, such as \"200 kN (s/m)^{0:g}\"; \"{1}\" was read",
                    a, excerpt(coefficient.as_text())));
  }
  if (const auto stiffness = node.find("stiffness")) damper.stiffness = stiffness->as_quantity();
  if (const auto rounding = node.find("rounding_velocity")) {
    if (damper.has_stiffness()) rounding->fail_at_key("smooths a damper without a stiffness; keep one of the two");
    if (damper.is_linear())
      rounding->fail_at_key("smooths a nonlinear damper; add an exponent such as exponent: 0.35, or leave it out");
    damper.rounding_velocity = rounding->as_quantity();
  }
  return damper;
}

// Parameters of a hysteretic law, including its stiffness.
hysteresis::Settings read_law(const Input& node, const hysteresis::Entry& entry) {
  node.only_keys();
  hysteresis::Settings law{.law = std::string(entry.name)};
  for (const hysteresis::ParameterInfo& parameter : entry.parameters) {
    if (parameter.need == hysteresis::Need::required) node.at(parameter.name);
    if (const auto value = node.find(parameter.name)) {
      if (parameter.is_list())
        read_list(*value, law.values);
      else
        law.values.emplace(parameter.name, value->as_quantity());
    }
  }
  law.words = read_choices(node, entry);
  return law;
}

DeviceOptions read_parts(const Input& node) {
  DeviceOptions options;
  if (const auto bar = node.find("bar")) options.bar = read_bar(*bar);
  if (const hysteresis::Entry* law = law_among_keys(node, "a device")) options.law = read_law(node.at(law->name), *law);
  if (const auto damper = node.find("damper")) options.damper = read_damper(*damper);
  return options;
}

// Fails at the location of the option that the model rejected. The ends are a list, or follow from one key.
[[noreturn]] void fail_at_device(const ModelError& error, const Input& device, const Input& ends) {
  const auto end = [&ends](std::size_t i) { return ends.is_list() ? ends.items()[i] : ends; };
  switch (error.option()) {
    case ModelOption::device_name: device.fail_at_key(error.what());
    case ModelOption::between: ends.fail(error.what());
    case ModelOption::left: end(0).fail(error.what());
    case ModelOption::right: end(1).fail(error.what());
    case ModelOption::axis: device.at("axis").fail(error.what());
    case ModelOption::bar: device.at("bar").fail(error.what());
    case ModelOption::device_law: {
      const hysteresis::Entry& law = *law_among_keys(device, "a device");
      const Input node = device.at(law.name);
      if (device.find("bar")) node.fail_at_key(error.what());
      location_of(error.what(), node, law).fail(error.what());
    }
    case ModelOption::damper: device.at("damper").fail(error.what());
    default: device.fail(error.what());
  }
}

// Node of a frame, floor number, or ground.
DeviceEnd read_end(const Input& node, bool is_frame) {
  const std::string text = node.as_text();
  if (text == "ground") return {};
  if (is_frame) return {.node = text};
  return {.floor = static_cast<int>(node.as_integer())};
}

std::pair<DeviceEnd, DeviceEnd> read_own_ends(const Input& between, bool is_frame) {
  const std::vector<Input> items = between.items();
  return {read_end(items[0], is_frame), read_end(items[1], is_frame)};
}

}  // namespace

void read_device(const std::string& name, const Input& node, Model& model) {
  node.only_keys();
  const Input between = node.at("between");
  const auto [left, right] = read_ends(between, model);
  const DeviceOptions options = read_parts(node);
  try {
    model.connect(name, left, right, options);
  } catch (const ModelError& error) {
    fail_at_device(error, node, between);
  }
}

void read_own_device(const std::string& name, const Input& node, const StructureHandle& structure, Model& model) {
  node.only_keys();
  const auto storey = node.find("storey"), between = node.find("between"), axis = node.find("axis");
  const bool is_frame = model.structures[static_cast<std::size_t>(structure.number())].dimension > 1;
  if (storey && between)
    between->fail_at_key("a device is in a storey or between two points; keep one of storey and between");
  if (storey && is_frame)
    storey->fail_at_key("is for shear buildings; in a frame give two nodes, such as between: [a, b]");
  if (!storey && !between)
    node.fail(is_frame ? "the ends are missing; type between: [a, b] with two nodes"
                       : "the location is missing; type storey: 1, or between: [ground, 2] with two floors");
  DeviceOptions options = read_parts(node);
  std::pair<DeviceEnd, DeviceEnd> ends;
  if (between) {
    ends = read_own_ends(*between, is_frame);
  } else {
    const int number = static_cast<int>(storey->as_integer());
    if (number > 1) ends.first.floor = number - 1;
    ends.second.floor = number;
  }
  std::optional<DeviceAxis> chosen;
  if (axis) {
    const std::string spec = axis->as_choice();
    chosen = spec == "along" ? DeviceAxis::along
             : spec == "x"   ? DeviceAxis::x
             : spec == "y"   ? DeviceAxis::y
                             : DeviceAxis::z;
  }
  try {
    model.connect_within(name, structure, ends.first, ends.second, chosen, options);
  } catch (const ModelError& error) {
    fail_at_device(error, node, between ? *between : *storey);
  }
}

}  // namespace pounding
