#include <pounding/input/damping_input.hpp>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/bounds.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {
namespace {

using To = ProportionalDamping::To;

std::optional<DampedStiffness> read_damped_stiffness(const Input& node, const Structure& s) {
  const auto of = node.find("of");
  if (!of) return std::nullopt;
  const bool above = of->as_choice() == "superstructure";
  if (above && !is_isolated(s))
    of->fail("applies to structures on isolators, and there are none; type of: initial, or remove of");
  return above ? DampedStiffness::superstructure : DampedStiffness::initial;
}

// Two modes or two periods with the ratio.
RayleighDamping read_two_points(const Input& node, const Structure& s) {
  RayleighDamping damping{.ratio = node.quantity("ratio")};
  const std::optional<Input> modes = node.find("modes"), periods = node.find("periods");
  if (modes && periods) periods->fail_at_key("give modes or periods, not both");
  if (periods) {
    const std::vector<double> t = periods->as_quantities(2);
    damping.periods = {t[0], t[1]};
  }
  if (modes) {
    if (!modes->is_list() || modes->items().size() != 2) modes->fail("takes two mode numbers; type modes: [1, 2]");
    const std::vector<Input> items = modes->items();
    const Bounds allowed{.low = 1, .high = static_cast<double>(count_of_modes(s))};
    damping.modes = {static_cast<int>(items[0].as_integer(allowed)), static_cast<int>(items[1].as_integer(allowed))};
  }
  return damping;
}

// Refuses these keys next to the factors alpha and beta.
void refuse_next_to_factors(const Input& node, std::string_view factor) {
  for (const std::string_view key : {"ratio", "modes", "mode", "periods", "period"})
    if (const auto found = node.find_known(key))
      found->fail_at_key(fmt::format("{} and {} both set the damping; keep one of them", factor, key));
}

Damping read_rayleigh(const Input& node, const Structure& s, const std::optional<DampedStiffness>& of) {
  node.only_keys();
  const auto alpha = node.find("alpha"), beta = node.find("beta");
  if (!alpha && !beta) {
    if (!node.has("ratio"))
      node.fail("the damping is missing; type {ratio: 5 %, modes: [1, 2]}, or {alpha: 0.3, beta: 0.002}");
    return Damping(read_two_points(node, s), of);
  }
  refuse_next_to_factors(node, alpha ? "alpha" : "beta");
  return Damping(RayleighFactors{.alpha = node.quantity("alpha"), .beta = node.quantity("beta")}, of);
}

Damping read_proportional(const Input& node, const Structure& s, To to, const std::optional<DampedStiffness>& of) {
  node.only_keys();
  if (const std::string factor = node.chosen(); factor != "ratio") {
    refuse_next_to_factors(node, factor);
    const double value = node.quantity(factor);
    return Damping(to == To::mass ? RayleighFactors{.alpha = value} : RayleighFactors{.beta = value}, of);
  }
  ProportionalDamping damping{.to = to, .ratio = node.quantity("ratio"), .period = node.find_quantity("period")};
  if (const auto mode = node.find("mode")) {
    if (damping.period) mode->fail_at_key("give the mode or the period, not both");
    damping.mode = static_cast<int>(mode->as_integer({.low = 1, .high = static_cast<double>(count_of_modes(s))}));
  }
  return Damping(damping, of);
}

Damping read_modal(const Input& node, const Structure& s, const std::optional<DampedStiffness>& of) {
  node.only_keys();
  const auto ratios = node.find("ratios"), others = node.find("others");
  if (node.chosen() == "ratio") {
    if (others) others->fail_at_key("applies to the modes beyond the list ratios; type ratios: [5 %, 2 %]");
    return Damping(ModalDamping{node.quantity("ratio")}, of);
  }
  ModalDamping modal;
  for (const Input& item : ratios->items()) modal.ratios.push_back(item.as_quantity());
  const int count = count_of_modes(s), listed = static_cast<int>(modal.ratios.size());
  if (listed == 0) ratios->fail("takes the ratios of the lowest modes; type ratios: [5 %, 5 %, 2 %]");
  if (listed > count)
    ratios->fail(
        fmt::format("takes at most {} ratios, one per mode of the structure; a list of {} was read", count, listed));
  if (!others && listed < count)
    ratios->fail(fmt::format("sets modes 1 to {}, and the structure has {} modes; type others: 2 % for all others",
                             listed, count));
  if (others) modal.ratio = others->as_quantity();
  return Damping(std::move(modal), of);
}

}  // namespace

Damping read_damping(const Input& node, const Structure& s) {
  if (!node.is_map()) return node.as_quantity();
  node.only_keys();
  const std::string model = node.chosen("damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}");
  const auto of = read_damped_stiffness(node, s);
  const Input chosen = node.at(model);
  const bool by_mass = model == "mass_proportional" ||
                       (model == "rayleigh" && chosen.is_map() && (chosen.has("ratio") || chosen.has("alpha")));
  if (by_mass && is_isolated(s) && of != DampedStiffness::initial)
    chosen.fail_at_key(
        "would damp the motion of the isolators; type damping: 2 %, which is proportional to the stiffness above them, "
        "damping: {modal: {ratio: 2 %}}, or add of: initial to damp the isolators as well");
  if (model == "rayleigh") return read_rayleigh(chosen, s, of);
  if (model == "modal") return read_modal(chosen, s, of);
  return read_proportional(chosen, s, model == "mass_proportional" ? To::mass : To::stiffness, of);
}

}  // namespace pounding
