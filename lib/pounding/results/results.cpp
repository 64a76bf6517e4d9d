#include <pounding/results/results.hpp>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/results/parts_file.hpp>
#include <pounding/results/replaced_file.hpp>

namespace pounding {
namespace {

using namespace hdf5;

template <class Histories>
void check_names(const Histories& histories, const std::string& kind) {
  std::set<std::string_view> seen;
  for (const auto& history : histories) {
    const std::string& name = history.name;
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
      throw InputError(kind + " name \"" + name +
                       "\" cannot be the name of a group in the results file: type a name that is not empty, \".\" or "
                       "\"..\" and has no '/' in it.");
    if (!seen.insert(name).second)
      throw InputError("two " + kind + "s have the name \"" + name + "\": type a different name for each.");
  }
}

using Names = std::vector<std::string>;

// Names of floors accompany their numbers; names of nodes may be too many for an attribute.
void write_motion(hid_t place, const std::string& name, std::size_t places, const Names* floors,
                  const Names& directions, std::size_t samples,
                  const std::array<const std::vector<double>*, 3>& histories) {
  const Label labels[] = {{"displacement", "m", "displacement relative to the ground"},
                          {"velocity", "m/s", "velocity relative to the ground"},
                          {"acceleration", "m/s^2", "absolute acceleration"}};
  for (int i = 0; i < 3; ++i) {
    check_length(histories[i]->size(), samples * places * directions.size(), name + ": " + labels[i].name);
    const Handle made = array(place, labels[i], *histories[i], {samples, places, directions.size()});
    if (floors) attribute(made, "floors", *floors);
    attribute(made, "directions", directions);
  }
}

void write_geometry(hid_t parent, const Geometry& geometry) {
  const Handle place = group(parent, "geometry");
  std::vector<double> nodes;
  for (const Eigen::Vector3d& p : geometry.positions) nodes.insert(nodes.end(), p.begin(), p.end());
  array(place, {"nodes", "m", "undeformed positions of the nodes: x, y, z"}, nodes, {geometry.positions.size(), 3});
  std::vector<int> members;
  for (const auto& ends : geometry.members) members.insert(members.end(), ends.begin(), ends.end());
  integers(place, {"members", "1", "nodes of the members, counted from 0"}, members, {geometry.members.size(), 2});
  integers(place, {"floor_of_node", "1", "floor of each node, counted from 0 at the lowest; -1 for none"},
           geometry.floor_of_node, {geometry.floor_of_node.size()});
  texts(place, "node_names", "names of the nodes", geometry.node_names);
  texts(place, "member_names", "names of the members", geometry.member_names);
}

void write_structure(hid_t parent, const StructureHistory& history, std::size_t samples) {
  const Handle place = group(parent, history.name);
  const std::size_t floors = history.floors.size();
  attribute(place, "kind", history.kind);
  attribute(place, "dimension", history.dimension);
  attribute(place, "floors", history.floors);
  attribute(place, "elevations", history.elevations);
  attribute(place, "directions", history.directions);
  if (!history.plans.empty())
    array(place,
          {"plan", "m",
           "extent of rigid floors about the point whose motion is reported: smallest x, largest x, smallest y, "
           "largest y"},
          history.plans, {floors, 4});
  write_motion(place, history.name, floors, &history.floors, history.directions, samples,
               {&history.displacement, &history.velocity, &history.acceleration});

  const std::size_t directions = history.storey_directions();
  const auto storey = [&](const Label& label, const std::vector<double>& values) {
    const std::size_t storeys = values.empty() ? 0 : floors;
    check_length(values.size(), samples * storeys * directions, history.name + ": " + label.name);
    const Handle made = directions == 1 ? array(place, label, values, {samples, storeys})
                                        : array(place, label, values, {samples, storeys, directions});
    attribute(made, "floors", storeys == 0 ? Names{} : history.floors);
  };
  storey({"drift", "m", "storey drift: displacement relative to the floor below"}, history.drift);
  storey({"storey_shear", "N", "shear force of the storey below the floor"}, history.storey_shear);
  if (!history.storey_shear.empty()) {
    std::vector<double> lowest;
    for (std::size_t t = 0; t < samples; ++t)
      for (std::size_t j = 0; j < directions; ++j) lowest.push_back(history.storey_shear[t * floors * directions + j]);
    array(place, {"base_shear", "N", "shear force of the lowest storey"}, lowest, {samples, directions});
  }
  if (!history.nodes.empty()) {
    const Handle nodes = group(place, "nodes");
    texts(nodes, "names", "names of the nodes", history.nodes);
    write_motion(nodes, history.name, history.nodes.size(), nullptr, history.node_directions, samples,
                 {&history.node_displacement, &history.node_velocity, &history.node_acceleration});
  }
  if (!history.members.empty()) {
    const Handle members = group(place, "members");
    texts(members, "names", "names of the members", history.members);
    check_length(history.end_forces.size(), samples * history.members.size() * history.member_components.size(),
                 history.name + ": end forces");
    const Handle made =
        array(members, {"end_forces", "N", "forces [N] and moments [N m] on the ends of members, local axes"},
              history.end_forces, {samples, history.members.size(), history.member_components.size()});
    attribute(made, "components", history.member_components);
    attribute(made, "gravity_included", static_cast<int>(history.envelope.with_gravity));
    attribute(made, "included", history.envelope.included);
  }
  if (const Names& supports = history.envelope.supports; !supports.empty()) {
    const Handle reactions = group(place, "reactions");
    texts(reactions, "names", "names of the nodes", supports);
    const Names& along = history.envelope.directions;
    check_length(history.reaction.size(), samples * supports.size() * along.size(), history.name + ": reactions");
    const Handle made =
        array(reactions, {"force", "N", "forces [N] and moments [N m] of the ground on the structure, without damping"},
              history.reaction, {samples, supports.size(), along.size()});
    attribute(made, "directions", along);
    attribute(made, "gravity_included", static_cast<int>(history.envelope.with_gravity));
    attribute(made, "included", history.envelope.included);
  }
  write_springs(place, history.name, history.springs, samples);
  if (!history.geometry.positions.empty()) write_geometry(place, history.geometry);
}

/// A list of an object and its dataset.
template <class T>
struct ListField {
  Label label;
  std::vector<double> T::* values;
};

constexpr ListField<LinkHistory> link_fields[] = {
    {{"time", "s", "time, dense inside contacts"}, &LinkHistory::time},
    {{"penetration", "m", "penetration, positive when overlapping, negative when open"}, &LinkHistory::penetration},
    {{"velocity", "m/s", "rate of the penetration, positive when closing"}, &LinkHistory::velocity},
    {{"force", "N", "contact force, positive when it pushes apart"}, &LinkHistory::force},
    {{"energy", "J", "work done on the link, stored and lost"}, &LinkHistory::energy},
};

constexpr ListField<EnergyHistory> energy_fields[] = {
    {{"time", "s", "time"}, &EnergyHistory::time},
    {{"input", "J",
      "relative input energy: work of -M r ag and of forces on the motion relative to the ground, and the energy "
      "at the start"},
     &EnergyHistory::input},
    {{"kinetic", "J", "kinetic energy of the motion relative to the ground"}, &EnergyHistory::kinetic},
    {{"strain", "J", "elastic energy"}, &EnergyHistory::strain},
    {{"damping", "J", "energy dissipated by the damping of the structures"}, &EnergyHistory::damping},
    {{"hysteretic", "J", "energy dissipated by yielding"}, &EnergyHistory::hysteretic},
    {{"impact", "J", "work done on the links: lost, and stored while they press"}, &EnergyHistory::impact},
    {{"devices", "J", "energy dissipated by dampers"}, &EnergyHistory::devices},
    {{"error", "J", "input minus all other parts"}, &EnergyHistory::error},
};

/// Visits the fields that the file has.
template <class Visit>
void visit_energy(const Results& results, Visit&& visit) {
  for (const ListField<EnergyHistory>& field : energy_fields)
    if (field.values != &EnergyHistory::devices || results.has_devices()) visit(field);
}

/// Writes the lists of an object, all as long as its time.
template <class T>
void write_list(hid_t place, const ListField<T>& field, const T& object, const std::string& name) {
  const std::vector<double>& values = object.*field.values;
  check_length(values.size(), object.time.size(), name + ": " + field.label.name);
  array(place, field.label, values, {values.size()});
}

void write_link(hid_t parent, const LinkHistory& history) {
  const Handle place = group(parent, history.name);
  attribute(place, "gap", history.gap);
  attribute(place, "gap_units", std::string("m"));
  attribute(place, "largest_opening", history.largest_opening);
  attribute(place, "largest_opening_units", std::string("m"));
  attribute(place, "t_opening", history.t_opening);
  attribute(place, "t_opening_units", std::string("s"));
  attribute(place, "seat", history.seat);
  attribute(place, "seat_units", std::string("m"));
  attribute(place, "law", history.law);
  write_ends(place, history);

  for (const auto& field : link_fields) write_list(place, field, history, history.name);
  if (history.tangents == 0) return;
  const std::size_t tangents = history.tangents;
  check_length(history.friction.size(), history.time.size() * tangents, history.name + ": friction");
  array(place,
        {"friction", "N",
         "friction force on the left body, opposite to its sliding: along the edge, then up; in the plane up only"},
        history.friction, {history.time.size(), tangents});
}

struct ImpactField {
  Label label;
  double ImpactRow::* value;
};

constexpr ImpactField impact_fields[] = {
    {{"t_start", "s", "touch"}, &ImpactRow::t_start},
    {{"t_end", "s", "separation"}, &ImpactRow::t_end},
    {{"t_release", "s", "the force fell to zero for the last time"}, &ImpactRow::t_release},
    {{"v_approach", "m/s", "closing speed at touch"}, &ImpactRow::v_approach},
    {{"v_separation", "m/s", "opening speed at separation"}, &ImpactRow::v_separation},
    {{"restitution", "1", "v_separation / v_approach, NaN for a touch at rest"}, &ImpactRow::restitution},
    {{"peak_force", "N", "largest contact force"}, &ImpactRow::peak_force},
    {{"t_peak", "s", "time of the largest contact force"}, &ImpactRow::t_peak},
    {{"peak_penetration", "m", "largest penetration"}, &ImpactRow::peak_penetration},
    {{"impulse", "N s", "integral of the contact force"}, &ImpactRow::impulse},
    {{"energy_lost", "J", "energy dissipated by the link"}, &ImpactRow::energy_lost},
    {{"energy_stored", "J", "recoverable energy of a contact that is still closed; otherwise zero"},
     &ImpactRow::energy_stored},
};

/// One table with one row per impact: the name of the link as fixed-length text, then the numbers.
void write_impacts(hid_t file, const Results& results) {
  std::size_t name_size = 1;
  for (const LinkHistory& link : results.links) name_size = std::max(name_size, link.name.size());
  const std::size_t fields = std::size(impact_fields);
  const std::size_t row_size = name_size + fields * sizeof(double);

  const Handle row(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "create the type of an impact");
  checked(H5Tinsert(row, "link", 0, hdf5::text_type(name_size)), "add link to the type of an impact");
  std::vector<std::string> units{"text"}, long_names{"name of the link"};
  for (std::size_t i = 0; i < fields; ++i) {
    const Label& label = impact_fields[i].label;
    checked(H5Tinsert(row, label.name, name_size + i * sizeof(double), H5T_NATIVE_DOUBLE),
            std::string("add ") + label.name + " to the type of an impact");
    units.emplace_back(label.units);
    long_names.emplace_back(label.long_name);
  }

  std::vector<std::byte> table(results.impacts.size() * row_size);
  std::byte* place = table.data();
  for (const ImpactRow& impact : results.impacts) {
    if (impact.link < 0 || static_cast<std::size_t>(impact.link) >= results.links.size())
      throw std::invalid_argument("an impact refers to link " + std::to_string(impact.link) + "; there are " +
                                  std::to_string(results.links.size()) + " links, counted from 0");
    const std::string& name = results.links[static_cast<std::size_t>(impact.link)].name;
    std::memcpy(place, name.data(), name.size());
    for (std::size_t i = 0; i < fields; ++i)
      std::memcpy(place + name_size + i * sizeof(double), &(impact.*impact_fields[i].value), sizeof(double));
    place += row_size;
  }

  hdf5::table(file, "impacts", "impacts in order of touch", row, results.impacts.size(), table.data(), units,
              long_names);
}

void write_checkpoint(hid_t file, const Results& results) {
  const Checkpoint& checkpoint = *results.checkpoint;
  const Handle place = group(file, "checkpoint");
  attribute(place, "ground", checkpoint.ground);
  text(place, "model_file", "absolute path of the input file", checkpoint.model_file);
  text(place, "options", "PETSc options that affect the results",
       fmt::format("{}", fmt::join(checkpoint.options, "\n")));
  bytes(place, "state", "state of the program that wrote it", checkpoint.state);
}

// The run without links shares the input of the enclosing file.
const std::set<std::string> without_pounding_leaves_out{"input"};

// Visits every history once, for reading, writing and comparing.
template <class AnyResults, class Visit>
void visit_all(AnyResults& results, Visit&& visit) {
  visit("time", results.time);
  visit("ground/acceleration", results.ground_acceleration);
  if (results.shakes_y) visit("ground/acceleration_y", results.ground_acceleration_y);
  if (results.shakes_z) visit("ground/acceleration_z", results.ground_acceleration_z);
  for (auto& s : results.structures) {
    const std::string place = "structures/" + s.name + '/';
    visit(place + "displacement", s.displacement);
    visit(place + "velocity", s.velocity);
    visit(place + "acceleration", s.acceleration);
    visit(place + "drift", s.drift);
    visit(place + "storey_shear", s.storey_shear);
    if (!s.nodes.empty()) {
      visit(place + "nodes/displacement", s.node_displacement);
      visit(place + "nodes/velocity", s.node_velocity);
      visit(place + "nodes/acceleration", s.node_acceleration);
    }
    if (!s.members.empty()) visit(place + "members/end_forces", s.end_forces);
    if (!s.envelope.supports.empty()) visit(place + "reactions/force", s.reaction);
    if (s.springs.size() > 0) {
      visit(place + "springs/deformation", s.springs.deformation);
      visit(place + "springs/force", s.springs.force);
      visit(place + "springs/hysteretic", s.springs.hysteretic);
    }
  }
  for (auto& link : results.links) {
    const std::string place = "links/" + link.name + '/';
    for (const auto& field : link_fields) visit(place + field.label.name, link.*field.values);
    if (link.tangents > 0) visit(place + "friction", link.friction);
  }
  for (auto& device : results.devices) {
    visit("devices/" + device.name + "/elongation", device.elongation);
    visit("devices/" + device.name + "/force", device.force);
  }
  visit_energy(results, [&](const auto& field) {
    visit(std::string("energy/") + field.label.name, results.energy.*field.values);
  });
}

void write_all(hid_t file, const Results& results) {
  check_names(results.structures, "structure");
  check_names(results.links, "link");
  check_names(results.devices, "device");
  attribute(file, "program", results.program);
  attribute(file, "version", results.version);
  attribute(file, "created", results.created);
  attribute(file, "title", results.title);
  attribute(file, "command", results.command);
  attribute(file, "status", results.status);

  const Handle input = group(file, "input");
  text(input, "model.yaml", "input as given", results.model_yaml);
  text(input, "resolved.yaml", "input with every default and calibrated parameter", results.resolved_yaml);

  array(file, {"time", "s", "output times"}, results.time, {results.time.size()});
  const Handle ground = group(file, "ground");
  const auto along = [&](const char* name, const char* long_name, const std::vector<double>& values) {
    check_length(values.size(), results.time.size(), "ground acceleration");
    array(ground, {name, "m/s^2", long_name}, values, {values.size()});
  };
  along("acceleration", "acceleration of the ground at the output times", results.ground_acceleration);
  if (results.shakes_y)
    along("acceleration_y", "ground acceleration along y at the output times", results.ground_acceleration_y);
  if (results.shakes_z)
    along("acceleration_z", "ground acceleration along z at the output times, positive up",
          results.ground_acceleration_z);

  const Handle structures = group(file, "structures");
  for (const StructureHistory& history : results.structures) write_structure(structures, history, results.time.size());
  const Handle links = group(file, "links");
  for (const LinkHistory& history : results.links) write_link(links, history);
  write_devices(file, results.devices, results.time.size());
  write_envelopes(file, results.structures);
  write_impacts(file, results);
  const Handle energy = group(file, "energy");
  visit_energy(results, [&](const auto& field) { write_list(energy, field, results.energy, "energy"); });
  text(file, "summary", "summary as JSON", results.summary_json);
  write_solver(file, results);
  if (!results.no_pounding.empty())
    hdf5::add_file(file, "no_pounding", results.no_pounding, without_pounding_leaves_out);
  if (results.checkpoint) write_checkpoint(file, results);
}

}  // namespace

bool Results::has_devices() const {
  return !devices.empty() || std::ranges::any_of(structures, [](const StructureHistory& s) {
    return std::ranges::any_of(s.springs.laws, [](const std::string& law) { return law.ends_with("damper"); });
  });
}

void visit_histories(Results& results,
                     const std::function<void(const std::string& path, std::vector<double>& values)>& visit) {
  visit_all(results, visit);
}

FileImage results_image(const Results& results) {
  return hdf5::checked_image([&](hid_t file) { write_all(file, results); });
}

FileImage image_to_add(const Results& results) {
  return hdf5::file_image([&](hid_t file) { write_all(file, results); });
}

void write_results(const Results& results, const std::string& path) {
  ReplacedFile(path).replace(results_image(results));
}

}  // namespace pounding
