/// The kernel of studies: rows of numbers in, columns of peaks out.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <pounding/input/read_model.hpp>
#include <pounding/laws/compiled.hpp>
#include <pounding/study/kernel.hpp>
#include <pounding/study/modal_form.hpp>
#include "bindings.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// One number per row, or one for all rows.
class Column {
 public:
  Column() = default;
  Column(const std::string& name, const Array& values, std::size_t rows)
      : data_(values.data()), step_(values.size() == 1 ? 0 : 1) {
    if (values.size() != 1 && static_cast<std::size_t>(values.size()) != rows)
      throw std::invalid_argument(name + ": " + std::to_string(values.size()) + " numbers for " + std::to_string(rows) +
                                  " rows");
  }
  double operator[](std::size_t row) const { return data_[row * step_]; }

 private:
  const double* data_ = nullptr;
  std::size_t step_ = 0;
};

/// Peaks of rows, allocated before the first row runs.
class Columns {
 public:
  Columns(std::size_t rows, std::vector<std::size_t> widths_of_outputs, std::vector<std::string> outputs,
          std::size_t links, bool gap)
      : rows_(rows), links_(links) {
    for (std::size_t i = 0; i < outputs.size(); ++i) add(outputs[i], widths_of_outputs[i]);
    first_link_ = data_.size();
    for (const char* name : {"impacts", "peak_force", "peak_penetration", "impulse", "energy_lost"}) add(name, links);
    if (gap) add("required_gap", links);
    add("steps", 1);
  }

  void fill(std::size_t row, const study::Peaks& peaks, const study::Peaks* apart) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < first_link_; ++i)
      for (std::size_t k = 0; k < data_[i].width; ++k) data_[i].at(row, k) = peaks.outputs[next++];
    for (std::size_t l = 0; l < links_; ++l) {
      const study::LinkPeaks& link = peaks.links[l];
      const double values[] = {static_cast<double>(link.impacts), link.peak_force, link.peak_penetration, link.impulse,
                               link.energy_lost};
      for (std::size_t i = 0; i < 5; ++i) data_[first_link_ + i].at(row, l) = values[i];
      if (apart) data_[first_link_ + 5].at(row, l) = apart->outputs[l];
    }
    data_.back().at(row, 0) = static_cast<double>(peaks.steps);
  }
  /// Marks a failed row: its values are NaN.
  void fail(std::size_t row, std::string reason) {
    for (Named& column : data_)
      for (std::size_t k = 0; k < column.width; ++k) column.at(row, k) = std::numeric_limits<double>::quiet_NaN();
    reasons_.emplace(row, std::move(reason));
  }

  py::dict result() const {
    py::dict found;
    for (const Named& column : data_) {
      const std::vector<std::size_t> shape = column.width == 1 ? std::vector{rows_} : std::vector{rows_, column.width};
      Array values(shape);
      std::copy(column.values.begin(), column.values.end(), values.mutable_data());
      found[py::str(column.name)] = values;
    }
    found["reasons"] = reasons_;
    return found;
  }

 private:
  struct Named {
    std::string name;
    std::size_t width;
    std::vector<double> values;
    double& at(std::size_t row, std::size_t k) { return values[row * width + k]; }
  };
  void add(std::string name, std::size_t width) {
    data_.push_back({std::move(name), width, std::vector<double>(rows_ * width)});
  }

  std::size_t rows_, links_, first_link_ = 0;
  std::vector<Named> data_;
  std::map<std::size_t, std::string> reasons_;
};

/// Runs one row and stores its result; an exception becomes the reason of the row.
template <class MakeModel>
void run_row(Columns& columns, std::size_t row, bool gap, const study::EvenRecord& record,
             const study::Settings& settings, const MakeModel& make) {
  try {
    const study::LinearModel& model = make(row);
    const study::Peaks peaks = study::run(model, record, settings);
    if (!gap) return columns.fill(row, peaks, nullptr);
    const study::Peaks apart = study::run(study::without_links(model), record, settings);
    columns.fill(row, peaks, &apart);
  } catch (const std::invalid_argument& error) {
    columns.fail(row, error.what());
  } catch (const std::runtime_error& error) {
    columns.fail(row, error.what());
  }
}

py::dict study_pairs(const py::dict& pairs, const std::string& law, const std::string& formula,
                     const py::dict& parameters, const Array& record, double step, double duration, double tolerance,
                     bool accelerations, bool required_gap) {
  std::size_t rows = 1;
  for (const py::dict& dict : {pairs, parameters})
    for (const auto& [name, values] : dict)
      rows = std::max(rows, static_cast<std::size_t>(py::cast<Array>(values).size()));
  std::vector<Array> alive;  // arrays referenced by the columns
  const auto columns_of = [&](const py::dict& dict) {
    std::map<std::string, Column, std::less<>> columns;
    for (const auto& [name, values] : dict) {
      alive.push_back(py::cast<Array>(values));
      columns.emplace(py::cast<std::string>(name), Column(py::cast<std::string>(name), alive.back(), rows));
    }
    return columns;
  };
  const auto of_pair = columns_of(pairs), of_law = columns_of(parameters);
  const std::vector<std::string> known{"mass_left",    "mass_right",    "period_left", "period_right",
                                       "damping_left", "damping_right", "gap",         "factor"};
  for (const auto& [name, column] : of_pair)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::invalid_argument("\"" + name + "\" is not a column of a pair");
  for (const std::string& name : known)
    if (name != "factor" && !of_pair.contains(name))
      throw std::invalid_argument("the column \"" + name + "\" is missing");
  const laws::Entry& entry = laws::find_law(law);
  const std::span<const double> samples{record.data(), static_cast<std::size_t>(record.size())};
  Columns found(rows, accelerations ? std::vector<std::size_t>{2, 2} : std::vector<std::size_t>{2},
                accelerations ? std::vector<std::string>{"displacement", "acceleration"}
                              : std::vector<std::string>{"displacement"},
                1, required_gap);
  {
    const py::gil_scoped_release free;
    study::LinearModel model;
    const auto value = [&](const char* name, std::size_t row) { return of_pair.find(name)->second[row]; };
    const auto make = [&](std::size_t row) -> const study::LinearModel& {
      const study::Oscillator left{value("mass_left", row), value("period_left", row), value("damping_left", row)};
      const study::Oscillator right{value("mass_right", row), value("period_right", row), value("damping_right", row)};
      laws::Settings settings{.law = law, .formula = formula};
      if (entry.takes_reduced_mass) settings.reduced_mass = left.mass * right.mass / (left.mass + right.mass);
      for (const auto& [name, column] : of_law)
        if (name == "restitution")
          settings.restitution = column[row];
        else if (name == "impact_velocity")
          settings.impact_velocity = column[row];
        else
          settings.values[name] = column[row];
      return model = study::pair_of(left, right, value("gap", row), laws::make_law(settings), accelerations);
    };
    const auto factor = of_pair.find("factor");
    for (std::size_t row = 0; row < rows; ++row)
      run_row(found, row, required_gap, {samples, step, factor == of_pair.end() ? 1 : factor->second[row]},
              {.duration = duration, .tolerance = tolerance}, make);
  }
  return found.result();
}

/// A model in modal coordinates.
study::LinearModel linear_model(const std::string& text, const std::string& name, bool accelerations) {
  Model model = read_model(Input::read_text(text, name));
  model.complete();
  return study::modal_form(model, accelerations);
}

py::dict study_model(const study::LinearModel& model, const Array& record, double step, const Array& factors,
                     double duration, double tolerance, bool required_gap) {
  const std::span<const double> samples{record.data(), static_cast<std::size_t>(record.size())};
  const auto rows = static_cast<std::size_t>(factors.size());
  Columns found(rows, {model.outputs.size()}, {"outputs"}, model.links.size(), required_gap);
  const double* factor = factors.data();
  {
    const py::gil_scoped_release free;
    for (std::size_t row = 0; row < rows; ++row)
      run_row(found, row, required_gap, {samples, step, factor[row]}, {.duration = duration, .tolerance = tolerance},
              [&](std::size_t) -> const study::LinearModel& { return model; });
  }
  return found.result();
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("study_pairs", study_pairs, "pairs"_a, "law"_a, "formula"_a, "parameters"_a, "record"_a, "step"_a,
             "duration"_a = 0.0, "tolerance"_a = study::Settings{}.tolerance, "accelerations"_a = false,
             "required_gap"_a = false);
  py::class_<study::LinearModel>(module, "LinearModel")
      .def_property_readonly("modes", &study::LinearModel::modes)
      .def_property_readonly("links", [](const study::LinearModel& model) { return model.links.size(); })
      .def_property_readonly("outputs", [](const study::LinearModel& model) { return model.outputs.size(); });
  module.def("linear_model", linear_model, "text"_a, "name"_a, "accelerations"_a = false);
  module.def(
      "needs_solver",
      [](const std::string& text, const std::string& name) {
        Model model = read_model(Input::read_text(text, name));
        model.complete();
        return study::needs_solver(model);
      },
      "text"_a, "name"_a);
  module.def("study_model", study_model, "model"_a, "record"_a, "step"_a, "factors"_a, "duration"_a = 0.0,
             "tolerance"_a = study::Settings{}.tolerance, "required_gap"_a = false);
}

}  // namespace pounding::python
