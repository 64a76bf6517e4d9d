#include <pounding/model/plausible.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/drawing.hpp>

namespace pounding {
namespace {

constexpr double shortest_period = 0.02, longest_period = 20;  // [s]
constexpr double widest_gap = 2;                               // [m]
constexpr double lightest_floor = 1e3;                         // [kg]
constexpr double softest_material = 1e6;                       // [Pa]
constexpr double least_yield_drift = 1e-5;                     // [m]
constexpr double least_yield_rotation = 2e-5;                  // [rad]
constexpr double largest_ultimate_rotation = 0.5;              // [rad]
constexpr double deepest_penetration = 0.05;                   // [m]
constexpr double coarsest_tolerance = 1e-2;

// Bodies are no buildings: balls and trucks may be light.
bool stands(const Structure& s) { return !s.is_rigid() && !s.is_free; }

void doubt_period(const Structure& s, std::vector<Doubt>& doubts) {
  const double period = 2 * M_PI / s.frequencies[0];
  if (period >= shortest_period && period <= longest_period) return;
  doubts.push_back({"period", fmt::format("structure {}: the first period is {:.4g} s, and those of structures lie from {:g} s to {:g} s; are "
                                          "masses and stiffnesses in kg and N/m, or with their units?",
                                          s.name, period, shortest_period, longest_period)});
}

void doubt_mass(const Structure& s, std::vector<Doubt>& doubts) {
  const auto lightest = std::min_element(s.floors.begin(), s.floors.end(),
                                         [](const Floor& a, const Floor& b) { return a.mass < b.mass; });
  if (lightest == s.floors.end() || lightest->mass >= lightest_floor) return;
  doubts.push_back({"mass", fmt::format("structure {}: floor {} has {}, under 1 t; a bare mass is in kg, type its unit, as in 250 t", s.name,
                                        lightest->label, format_quantity(lightest->mass, dimension::mass))});
}

// Height of the highest storey, the first one from the lowest node [m]; of the whole frame where it has no floors.
double highest_storey(const Structure& s) {
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); };
  const auto [low, high] = std::minmax_element(s.geometry.positions.begin(), s.geometry.positions.end(), less);
  double below = low->z(), highest = 0;
  for (const Floor& floor : s.floors) {
    highest = std::max(highest, *floor.elevation - below);
    below = *floor.elevation;
  }
  return s.floors.empty() ? high->z() - low->z() : highest;
}

void doubt_members(const Structure& s, std::vector<Doubt>& doubts) {
  const Geometry& g = s.geometry;
  if (g.members.empty()) return;
  const auto deepest = std::max_element(g.depths.begin(), g.depths.end());
  const auto name_of = [&](std::ptrdiff_t member) -> const std::string& { return g.member_names[member]; };
  const auto metres = [](double length) { return format_quantity(length, dimension::length); };
  if (const double storey = highest_storey(s); storey > 0 && *deepest > storey)
    doubts.push_back({"section", fmt::format("structure {}: member {} is some {} deep, more than a storey of {}; a bare length is in m, type its "
                                             "unit, as in 400 mm",
                                             s.name, name_of(deepest - g.depths.begin()), metres(*deepest), metres(storey))});
  const auto softest = std::min_element(g.moduli.begin(), g.moduli.end());
  if (*softest < softest_material)
    doubts.push_back({"E", fmt::format("structure {}: member {} has E = {}, under 1 MPa; a bare E is in Pa, type its unit, as in 30 GPa", s.name,
                                       name_of(softest - g.moduli.begin()), format_quantity(*softest, dimension::stress))});
}

// Isolators stick until they slide, and dampers have no limit.
void doubt_yielding(const Structure& s, std::vector<Doubt>& doubts) {
  const auto first_doubt = [&](const char* name, auto&& text_of) {
    for (const YieldingPart& part : s.yielding)
      if (const std::string text = text_of(part); !text.empty()) {
        doubts.push_back({name, fmt::format("structure {}: {} {}", s.name, part.name, text)});
        return;
      }
  };
  first_doubt("yield", [](const YieldingPart& part) -> std::string {
    const double first = std::min(part.limits.positive, part.limits.negative);
    if (part.kind == YieldingPart::Kind::storey && first < least_yield_drift)
      return fmt::format("yields at {}, under 0.01 mm; a bare force is in N, type its unit, as in 900 kN", format_quantity(first, dimension::length));
    if (part.kind == YieldingPart::Kind::hinge && first < least_yield_rotation)
      return fmt::format("yields at {:.4g} mrad, under 0.02 mrad; a bare moment is in N m, type its unit, as in 250 kN m", 1e3 * first);
    return {};
  });
  first_doubt("rotation", [](const YieldingPart& part) -> std::string {
    const double ultimate = part.parameter("ultimate_rotation");
    if (!(ultimate > largest_ultimate_rotation)) return {};
    return fmt::format("has an ultimate rotation of {:.4g} rad, above 0.5 rad; a bare rotation is in rad, as in 0.03", ultimate);
  });
}

void doubt_gaps(const Model& model, std::vector<Doubt>& doubts) {
  const auto widest = std::max_element(model.links.begin(), model.links.end(), [](const Link& a, const Link& b) { return a.gap < b.gap; });
  if (widest == model.links.end() || widest->gap <= widest_gap) return;
  doubts.push_back({"gap", fmt::format("link {}: the gap is {}, above {:g} m; a bare length is in m, type its unit, as in 20 mm, and look at the "
                                       "origins",
                                       widest->name, format_quantity(widest->gap, dimension::length), widest_gap)});
}

// Ends without a typed face whose gap would hold the columns on both sides: drawn by axes, it seems.
void doubt_faces(const Model& model, std::vector<Doubt>& doubts) {
  for (const Link& link : model.links) {
    const Structure &a = model.structures[link.left.structure], &b = model.structures[link.right.structure];
    if (link.left.face || link.right.face || link.gap < narrowest_between_axes || link.gap > widest_gap || !are_drawn(a, b)) continue;
    const AxisAdvice advice = advice_on_axes(model, link.left, link.right, side_of(link.direction));
    if (advice.sum() == 0 || link.gap < advice.sum()) continue;
    doubts.push_back({"face", fmt::format("link {}: the gap is {}, and the columns reach {} and {} beyond their axes; if the frames are drawn by axes, type "
                                          "{}, which leaves {} between faces",
                                          link.name, format_quantity(link.gap, dimension::length), format_quantity(advice.halves[0], dimension::length),
                                          format_quantity(advice.halves[1], dimension::length), advice.text,
                                          format_quantity(link.gap - advice.sum(), dimension::length))});
    return;
  }
}

// A column is stiff that near a joint, and its short end takes nearly the whole blow.
void doubt_joints(const Model& model, std::vector<Doubt>& doubts) {
  const Link* nearest = nullptr;
  const LinkEnd* hit = nullptr;
  int others = -1;
  for (const Link& link : model.links)
    for (const LinkEnd* end : {&link.left, &link.right}) {
      if (!(end->point.to_joint > 0 && end->point.to_joint < end->point.column_depth)) continue;
      ++others;
      if (!hit || end->point.to_joint < hit->point.to_joint - drawn_rounding) nearest = &link, hit = end;
    }
  if (!hit) return;
  const auto metres = [](double length) { return format_quantity(length, dimension::length); };
  doubts.push_back({"joint", fmt::format("link {}: the column of {} is hit {} from a joint, and it is {} deep{}; if the floors are level, type level_within: "
                                         "{}, or link the floors by their numbers",
                                         nearest->name, model.structures[hit->structure].name, metres(hit->point.to_joint),
                                         metres(hit->point.column_depth), others > 0 ? fmt::format(" (and {} more)", others) : "",
                                         metres(std::ceil(hit->point.to_joint * 100) / 100))});
}

// The texts of those that the model does not accept.
std::vector<std::string> texts(const Model& model, const std::vector<Doubt>& doubts) {
  std::vector<std::string> all;
  for (const Doubt& doubt : doubts)
    if (std::find(model.accept.begin(), model.accept.end(), doubt.name) == model.accept.end())
      all.push_back(fmt::format("{} (where it is meant: accept: [{}])", doubt.text, doubt.name));
  return all;
}

}  // namespace

std::vector<std::string> implausible(const Model& model) {
  std::vector<Doubt> doubts = model.read_doubts;
  for (const Structure& s : model.structures) {
    if (!stands(s)) continue;
    doubt_period(s, doubts);
    doubt_mass(s, doubts);
    doubt_members(s, doubts);
    doubt_yielding(s, doubts);
  }
  doubt_gaps(model, doubts);
  doubt_faces(model, doubts);
  doubt_joints(model, doubts);
  if (model.analysis.tolerance > coarsest_tolerance)
    doubts.push_back({"tolerance", fmt::format("analysis: a tolerance of {:g} allows errors of {:g} % in displacements and forces; 1e-4 is usual",
                                               model.analysis.tolerance, 100 * model.analysis.tolerance)});
  return texts(model, doubts);
}

std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations) {
  std::vector<Doubt> doubts;
  if (!moved)
    doubts.push_back({"motion", "nothing moved: the model has no ground motion, no forces and no initial motion; type one of ground_motion:, forces:, "
                                "initial_displacement: and initial_velocity:"});
  const auto deepest = std::max_element(penetrations.begin(), penetrations.end());
  if (deepest != penetrations.end() && *deepest > deepest_penetration)
    doubts.push_back({"penetration", fmt::format("link {}: the bodies overlap by {}, more than {:g} mm; the contact is too soft, look at the unit "
                                                 "of its stiffness",
                                                 model.links.at(static_cast<std::size_t>(deepest - penetrations.begin())).name,
                                                 format_quantity(*deepest, dimension::length), 1e3 * deepest_penetration)});
  return texts(model, doubts);
}

}  // namespace pounding
