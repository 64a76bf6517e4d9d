#include <pounding/model/reduction.hpp>

#include <cmath>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

namespace pounding {

namespace {

// Inputs other than contacts.
std::string links_text(const ReducedStructure& s) {
  std::string text;
  if (s.frictions > 0) text += fmt::format(", {} of them friction", s.frictions);
  if (s.devices > 0) text += fmt::format(", {} of them devices", s.devices);
  if (s.parts > 0) text += fmt::format(", parts that yield {} x {}", s.part_blocks, s.parts);
  return text;
}

// Errors with their names, except unknown ones.
std::string listed(std::initializer_list<std::pair<const char*, double>> errors) {
  std::string text;
  for (const auto& [what, error] : errors)
    if (!std::isnan(error)) text += fmt::format("{}{} {:.1g}", text.empty() ? "" : ", ", what, error);
  return text;
}

}  // namespace

std::string Reduction::text() const {
  const char* const checked = check ? ", check: true" : "";
  switch (kind) {
    case Kind::none: return "none";
    case Kind::automatic:
      if (!(error > 0)) return check ? "{check: true}" : "auto";
      return fmt::format("{{error: {:g}{}{}}}", error,
                         of_acceleration && of_members ? ", of: [acceleration, members]"
                         : of_acceleration             ? ", of: [acceleration]"
                         : of_members                  ? ", of: [members]"
                                                       : "",
                         checked);
    case Kind::all_modes: return "all modes";
    case Kind::blocks: return fmt::format("{{links: {}, ground: {}{}}}", links, ground, checked);
    case Kind::lowest: break;
  }
  return fmt::format("{{modes: {}{}}}", modes, checked);
}

std::string ReducedStructure::size_text() const {
  std::string text = fmt::format("{}: {} coordinates of {} (", name, coordinates, unknowns);
  text += modes > 0 ? fmt::format("{} lowest modes, static responses", modes)
                    : fmt::format("links {} x {}{}, ground {} x {}", link_blocks, links, links_text(*this),
                                  ground_blocks, grounds);
  if (frequency > 0) text += fmt::format(", one at {:.2g} Hz", frequency);
  return text + ")";
}

std::string ReducedStructure::error_text() const {
  const std::string text = listed({{"forces", error_force},
                                   {"displacements", error_displacement},
                                   {"accelerations", error_acceleration},
                                   {"members", error_members}});
  return text.empty() ? "not estimated" : text;
}

std::string ReducedStructure::check_text() const {
  if (checked_windows == 0) return "";
  return fmt::format("all unknowns in the {}: {}",
                     checked_windows == 1 ? "hardest impact" : fmt::format("{} hardest impacts", checked_windows),
                     listed({{"forces", check_force}, {"displacements", check_displacement}}));
}

}  // namespace pounding
