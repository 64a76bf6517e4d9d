#include <pounding/input/frame_input.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <pounding/input/frame_bays.hpp>
#include <pounding/input/names.hpp>
#include <pounding/input/frame_parser.hpp>
#include <pounding/input/section_input.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

// Up to here all nodes are reported when nothing else is asked for.
constexpr int max_reported = 100;

// A refusal by the frame, at the place that caused it.
template <class Act>
auto placed(const Input& place, Act&& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    place.fail(error.what());
  }
}

class Reader {
 public:
  explicit Reader(const Input& body) : body_(body), words_(body), library_(body, dimension_) {}

  FrameModel read() {
    model_.frame = Frame(dimension_);
    if (!body_.has("grid") && !body_.has("nodes"))
      body_.fail("a frame needs nodes; type grid: {storeys: 5, bays: 3, ...}, or nodes: {a: [0, 0], b: [0, 3 m]}");
    read_origin();
    if (const auto mass = body_.find("mass"))
      if (mass->as_choice("mass of members", {"lumped", "consistent"}) == "consistent") mass_kind_ = BeamMass::consistent;
    if (const auto grid = body_.find("grid")) read_grid(*grid);
    if (const auto nodes = body_.find("nodes"))
      for (const auto& [name, node] : nodes->entries()) read_node(name, node);
    if (const auto members = body_.find("members"))
      for (const auto& [name, node] : members->entries()) read_member(name, node);
    if (const auto masses = body_.find("masses"))
      for (const auto& [name, node] : masses->entries()) read_mass(node_at_key(name, node), node);
    if (const auto loads = body_.find("loads"))
      for (const auto& [name, node] : loads->entries()) read_load(node_at_key(name, node), node);
    if (const auto springs = body_.find("springs"))
      for (const Input& node : springs->items()) read_spring(node);
    read_supports();
    if (const auto ties = body_.find("ties"))
      for (const Input& node : ties->items()) read_tie(node);
    model_.given_nodes = model_.frame.nodes();
    if (const auto floors = body_.find("floors"))
      for (const Input& node : floors->items()) read_floor(node);
    make_floors_rigid();
    read_gravity();
    read_report();
    return std::move(model_);
  }

 private:
  struct FloorPlace {
    Input place;
    bool rigid;
    std::vector<double> weights;  // of the nodes, where the masses are none
  };

  // Names and vectors.

  std::vector<std::string> node_names() const {
    std::vector<std::string> names;
    for (int i = 0; i < model_.frame.nodes(); ++i) names.push_back(model_.frame.node_name(i));
    return names;
  }

  int node_at_key(const std::string& name, const Input& place) const {
    const auto found = nodes_.find(name);
    if (found == nodes_.end()) place.fail_at_key(unknown_name("node", name, node_names()));
    return found->second;
  }

  int node_of(const Input& item) const {
    const std::string name = item.as_text();
    const auto found = nodes_.find(name);
    if (found == nodes_.end()) item.fail(unknown_name("node", name, node_names()));
    return found->second;
  }

  std::vector<int> nodes_of(const Input& list) const {
    std::vector<int> nodes;
    for (const Input& item : list.items()) nodes.push_back(node_of(item));
    if (nodes.empty()) list.fail("takes the names of nodes such as [a, b]; the list is empty");
    return nodes;
  }

  void read_origin() {
    const auto node = body_.find("origin");
    if (!node) return;
    const std::size_t least = dimension_ == 2 ? 1 : 2;
    const std::size_t count = node->is_list() ? node->items().size() : 0;
    if (count != least && count != least + 1)
      node->fail(dimension_ == 2 ? "takes [x] or [x, z]; type origin: [12 m, 0]"
                                 : "takes [x, y] or [x, y, z]; type origin: [12 m, 0, 0]");
    std::vector<double> values;
    for (const Input& item : node->items()) values.push_back(item.as_quantity(dimension::length));
    origin_.x() = values[0];
    if (dimension_ == 3) origin_.y() = values[1];
    if (count > least) origin_.z() = values.back();
  }

  // Nodes and members.

  int add_node(const std::string& name, const Vector3d& position, const Input& place) {
    const int node = placed(place, [&] { return model_.frame.add_node(position, name); });
    nodes_.emplace(name, node);
    node_mass_.push_back(0);
    model_.node_places.push_back(place);
    return node;
  }

  void name_member(int member, const std::string& name, const Input& place,
                   const std::array<Vector3d, 2>& offsets = {Vector3d::Zero(), Vector3d::Zero()}) {
    model_.frame.set_name(member, name);
    members_.emplace(name, member);
    model_.member_places.push_back(place);
    model_.offsets.push_back(offsets);
  }

  void check_name(const std::string& name, const Input& place) const {
    if (name.empty() || name.find_first_of("/.") != std::string::npos)
      place.fail_at_key("a name must not be empty or contain \".\" or \"/\"; type a name such as b1");
  }

  void read_node(const std::string& name, const Input& node) {
    check_name(name, node);
    if (name == "feet" && body_.has("grid")) node.fail_at_key("\"feet\" are those of the grid; choose another name");
    add_node(name, words_.vector(node, dimension::length, dimension_ == 2 ? "[0, 3 m]" : "[0, 0, 3 m]") + origin_, node);
  }

  void read_member(const std::string& name, const Input& node) {
    check_name(name, node);
    if (members_.contains(name)) node.fail_at_key("the grid has a member of this name; choose another one");
    node.only_keys({"between", "section", "truss", "material", "releases", "offsets", "load", "reference"});
    const Input between = node.at("between", "[a, b]");
    if (!between.is_list() || between.items().size() != 2) between.fail("takes two nodes; type between: [a, b]");
    const int start = node_of(between.items()[0]), end = node_of(between.items()[1]);
    const auto own_material = node.find("material");
    const Material material = own_material ? library_.material(*own_material) : library_.default_material(node);
    if (const auto truss = node.find("truss")) {
      for (const std::string_view key : {"section", "releases", "offsets", "load", "reference"})
        if (const auto found = node.find(key)) found->fail_at_key("belongs to a beam; a truss takes its area only");
      const double area = truss->as_quantity(dimension::area, bounds::positive);
      return name_member(placed(node, [&] { return model_.frame.add_truss(start, end, area, material); }), name, node);
    }
    const auto section = node.find("section");
    if (!section) node.fail("the section is missing; type section: {rectangle: [0.4 m, 0.6 m]}, or truss: 20 cm^2");
    BeamOptions options{.mass = mass_kind_};
    if (const auto releases = node.find("releases")) {
      releases->only_keys({"start", "end"});
      if (const auto at = releases->find("start")) options.start_releases = words_.dofs(*at);
      if (const auto at = releases->find("end")) options.end_releases = words_.dofs(*at);
    }
    if (const auto offsets = node.find("offsets")) {
      const std::string_view example = dimension_ == 2 ? "[0, 0.3 m]" : "[0, 0, 0.3 m]";
      offsets->only_keys({"start", "end"});
      if (const auto at = offsets->find("start")) options.start_offset = words_.vector(*at, dimension::length, example);
      if (const auto at = offsets->find("end")) options.end_offset = words_.vector(*at, dimension::length, example);
    }
    if (const auto reference = node.find("reference")) {
      if (dimension_ == 2) reference->fail_at_key("is for frames in space; in the plane local y is y; leave it out");
      options.reference = words_.vector(*reference, dimension::none, "[0, 1, 0]");
    }
    const int member = placed(node, [&] {
      return model_.frame.add_member(start, end, library_.section(*section), material, options);
    });
    name_member(member, name, node, {options.start_offset, options.end_offset});
    if (const auto load = node.find("load")) {
      const std::string_view example = dimension_ == 2 ? "[0, -10 kN/m]" : "[0, 0, -10 kN/m]";
      const Vector3d per_length = words_.vector(*load, dimension::stiffness, example);
      placed(*load, [&] { model_.frame.add_member_load(member, per_length); });
      model_.loads = true;
    }
  }

  // The grid.

  std::string grid_name(int storey, int i, int k) const {
    return dimension_ == 2 ? fmt::format("{}.{}", storey, i) : fmt::format("{}.{}.{}", storey, i, k);
  }

  void read_grid(const Input& grid) {
    grid.only_keys({"storeys", "bays", "storey_height", "bay_width", "columns", "beams", "floor_mass", "rigid_floors"});
    const int storeys = static_cast<int>(grid.at("storeys", "5").as_integer(1, 1000));
    const auto [along_x, along_y] = read_bays(grid, dimension_);
    const auto heights = grid.at("storey_height", "3.2 m").as_quantities(storeys, dimension::length, bounds::positive);
    const Section column = library_.section(grid.at("columns", "{rectangle: [0.4 m, 0.4 m]}"));
    const Section beam = library_.section(grid.at("beams", "{rectangle: [0.3 m, 0.5 m]}"));
    const Material material = library_.default_material(grid);
    const auto mass = grid.find("floor_mass"), rigid = grid.find("rigid_floors");
    const auto masses = mass ? mass->as_quantities(storeys, dimension::mass, bounds::non_negative)
                             : std::vector<double>(storeys, 0.0);
    const bool is_rigid = rigid ? rigid->as_bool() : dimension_ == 3;
    const BeamOptions options{.mass = mass_kind_};
    const auto add = [&](int start, int end, const Section& section, const std::string& name) {
      name_member(placed(grid, [&] { return model_.frame.add_member(start, end, section, material, options); }), name, grid);
    };
    const auto node = [&](int storey, int i, int k) { return nodes_.at(grid_name(storey, i, k)); };

    double height = 0;
    for (int storey = 0; storey <= storeys; ++storey) {
      if (storey > 0) height += heights[storey - 1];
      FrameFloor floor{.label = std::to_string(storey), .nodes = {}, .elevation = height + origin_.z()};
      std::vector<double> shares;
      for (int k = 0; k <= along_y.count; ++k)
        for (int i = 0; i <= along_x.count; ++i) {
          const Vector3d at = Vector3d(along_x.at[i], along_y.at[k], height) + origin_;
          floor.nodes.push_back(add_node(grid_name(storey, i, k), at, grid));
          shares.push_back(along_x.share[i] * along_y.share[k]);
        }
      if (storey == 0) {
        feet_ = floor.nodes;
        continue;
      }
      for (std::size_t n = 0; n < floor.nodes.size(); ++n) {
        const double part = masses[storey - 1] * shares[n];
        model_.frame.add_mass(floor.nodes[n], part);
        node_mass_[floor.nodes[n]] += part;
      }
      model_.floors.push_back(std::move(floor));
      floor_places_.push_back({grid, is_rigid, std::move(shares)});
    }
    for (int storey = 1; storey <= storeys; ++storey)
      for (int k = 0; k <= along_y.count; ++k)
        for (int i = 0; i <= along_x.count; ++i) {
          const std::string name = grid_name(storey, i, k);
          add(node(storey - 1, i, k), node(storey, i, k), column, "column " + name);
          if (i < along_x.count) add(node(storey, i, k), node(storey, i + 1, k), beam, "beam x " + name);
          if (k < along_y.count) add(node(storey, i, k), node(storey, i, k + 1), beam, "beam y " + name);
        }
  }

  // What stands at nodes.

  void read_mass(int node, const Input& value) {
    if (!value.is_map()) {
      const double mass = value.as_quantity(dimension::mass, bounds::non_negative);
      node_mass_[node] += mass;
      return placed(value, [&] { model_.frame.add_mass(node, mass); });
    }
    for (const auto& [key, each] : value.entries()) {
      const Dof dof = words_.dof_at_key(key, each);
      const double mass = each.as_quantity(of_mass(dof), bounds::non_negative);
      if (dof == Dof::ux) node_mass_[node] += mass;
      placed(each, [&] { model_.frame.add_mass(node, dof, mass); });
    }
  }

  void read_load(int node, const Input& value) {
    if (!value.is_map()) value.fail("takes forces with their directions; type {uz: -10 kN}");
    for (const auto& [key, each] : value.entries()) {
      const Dof dof = words_.dof_at_key(key, each);
      placed(each, [&] { model_.frame.add_load(node, dof, each.as_quantity(of_load(dof))); });
      model_.loads = true;
    }
  }

  void read_spring(const Input& node) {
    node.only_keys({"node", "between", "dof", "stiffness", "damping"});
    const auto at = node.find("node"), between = node.find("between");
    if (at && between) between->fail_at_key("a spring stands at one node or between two; keep one of node and between");
    if (!at && !between) node.fail("its place is missing; type node: a for a spring to the ground, or between: [a, b]");
    const Dof dof = words_.dof(node.at("dof", "ux"));
    const auto stiffness = node.find("stiffness"), damping = node.find("damping");
    if (!stiffness && !damping) node.fail("has neither stiffness nor damping; type stiffness: 1 MN/m");
    const double k = stiffness ? stiffness->as_quantity(of_spring(dof), bounds::non_negative) : 0;
    const double c = damping ? damping->as_quantity(of_dashpot(dof), bounds::non_negative) : 0;
    if (at) {
      const int a = node_of(*at);
      if (stiffness) grounded_.push_back(a);
      return placed(node, [&] {
        if (stiffness) model_.frame.add_spring(a, dof, k);
        if (damping) model_.frame.add_dashpot(a, dof, c);
      });
    }
    if (!between->is_list() || between->items().size() != 2) between->fail("takes two nodes; type between: [a, b]");
    const int a = node_of(between->items()[0]), b = node_of(between->items()[1]);
    placed(node, [&] {
      if (stiffness) model_.frame.add_spring(a, b, dof, k);
      if (damping) model_.frame.add_dashpot(a, b, dof, c);
    });
    if (stiffness) model_.springs.push_back({a, b, dof, k});
  }

  void read_tie(const Input& node) {
    node.only_keys({"master", "nodes", "dofs", "rigid"});
    const Input at = node.at("master", "a");
    const int master = node_of(at);
    const std::vector<int> nodes = nodes_of(node.at("nodes", "[b, c]"));
    const auto dofs = node.find("dofs"), rigid = node.find("rigid");
    if (dofs && rigid) rigid->fail_at_key("a rigid tie holds all displacements; keep one of dofs and rigid");
    if (!dofs && !(rigid && rigid->as_bool())) node.fail("what is tied is missing; type dofs: [ux], or rigid: true");
    for (const int each : nodes)
      placed(node, [&] {
        if (dofs) model_.frame.tie(master, each, words_.dofs(*dofs));
        else model_.frame.tie_rigidly(master, each);
      });
  }

  // Supports.

  void add_support(const SupportWish& wish, const std::string& name, const std::vector<int>& nodes, const Input& place) {
    for (const int node : nodes)
      placed(place, [&] {
        model_.frame.fix(node, wish.fixed);
        for (const auto& [dof, stiffness] : wish.springs) model_.frame.add_spring(node, dof, stiffness);
        for (const auto& [dof, damping] : wish.dashpots) model_.frame.add_dashpot(node, dof, damping);
      });
    if (wish.delay > 0 || wish.motion) model_.supports.push_back({name, nodes, wish.delay, wish.motion});
    else common_.insert(common_.end(), nodes.begin(), nodes.end());
  }

  void read_supports() {
    SupportWish feet;
    for (const Dof dof : dofs_of(dimension_)) feet.fixed.push_back(dof);
    std::vector<int> open = feet_;
    std::optional<Input> feet_place;
    if (const auto supports = body_.find("supports"))
      for (const auto& [name, node] : supports->entries()) {
        if (name == "feet" && !feet_.empty()) {
          feet = words_.support(node);
          feet_place.emplace(node);
          continue;
        }
        const int at = node_at_key(name, node);
        std::erase(open, at);
        add_support(words_.support(node), name, {at}, node);
      }
    if (!open.empty()) add_support(feet, "feet", open, feet_place ? *feet_place : *body_.find("grid"));

    // A spring to the ground stands on a support too; one at a support moves as the support does.
    for (const int node : grounded_) {
      const auto holds = [&](const std::vector<int>& nodes) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
      const auto of_group = [&](const FrameSupport& group) { return holds(group.nodes); };
      if (!holds(common_) && std::none_of(model_.supports.begin(), model_.supports.end(), of_group)) common_.push_back(node);
    }
    if (!common_.empty()) model_.supports.insert(model_.supports.begin(), {.name = "", .nodes = common_});
    if (model_.supports.empty()) body_.fail("nothing holds the frame to the ground; type supports: {a: fixed}");
  }

  // Floors.

  void read_floor(const Input& node) {
    node.only_keys({"nodes", "elevation", "rigid", "label"});
    FrameFloor floor;
    const Input list = node.at("nodes", "[b, c]");
    floor.nodes = nodes_of(list);
    for (std::size_t i = 0; i < floor.nodes.size(); ++i)
      for (const FrameFloor* other : all_with(floor, i))
        list.items()[i].fail(other == &floor ? std::string("stands twice in this floor; keep it once")
                                             : fmt::format("belongs to floor {} already", other->label));
    floor.elevation = model_.frame.position(floor.nodes.front()).z();
    if (const auto elevation = node.find("elevation")) floor.elevation = elevation->as_quantity(dimension::length) + origin_.z();
    const auto label = node.find("label");
    floor.label = label ? label->as_text() : std::to_string(model_.floors.size() + 1);
    for (const FrameFloor& other : model_.floors)
      if (other.label == floor.label) (label ? *label : node).fail(fmt::format("two floors have the label {}; choose another one", floor.label));
    if (!model_.floors.empty() && floor.elevation <= model_.floors.back().elevation)
      node.fail(fmt::format("floors stand in the order from the ground up, and this one at {} is not above floor {} at {}",
                            height(floor.elevation), model_.floors.back().label, height(model_.floors.back().elevation)));
    const auto rigid = node.find("rigid");
    const bool is_rigid = rigid ? rigid->as_bool() : dimension_ == 3;
    const std::vector<double> equal(floor.nodes.size(), 1.0);
    model_.floors.push_back(std::move(floor));
    floor_places_.push_back({node, is_rigid, equal});
  }

  static std::string height(double z) { return format_quantity(z, dimension::length); }

  // The floors that hold the i-th node of this one beside that place.
  std::vector<const FrameFloor*> all_with(const FrameFloor& floor, std::size_t i) const {
    const auto end = floor.nodes.begin() + static_cast<std::ptrdiff_t>(i);
    std::vector<const FrameFloor*> found;
    if (std::find(floor.nodes.begin(), end, floor.nodes[i]) != end) found.push_back(&floor);
    for (const FrameFloor& other : model_.floors)
      if (std::find(other.nodes.begin(), other.nodes.end(), floor.nodes[i]) != other.nodes.end()) found.push_back(&other);
    return found;
  }

  void make_floors_rigid() {
    for (std::size_t f = 0; f < model_.floors.size(); ++f)
      if (floor_places_[f].rigid) make_rigid(model_.floors[f], floor_places_[f]);
  }

  void make_rigid(FrameFloor& floor, const FloorPlace& from) {
    Frame& frame = model_.frame;
    double lowest = frame.position(floor.nodes.front()).z(), highest = lowest;
    double mass = 0;
    for (const int node : floor.nodes) {
      lowest = std::min(lowest, frame.position(node).z());
      highest = std::max(highest, frame.position(node).z());
      mass += node_mass_[node];
    }
    // The tie takes horizontal arms only.
    if (highest - lowest > 1e-9 * (1 + std::abs(highest)))
      from.place.fail(fmt::format("a rigid floor is level, and its nodes lie from {} to {}; type rigid: false", height(lowest), height(highest)));
    std::vector<int> followers = floor.nodes;
    if (dimension_ == 2) {
      floor.master = followers.front();
      followers.erase(followers.begin());
    } else {
      Vector3d centre(0, 0, 0);
      double whole = 0;
      for (std::size_t i = 0; i < floor.nodes.size(); ++i) {
        const double weight = mass > 0 ? node_mass_[floor.nodes[i]] : from.weights[i];
        centre += weight * frame.position(floor.nodes[i]);
        whole += weight;
      }
      centre /= whole;
      centre.z() = lowest;
      floor.master = frame.add_node(centre, "floor " + floor.label);
      model_.node_places.push_back(from.place);
      frame.fix(floor.master, {Dof::uz, Dof::rx, Dof::ry});
    }
    placed(from.place, [&] { frame.tie_floor(floor.master, followers); });
  }

  // The rest.

  void read_gravity() {
    const auto geometry = body_.find("geometry"), gravity = body_.find("gravity");
    if (geometry) {
      const std::string choice = geometry->as_choice("geometry", {"linear", "p_delta", "corotational"});
      model_.p_delta = choice == "p_delta";
      model_.corotational = choice == "corotational";
    }
    model_.gravity = gravity ? gravity->as_bool() : model_.loads || model_.p_delta;
    model_.loads = model_.loads || model_.gravity;
    if (model_.p_delta && !model_.loads)
      geometry->fail("p_delta needs forces at rest, and nothing acts; type gravity: true, or give loads");
  }

  std::vector<int> read_wish(const Input& node, std::string_view what, const std::map<std::string, int>& known,
                             int all) const {
    std::vector<int> numbers(all);
    std::iota(numbers.begin(), numbers.end(), 0);
    if (node.is_scalar()) {
      if (node.as_text() != "all") node.fail(fmt::format("takes all, or a list of {0}s; type {0}s: [a, b]", what));
      return numbers;
    }
    numbers.clear();
    std::vector<std::string> names;
    for (const auto& [name, number] : known) names.push_back(name);
    for (const Input& item : node.items()) {
      const auto found = known.find(item.as_text());
      if (found == known.end()) item.fail(unknown_name(what, item.as_text(), names));
      numbers.push_back(found->second);
    }
    return numbers;
  }

  void read_report() {
    const auto report = body_.find("report");
    if (report) report->only_keys({"nodes", "members"});
    const auto nodes = report ? report->find("nodes") : std::nullopt, members = report ? report->find("members") : std::nullopt;
    if (nodes) {
      model_.reported_nodes = read_wish(*nodes, "node", nodes_, model_.given_nodes);
    } else if (model_.given_nodes <= max_reported) {
      model_.reported_nodes.resize(model_.given_nodes);
      std::iota(model_.reported_nodes.begin(), model_.reported_nodes.end(), 0);
    }
    if (members) model_.reported_members = read_wish(*members, "member", members_, model_.frame.members());
  }

  const Input& body_;
  FrameParser words_;
  int dimension_ = words_.dimension();
  SectionLibrary library_;
  FrameModel model_;
  Vector3d origin_ = Vector3d::Zero();
  BeamMass mass_kind_ = BeamMass::lumped;
  std::map<std::string, int> nodes_, members_;
  std::vector<double> node_mass_;          // that was given along x
  std::vector<int> feet_, common_, grounded_;  // of the grid; supports without a motion of their own; under springs
  std::vector<FloorPlace> floor_places_;
};

}  // namespace

FrameModel read_frame(const Input& body) {
  body.only_keys({"dimension", "origin", "material", "materials", "sections", "grid", "nodes", "members", "supports",
                  "floors", "masses", "loads", "springs", "ties", "mass", "gravity", "geometry", "report", "damping",
                  "initial_velocity", "initial_displacement"});
  return Reader(body).read();
}

void fail_at_part(const std::string& refusal, const FrameModel& model, const Input& body) {
  for (int node = 0; node < model.frame.nodes(); ++node)
    if (refusal.starts_with(fmt::format("node {}: ", model.frame.node_name(node)))) model.node_places[node].fail(refusal);
  for (int member = 0; member < model.frame.members(); ++member)
    if (refusal.starts_with(fmt::format("member {}: ", model.frame.member_name(member)))) model.member_places[member].fail(refusal);
  body.fail(refusal);
}

}  // namespace pounding
