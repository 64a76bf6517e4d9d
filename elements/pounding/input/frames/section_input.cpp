#include <pounding/input/frames/section_input.hpp>

#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>
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

Section read_shape(const Input& node, std::string_view shape) {
  try {
    if (shape == "circle") return circle_section(node.as_quantity());
    if (shape == "rectangle") {
      if (!node.is_list() || node.items().size() != 2)
        node.fail("takes [width, depth]; type rectangle: [0.4 m, 0.6 m]");
      return rectangle_section(node.items()[0].as_quantity(), node.items()[1].as_quantity());
    }
    if (shape == "tube") {
      node.only_keys();
      return tube_section(node.quantity("diameter"), node.quantity("thickness"));
    }
    node.only_keys();
    return i_section(node.quantity("depth"), node.quantity("width"), node.quantity("flange"), node.quantity("web"));
  } catch (const std::invalid_argument& error) {
    node.fail(error.what());
  }
}

Section read_numbers(const Input& node, int dimension) {
  constexpr double rigid = std::numeric_limits<double>::infinity();
  Section s;
  s.area = node.quantity("area");
  s.inertia_y = node.quantity("inertia_y");
  if (dimension == 3) {
    s.inertia_z = node.quantity("inertia_z");
    s.torsion = node.quantity("torsion");
  } else {
    s.inertia_z = node.find_quantity("inertia_z").value_or(0);
    s.torsion = node.find_quantity("torsion").value_or(0);
  }
  s.shear_area_y = node.find_quantity("shear_area_y").value_or(rigid);
  s.shear_area_z = node.find_quantity("shear_area_z").value_or(rigid);
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

// Storeys of a key such as "4" or "1-3".
std::pair<int, int> storeys_of(const std::string& key, const Input& location, int storeys) {
  int first = 0, last = 0;
  const char *begin = key.data(), *end = begin + key.size();
  const auto [dash, bad_first] = std::from_chars(begin, end, first);
  bool is_range = bad_first == std::errc{};
  if (is_range && dash == end)
    last = first;
  else if (is_range && *dash == '-') {
    const auto [after, bad_last] = std::from_chars(dash + 1, end, last);
    is_range = bad_last == std::errc{} && after == end;
  } else
    is_range = false;
  if (!is_range)
    location.fail_at_key(
        fmt::format("\"{}\" is not a storey; type a number such as 4, or a range such as 1-3", excerpt(key)));
  if (first < 1 || last < first || last > storeys)
    location.fail_at_key(
        fmt::format("\"{}\" is out of range: storeys are numbered from 1 at the ground to {}", excerpt(key), storeys));
  return {first, last};
}

bool is_by_storey(const Input& node) {
  if (!node.is_map()) return false;
  const auto entries = node.entries();
  return !entries.empty() && entries.front().first.find_first_of("0123456789") == 0;
}

}  // namespace

Material read_material(const Input& node) {
  node.only_keys();
  const double young = node.quantity("E");
  const auto shear = node.find("G"), poisson = node.find("poisson");
  if (shear && poisson) poisson->fail_at_key("G and poisson both define the shear modulus; keep one of them");
  const double density = node.quantity("density");
  if (shear) return {.young = young, .shear = shear->as_quantity(), .density = density};
  return isotropic(young, density, node.quantity("poisson"));
}

Section read_section(const Input& node, int dimension) {
  node.only_keys();

  std::optional<std::string_view> shape;
  for (const std::string_view each : shapes) {
    const auto found = node.find(each);
    if (!found) continue;
    if (shape)
      found->fail_at_key(fmt::format("a section has one shape, and {} is also given; keep one of the two", *shape));
    shape = each;
  }
  for (const std::string_view key : numbers)
    if (const auto found = node.find(key); found && shape)
      found->fail_at_key(
          fmt::format("follows from the shape {}; leave it out, or give section properties only", *shape));
  if (!shape && !node.has("area")) node.fail(fmt::format("the shape is missing; type {}", section_example));

  Section section = shape ? read_shape(*node.find(*shape), *shape) : read_numbers(node, dimension);
  if (const auto shear = node.find("shear")) {
    const bool wanted = shear->as_bool();
    const bool has = dimension == 2 ? node.has("shear_area_z") : node.has("shear_area_y") && node.has("shear_area_z");
    if (wanted && !shape && !has)
      shear->fail(dimension == 2 ? "requires shear_area_z; type shear_area_z: 0.13 m^2"
                                 : "requires shear_area_y and shear_area_z; type shear_area_z: 0.13 m^2");
    if (!wanted) section = without_shear_deformation(section);
  }
  if (const auto stiffness = node.find("stiffness")) section = with_stiffness(section, stiffness->as_quantity());
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

std::vector<Section> SectionLibrary::of_storey(const Input& node, int lines) const {
  if (!node.is_list()) return {section(node)};
  const std::vector<Input> items = node.items();
  if (static_cast<int>(items.size()) != lines)
    node.fail(fmt::format("takes one section for the storey, or a list of {} by line; a list of {} was read", lines,
                          items.size()));
  std::vector<Section> sections;
  for (const Input& item : items) sections.push_back(section(item));
  return sections;
}

GridSections SectionLibrary::sections_of_grid(const Input& node, int storeys, int lines) const {
  std::vector<std::vector<Section>> rows;
  if (node.is_list()) {
    const std::vector<Input> items = node.items();
    if (static_cast<int>(items.size()) != storeys)
      node.fail(fmt::format("takes one section or a list of {} from the ground up; a list of {} was read", storeys,
                            items.size()));
    for (const Input& item : items) rows.push_back(of_storey(item, lines));
    return rows;
  }
  if (!is_by_storey(node)) return section(node);
  rows.resize(storeys);
  for (const auto& [key, each] : node.entries()) {
    const auto [first, last] = storeys_of(key, each, storeys);
    for (int storey = first; storey <= last; ++storey) {
      if (!rows[storey - 1].empty()) each.fail_at_key(fmt::format("storey {} is given twice; keep it once", storey));
      rows[storey - 1] = of_storey(each, lines);
    }
  }
  for (int storey = 1; storey <= storeys; ++storey)
    if (rows[storey - 1].empty())
      node.fail(fmt::format("storey {} is missing; list every storey from 1 to {} once, as in {{1-3: C60, 4-5: C50}}",
                            storey, storeys));
  return rows;
}

Material SectionLibrary::material(const Input& node) const {
  return node.is_map() ? read_material(node) : named(node, "material", materials_);
}

Material SectionLibrary::default_material(const Input& member) const {
  if (!default_) member.fail("the material is missing; type material: {E: 30 GPa} in the frame, for all members");
  return *default_;
}

}  // namespace pounding
