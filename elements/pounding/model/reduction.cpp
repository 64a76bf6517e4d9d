#include <pounding/model/reduction.hpp>

#include <cmath>

#include <fmt/format.h>

namespace pounding {

namespace {

// The inputs that are no contacts.
std::string links_text(const ReducedStructure& s) {
  std::string text;
  if (s.frictions > 0) text += fmt::format(", {} of them friction", s.frictions);
  if (s.devices > 0) text += fmt::format(", {} of them devices", s.devices);
  if (s.parts > 0) text += fmt::format(", parts that yield {} x {}", s.part_blocks, s.parts);
  return text;
}

}  // namespace

std::string Reduction::text() const {
  switch (kind) {
    case Kind::none: return "none";
    case Kind::automatic:
      if (!(error > 0)) return "auto";
      return fmt::format("{{error: {:g}{}}}", error,
                         of_acceleration && of_members ? ", of: [acceleration, members]"
                         : of_acceleration             ? ", of: [acceleration]"
                         : of_members                  ? ", of: [members]"
                                                       : "");
    case Kind::all_modes: return "all modes";
    case Kind::blocks: return fmt::format("{{links: {}, ground: {}}}", links, ground);
    case Kind::lowest: break;
  }
  return fmt::format("{{modes: {}}}", modes);
}

std::string ReducedStructure::size_text() const {
  std::string text = fmt::format("{}: {} coordinates of {} (", name, coordinates, unknowns);
  text += modes > 0 ? fmt::format("{} lowest modes, static answers", modes)
                    : fmt::format("links {} x {}{}, ground {} x {}", link_blocks, links, links_text(*this), ground_blocks, grounds);
  if (frequency > 0) text += fmt::format(", one at {:.2g} Hz", frequency);
  return text + ")";
}

std::string ReducedStructure::error_text() const {
  std::string text;
  const auto add = [&](const char* what, double error) {
    if (!std::isnan(error)) text += fmt::format("{}{} {:.1g}", text.empty() ? "" : ", ", what, error);
  };
  add("forces", error_force);
  add("displacements", error_displacement);
  add("accelerations", error_acceleration);
  add("members", error_members);
  return text.empty() ? "not estimated" : text;
}

}  // namespace pounding
