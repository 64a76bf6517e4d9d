/// Rows of studies: a model whose text is read once and whose values change from row to row, for the solver and for the
/// kernel.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <pounding/core/archive.hpp>
#include <pounding/input/ground_input.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/separation.hpp>
#include <pounding/structures/storey_heights.hpp>
#include <pounding/study/linear_model.hpp>
#include <pounding/study/modal_form.hpp>
#include "bindings.hpp"
#include "host.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

/// Motion of the ground, read once for many rows.
struct RowMotion {
  GroundSection ground;

  /// Maximum over the records of the fraction of the Arias intensity after a time [s], and of the time by which 95 %
  /// has arrived [s]. Zero for motions in closed form.
  std::pair<double, double> arias_after(double time) const {
    double fraction = 0, t95 = 0;
    for (const GroundMotion& component : ground.components)
      if (const Samples* samples = component.samples()) {
        fraction = std::max(fraction, arias_fraction_after(*samples, time));
        t95 = std::max(t95, measure(*samples).t95);
      }
    return {fraction, t95};
  }

  const GroundMotion& along_x() const { return ground.components[0]; }
  /// True if the kernel supports the motion: evenly spaced from time 0.
  bool is_even() const {
    return along_x().samples() && along_x().sample_step() > 0 && along_x().samples()->times.front() == 0;
  }
  double step() const { return is_even() ? along_x().sample_step() : 0; }
  py::array_t<double> accelerations() const {
    if (!is_even()) return {};
    const std::vector<double>& values = along_x().samples()->accelerations;
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  }
};

/// The motion with all accelerations times `factor`. Throws std::invalid_argument for one in closed form.
GroundMotion times(const GroundMotion& motion, double factor) {
  if (motion.is_still()) return motion;
  if (!motion.samples()) throw std::invalid_argument("only samples can be scaled");
  Samples samples = *motion.samples();
  for (double& a : samples.accelerations) a *= factor;
  const GroundMotion scaled(std::move(samples), motion.source());
  if (motion.initial_velocity() == 0 && motion.initial_displacement() == 0) return scaled;
  return scaled.with_initial_motion(factor * motion.initial_velocity(), factor * motion.initial_displacement());
}

RowMotion times(const RowMotion& motion, double factor) {
  RowMotion scaled = motion;
  for (GroundMotion& component : scaled.ground.components) component = times(component, factor);
  return scaled;
}

using Files = std::map<std::string, std::string>;

RowMotion read_row_motion(const std::string& text, const std::string& name, const Files& files) {
  return {read_ground_section(
      Input::read_text(text, name, std::make_shared<const Files>(files)).in(keys::model).at("ground_motion"))};
}

/// A structure, in the order of the outputs of the kernel.
struct OutputsOfStructure {
  std::string name;
  int floors = 0;
  bool has_storeys = false;
};

/// A link with the inputs of separation rules.
struct EndsOfLink {
  std::string name;
  double correlation = 0;  ///< of the displacements of both ends; NaN where a structure has no period
};

/// One row for the kernel.
struct LinearRow {
  study::LinearModel model;
  study::LinearModel
      alone;  ///< without links; outputs besides: of each link the largest approach, then the peaks of both ends
  std::vector<OutputsOfStructure> structures;
  std::vector<EndsOfLink> links;
  double duration = 0, tolerance = 0;
};

// Outputs of the run without links that follow those of the floors.
void add_separations(const Model& model, LinearRow& row) {
  std::vector<Mode> first;
  for (const Structure& s : model.structures) {
    const std::vector<Mode> lowest = modes(s, 1);
    first.push_back(lowest.empty() ? Mode{} : lowest.front());
  }
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    const Link& link = model.links[l];
    const study::LinkModes& modal = row.model.links[l];
    // Gravity would change the approach as it changes the gap.
    if (modal.gap != link.gap)
      throw std::invalid_argument("this model takes the solver: gravity changes the gap of link " + link.name);
    using Kind = study::Output::Kind;
    row.alone.outputs.push_back({.kind = Kind::closing, .factors = modal.closing});
    std::size_t mode = 0;
    for (const int side : {link.left.structure, link.right.structure}) {
      study::Output end{.kind = Kind::displacement, .factors = std::vector<double>(modal.closing.size(), 0)};
      mode = 0;
      for (int s = 0; s < static_cast<int>(model.structures.size()); ++s) {
        const Structure& structure = model.structures[static_cast<std::size_t>(s)];
        const std::size_t count = structure.is_rigid() ? 0 : static_cast<std::size_t>(count_of_modes(structure));
        for (std::size_t j = mode; s == side && j < mode + count; ++j) end.factors[j] = modal.closing[j];
        mode += count;
      }
      row.alone.outputs.push_back(std::move(end));
    }
    const std::size_t a = static_cast<std::size_t>(link.left.structure),
                      b = static_cast<std::size_t>(link.right.structure);
    const bool by_wall = model.structures[a].is_rigid() || model.structures[b].is_rigid();
    row.links.push_back({link.name, by_wall ? 0
                                            : double_difference(first[a].period, first[a].damping_ratio,
                                                                first[b].period, first[b].damping_ratio)});
  }
}

py::dict numbers_of(const std::vector<StructureSummary>& structures) {
  py::dict found;
  for (const StructureSummary& s : structures)
    found[py::str(s.name)] = py::dict("peak_displacement"_a = s.peak_displacement, "peak_drift"_a = s.peak_drift,
                                      "peak_acceleration"_a = s.peak_acceleration, "peak_rotation"_a = s.peak_rotation,
                                      "peak_edge_displacement"_a = s.peak_edge_displacement);
  return found;
}

/// The part of the summary that rows keep, under the keys of --json.
py::dict numbers_of(const Summary& summary) {
  py::list links, separations;
  for (const LinkSummary& l : summary.links)
    links.append(py::dict("name"_a = l.name, "impacts"_a = l.impacts, "peak_force"_a = l.peak_force,
                          "peak_penetration"_a = l.peak_penetration, "impulse"_a = l.impulse,
                          "energy_lost"_a = l.energy_lost, "largest_opening"_a = l.largest_opening));
  for (const LinkSeparation& s : summary.separations)
    separations.append(py::dict("link"_a = s.link, "enough"_a = s.enough, "left"_a = s.left, "right"_a = s.right,
                                "abs"_a = s.absolute_sum, "srss"_a = s.srss, "ddc"_a = s.ddc));
  return py::dict(
      "status"_a = summary.status, "links"_a = links, "structures"_a = numbers_of(summary.structures),
      "no_pounding"_a = py::dict("status"_a = summary.without_links_status,
                                 "structures"_a = numbers_of(summary.without_pounding), "separations"_a = separations));
}

/// A model and the locations of the values in its text that vary between rows.
class RowModel {
 public:
  RowModel(const std::string& text, const std::string& name, const std::vector<std::vector<std::string>>& places,
           const Files& files)
      : root_(Input::read_text(text, name, std::make_shared<const Files>(files))) {
    for (const std::vector<std::string>& keys : places) {
      Input node = root_;
      for (const std::string& key : keys)
        node = node.is_list() ? Input(node.items().at(std::stoul(key))) : node.at(key);
      places_.push_back(node);
    }
  }

  /// Writes the values of a row, in the order of the places.
  void put(const std::vector<std::string>& values) {
    if (values == values_) return;
    cached_.reset();
    for (std::size_t i = 0; i < values.size(); ++i) places_.at(i).rewrite(values[i]);
    values_ = values;
  }

  /// The model for the kernel. Throws InputError for a wrong input, std::invalid_argument if it needs the solver.
  LinearRow linear(const RowMotion* motion, bool accelerations, bool alone) const {
    Model model = read(motion, dense_modes);
    LinearRow row;
    row.model = study::modal_form(model, accelerations);
    for (const Structure& s : model.structures)
      if (!s.is_rigid()) row.structures.push_back({s.name, static_cast<int>(s.floors.size()), s.has_storeys()});
    row.duration = model.analysis.duration, row.tolerance = model.analysis.tolerance;
    if (alone) {
      row.alone = row.model;
      row.alone.links.clear();
      add_separations(model, row);
    } else {
      for (const Link& link : model.links) row.links.push_back({link.name, 0});
    }
    return row;
  }

  /// Results of the row from the solver; `whole` returns the object of `pounding run --json`, with the heights of
  /// storeys and the names of hinges. Throws InputError, SolverError, and exceptions of signal handlers.
  py::dict run(const RowMotion* motion, bool whole) {
    std::optional<py::error_already_set> raised;
    Summary summary;
    std::vector<std::vector<double>> heights;
    {
      const py::gil_scoped_release free;
      const PetscForThisThread mine;
      start_petsc();
      const Model& model = made_ready(motion);
      RunOptions options{.numbers_only = true};
      options.stop = [&](std::span<const ContactMemory>) {
        const py::gil_scoped_acquire hold;
        if (PyErr_CheckSignals() != 0) raised.emplace();
        return raised.has_value();
      };
      try {
        summary = pounding::run(model, options).summary;
        for (const StructureSummary& s : summary.structures) heights.push_back(heights_of(model, s.name));
      } catch (const FailedRun&) {
        if (!raised) throw;
      }
    }
    if (raised) throw std::move(*raised);
    py::dict found =
        whole ? py::dict(py::module_::import("json").attr("loads")(to_json(summary))) : numbers_of(summary);
    for (std::size_t i = 0; i < heights.size(); ++i)
      found["structures"][py::str(summary.structures[i].name)]["storey_heights"] = heights[i];
    for (const StructureSummary& s : summary.structures) {
      py::list hinges;
      for (const SpringSummary& part : s.springs)
        if (part.is_hinge) hinges.append(part.name);
      if (whole && !hinges.empty()) found["structures"][py::str(s.name)]["hinges"] = hinges;
    }
    return found;
  }

 private:
  static std::vector<double> heights_of(const Model& model, const std::string& name) {
    for (const Structure& s : model.structures)
      if (s.name == name) return storey_heights(s);
    return {};
  }
  Model read(const RowMotion* motion, const ModeSolver& modes) const {
    return read_model(root_, modes, 1, motion ? &motion->ground : nullptr);
  }

  // The model of the row as if it had just been read. Rows that differ only in the ground motion share one.
  const Model& made_ready(const RowMotion* motion) {
    if (!motion || motion->ground.wave || !cached_ || !cached_->can_move_otherwise()) {
      cached_.reset();
      cached_.emplace(read(motion, petsc::lowest_modes));
    } else {
      try {
        cached_->move_otherwise(motion->ground);
      } catch (const ModelError&) {
        // The reader reports the location.
        cached_.reset();
        cached_.emplace(read(motion, petsc::lowest_modes));
      }
    }
    return *cached_;
  }

  Input root_;
  std::vector<Input> places_;
  std::vector<std::string> values_;
  std::optional<Model> cached_;
};

}  // namespace

void bind_study_rows(py::module_& module) {
  py::class_<RowMotion>(module, "RowMotion")
      .def(py::init(&read_row_motion), "text"_a, "name"_a, "files"_a = py::dict())
      .def("scaled", py::overload_cast<const RowMotion&, double>(&times), "factor"_a)
      .def_property_readonly("step", &RowMotion::step)
      .def_property_readonly("duration", [](const RowMotion& motion) { return motion.along_x().duration(); })
      .def_property_readonly("accelerations", &RowMotion::accelerations)
      .def("arias_after", &RowMotion::arias_after, "time"_a);
  py::class_<LinearRow>(module, "LinearRow")
      .def_readonly("model", &LinearRow::model)
      .def_readonly("alone", &LinearRow::alone)
      .def_property_readonly("structures",
                             [](const LinearRow& row) {
                               std::vector<std::tuple<std::string, int, bool>> found;
                               for (const OutputsOfStructure& s : row.structures)
                                 found.emplace_back(s.name, s.floors, s.has_storeys);
                               return found;
                             })
      .def_property_readonly("links",
                             [](const LinearRow& row) {
                               std::vector<std::pair<std::string, double>> found;
                               for (const EndsOfLink& link : row.links) found.emplace_back(link.name, link.correlation);
                               return found;
                             })
      .def_property_readonly("fastest",
                             [](const LinearRow& row) {
                               double square = 0;
                               for (const double stiffness : row.model.stiffness) square = std::max(square, stiffness);
                               return std::sqrt(square);
                             })
      .def_readonly("duration", &LinearRow::duration)
      .def_readonly("tolerance", &LinearRow::tolerance);
  py::class_<RowModel>(module, "RowModel")
      .def(py::init<std::string, std::string, std::vector<std::vector<std::string>>, Files>(), "text"_a, "name"_a,
           "places"_a, "files"_a = py::dict())
      .def("put", &RowModel::put, "values"_a)
      .def("linear", &RowModel::linear, "motion"_a, "accelerations"_a, "alone"_a)
      .def("run", &RowModel::run, "motion"_a, "whole"_a = false);
  module.def("double_difference", py::vectorize(&double_difference), "period_a"_a, "damping_a"_a, "period_b"_a,
             "damping_b"_a);
  /// Version of the results of the kernel, incremented if they change bitwise.
  module.attr("kernel_version") = 5;
}

}  // namespace pounding::python
