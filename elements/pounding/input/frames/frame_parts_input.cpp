#include <pounding/input/frames/frame_parts_input.hpp>

#include <algorithm>

#include <pounding/core/names.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/input/frames/frame_bays.hpp>
#include <pounding/input/frames/grid_loads.hpp>

namespace pounding {

using Eigen::Vector3d;

namespace {

// Groups of members of a grid: columns, beams, or one column line.
bool is_group(const std::string& name) { return name == "columns" || name == "beams" || name.starts_with("columns "); }

// "columns 2" for "column 1.2"; empty for beams.
std::string line_of(const std::string& member) {
  return member.starts_with("column ") ? "columns " + member.substr(member.find('.') + 1) : std::string();
}

std::vector<std::string> members_of(const std::string& group, const std::vector<std::string>& known) {
  std::vector<std::string> members;
  for (const std::string& each : known)
    if (const std::string line = line_of(each); group == line || group == (line.empty() ? "beams" : "columns"))
      members.push_back(each);
  return members;
}

std::vector<std::string> lines_of_columns(const std::vector<std::string>& known) {
  std::vector<std::string> lines;
  for (const std::string& each : known)
    if (const std::string line = line_of(each); !line.empty() && std::ranges::find(lines, line) == lines.end())
      lines.push_back(line);
  return lines;
}

[[noreturn]] void refuse_material(const Input& material) {
  material.fail_at_key("is that of an elastic member, and the fibres of the section have materials; leave it out");
}

}  // namespace

FramePartsInput::FramePartsInput(const Input& body) : body_(body), keys_(body), library_(body, dimension_) {
  frame.model.frame = Frame(dimension_);
  if (!body_.has("grid") && !body_.has("nodes"))
    body_.fail("a frame needs nodes; type grid: {storeys: 5, bays: 3, ...}, or nodes: {a: [0, 0], b: [0, 3 m]}");
  read_origin();
  if (const auto mass = body_.find("mass"))
    if (mass->as_choice() == "consistent") mass_kind_ = BeamMass::consistent;
  if (const auto grid = body_.find("grid")) read_grid(*grid);
  if (const auto nodes = body_.find("nodes"))
    for (const auto& [name, node] : nodes->entries()) read_node(name, node);
  if (const auto members = body_.find("members"))
    for (const auto& [name, node] : members->entries())
      if (!is_of_grid(name)) read_member(name, node);
}

// Names of user-defined members have no dot.
bool FramePartsInput::is_of_grid(const std::string& name) const {
  return body_.has("grid") && (name.find('.') != std::string::npos || is_group(name));
}

std::vector<std::string> FramePartsInput::node_names() const {
  std::vector<std::string> names;
  for (int i = 0; i < frame.model.frame.nodes(); ++i) names.push_back(frame.model.frame.node_name(i));
  return names;
}

int FramePartsInput::node_at_key(const std::string& name, const Input& location) const {
  const auto found = nodes_.find(name);
  if (found == nodes_.end()) location.fail_at_key(unknown_name("node", name, node_names()));
  return found->second;
}

int FramePartsInput::node_of(const Input& item) const {
  const std::string name = item.as_text();
  const auto found = nodes_.find(name);
  if (found == nodes_.end()) item.fail(unknown_name("node", name, node_names()));
  return found->second;
}

std::vector<int> FramePartsInput::nodes_of(const Input& list) const {
  std::vector<int> nodes;
  for (const Input& item : list.items()) nodes.push_back(node_of(item));
  if (nodes.empty()) list.fail("takes node names such as [a, b]; the list is empty");
  return nodes;
}

void FramePartsInput::read_origin() {
  const auto node = body_.find("origin");
  if (!node) return;
  const std::size_t minimum = dimension_ == 2 ? 1 : 2;
  const std::size_t count = node->is_list() ? node->items().size() : 0;
  if (count != minimum && count != minimum + 1)
    node->fail(dimension_ == 2 ? "takes [x] or [x, z]; type origin: [12 m, 0]"
                               : "takes [x, y] or [x, y, z]; type origin: [12 m, 0, 0]");
  std::vector<double> values;
  for (const Input& item : node->items()) values.push_back(item.as_quantity());
  origin_.x() = values[0];
  if (dimension_ == 3) origin_.y() = values[1];
  if (count > minimum) origin_.z() = values.back();
}

void FramePartsInput::read_grid(const Input& node) {
  node.only_keys();
  GridFrame grid;
  grid.storeys = static_cast<int>(node.at("storeys").as_integer());
  const auto [along_x, along_y] = read_bays(node, dimension_);
  grid.bays_x = static_cast<int>(along_x.size());
  grid.bays_y = static_cast<int>(along_y.size());
  placed(node, [&] { grid.require_affordable(); });
  grid.bay_width_x = along_x;
  grid.bay_width_y = along_y;
  grid.storey_height = node.at("storey_height").as_quantities(grid.storeys);
  const int lines_of_columns = (grid.bays_x + 1) * (grid.bays_y + 1);
  grid.column = library_.sections_of_grid(node.at("columns"), grid.storeys, lines_of_columns);
  grid.beam =
      library_.sections_of_grid(node.at("beams"), grid.storeys, dimension_ == 2 ? grid.bays_x : lines_of_columns);
  const auto is_elastic = [](const GridSections& sections) {
    return std::ranges::any_of(sections.values(), [](const auto& of_storey) {
      return std::ranges::any_of(of_storey, [](const Section& section) { return !section.fibres; });
    });
  };
  if (is_elastic(grid.column) || is_elastic(grid.beam)) grid.material = library_.default_material(node);
  grid.mass = mass_kind_;
  if (const auto mass = node.find("floor_mass")) grid.floor_mass = mass->as_quantities(grid.storeys);
  read_loads(node, grid);
  if (const auto members = body_.find("members")) read_members_of_grid(*members, grid);
  grid_ = placed(node, [&] { return add_grid(frame.model, grid); });
  const Frame& made = frame.model.frame;
  for (int i = 0; i < made.nodes(); ++i) nodes_.emplace(made.node_name(i), i);
  for (int i = 0; i < made.members(); ++i) members_.emplace(made.member_name(i), i);
  frame.node_locations.assign(made.nodes(), node);
  frame.member_locations.assign(made.members(), node);
}

// Reads changes to members of the grid. The entry of a single member replaces that of its group.
void FramePartsInput::read_members_of_grid(const Input& members, GridFrame& grid) const {
  const std::vector<std::string> known = grid.member_names();
  for (const auto& [name, node] : members.entries())
    if (is_of_grid(name) && is_group(name)) {
      const GridMember own = read_member_of_grid(node);
      const std::vector<std::string> named = members_of(name, known);
      if (named.empty()) node.fail_at_key(unknown_name("line of columns", name, lines_of_columns(known)));
      for (const std::string& each : named) grid.members[each] = own;
    }
  for (const auto& [name, node] : members.entries()) {
    if (!is_of_grid(name) || is_group(name)) continue;
    if (std::find(known.begin(), known.end(), name) == known.end())
      node.fail_at_key(unknown_name("member", name, known));
    grid.members[name] = read_member_of_grid(node);
  }
}

GridMember FramePartsInput::read_member_of_grid(const Input& node) const {
  node.only_keys();
  for (const std::string_view key : {"between", "truss"})
    if (const auto found = node.find(key))
      found->fail_at_key("is not allowed for a member of the grid, which keeps its nodes and remains a beam");
  GridMember own;
  if (const auto section = node.find("section")) own.section = library_.section(*section);
  const auto material = node.find("material");
  if (material) own.material = library_.material(*material);
  if (own.section && own.section->fibres && material) refuse_material(*material);
  if (own.section && !own.section->fibres && !material) own.material = library_.default_material(node);
  own.options = read_beam_options(node);
  if (const auto load = node.find("load")) own.load = read_load(*load);
  if (const auto parts = node.find("parts")) own.parts = static_cast<int>(parts->as_integer());
  return own;
}

Vector3d FramePartsInput::read_load(const Input& load) const {
  return keys_.vector(load, dimension_ == 2 ? "[0, -10 kN/m]" : "[0, 0, -10 kN/m]");
}

void FramePartsInput::check_name(const std::string& name, const Input& location) const {
  if (name.empty() || name.find_first_of("/.") != std::string::npos)
    location.fail_at_key("a name must not be empty or contain \".\" or \"/\"; type a name such as b1");
}

void FramePartsInput::read_node(const std::string& name, const Input& node) {
  check_name(name, node);
  if (name == "feet" && body_.has("grid")) node.fail_at_key("\"feet\" refers to the grid; choose another name");
  const Vector3d position = keys_.vector(node, dimension_ == 2 ? "[0, 3 m]" : "[0, 0, 3 m]");
  nodes_.emplace(name, placed(node, [&] { return frame.model.frame.add_node(position, name); }));
  frame.node_locations.push_back(node);
}

void FramePartsInput::name_member(int member, const std::string& name, const Input& location) {
  frame.model.frame.set_name(member, name);
  members_.emplace(name, member);
  frame.member_locations.push_back(location);
}

void FramePartsInput::add_truss(const std::string& name, const Input& node, const Input& truss, int start, int end,
                                const Material& material) {
  for (const std::string_view key : {"section", "releases", "offsets", "load", "parts", "reference"})
    if (const auto found = node.find(key)) found->fail_at_key("belongs to a beam; a truss has an area only");
  const double area = truss.as_quantity();
  name_member(placed(node, [&] { return frame.model.frame.add_truss(start, end, area, material); }), name, node);
}

BeamOptions FramePartsInput::read_beam_options(const Input& node) const {
  BeamOptions options{.mass = mass_kind_};
  if (const auto releases = node.find("releases")) {
    releases->only_keys();
    if (const auto at = releases->find("start")) options.start_releases = keys_.dofs(*at);
    if (const auto at = releases->find("end")) options.end_releases = keys_.dofs(*at);
  }
  if (const auto offsets = node.find("offsets")) {
    const std::string_view example = dimension_ == 2 ? "[0, 0.3 m]" : "[0, 0, 0.3 m]";
    offsets->only_keys();
    if (const auto at = offsets->find("start")) options.start_offset = keys_.vector(*at, example);
    if (const auto at = offsets->find("end")) options.end_offset = keys_.vector(*at, example);
  }
  if (const auto reference = node.find("reference")) {
    if (dimension_ == 2) reference->fail_at_key("is for frames in space; leave it out");
    options.reference = keys_.vector(*reference, "[0, 1, 0]");
  }
  return options;
}

void FramePartsInput::read_member(const std::string& name, const Input& node) {
  check_name(name, node);
  if (members_.contains(name)) node.fail_at_key("the grid already has a member of this name; choose another one");
  node.only_keys();
  const Input between = node.at("between");
  if (!between.is_list() || between.items().size() != 2) between.fail("takes two nodes; type between: [a, b]");
  const int start = node_of(between.items()[0]), end = node_of(between.items()[1]);
  const auto own_material = node.find("material"), truss = node.find("truss"), section_node = node.find("section");
  const auto material = [&] {
    return own_material ? library_.material(*own_material) : library_.default_material(node);
  };
  if (truss) return add_truss(name, node, *truss, start, end, material());
  if (!section_node) node.fail("the section is missing; type section: {rectangle: [0.4 m, 0.6 m]}, or truss: 20 cm^2");
  const Section section = library_.section(*section_node);
  if (section.fibres && own_material) refuse_material(*own_material);
  Frame& made = frame.model.frame;
  const int nodes = made.nodes();
  const auto parts = node.find("parts");
  const CutMember beam{.section = section,
                       .material = section.fibres ? section.fibres->material : material(),
                       .options = read_beam_options(node),
                       .parts = parts ? static_cast<int>(parts->as_integer()) : 1};
  const std::vector<int> members = placed(node, [&] { return add_member_in_parts(made, name, start, end, beam); });
  for (const int member : members) name_member(member, made.member_name(member), node);
  for (int added = nodes; added < made.nodes(); ++added) {
    nodes_.emplace(made.node_name(added), added);
    frame.node_locations.push_back(node);
  }
  if (const auto load = node.find("load")) {
    const Vector3d per_length = read_load(*load);
    for (const int member : members) placed(*load, [&] { made.add_member_load(member, per_length); });
  }
}

}  // namespace pounding
