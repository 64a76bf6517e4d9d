#include <pounding/input/keys/key.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

// An end of an interval; integers have all digits.
std::string end_text(double end) {
  const bool is_integer = end == std::trunc(end) && std::abs(end) < 1e15;
  return is_integer ? fmt::format("{:.0f}", end) : fmt::format("{:g}", end);
}

}  // namespace

std::string Bounds::text() const {
  if (has_low() && has_high())
    return fmt::format(" in {}{}, {}{}", without_low ? '(' : '[', end_text(low), end_text(high),
                       without_high ? ')' : ']');
  if (has_low()) return fmt::format(" {} {}", without_low ? ">" : ">=", end_text(low));
  if (has_high()) return fmt::format(" {} {}", without_high ? "<" : "<=", end_text(high));
  return {};
}

namespace keys {
namespace {

// Sections without those of hysteretic laws, which follow the sections that contain them.
constexpr auto without_laws =
    [](const auto&... sections) {
      return std::array<const Section*, sizeof...(sections)>{&sections...};
    }(model, ground_motion, components, motion, wave, harmonic, sum_part, pulse, synthetic, displacement,
      moved_harmonic, moved_part, structure, body, oscillator, shear_building, storey_spring, wall, damping, rayleigh,
      mass_proportional, stiffness_proportional, modal, force, force_harmonic, force_sum_part, force_pulse, step_force,
      frame, material, confined, cross_section, i_section, tube, rc_rectangle, fibres_of_section, patch,
      patch_rectangle, patch_ring, bar_layer, grid, bay_width, combination, member, releases, offsets, support,
      support_springs, support_dashpots, isolator, floor, node_masses, node_loads, node_displacements, spring, tie,
      hinge, frame_fibres, report, link, link_end, link_friction, stiffness, device, own_device, bar, damper, analysis,
      reduction, checkpoint);

}  // namespace

std::optional<double> Key::default_quantity() const {
  if (takes != Takes::quantity || otherwise.empty()) return std::nullopt;
  try {
    return parse_quantity(otherwise, dimension);
  } catch (const InputError&) {
    return std::nullopt;  // described in prose
  }
}

std::string Key::unit_text() const {
  if (!unit.empty()) return std::string(unit);
  const std::string plain = pounding::unit_text(dimension);
  return turning ? fmt::format("{} or {}", plain, pounding::unit_text(*turning)) : plain;
}

const Key* Section::find(std::string_view key) const noexcept {
  const auto found = std::ranges::find(keys, key, &Key::key);
  return found == keys.end() ? nullptr : &*found;
}

std::span<const Section* const> sections() noexcept {
  static const std::vector<const Section*> all = [] {
    std::vector<const Section*> made;
    for (const Section* section : without_laws) {
      made.push_back(section);
      if (section == &material) std::ranges::copy(laws_of_materials(), std::back_inserter(made));
      if (section == &storey_spring) std::ranges::copy(laws_of_springs(), std::back_inserter(made));
      if (section == &isolator) std::ranges::copy(laws_of_isolators(), std::back_inserter(made));
      if (section == &hinge) std::ranges::copy(laws_of_hinges(), std::back_inserter(made));
      if (section == &own_device) std::ranges::copy(laws_of_devices(), std::back_inserter(made));
    }
    return made;
  }();
  return all;
}

}  // namespace keys
}  // namespace pounding
