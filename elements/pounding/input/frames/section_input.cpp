#include <pounding/input/frames/section_input.hpp>

#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/base/nearest_name.hpp>
#include <pounding/core/names.hpp>
#include <pounding/frames/profiles/profiles.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/frames/by_storey.hpp>
#include <pounding/input/frames/fibre_section_input.hpp>
#include <pounding/input/frames/frame_parser.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 7> numbers{
    "inertia_y", "inertia_z", "torsion", "shear_area_y", "shear_area_z", "plastic_modulus_y", "plastic_modulus_z"};

Section read_profile(const Input& node, const std::string& name) {
  if (const auto found = placed(node, [&] { return find_profile(name); })) return *found;
  node.fail(fmt::format("unknown section \"{}\"; {}", excerpt(name), nearest_profiles(name)));
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
  s.plastic_y = node.find_quantity("plastic_modulus_y").value_or(0);
  s.plastic_z = node.find_quantity("plastic_modulus_z").value_or(0);
  return s;
}

template <class Value>
std::vector<std::string> names(const std::map<std::string, Value>& values) {
  std::vector<std::string> all;
  for (const auto& [name, value] : values) all.push_back(name);
  return all;
}

// Reads {E, G or poisson (default 0.2), density (default 0), strength}.
Material read_material(const Input& node) {
  node.only_keys();
  if (const std::string law = node.chosen("E: 30 GPa"); law != "E")
    node.at(law).fail_at_key("is a law of fibres, for materials by name; type E: 30 GPa for an elastic material");
  const double young = node.quantity("E");
  const auto shear = node.find("G"), poisson = node.find("poisson");
  if (shear && poisson) poisson->fail_at_key("G and poisson both define the shear modulus; keep one of them");
  const double density = node.quantity("density");
  Material material = shear ? Material{.young = young, .shear = shear->as_quantity(), .density = density}
                            : isotropic(young, density, node.quantity("poisson"));
  material.strength = node.find_quantity("strength").value_or(0);
  return material;
}

}  // namespace

Section read_shape(const Input& node, std::string_view shape) {
  if (shape == "profile") return read_profile(node, node.as_text());
  if (shape == "circle") return circle_section(node.as_quantity());
  if (shape == "rectangle") {
    if (!node.is_list() || node.items().size() != 2) node.fail("takes [width, depth]; type rectangle: [0.4 m, 0.6 m]");
    return rectangle_section(node.items()[0].as_quantity(), node.items()[1].as_quantity());
  }
  node.only_keys();
  if (shape == "tube") return tube_section(node.quantity("diameter"), node.quantity("thickness"));
  return i_section(node.quantity("depth"), node.quantity("width"), node.quantity("flange"), node.quantity("web"));
}

Section SectionLibrary::read(const Input& node, const std::string& name) const {
  node.only_keys();
  const std::string shape = node.chosen("rectangle: [0.4 m, 0.6 m], or area: 0.16 m^2 with inertia_y: 2.1e-3 m^4");
  const bool has_shape = shape != "area";
  for (const std::string_view key : numbers)
    if (const auto found = node.find(key); found && has_shape)
      found->fail_at_key(
          fmt::format("follows from the shape {}; leave it out, or give section properties only", shape));
  if (has_fibres(node))
    return read_fibre_section(node, shape, {name, dimension_, fibre_materials_, default_ ? default_->density : 0.0});
  for (const char* const key : {"layers", "across", "density", "GJ"})
    if (const auto found = node.find(key))
      found->fail_at_key("belongs to a section of fibres; add material: NAME, or leave it out");
  const Input given = node.at(shape);
  Section section =
      has_shape ? placed(given, [&] { return read_shape(given, shape); }) : read_numbers(node, dimension_);
  if (const auto shear = node.find("shear")) {
    const bool wanted = shear->as_bool();
    const bool has = dimension_ == 2 ? node.has("shear_area_z") : node.has("shear_area_y") && node.has("shear_area_z");
    if (wanted && !has_shape && !has)
      shear->fail(dimension_ == 2 ? "requires shear_area_z; type shear_area_z: 0.13 m^2"
                                  : "requires shear_area_y and shear_area_z; type shear_area_z: 0.13 m^2");
    if (!wanted) section = without_shear_deformation(section);
  }
  if (const auto axis = node.find("axis"); axis && axis->as_choice() == "weak") section = turned_section(section);
  if (const auto stiffness = node.find("stiffness")) section = with_stiffness(section, stiffness->as_quantity());
  return section;
}

SectionLibrary::SectionLibrary(const Input& frame, int dimension) : dimension_(dimension) {
  if (const auto all = frame.find("materials")) {
    // Confined concretes refer to others.
    for (const bool is_confined : {false, true})
      for (const auto& [name, node] : all->entries()) {
        if (node.has("confined") != is_confined) continue;
        if (node.has("E"))
          materials_.emplace(name, read_material(node));
        else
          fibre_materials_.emplace(name, read_fibre_material(name, node, fibre_materials_));
      }
  }
  if (const auto node = frame.find("material")) default_ = material(*node);
  if (const auto all = frame.find("sections"))
    for (const auto& [name, node] : all->entries()) sections_.emplace(name, read(node, name));
}

Section SectionLibrary::section(const Input& node) const {
  // The path within the frame names a section that is typed at its place of use: "grid.columns".
  const std::size_t frame = node.path().find("frame.");
  if (node.is_map()) return read(node, node.path().substr(frame == std::string::npos ? 0 : frame + 6));
  const std::string name = node.as_text();
  if (const auto found = sections_.find(name); found != sections_.end()) return found->second;
  if (sections_.empty() || placed(node, [&] { return find_profile(name); })) return read_profile(node, name);
  const std::vector<std::string> known = names(sections_);
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::string unknown = unknown_name("section", name, known);
  if (!nearest_name(name, views).empty()) node.fail(unknown);
  node.fail(fmt::format("{} Otherwise {}", unknown, nearest_profiles(name)));
}

GridSections SectionLibrary::sections_of_grid(const Input& node, int storeys, int lines) const {
  return read_by_storey(node, storeys, lines, "section", {"C60", "C50"},
                        [this](const Input& each) { return section(each); });
}

Material SectionLibrary::material(const Input& node) const {
  if (node.is_map()) return read_material(node);
  const std::string name = node.as_text();
  if (!materials_.contains(name))
    if (const auto steel = find_steel(name)) return *steel;
  if (const auto found = materials_.find(name); found != materials_.end()) return found->second;
  if (fibre_materials_.contains(name))
    node.fail(
        fmt::format("\"{}\" is a law of fibres, and members without fibres take an elastic material; type "
                    "material: {{E: 30 GPa}}",
                    excerpt(name)));
  node.fail(unknown_name("material", name, names(materials_)));
}

Material SectionLibrary::default_material(const Input& member) const {
  if (!default_) member.fail("the material is missing; type material: {E: 30 GPa} in the frame, for all members");
  return *default_;
}

std::string NamedSection::name() const { return fmt::format("{}.{}", structure, section.fibres->name); }

std::vector<NamedSection> read_fibre_sections(const Input& file) {
  const Input root = file.in(keys::model);
  std::vector<NamedSection> all;
  for (const auto& [name, structure] : root.at("structures").entries()) {
    const auto frame = structure.find("frame");
    if (!frame) continue;
    const Input body = frame->in(keys::frame);
    body.only_keys();
    const SectionLibrary library(body, FrameParser(body).dimension());
    for (const auto& [section_name, section] : library.sections())
      if (section.fibres) all.push_back({name, section});
  }
  if (all.empty())
    file.fail(
        "no frame has a section of fibres in sections; type rc_rectangle: {...}, fibres: {...}, or a shape with "
        "a material");
  return all;
}

}  // namespace pounding
