#include <pounding/input/section_input.hpp>

#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/frames/sections.hpp>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 4> shapes{"rectangle", "i_section", "tube", "circle"};
constexpr std::array<std::string_view, 6> numbers{"area",    "inertia_y",    "inertia_z",
                                                  "torsion", "shear_area_y", "shear_area_z"};
constexpr std::string_view section_example = "rectangle: [0.4 m, 0.6 m], or area: 0.16 m^2 with inertia_y: 2.1e-3 m^4";

double length(const Input& node) { return node.as_quantity(dimension::length, bounds::positive); }

Section read_shape(const Input& node, std::string_view shape) {
  try {
    if (shape == "circle") return circle_section(length(node));
    if (shape == "rectangle") {
      if (!node.is_list() || node.items().size() != 2) node.fail("takes [width, depth]; type rectangle: [0.4 m, 0.6 m]");
      return rectangle_section(length(node.items()[0]), length(node.items()[1]));
    }
    if (shape == "tube") {
      node.only_keys({"diameter", "thickness"});
      return tube_section(length(node.at("diameter", "0.5 m")), length(node.at("thickness", "10 mm")));
    }
    node.only_keys({"depth", "width", "flange", "web"});
    return i_section(length(node.at("depth", "300 mm")), length(node.at("width", "150 mm")),
                     length(node.at("flange", "10.7 mm")), length(node.at("web", "7.1 mm")));
  } catch (const std::invalid_argument& error) {
    node.fail(error.what());
  }
}

Section read_numbers(const Input& node, int dimension) {
  const auto number = [&](std::string_view key, std::string_view example, const Dimension& unit) {
    return node.at(key, example).as_quantity(unit, bounds::positive);
  };
  const auto optional = [&](std::string_view key, const Dimension& unit, double otherwise) {
    return node.quantity_or(key, unit, otherwise, bounds::positive);
  };
  constexpr double rigid = std::numeric_limits<double>::infinity();
  Section s;
  s.area = number("area", "0.16 m^2", dimension::area);
  s.inertia_y = number("inertia_y", "2.1e-3 m^4", dimension::second_moment);
  if (dimension == 3) {
    s.inertia_z = number("inertia_z", "2.1e-3 m^4", dimension::second_moment);
    s.torsion = number("torsion", "3.6e-3 m^4", dimension::second_moment);
  } else {
    s.inertia_z = optional("inertia_z", dimension::second_moment, 0);
    s.torsion = optional("torsion", dimension::second_moment, 0);
  }
  s.shear_area_y = optional("shear_area_y", dimension::area, rigid);
  s.shear_area_z = optional("shear_area_z", dimension::area, rigid);
  return s;
}

template <class Value>
std::vector<std::string> names(const std::map<std::string, Value>& values) {
  std::vector<std::string> all;
  for (const auto& [name, value] : values) all.push_back(name);
  return all;
}

template <class Value>
Value named(const Input& node, std::string_view what, const std::map<std::string, Value>& values) {
  const std::string name = node.as_text();
  const auto found = values.find(name);
  if (found == values.end()) node.fail(unknown_name(what, name, names(values)));
  return found->second;
}

}  // namespace

Material read_material(const Input& node) {
  node.only_keys({"E", "G", "poisson", "density"});
  const double young = node.at("E", "30 GPa").as_quantity(dimension::stress, bounds::positive);
  const auto shear = node.find("G"), poisson = node.find("poisson");
  if (shear && poisson) poisson->fail_at_key("G and poisson both set the shear modulus; keep one of them");
  constexpr Bounds of_poisson{.low = 0, .high = 0.5};
  const double density = node.quantity_or("density", dimension::density, 0, bounds::non_negative);
  if (shear) return {.young = young, .shear = shear->as_quantity(dimension::stress, bounds::positive), .density = density};
  return poisson ? isotropic(young, density, poisson->as_number(of_poisson)) : isotropic(young, density);
}

Section read_section(const Input& node, int dimension) {
  std::vector<std::string_view> keys(shapes.begin(), shapes.end());
  keys.insert(keys.end(), numbers.begin(), numbers.end());
  keys.insert(keys.end(), {"shear", "stiffness"});
  node.only_keys(keys);

  std::optional<std::string_view> shape;
  for (const std::string_view each : shapes) {
    const auto found = node.find(each);
    if (!found) continue;
    if (shape) found->fail_at_key(fmt::format("a section has one shape, and a {} is given too; keep one of the two", *shape));
    shape = each;
  }
  for (const std::string_view key : numbers)
    if (const auto found = node.find(key); found && shape)
      found->fail_at_key(fmt::format("follows from the {}; leave it out, or give numbers only", *shape));
  if (!shape && !node.has("area")) node.fail(fmt::format("the shape is missing; type {}", section_example));

  Section section = shape ? read_shape(*node.find(*shape), *shape) : read_numbers(node, dimension);
  if (const auto shear = node.find("shear")) {
    const bool wanted = shear->as_bool();
    const bool has = dimension == 2 ? node.has("shear_area_z") : node.has("shear_area_y") && node.has("shear_area_z");
    if (wanted && !shape && !has)
      shear->fail(dimension == 2 ? "needs shear_area_z; type shear_area_z: 0.13 m^2"
                                 : "needs shear_area_y and shear_area_z; type shear_area_z: 0.13 m^2");
    if (!wanted) section = without_shear_deformation(section);
  }
  if (const auto stiffness = node.find("stiffness")) section = with_stiffness(section, stiffness->as_number(bounds::positive));
  return section;
}

SectionLibrary::SectionLibrary(const Input& frame, int dimension) : dimension_(dimension) {
  if (const auto all = frame.find("materials"))
    for (const auto& [name, node] : all->entries()) materials_.emplace(name, read_material(node));
  if (const auto all = frame.find("sections"))
    for (const auto& [name, node] : all->entries()) sections_.emplace(name, read_section(node, dimension));
  if (const auto node = frame.find("material")) default_ = material(*node);
}

Section SectionLibrary::section(const Input& node) const {
  return node.is_map() ? read_section(node, dimension_) : named(node, "section", sections_);
}

Material SectionLibrary::material(const Input& node) const {
  return node.is_map() ? read_material(node) : named(node, "material", materials_);
}

Material SectionLibrary::default_material(const Input& member) const {
  if (!default_) member.fail("the material is missing; type material: {E: 30 GPa} in the frame, for all members");
  return *default_;
}

}  // namespace pounding
