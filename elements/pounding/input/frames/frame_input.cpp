#include <pounding/input/frames/frame_input.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/input/frames/fibre_member_input.hpp>
#include <pounding/input/frames/frame_parts_input.hpp>
#include <pounding/input/frames/hinge_input.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

// Reads all parts of a frame.
class FrameReader {
 public:
  explicit FrameReader(const Input& body) : body_(body), parts_(body) {}

  FrameInput read() {
    if (const auto masses = body_.find("masses"))
      for (const auto& [name, node] : masses->entries()) read_mass(parts_.node_at_key(name, node), node);
    if (const auto loads = body_.find("loads"))
      for (const auto& [name, node] : loads->entries()) read_load(parts_.node_at_key(name, node), node);
    if (const auto springs = body_.find("springs"))
      for (const Input& node : springs->items()) read_spring(node);
    read_supports();
    if (const auto ties = body_.find("ties"))
      for (const Input& node : ties->items()) read_tie(node);
    const auto grid = body_.find("grid");
    for (std::size_t i = 0; grid && i < model_.floors.size(); ++i)
      add_floor_location(*grid, grid->find("rigid_floors"));
    if (const auto floors = body_.find("floors"))
      for (const Input& node : floors->items()) read_floor(node);
    make_floors_rigid();
    if (const auto hinges = body_.find("hinges")) read_hinges(*hinges, parts_.frame);
    read_gravity();
    if (const auto fibres = body_.find("fibres")) read_fibre_members(*fibres, model_);
    read_report();
    model_.move_by(parts_.origin());
    return std::move(parts_.frame);
  }

 private:
  struct FloorLocation {
    Input location;
    bool rigid;
    std::vector<double> weights;  // of the nodes if they have no masses
  };

  void read_mass(int node, const Input& value) {
    if (!value.is_map()) {
      const double mass = value.as_quantity();
      return placed(value, [&] { model_.frame.add_mass(node, mass); });
    }
    for (const auto& [key, each] : value.entries()) {
      const Dof dof = parts_.keys().dof_at_key(key, each);
      const double mass = each.as_quantity();
      placed(each, [&] { model_.frame.add_mass(node, dof, mass); });
    }
  }

  void read_load(int node, const Input& value) {
    if (!value.is_map()) value.fail("takes forces by direction; type {uz: -10 kN}");
    for (const auto& [key, each] : value.entries()) {
      const Dof dof = parts_.keys().dof_at_key(key, each);
      placed(each, [&, &load = each] { model_.frame.add_load(node, dof, load.as_quantity()); });
    }
  }

  void read_spring(const Input& node) {
    node.only_keys();
    const bool is_on_ground = node.chosen() == "node";
    const auto at = node.find("node"), between = node.find("between");
    const Dof dof = parts_.keys().dof(node.at("dof"));
    const auto stiffness = node.find("stiffness"), damping = node.find("damping");
    if (!stiffness && !damping) node.fail("stiffness and damping are missing; type stiffness: 1 MN/m");
    const auto acts_in = node.find("acts_in");
    const bool lifts = acts_in && acts_in->as_choice() == "compression";
    if (lifts && (between || dof != Dof::uz || !stiffness))
      acts_in->fail_at_key(
          "applies to a spring between the ground and a node along uz, as in {node: a, dof: uz, stiffness: 200 MN/m, "
          "acts_in: compression}");
    const double k = stiffness ? stiffness->as_quantity(of_spring(dof)) : 0;
    if (lifts && !(k > 0)) stiffness->fail("must be positive for a spring that acts in compression");
    const double c = damping ? damping->as_quantity(of_dashpot(dof)) : 0;
    if (is_on_ground) {
      const int a = parts_.node_of(*at);
      return placed(node, [&] {
        if (lifts) {
          model_.uplifts.push_back({a, k});
          parts_.frame.uplift_locations.push_back(node);
        } else if (stiffness) {
          model_.frame.add_spring(a, dof, k);
        }
        if (damping) model_.frame.add_dashpot(a, dof, c);
      });
    }
    if (!between->is_list() || between->items().size() != 2) between->fail("takes two nodes; type between: [a, b]");
    const int a = parts_.node_of(between->items()[0]), b = parts_.node_of(between->items()[1]);
    placed(node, [&] {
      if (stiffness) model_.frame.add_spring(a, b, dof, k);
      if (damping) model_.frame.add_dashpot(a, b, dof, c);
    });
  }

  void read_tie(const Input& node) {
    node.only_keys();
    const Input at = node.at("master");
    const int master = parts_.node_of(at);
    const std::vector<int> nodes = parts_.nodes_of(node.at("nodes"));
    const auto dofs = node.find("dofs"), rigid = node.find("rigid");
    if (node.chosen() == "rigid" && !rigid->as_bool())
      rigid->fail("leaves the degrees of freedom open; type rigid: true, or dofs: [ux]");
    for (const int each : nodes)
      placed(node, [&] {
        if (dofs)
          model_.frame.tie(master, each, parts_.keys().dofs(*dofs));
        else
          model_.frame.tie_rigidly(master, each);
      });
  }

  void add_support(const SupportWish& wish, const std::string& name, const std::vector<int>& nodes,
                   const Input& location) {
    for (const int node : nodes)
      placed(location, [&] {
        model_.frame.fix(node, wish.fixed);
        for (const auto& [dof, stiffness] : wish.springs) model_.frame.add_spring(node, dof, stiffness);
        for (const auto& [dof, damping] : wish.dashpots) model_.frame.add_dashpot(node, dof, damping);
      });
    if (wish.isolator)
      for (const int node : nodes) {
        model_.isolators.push_back({node, *wish.isolator});
        parts_.frame.isolator_locations.push_back(location.at("isolator"));
      }
    if (wish.delay > 0 || wish.motion)
      model_.supports.push_back({name, nodes, wish.delay, wish.motion});
    else
      common_.insert(common_.end(), nodes.begin(), nodes.end());
  }

  void read_supports() {
    SupportWish of_feet;
    for (const Dof dof : dofs_of(parts_.dimension())) of_feet.fixed.push_back(dof);
    const std::vector<int>& feet = parts_.grid().feet;
    std::vector<int> open = feet;
    std::optional<Input> feet_location;
    const auto supports = body_.find("supports");
    if (supports && supports->is_scalar()) {
      if (supports->as_text() != "none")
        supports->fail(fmt::format(
            "takes supports by node such as {{a: fixed}}, with feet for all feet of a grid, or none; \"{}\" was read",
            supports->as_text()));
      model_.is_free = true;
      return;
    }
    if (supports)
      for (const auto& [name, node] : supports->entries()) {
        if (name == "feet" && !feet.empty()) {
          of_feet = parts_.keys().support(node);
          feet_location.emplace(node);
          continue;
        }
        const int at = parts_.node_at_key(name, node);
        std::erase(open, at);
        add_support(parts_.keys().support(node), name, {at}, node);
      }
    if (!open.empty()) add_support(of_feet, "feet", open, feet_location ? *feet_location : *body_.find("grid"));
    if (!common_.empty()) model_.supports.insert(model_.supports.begin(), {.name = "", .nodes = common_});
  }

  void read_floor(const Input& node) {
    node.only_keys();
    FrameFloor floor;
    const Input list = node.at("nodes");
    floor.nodes = parts_.nodes_of(list);
    for (std::size_t i = 0; i < floor.nodes.size(); ++i)
      for (const FrameFloor* other : all_with(floor, i))
        list.items()[i].fail(other == &floor ? std::string("is in this floor twice; keep it once")
                                             : fmt::format("already belongs to floor {}", other->label));
    floor.elevation = model_.frame.position(floor.nodes.front()).z();
    if (const auto elevation = node.find("elevation")) floor.elevation = elevation->as_quantity();
    const auto label = node.find("label");
    floor.label = label ? label->as_text() : std::to_string(model_.floors.size() + 1);
    for (const FrameFloor& other : model_.floors)
      if (other.label == floor.label)
        (label ? *label : node)
            .fail(fmt::format("the label {} is already used by another floor; choose another label", floor.label));
    if (!model_.floors.empty() && floor.elevation <= model_.floors.back().elevation)
      node.fail(fmt::format("floors are listed from the ground up, but this one at {} is not above floor {} at {}",
                            height(floor.elevation), model_.floors.back().label,
                            height(model_.floors.back().elevation)));
    model_.floors.push_back(std::move(floor));
    add_floor_location(node, node.find("rigid"));
  }

  // Stores the location of the last floor. Floors in space are rigid by default.
  void add_floor_location(const Input& location, const std::optional<Input>& rigid) {
    const bool of_grid = floor_locations_.size() < grid_floors_;
    floor_locations_.push_back({location, rigid ? rigid->as_bool() : parts_.dimension() == 3,
                                of_grid ? parts_.grid().weights : std::vector<double>{}});
  }

  std::string height(double z) const { return format_quantity(z + parts_.origin().z(), dimension::length); }

  // Floors that contain the i-th node of this floor, apart from that entry.
  std::vector<const FrameFloor*> all_with(const FrameFloor& floor, std::size_t i) const {
    const auto end = floor.nodes.begin() + static_cast<std::ptrdiff_t>(i);
    std::vector<const FrameFloor*> found;
    if (std::find(floor.nodes.begin(), end, floor.nodes[i]) != end) found.push_back(&floor);
    for (const FrameFloor& other : model_.floors)
      if (std::find(other.nodes.begin(), other.nodes.end(), floor.nodes[i]) != other.nodes.end())
        found.push_back(&other);
    return found;
  }

  void make_floors_rigid() {
    for (std::size_t i = 0; i < model_.floors.size(); ++i) {
      const FloorLocation& from = floor_locations_[i];
      if (!from.rigid) continue;
      placed(from.location, [&] { make_floor_rigid(model_, static_cast<int>(i), from.weights); });
      // In space a rigid floor has a master node.
      if (model_.frame.nodes() > static_cast<int>(parts_.frame.node_locations.size()))
        parts_.frame.node_locations.push_back(from.location);
    }
  }

  void read_gravity() {
    const auto geometry = body_.find("geometry"), gravity = body_.find("gravity");
    if (geometry) {
      const std::string choice = geometry->as_choice();
      model_.geometry = choice == "p_delta"        ? FrameGeometry::p_delta
                        : choice == "corotational" ? FrameGeometry::corotational
                                                   : FrameGeometry::linear;
    }
    if (gravity) model_.gravity = gravity->as_bool();
    balance_loaded_mass(model_, parts_.grid());
    if (geometry) placed(*geometry, [&] { model_.check_geometry(); });
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
    if (!report) return;
    report->only_keys();
    if (const auto nodes = report->find("nodes"))
      model_.reported_nodes = read_wish(*nodes, "node", parts_.node_numbers(), model_.given_nodes());
    if (const auto members = report->find("members"))
      model_.reported_members = read_wish(*members, "member", parts_.member_numbers(), model_.frame.members());
  }

  const Input& body_;
  FramePartsInput parts_;
  FrameModel& model_ = parts_.frame.model;
  std::size_t grid_floors_ = model_.floors.size();
  std::vector<int> common_;  // supports without a separate motion
  std::vector<FloorLocation> floor_locations_;
};

// Fails at the hinge, isolator, spring, node or member with which the message begins, else at the frame.
[[noreturn]] void fail_at_part(const std::string& refusal, const FrameInput& from, const Input& body) {
  const Frame& frame = from.model.frame;
  const auto fail_at_named = [&](const std::vector<Input>& locations, std::string_view kind, const auto& name_of) {
    for (int i = 0; i < static_cast<int>(locations.size()); ++i) {
      const std::string name = fmt::format("{} {}", kind, name_of(i));
      // An isolator in space has one part per axis: "isolator a x: ".
      if (refusal.starts_with(name + ": ") || (kind == "isolator" && refusal.starts_with(name + " ")))
        locations[i].fail(refusal);
    }
  };
  fail_at_named(from.hinge_locations, "hinge", [&](int i) { return frame.hinge_name(i); });
  fail_at_named(from.isolator_locations, "isolator",
                [&](int i) { return frame.node_name(from.model.isolators[i].node); });
  fail_at_named(from.uplift_locations, "support", [&](int i) { return frame.node_name(from.model.uplifts[i].node); });
  fail_at_named(from.node_locations, "node", [&](int i) { return frame.node_name(i); });
  fail_at_named(from.member_locations, "member", [&](int i) { return frame.member_name(i); });
  body.fail(refusal);
}

}  // namespace

FrameInput read_frame(const Input& node) {
  const Input body = node.in(keys::frame);
  body.only_keys();
  return FrameReader(body).read();
}

Structure read_frame_structure(const Input& body) {
  const FrameInput read = read_frame(body);
  try {
    return make_structure(read.model);
  } catch (const std::invalid_argument& error) {
    fail_at_part(error.what(), read, body);
  }
}

}  // namespace pounding
