#include <pounding/input/link_input.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/face_input.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/law_input.hpp>
#include <pounding/model/contact_law.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/facing.hpp>
#include <pounding/model/neighbours.hpp>

namespace pounding {
namespace {

int structure_named(const std::string& name, const Input& node, const Model& model) {
  const auto found = std::ranges::find(model.structures, name, &Structure::name);
  if (found != model.structures.end()) return static_cast<int>(found - model.structures.begin());
  std::vector<std::string_view> names;
  for (const Structure& s : model.structures) names.push_back(s.name);
  node.fail(fmt::format("unknown structure \"{}\".{}", excerpt(name), suggestion(name, names)));
}

int read_floor(const std::string& number_text, const std::string& text, const Input& node, const Structure& s) {
  double number = 0;
  const bool is_whole = parse_number(number_text, number) && number == std::floor(number) && std::abs(number) < 1e9;
  placed(node, [&] { require_floor(s, is_whole ? static_cast<int>(number) : 0, text); });
  return static_cast<int>(number);
}

ContactLocation read_end(const Input& node, const Model& model) {
  ContactLocation end;
  if (!node.is_map()) {
    const std::string text = node.as_text();
    const std::size_t dot = text.find('.');
    end.structure = structure_named(text.substr(0, dot), node, model);
    if (dot != std::string::npos)
      end.floor = read_floor(text.substr(dot + 1), text, node, model.structures[end.structure]);
    return end;
  }
  node.only_keys();
  const Input name = node.at("structure");
  end.structure = structure_named(name.as_text(), name, model);
  const std::optional<Input> floor = node.find("floor"), at_node = node.find("node"),
                             elevation = node.find("elevation");
  if (floor.has_value() + at_node.has_value() + elevation.has_value() > 1)
    node.fail("takes one of floor, node and elevation; keep one of them");
  if (floor) end.floor = read_floor(floor->as_text(), floor->as_text(), *floor, model.structures[end.structure]);
  if (at_node) end.node = at_node->as_text();
  if (elevation) end.elevation = elevation->as_quantity();
  if (const auto face = node.find("face")) end.face = read_face(*face);
  return end;
}

std::optional<FacingFloors> read_floors(const Input& link) {
  const auto floors = link.find("floors");
  if (!floors) return {};
  const std::string choice = floors->as_choice();
  return choice == "all" ? FacingFloors::all : choice == "level" ? FacingFloors::level : FacingFloors::any;
}

// Location of the option that the model rejected.
Input location_of(const ModelError& error, const Input& link, const Input& between) {
  const auto at = [&](const char* key) { return link.find(key).value_or(link); };
  switch (error.option()) {
    case ModelOption::between: return between;
    case ModelOption::left: return between.is_list() ? between.items()[0] : between;
    case ModelOption::right: return between.is_list() ? between.items()[1] : between;
    case ModelOption::within: return at("within");
    case ModelOption::floors: return at("floors");
    case ModelOption::level_within: return at("level_within");
    case ModelOption::gap: return at("gap");
    case ModelOption::preload: return at("preload");
    case ModelOption::link_name: return at("name");
    case ModelOption::points: return at("points");
    case ModelOption::friction: return at("friction");
    case ModelOption::sliding_velocity: return at("sliding_velocity");
    case ModelOption::reduced_mass: return at("reduced_mass");
    case ModelOption::seat: return at("seat");
    case ModelOption::law: return location_of_law(error.what(), link);
    default: return link;
  }
}

// One coefficient, or a map.
void read_link_friction(const Input& node, LinkOptions& options) {
  if (!node.is_map()) {
    options.friction = node.as_quantity();
    return;
  }
  node.only_keys();
  options.friction = node.quantity("coefficient");
  options.static_friction = node.find_quantity("static");
  options.stribeck_velocity = node.find_quantity("stribeck_velocity");
  options.tangential_stiffness = node.find_quantity("tangential_stiffness");
  options.tangential_ratio = node.find_quantity("tangential_ratio");
  const std::optional<double> poisson = node.find_quantity("poisson");
  if (options.tangential_stiffness.has_value() + options.tangential_ratio.has_value() + poisson.has_value() > 1)
    node.fail("takes one of tangential_stiffness, tangential_ratio and poisson; keep one of them");
  if (poisson) options.tangential_ratio = 2 * (1 - *poisson) / (2 - *poisson);
}

// The gap is optional if it follows from the drawing.
LinkOptions read_options(const Input& node, int count, bool is_drawn) {
  LinkOptions options;
  if (const auto preload = node.find("preload")) options.preload = preload->as_bool();
  if (!is_drawn || node.has("gap")) options.gap = node.at("gap").as_quantities(count);
  if (const auto name = node.find("name")) options.name = name->as_text();
  if (const auto points = node.find("points")) options.points = static_cast<int>(points->as_integer());
  options.level_within = node.find_quantity("level_within");
  if (const auto friction = node.find("friction")) read_link_friction(*friction, options);
  options.sliding_velocity = node.find_quantity("sliding_velocity");
  options.reduced_mass = node.find_quantity("reduced_mass");
  options.seat = node.find_quantity("seat");
  return options;
}

std::pair<LinkOptions, laws::Settings> read_options_and_law(const Input& node, std::optional<FacingFloors> floors,
                                                            int count, bool is_drawn) {
  LinkOptions options = read_options(node, count, is_drawn);
  options.floors = floors;
  const LawInput law = read_law(node);
  options.stiffness = law.stiffness;
  return {options, law.settings};
}

void require_neighbours(const Input& between) {
  constexpr std::string_view allowed[] = {"neighbours"};
  const std::string read = between.as_text();
  if (read == allowed[0]) return;
  const bool is_near = !nearest_name(read, allowed).empty();
  between.fail(is_near
                   ? fmt::format("unknown value \"{}\".{}", excerpt(read), suggestion(read, allowed))
                   : "takes two structures, the left one first; type between: [left, right], or between: neighbours");
}

void read_links_of_neighbours(const Input& node, const Input& between, Model& model) {
  try {
    const double within = node.quantity("within");
    if (const auto gap = node.find("gap"); gap && gap->is_list())
      gap->fail("takes one gap for all neighbours; leave it out to use the drawn distance of each pair");
    const auto [options, law] = read_options_and_law(node, read_floors(node), 1, true);
    link_neighbours(model, options, law, within);
  } catch (const ModelError& error) {
    fail_at(location_of(error, node, between), error);
  }
}

}  // namespace

std::pair<ContactLocation, ContactLocation> read_ends(const Input& between, const Model& model) {
  if (!between.is_list() || between.items().size() != 2)
    between.fail("takes two structures, the left one first; type between: [left, right]");
  const std::vector<Input> ends = between.items();
  const ContactLocation left = read_end(ends[0], model), right = read_end(ends[1], model);
  return {left, right};
}

void read_link(const Input& node, Model& model) {
  refuse_unknown_keys(node);
  const Input between = node.at("between");
  if (between.is_scalar()) {
    require_neighbours(between);
    read_links_of_neighbours(node, between, model);
    return;
  }
  const auto [left, right] = read_ends(between, model);
  if (const auto within = node.find("within")) within->fail_at_key("belongs to between: neighbours; leave it out");
  try {
    const std::optional<FacingFloors> floors = read_floors(node);
    const std::size_t count = pairs_of(model, left, right, floors, node.find_quantity("level_within")).size();
    const Structure &a = model.structures[left.structure], &b = model.structures[right.structure];
    facing_side(a, b);
    const auto [options, law] = read_options_and_law(node, floors, static_cast<int>(count), are_drawn(a, b));
    model.link(left, right, options, law);
  } catch (const ModelError& error) {
    fail_at(location_of(error, node, between), error);
  }
}

}  // namespace pounding
