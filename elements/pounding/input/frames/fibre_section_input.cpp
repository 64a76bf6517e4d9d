#include <pounding/input/frames/fibre_section_input.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/frames/profiles/profiles.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/frames/section_input.hpp>
#include <pounding/input/keys/key.hpp>

namespace pounding {
namespace {

using sections::Fibres;
using sections::Point;

constexpr int usual_layers = 24, usual_across = 12;

// The materials of one section, in the order in which they are used.
class UsedMaterials {
 public:
  explicit UsedMaterials(const FibreMaterials& laws) : laws_(laws) {}

  std::size_t index(const Input& node) {
    const FibreMaterial& law = find_law(node, laws_);
    const auto found = std::ranges::find(used_, law.name, &FibreMaterial::name);
    if (found != used_.end()) return static_cast<std::size_t>(found - used_.begin());
    used_.push_back(law);
    return used_.size() - 1;
  }
  std::vector<FibreMaterial> take() { return std::move(used_); }

 private:
  const FibreMaterials& laws_;
  std::vector<FibreMaterial> used_;
};

std::array<double, 2> read_pair(const Input& node, const char* example) {
  if (!node.is_list() || node.items().size() != 2) node.fail(fmt::format("takes two lengths; type {}", example));
  const std::vector<Input> items = node.items();
  return {items[0].as_quantity(dimension::length, bounds::any), items[1].as_quantity(dimension::length, bounds::any)};
}

Point read_point(const Input& node) {
  const auto [y, z] = read_pair(node, "[0.16 m, -0.16 m]");
  return {y, z};
}

Point read_centre(const Input& node) {
  const auto centre = node.find("centre");
  return centre ? read_point(*centre) : Point{};
}

void add_patch(const Input& node, UsedMaterials& used, Fibres& fibres) {
  node.only_keys();
  const std::string kind = node.chosen();
  const Input given = node.at(kind), cells_node = node.at("cells");
  if (!cells_node.is_list() || cells_node.items().size() != 2)
    cells_node.fail("takes two numbers; type cells: [1, 24]");
  const std::vector<Input> counts = cells_node.items();
  const sections::Cells cells{static_cast<int>(counts[0].as_integer()), static_cast<int>(counts[1].as_integer())};
  const std::size_t material = used.index(node.at("material"));
  if (kind == "quadrilateral") {
    const std::vector<Input> corners = given.items();
    if (corners.size() != 4) given.fail("takes four corners [y, z] in order around the quadrilateral");
    std::array<Point, 4> at;
    std::ranges::transform(corners, at.begin(), read_point);
    return placed(given, [&] { sections::add_quadrilateral(fibres, material, at, cells); });
  }
  given.only_keys();
  if (kind == "ring") {
    const double outer = given.quantity("outer"), inner = given.quantity("inner");
    const Point centre = read_centre(given);
    return placed(given, [&] { sections::add_ring(fibres, material, centre, inner, outer, cells); });
  }
  const auto [left, right] = read_pair(given.at("y"), "y: [-0.2 m, 0.2 m]");
  const auto [low, high] = read_pair(given.at("z"), "z: [-0.2 m, 0.2 m]");
  if (!(right > left)) given.at("y").fail("takes two ascending lengths; type y: [-0.2 m, 0.2 m]");
  if (!(high > low)) given.at("z").fail("takes two ascending lengths; type z: [-0.2 m, 0.2 m]");
  sections::add_rectangle(fibres, material, {left, low}, {right, high}, cells);
}

void add_layer(const Input& node, UsedMaterials& used, Fibres& fibres) {
  node.only_keys();
  const sections::Bars bars = read_bars(node.at("bars"));
  const std::size_t material = used.index(node.at("material"));
  if (const auto radius = node.find("radius")) {
    for (const char* const key : {"from", "to"})
      if (const auto found = node.find(key))
        found->fail_at_key("belongs to a straight row, and radius to a circle; keep one");
    return sections::add_circular_layer(fibres, material, bars.count, bars.area, read_centre(node),
                                        radius->as_quantity());
  }
  if (const auto centre = node.find("centre")) centre->fail_at_key("belongs to a circle of bars; type radius: 0.2 m");
  const Point from = read_point(node.at("from")), to = read_point(node.at("to"));
  sections::add_straight_layer(fibres, material, bars.count, bars.area, from, to);
}

void add_fibre(const Input& node, UsedMaterials& used, Fibres& fibres) {
  if (!node.is_list() || node.items().size() != 4)
    node.fail("takes [y, z, area, material]; type [0, 0.16 m, 1257 mm2, bars]");
  const std::vector<Input> items = node.items();
  fibres.push_back({items[0].as_quantity(dimension::length, bounds::any),
                    items[1].as_quantity(dimension::length, bounds::any),
                    items[2].as_quantity(dimension::area, bounds::positive), used.index(items[3])});
}

// Explicit fibres, and their gross area.
std::pair<Section, Fibres> read_fibres(const Input& node, UsedMaterials& used) {
  node.only_keys();
  Fibres fibres, patches;
  if (const auto list = node.find("patches"))
    for (const Input& each : list->items()) add_patch(each, used, patches);
  fibres = patches;
  if (const auto list = node.find("layers"))
    for (const Input& each : list->items()) add_layer(each, used, fibres);
  if (const auto list = node.find("points"))
    for (const Input& each : list->items()) add_fibre(each, used, fibres);
  if (fibres.empty())
    node.fail("has no fibres; type patches: [...], layers: [...] or points: [[0, 0.16 m, 1257 mm2, bars]]");
  const Fibres& covering = patches.empty() ? fibres : patches;
  Section shape{.area = sections::area(covering)};
  if (const auto area = node.find("area")) {
    placed(*area, [&] { sections::check_area(covering, area->as_quantity()); });
    shape.area = area->as_quantity();
  }
  return {shape, fibres};
}

std::pair<Section, Fibres> read_rc_rectangle(const Input& node, UsedMaterials& used, int layers, int across) {
  node.only_keys();
  sections::RcRectangle rc{.width = node.quantity("width"),
                           .depth = node.quantity("depth"),
                           .cover = node.quantity("cover"),
                           .core = used.index(node.at("core")),
                           .shell = used.index(node.at("shell")),
                           .bars = used.index(node.at("bars")),
                           .top = read_bars(node.at("top")),
                           .bottom = read_bars(node.at("bottom")),
                           .layers = layers,
                           .across = across};
  if (const auto sides = node.find("sides")) {
    rc.sides = read_bars(*sides);
    if (rc.sides.count % 2 != 0)
      sides->fail("takes an even number of bars, half of them in each side; type sides: 2 d20");
  }
  return placed(node, [&] { return std::pair(rectangle_section(rc.width, rc.depth), sections::rc_rectangle(rc)); });
}

std::pair<Section, Fibres> read_steel(const Input& given, const std::string& shape, int layers, int across) {
  const Section section = read_shape(given, shape);
  const auto fibres = [&]() -> Fibres {
    if (shape == "profile") return *profile_fibres(given.as_text(), layers, across);
    if (shape == "rectangle") return sections::rectangle(section.width, section.depth, 0, layers, across);
    if (shape == "circle") return sections::pipe(section.depth, section.depth / 2, 0, (layers + 1) / 2, 2 * layers);
    if (shape == "tube") return sections::pipe(section.depth, given.quantity("thickness"), 0, 2, 2 * layers);
    return sections::i_section(section.depth, section.width, given.quantity("flange"), given.quantity("web"), 0, layers,
                               across);
  };
  return placed(given, [&] {
    std::pair made(section, fibres());
    sections::check_area(made.second, section.area);
    return made;
  });
}

}  // namespace

bool has_fibres(const Input& section) {
  return section.has("rc_rectangle") || section.has("fibres") || section.has("material");
}

Section read_fibre_section(const Input& node, const std::string& shape, const FibreSectionContext& context) {
  const auto material = node.find("material"), gj = node.find("GJ"), axis = node.find("axis"),
             shear = node.find("shear");
  const bool is_explicit = shape == "fibres", is_steel = !is_explicit && shape != "rc_rectangle";
  if (material && !is_steel)
    material->fail_at_key(fmt::format("belongs to a shape of one material; {0} names its materials inside", shape));
  if (shape == "area")
    material->fail_at_key("needs a shape that can be divided into fibres; type rectangle: [0.2 m, 0.4 m]");
  if (const auto factor = node.find("stiffness"))
    factor->fail_at_key("does not apply to fibres, whose materials determine the stiffness; leave it out");
  const bool is_weak = axis && axis->as_choice() == "weak";
  for (const char* const key : {"layers", "across"})
    if (const auto found = node.find(key); found && is_explicit)
      found->fail_at_key("belongs to a shape; patches have cells");
  if (is_explicit && shear && shear->as_bool())
    shear->fail("needs the shear areas of a shape, which explicit fibres do not have; leave it out");
  if (is_explicit && !gj && context.dimension == 3)
    node.fail("the torsional stiffness of explicit fibres is missing; type GJ: 40 MN m^2");
  const auto count = [&](const char* key, int otherwise) {
    const auto found = node.find(key);
    return found ? static_cast<int>(found->as_integer()) : otherwise;
  };
  const int layers = count("layers", usual_layers);
  const int across = count("across", context.dimension == 3 || is_weak ? usual_across : 0);
  UsedMaterials used(context.laws);
  const Input given = node.at(shape);
  if (is_steel) used.index(*material);
  auto [section, fibres] = is_explicit               ? read_fibres(given, used)
                           : shape == "rc_rectangle" ? read_rc_rectangle(given, used, layers, across)
                                                     : read_steel(given, shape, layers, across);
  if (!(shear && shear->as_bool())) section = without_shear_deformation(section);
  if (is_weak) {
    section = turned_section(section);
    for (sections::Fibre& fibre : fibres) std::swap(fibre.y, fibre.z);
  }
  const auto density = node.find_quantity("density");
  FibreSectionOptions options{.name = context.name, .density = density.value_or(context.density)};
  if (gj) options.torsion_stiffness = gj->as_quantity();
  return placed(node, [&] { return section_of_fibres(section, used.take(), fibres, options); });
}

}  // namespace pounding
