#include <pounding/study/linear_model.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace pounding::study {
namespace {

void require_numbers(const std::string& what, const std::vector<double>& values, std::size_t count, bool negative) {
  if (values.size() != count)
    throw std::invalid_argument(what + ": " + std::to_string(values.size()) + " numbers for " + std::to_string(count) +
                                " modes");
  for (const double value : values)
    if (!std::isfinite(value) || (!negative && value < 0))
      throw std::invalid_argument(what + ": a number must be finite" + (negative ? "" : " and not negative"));
}

void require_law(const LinkModes& link) {
  std::visit(
      [](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (laws::instantaneous<Law>)
          throw std::invalid_argument(std::string(Law::name) +
                                      ": a jump of the velocity is not a force; the kernel takes penalty laws");
        else
          law.check();
      },
      link.law);
}

}  // namespace

void LinearModel::check() const {
  const std::size_t count = stiffness.size();
  if (count == 0) throw std::invalid_argument("no structure of the study can move");
  require_numbers("stiffness", stiffness, count, false);
  require_numbers("damping", damping, count, false);
  require_numbers("load", load, count, true);
  if (!displacement.empty()) require_numbers("displacement", displacement, count, true);
  if (!velocity.empty()) require_numbers("velocity", velocity, count, true);
  for (const Output& output : outputs) require_numbers("output", output.factors, count, true);
  for (const LinkModes& link : links) {
    require_numbers("link", link.closing, count, true);
    if (!(link.gap >= 0 && std::isfinite(link.gap))) throw std::invalid_argument("gap must be finite and not negative");
    if (link.law.index() != links.front().law.index())
      throw std::invalid_argument("the links of a study share one law");
    require_law(link);
    double closed = -link.gap;
    for (std::size_t j = 0; j < displacement.size(); ++j) closed += link.closing[j] * displacement[j];
    if (closed > 0) throw std::invalid_argument("a link overlaps at the start");
  }
}

LinearModel pair_of(const Oscillator& left, const Oscillator& right, double gap, laws::AnyLaw law, bool accelerations) {
  LinearModel model;
  LinkModes link{.gap = gap, .closing = {}, .law = std::move(law)};
  int sign = 1, place = 0;
  for (const Oscillator* o : {&left, &right}) {
    if (!(o->mass > 0 && std::isfinite(o->mass))) throw std::invalid_argument("mass must be finite and positive");
    if (!(o->period > 0 && std::isfinite(o->period))) throw std::invalid_argument("period must be finite and positive");
    if (!(o->damping_ratio >= 0 && o->damping_ratio < 1))
      throw std::invalid_argument("damping_ratio must be in [0, 1)");
    const double w = 2 * std::numbers::pi / o->period, root = std::sqrt(o->mass);
    model.stiffness.push_back(w * w);
    model.damping.push_back(2 * o->damping_ratio * w);
    model.load.push_back(root);
    link.closing.push_back(sign / root);
    Output output{.kind = Output::Kind::displacement, .factors = {0, 0}};
    output.factors[static_cast<std::size_t>(place++)] = 1 / root;
    model.outputs.push_back(std::move(output));
    sign = -1;
  }
  if (accelerations)
    for (std::size_t i = 0; i < 2; ++i) {
      Output output = model.outputs[i];
      output.kind = Output::Kind::acceleration;
      model.outputs.push_back(std::move(output));
    }
  model.links.push_back(std::move(link));
  model.check();
  return model;
}

LinearModel without_links(const LinearModel& model) {
  LinearModel apart = model;
  apart.links.clear();
  apart.outputs.clear();
  for (const LinkModes& link : model.links)
    apart.outputs.push_back({.kind = Output::Kind::closing, .factors = link.closing});
  return apart;
}

}  // namespace pounding::study
