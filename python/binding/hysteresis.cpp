/// Laws of yielding along paths, and the tables that describe them.

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <pounding/hysteresis/all.hpp>
#include "bindings.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

/// A struct, since pybind11 converts a std::variant to its active alternative.
struct YieldingLaw {
  hysteresis::AnyLaw any;
};

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

YieldingLaw make_law(std::string name, const std::map<std::string, double>& values,
                     const std::map<std::string, std::string>& words) {
  hysteresis::Settings settings{.law = std::move(name)};
  settings.values.insert(values.begin(), values.end());
  settings.words.insert(words.begin(), words.end());
  return {hysteresis::make_law(settings)};
}

/// Force, slope, work and stored energy along each row of a table of deformations; every row begins undeformed.
py::tuple follow(const YieldingLaw& law, const Array& path) {
  const std::vector<py::ssize_t> shape(path.shape(), path.shape() + path.ndim());
  Array force(shape), slope(shape), work(shape), stored(shape);
  const double* d = path.data();
  double *f = force.mutable_data(), *k = slope.mutable_data(), *w = work.mutable_data(), *e = stored.mutable_data();
  const py::ssize_t rows = path.shape(0), columns = path.shape(1);
  {
    const py::gil_scoped_release free;
    std::visit(
        [&]<class L>(const L& chosen) {
          for (py::ssize_t row = 0, i = 0; row < rows; ++row) {
            typename L::State kept;
            double sum = 0;
            for (py::ssize_t column = 0; column < columns; ++column, ++i) {
              const hysteresis::Answer answer = chosen.respond(kept, d[i]);
              sum += chosen.work(kept, d[i]);
              kept = chosen.advance(kept, d[i]);
              f[i] = answer.force;
              k[i] = answer.slope;
              w[i] = sum;
              e[i] = chosen.stored(kept);
            }
          }
        },
        law.any);
  }
  return py::make_tuple(force, slope, work, stored);
}

py::list catalogue() {
  py::list entries;
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) {
    py::list parameters, choices;
    for (const hysteresis::ParameterInfo& p : entry.parameters)
      parameters.append(py::make_tuple(p.name, p.unit, p.meaning, typical_value(p), need_word(p.need), kind_word(p)));
    for (const hysteresis::ChoiceInfo& c : entry.choices)
      choices.append(py::make_tuple(c.name, c.meaning, std::vector<std::string>(c.words.begin(), c.words.end())));
    entries.append(py::dict("name"_a = entry.name, "shape"_a = entry.shape, "summary"_a = entry.summary,
                            "source"_a = entry.source, "parameters"_a = parameters, "choices"_a = choices,
                            "has_corners"_a = entry.has_corners));
  }
  return entries;
}

}  // namespace

void bind_hysteresis(py::module_& module) {
  module.def("yielding_catalogue", &catalogue);
  py::class_<YieldingLaw>(module, "YieldingLaw")
      .def(py::init(&make_law), "law"_a, "values"_a, "words"_a)
      .def("follow", &follow, "path"_a)
      .def_property_readonly("stiffness",
                             [](const YieldingLaw& law) {
                               return std::visit([](const auto& chosen) { return chosen.stiffness(); }, law.any);
                             })
      .def_property_readonly("yield_deformation", [](const YieldingLaw& law) {
        return std::visit([](const auto& chosen) { return chosen.yield_deformation(); }, law.any);
      });
}

}  // namespace pounding::python
