/// Laws on arrays, and the tables that describe them.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>
#include <pounding/input/collision.hpp>
#include <pounding/laws/compiled.hpp>
#include <pounding/links/accepted_state.hpp>
#include "bindings.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace pounding::python {
namespace {

/// A struct, since pybind11 converts a std::variant to its active alternative.
struct Law {
  laws::AnyLaw any;
};

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Values of an array in order, or one value repeated.
struct Column {
  explicit Column(const Array& array) : first(array.data()), stride(array.ndim() == 0 ? 0 : 1) {}
  double operator[](py::ssize_t i) const { return first[i * stride]; }
  const double* first;
  py::ssize_t stride;
};

struct States {
  Column penetration, rate, approach_velocity;
  py::ssize_t count;
};

/// Common shape of the arrays that are not single numbers; the caller has broadcast them.
std::vector<py::ssize_t> common_shape(std::initializer_list<const Array*> arrays) {
  std::vector<py::ssize_t> shape;
  for (const Array* array : arrays) {
    if (array->ndim() == 0) continue;
    const std::vector<py::ssize_t> its(array->shape(), array->shape() + array->ndim());
    if (!shape.empty() && its != shape) throw std::logic_error("arrays of different shapes were not broadcast");
    shape = its;
  }
  return shape;
}

// NaN gives NaN. The law is evaluated before the test, so that the loop has no branch around it.
laws::Response answer(const auto& law, double penetration, double rate, const laws::Impact& impact) {
  const laws::Response r = law.respond(penetration, rate, impact);
  return std::isnan(penetration) || std::isnan(rate) ? laws::Response{NAN, NAN, NAN} : r;
}

/// States from `first` to `end` of impacts with the same beginning. Law and impact are unaliased copies, so that the
/// compiler hoists everything that depends only on them.
template <class L, class Take>
void press(const L law, const laws::Impact impact, const States& s, py::ssize_t first, py::ssize_t end, Take&& take) {
  for (py::ssize_t i = first; i < end; ++i) take(i, answer(law, s.penetration[i], s.rate[i], impact));
}

/// `take(i, response)` for every state, each as the first of its impact.
template <class L, class Take>
void for_each_state(const L& law, const States& s, Take&& take) {
  const Column& velocity = s.approach_velocity;
  for (py::ssize_t first = 0, end = 0; first < s.count; first = end) {
    end = velocity.stride == 0 ? s.count : first + 1;
    while (end < s.count && velocity[end] == velocity[first]) ++end;
    const laws::Impact impact = laws::touch(law, velocity[first]);
    if constexpr (laws::designed_for_speed<L>) {
      double deepest = 0;
      for (py::ssize_t i = first; i < end; ++i) deepest = std::max(deepest, s.penetration[i]);
      laws::require_design(law, deepest, impact);
    }
    press(law, impact, s, first, end, take);
  }
}

/// `take(i, response)` for the successive states of one impact: each is accepted before the next.
template <class L, class Take>
void for_each_accepted_state(const L& law, const States& s, Take&& take) {
  if (s.count == 0) return;
  laws::Impact impact = laws::touch(law, s.approach_velocity[0]);
  for (py::ssize_t i = 0; i < s.count; ++i) {
    take(i, answer(law, s.penetration[i], s.rate[i], impact));
    laws::require_design(law, s.penetration[i], impact);
    laws::keep(law, s.penetration[i], s.rate[i], impact);
  }
}

void for_each(const laws::AnyLaw& law, const States& states, bool in_order, auto&& take) {
  std::visit(
      [&](const auto& chosen) {
        in_order ? for_each_accepted_state(chosen, states, take) : for_each_state(chosen, states, take);
      },
      law);
}

Array forces(const Law& law, const Array& penetration, const Array& rate, const Array& approach_velocity,
             bool in_order) {
  Array force(common_shape({&penetration, &rate, &approach_velocity}));
  const States states{Column(penetration), Column(rate), Column(approach_velocity), force.size()};
  double* f = force.mutable_data();
  const py::gil_scoped_release free;
  for_each(law.any, states, in_order, [&](py::ssize_t i, const laws::Response& r) { f[i] = r.force; });
  return force;
}

py::tuple responses(const Law& law, const Array& penetration, const Array& rate, const Array& approach_velocity,
                    bool in_order) {
  const auto shape = common_shape({&penetration, &rate, &approach_velocity});
  Array force(shape), by_penetration(shape), by_rate(shape);
  const States states{Column(penetration), Column(rate), Column(approach_velocity), force.size()};
  double *f = force.mutable_data(), *k = by_penetration.mutable_data(), *c = by_rate.mutable_data();
  {
    const py::gil_scoped_release free;
    for_each(law.any, states, in_order, [&](py::ssize_t i, const laws::Response& r) {
      f[i] = r.force;
      k[i] = r.by_penetration;
      c[i] = r.by_rate;
    });
  }
  return py::make_tuple(force, by_penetration, by_rate);
}

/// Names of the quantities that have a closed form.
std::vector<std::string> closed_forms(const laws::FreeImpact& impact) {
  const auto& known = impact.closed_form;
  std::vector<std::string> closed;
  for (const auto& [is_closed, name] : {std::pair{known.restitution, "restitution"},
                                        {known.peak_force, "peak_force"},
                                        {known.time_of_peak, "time_of_peak"},
                                        {known.peak_penetration, "peak_penetration"},
                                        {known.duration, "duration"}})
    if (is_closed) closed.emplace_back(name);
  return closed;
}

Law make_law(std::string name, std::string formula, std::optional<double> restitution,
             std::optional<double> impact_velocity, double reduced_mass, const std::map<std::string, double>& values) {
  laws::Settings settings{.law = std::move(name),
                          .formula = std::move(formula),
                          .restitution = restitution,
                          .impact_velocity = impact_velocity,
                          .reduced_mass = reduced_mass};
  settings.values.insert(values.begin(), values.end());
  return {laws::make_law(settings)};
}

/// True if the force depends on the closing speed of the impact.
bool needs_approach_velocity(const Law& law) {
  return std::visit(
      [](const auto& chosen) {
        const laws::Impact slow = laws::touch(chosen, 0.1), fast = laws::touch(chosen, 10);
        for (const double penetration : {1e-6, 1e-4, 1e-2, 1.0})
          for (const double rate : {-0.01, 0.01})
            if (chosen.respond(penetration, rate, slow).force != chosen.respond(penetration, rate, fast).force)
              return true;
        return false;
      },
      law.any);
}

py::list described(const Law& law, double closing_speed) {
  py::list values;
  for (const laws::ResolvedValue& v : laws::describe(law.any, closing_speed))
    values.append(py::make_tuple(v.name, v.value, v.unit));
  return values;
}

py::dict dict_of(const laws::Entry& entry) {
  py::list parameters, formulas;
  for (const laws::ParameterInfo& p : entry.parameters)
    parameters.append(py::make_tuple(p.name, p.unit, p.meaning, typical_value(p), need_word(p.need), kind_word(p)));
  for (const laws::Formula& f : entry.formulas) formulas.append(py::make_tuple(f.name, f.source, f.note));
  return py::dict("name"_a = entry.name, "shape"_a = entry.shape, "summary"_a = entry.summary,
                  "source"_a = entry.source, "parameters"_a = parameters, "formulas"_a = formulas,
                  "takes_restitution"_a = entry.takes_restitution,
                  "takes_impact_velocity"_a = entry.takes_impact_velocity,
                  "takes_reduced_mass"_a = entry.takes_reduced_mass, "may_pull"_a = entry.may_pull,
                  "leaves_indentation"_a = entry.leaves_indentation, "instantaneous"_a = entry.instantaneous);
}

/// History of the contact of two bodies, for hosts that step in time. It excludes the gap of the host: `gap`
/// contains only the indentation left by earlier impacts.
struct Contact {
  laws::AnyLaw law;
  ContactState state{};

  bool touching() const { return presses(state.phase); }
  void touch(double closing_speed) {
    std::visit([&](const auto& chosen) { state.begin(chosen, closing_speed); }, law);
  }
  std::tuple<double, double, double> respond(double penetration, double rate) const {
    if (!touching()) return {0, 0, 0};
    const laws::Response r = std::visit(
        [&](const auto& chosen) { return chosen.respond(state.penetration(penetration), rate, state.impact); }, law);
    return {r.force, r.by_penetration, r.by_rate};
  }
  void accept(double penetration, double rate) {
    ContactState changed = state;
    std::visit([&](const auto& chosen) { pounding::accept(chosen, penetration, rate, changed); }, law);
    state = changed;
  }
  void separate(double penetration) {
    std::visit([&](const auto& chosen) { state.end(chosen, std::max(state.penetration(penetration), 0.0)); }, law);
  }
  std::vector<double> history() const {
    const laws::Impact& i = state.impact;
    return {touching() ? 1.0 : 0.0, state.gap, i.closing_speed, i.damping, i.largest_penetration, i.slip, i.crushed};
  }
  void restore(const std::vector<double>& values) {
    if (values.size() != 7) throw std::invalid_argument("a contact has 7 numbers");
    state = {.phase = values[0] != 0 ? ContactPhase::approach : ContactPhase::open,
             .impact = {.closing_speed = values[2],
                        .damping = values[3],
                        .largest_penetration = values[4],
                        .slip = values[5],
                        .crushed = values[6]},
             .gap = values[1]};
  }
};

py::list catalogue() {
  py::list entries;
  for (const laws::Entry& entry : laws::catalogue()) entries.append(dict_of(entry));
  return entries;
}

// The keys are those of `pounding calibrate --json`.
py::dict calibrated(const CollisionInput& words) {
  const Collision collision = read_collision(words);
  py::list rows;
  for (const CalibratedRow& row : calibrate(collision)) {
    py::dict entry;
    if (!row.refused.empty()) {
      entry["formula"] = row.formula;
      entry["refused"] = row.refused;
    } else {
      const laws::FreeImpact& impact = row.impact;
      entry = py::dict("restitution"_a = impact.restitution, "peak_force"_a = impact.peak_force,
                       "time_of_peak"_a = impact.time_of_peak, "peak_penetration"_a = impact.peak_penetration,
                       "duration"_a = impact.duration, "energy_lost"_a = impact.energy_lost,
                       "impulse"_a = impact.impulse, "formula"_a = row.formula);
      if (!collision.law.number.name.empty()) {
        entry[py::str(std::string(collision.law.number.name))] = row.number;
        entry[py::str(std::string(collision.law.coefficient.name))] = row.coefficient;
      }
    }
    rows.append(entry);
  }
  const laws::Settings& settings = collision.settings;
  py::dict parameters;
  for (const auto& [name, value] : settings.values) parameters[py::str(name)] = value;
  py::dict result("law"_a = collision.law.name, "reduced_mass"_a = settings.reduced_mass,
                  "closing_speed"_a = collision.velocity, "parameters"_a = parameters, "assumed"_a = collision.assumed,
                  "formulas"_a = rows);
  if (settings.restitution) result["restitution"] = *settings.restitution;
  return result;
}

double quantity(const std::string& text, const std::string& unit, double exponent) {
  return parse_quantity(text, parse_unit_dimension(laws::resolved_unit(unit, exponent)));
}

}  // namespace

const char* need_word(laws::Need need) {
  switch (need) {
    case laws::Need::required: return "required";
    case laws::Need::optional: return "optional";
    case laws::Need::damping: return "instead of restitution";
    case laws::Need::together: return "together, instead of all others";
    case laws::Need::instead: return "or others instead";
    case laws::Need::extra: return "may be left out";
  }
  return "";
}

const char* kind_word(const laws::ParameterInfo& parameter) {
  return parameter.is_flag ? "flag" : parameter.is_list() ? "list" : "number";
}

py::object typical_value(const laws::ParameterInfo& parameter) {
  if (parameter.is_flag) return py::bool_(parameter.typical != 0);
  if (parameter.is_list()) return py::cast(std::vector(parameter.typical_list.begin(), parameter.typical_list.end()));
  return py::float_(parameter.typical);
}

void bind_laws(py::module_& module) {
  module.def("catalogue", &catalogue);
  module.def("quantity", &quantity, "text"_a, "unit"_a, "exponent"_a = 1.0);
  module.def(
      "unknown_law", [](const std::string& name) { return laws::unknown_law(name, laws::catalogue()); }, "name"_a);
  module.def("calibrate",
             [](const std::string& law, const std::string& restitution, const std::string& m1, const std::string& m2,
                const std::string& stiffness, const std::string& velocity, const std::string& exponent,
                const std::vector<std::pair<std::string, std::string>>& parameters) {
               return calibrated({law, restitution, m1, m2, stiffness, velocity, exponent, parameters});
             });
  py::class_<laws::FreeImpact>(module, "FreeImpact")
      .def_readonly("restitution", &laws::FreeImpact::restitution)
      .def_readonly("peak_force", &laws::FreeImpact::peak_force)
      .def_readonly("time_of_peak", &laws::FreeImpact::time_of_peak)
      .def_readonly("peak_penetration", &laws::FreeImpact::peak_penetration)
      .def_readonly("duration", &laws::FreeImpact::duration)
      .def_readonly("energy_lost", &laws::FreeImpact::energy_lost)
      .def_readonly("impulse", &laws::FreeImpact::impulse)
      .def_property_readonly("closed_form", &closed_forms);
  py::class_<Contact>(module, "Contact")
      .def_property_readonly("touching", &Contact::touching)
      .def_property_readonly("history", &Contact::history)
      .def("restore", &Contact::restore, "values"_a)
      .def("touch", &Contact::touch, "closing_speed"_a)
      .def("respond", &Contact::respond, "penetration"_a, "rate"_a)
      .def("accept", &Contact::accept, "penetration"_a, "rate"_a)
      .def("separate", &Contact::separate, "penetration"_a);
  py::class_<Law>(module, "Law")
      .def(py::init(&make_law), "law"_a, "formula"_a, "restitution"_a, "impact_velocity"_a, "reduced_mass"_a,
           "values"_a)
      .def("forces", &forces)
      .def("responses", &responses)
      .def_property_readonly("needs_approach_velocity", &needs_approach_velocity)
      .def("contact", [](const Law& law) { return Contact{law.any}; })
      .def("describe", &described)
      .def("free_impact", [](const Law& law, double reduced_mass, double closing_speed) {
        return laws::free_impact(law.any, reduced_mass, closing_speed);
      });
}

}  // namespace pounding::python
