/// Models from their text: reading, checking, modes, pushovers.

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <pounding/core/units.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/input/pushover_input.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/recording/headings.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include <pounding/results/pushover_file.hpp>
#include <pounding/structures/storey_heights.hpp>

#include "bindings.hpp"
#include "source.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {

py::object plain(const Input& input) {
  if (input.is_map()) {
    py::dict values;
    for (const auto& [key, value] : input.entries()) values[py::str(key)] = plain(value);
    return values;
  }
  if (input.is_list()) {
    py::list values;
    for (const Input& item : input.items()) values.append(plain(item));
    return values;
  }
  if (!input.is_scalar()) return py::none();
  return py::str(input.as_text());
}

namespace {

std::tuple<std::string, std::string, std::vector<std::string>> checked(const Source& source) {
  return with_petsc([&] {
    const Model model = read(source);
    return std::tuple(describe(model), resolved_yaml(model), implausible(model));
  });
}

/// Available quantities of a structure: of floors, of storeys, and of rigid floors in space.
struct MovingStructure {
  std::string name;
  std::size_t floors = 0;
  bool has_storeys = false, has_plans = false;
  std::vector<double> heights;                   ///< of storeys [m]; empty if unknown
  std::vector<std::string> parts, hinges;        ///< names of all yielding parts, and of the hinges among them
  std::vector<std::string> members, components;  ///< of a frame: members, and components of their end forces
};

/// Moving structures, links as (name, is rigid), and the latest arrival time of the ground motion [s].
struct Layout {
  std::vector<MovingStructure> structures;
  std::vector<std::pair<std::string, bool>> links;
  std::vector<std::tuple<std::string, std::string, double>> ends;  ///< [link] structures and gap [m]
  double last_arrival = 0;
};

MovingStructure layout_of(const Structure& s) {
  MovingStructure found{s.name,
                        s.floors.size(),
                        s.has_storeys(),
                        std::ranges::any_of(s.floors, [](const Floor& floor) { return floor.plan.has_value(); }),
                        storey_heights(s),
                        {},
                        {},
                        s.forces.members,
                        s.forces.components};
  for (const YieldingPart& part : s.yielding) {
    found.parts.push_back(part.name);
    if (part.kind == YieldingPart::Kind::hinge) found.hinges.push_back(part.name);
  }
  return found;
}

Layout layout(const Source& source) {
  return with_petsc([&] {
    const Model model = read(source);
    Layout found;
    for (const Structure& s : model.structures)
      if (!s.is_rigid()) found.structures.push_back(layout_of(s));
    for (const Link& link : model.links) {
      found.links.emplace_back(link.name, link.contact->is_rigid());
      found.ends.emplace_back(model.structures[static_cast<std::size_t>(link.left.structure)].name,
                              model.structures[static_cast<std::size_t>(link.right.structure)].name, link.gap);
    }
    found.last_arrival = ground_plan(model).last_arrival;
    return found;
  });
}

/// Modes of one structure, with its geometry for pictures.
struct StructureModes {
  std::string name;
  std::vector<Mode> modes;                        ///< longest period first
  bool is_frame = false;                          ///< motion in x and z or in space; else along x only
  std::vector<std::optional<double>> elevations;  ///< [floor] [m]
  std::vector<Eigen::Vector3d> nodes;             ///< at rest [m]; none without geometry
  std::vector<std::array<int, 2>> members;        ///< numbers of their nodes
  std::vector<Eigen::MatrixX3d> node_shapes;      ///< [mode] displacements of the nodes, to the scale of the mode
};

StructureModes modes_of(const Structure& structure, int count) {
  StructureModes found;
  found.name = structure.name;
  found.is_frame = structure.dimension > 1;
  // An oscillator or a shear building shows all its modes.
  found.modes = modes(structure, found.is_frame ? count : std::numeric_limits<int>::max(), petsc::lowest_modes);
  for (const Floor& floor : structure.floors) found.elevations.push_back(floor.elevation);
  if (!structure.node_translations) return found;
  found.nodes = structure.geometry.positions;
  found.members = structure.geometry.members;
  for (const Mode& mode : found.modes) found.node_shapes.push_back(structure.node_translations(mode.unknowns));
  return found;
}

std::vector<StructureModes> modes_of_all(const Source& source, int count) {
  return with_petsc([&] {
    const Model model = read(source);
    std::vector<StructureModes> found;
    for (const Structure& structure : model.structures) found.push_back(modes_of(structure, count));
    return found;
  });
}

/// Bytes of a results file with the structures, links and devices of a model that was not run.
py::bytes image_at_rest(const Source& source) {
  const FileImage image = with_petsc([&] { return results_image(results_at_rest(read(source))); });
  return {reinterpret_cast<const char*>(image.data()), image.size()};
}

/// The results of a pushover as JSON; written to `output` unless that is empty.
std::string pushed_over(const Source& source, const PushoverInput& words, const std::string& output) {
  return with_petsc([&] {
    const Model model = read(source);
    const Pushover found = pushover(model, words, petsc::lowest_modes);
    if (!output.empty()) write_pushover(output, found, model.source_text);
    return pushover_json(found);
  });
}

/// Value in SI of a number with or without a unit, and its SI unit; no unit for a bare number.
std::pair<double, std::string> value_in_si(const std::string& text) {
  const char* const end = text.data() + text.size();
  const char* begin = text.data();
  while (begin != end && (*begin == ' ' || *begin == '+')) ++begin;
  double number = 0;
  const char* const rest = std::from_chars(begin, end, number).ptr;
  const Unit unit = rest == begin ? Unit{} : parse_unit({rest, end});
  return {parse_quantity(text, unit.dimension), unit_text(unit.dimension)};
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<Source>(module, "Source")
      .def(py::init<std::string, std::string, std::map<std::string, std::string>, bool>(), "text"_a, "name"_a,
           "files"_a = py::dict(), "generated"_a = false)
      .def_readonly("name", &Source::name);
  py::class_<Mode>(module, "Mode")
      .def_readonly("period", &Mode::period)
      .def_readonly("damping_ratio", &Mode::damping_ratio)
      .def_readonly("participation", &Mode::participation)
      .def_readonly("effective_mass", &Mode::effective_mass)
      .def_readonly("shape", &Mode::shape);
  py::class_<StructureModes>(module, "StructureModes")
      .def_readonly("name", &StructureModes::name)
      .def_readonly("modes", &StructureModes::modes)
      .def_readonly("is_frame", &StructureModes::is_frame)
      .def_readonly("elevations", &StructureModes::elevations)
      .def_readonly("nodes", &StructureModes::nodes)
      .def_readonly("members", &StructureModes::members)
      .def_readonly("node_shapes", &StructureModes::node_shapes);
  module.def("read_file", [](const std::string& path) { return Input::read_file(path).text(); });
  module.def("parse", [](const Source& source) { return plain(source.input()); });
  module.def("check", &checked);
  py::class_<MovingStructure>(module, "MovingStructure")
      .def_readonly("name", &MovingStructure::name)
      .def_readonly("floors", &MovingStructure::floors)
      .def_readonly("has_storeys", &MovingStructure::has_storeys)
      .def_readonly("has_plans", &MovingStructure::has_plans)
      .def_readonly("heights", &MovingStructure::heights)
      .def_readonly("parts", &MovingStructure::parts)
      .def_readonly("hinges", &MovingStructure::hinges)
      .def_readonly("members", &MovingStructure::members)
      .def_readonly("components", &MovingStructure::components);
  py::class_<Layout>(module, "Layout")
      .def_readonly("structures", &Layout::structures)
      .def_readonly("links", &Layout::links)
      .def_readonly("ends", &Layout::ends)
      .def_readonly("last_arrival", &Layout::last_arrival);
  module.def("layout", &layout, "source"_a);
  module.def("image_at_rest", &image_at_rest, "source"_a);
  module.def("modes", &modes_of_all, "source"_a, "count"_a);
  module.def(
      "pushover",
      [](const Source& source, const std::string& structure, const std::string& load, const std::string& direction,
         const std::string& to, const std::string& cyclic, const std::string& output) {
        return pushed_over(
            source,
            {.structure = structure, .load = load, .direction = direction, .to = to, .cyclic = cyclic, .mark = ""},
            output);
      },
      "source"_a, "structure"_a, "load"_a, "direction"_a, "to"_a, "cyclic"_a, "output"_a);
  module.def("si_value", &value_in_si, "text"_a);
  module.def(
      "find_record",
      [](const std::string& name, const std::string& folder) { return find_record(name, folder).string(); }, "name"_a,
      "folder"_a);
  module.def("read_record", [](const std::string& path) { return py::bytes(read_text_of_record(path)); }, "path"_a);
}

}  // namespace pounding::python
