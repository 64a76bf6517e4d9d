#include <pounding/reports/plausible.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/hysteresis/all.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/reports/fibre_report.hpp>
#include <pounding/structures/isolators.hpp>
#include <pounding/structures/storey_heights.hpp>

namespace pounding {
namespace {

constexpr double shortest_period = 0.02, longest_period = 20;  // [s]
constexpr double widest_gap = 2, narrowest_gap = 5e-5;         // [m]
constexpr double round_off_of_gap = 1e-9;                      // [m], in a gap that is drawn closed
constexpr double weakest_isolators = 2e-3;                     // of the weight
constexpr double strongest_ground = 10 * standard_gravity;     // [m/s^2]
constexpr double largest_start = 2, fastest_start = 10;        // [m], [m/s]
constexpr double largest_drift = 0.1;                          // of the height of the storey
constexpr double lightest_floor = 1e3;                         // [kg]
constexpr double thinnest_member = 2e-3;                       // [m]
constexpr double softest_material = 1e8;                       // [Pa]
constexpr double min_yield_drift = 1e-5;                       // [m]
constexpr double min_yield_rotation = 2e-5;                    // [rad]
constexpr double largest_ultimate_rotation = 0.5;              // [rad]
constexpr double largest_capacity = 20;                        // [m] or [rad], of springs that deteriorate
constexpr double deepest_penetration = 0.05;                   // [m]
constexpr double coarsest_tolerance = 1e-2;
constexpr double max_cut = 0.05;  // of the Arias intensity of a record

struct Warnings : std::vector<Warning> {
  template <class... T>
  void add(const char* name, fmt::format_string<T...> text, T&&... values) {
    push_back({name, fmt::format(text, std::forward<T>(values)...)});
  }
};

// True for buildings: bodies such as balls and trucks may be light.
bool stands(const Structure& s) { return !s.is_rigid() && !s.is_free; }

void warn_about_period(const Structure& s, Warnings& warnings) {
  const double period = 2 * M_PI / s.frequencies[0];
  if (period >= shortest_period && period <= longest_period) return;
  warnings.add("period",
               "structure {}: the first period is {:.4g} s, and those of structures lie from {:g} s to "
               "{:g} s; check that masses and stiffnesses are in kg and N/m, or have units",
               s.name, period, shortest_period, longest_period);
}

void warn_about_mass(const Structure& s, Warnings& warnings) {
  // A number that makes the floors light already has a warning of the reader.
  const std::string place = fmt::format("structures.{}.", s.name);
  if (std::ranges::any_of(
          warnings, [&](const Warning& warning) { return warning.name == "mass" && warning.text.starts_with(place); }))
    return;
  const auto lightest = std::min_element(s.floors.begin(), s.floors.end(),
                                         [](const Floor& a, const Floor& b) { return a.mass < b.mass; });
  if (lightest == s.floors.end() || lightest->mass >= lightest_floor) return;
  warnings.add("mass", "structure {}: floor {} has {}, under 1 t; a bare mass is in kg, type its unit, as in 250 t",
               s.name, lightest->label, format_quantity(lightest->mass, dimension::mass));
}

// Height of the highest storey, the first one from the lowest node [m]; of the whole frame if it has no floors.
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

void warn_about_members(const Structure& s, Warnings& warnings) {
  const Geometry& g = s.geometry;
  if (g.members.empty()) return;
  const auto deepest = std::max_element(g.depths.begin(), g.depths.end());
  const auto name_of = [&](std::ptrdiff_t member) -> const std::string& { return g.member_names[member]; };
  const auto metres = [](double length) { return format_quantity(length, dimension::length); };
  if (const double storey = highest_storey(s); storey > 0 && *deepest > storey)
    warnings.add("section",
                 "structure {}: member {} is some {} deep, more than a storey of {}; a bare length is in m, type its "
                 "unit, as in 400 mm",
                 s.name, name_of(deepest - g.depths.begin()), metres(*deepest), metres(storey));
  const auto thinnest = std::min_element(g.depths.begin(), g.depths.end());
  if (*thinnest < thinnest_member)
    warnings.add("section", "structure {}: member {} is some {} deep, under 2 mm; check the unit of its section",
                 s.name, name_of(thinnest - g.depths.begin()), metres(*thinnest));
  const auto softest = std::min_element(g.moduli.begin(), g.moduli.end());
  if (*softest < softest_material)
    warnings.add("E",
                 "structure {}: member {} has E = {}, under 100 MPa; a bare E is in Pa, type its unit, as in 30 GPa",
                 s.name, name_of(softest - g.moduli.begin()), format_quantity(*softest, dimension::stress));
}

// Laws that their authors have replaced, each once.
void warn_about_laws(const Model& model, Warnings& warnings) {
  std::set<std::string> named;
  const auto look_at = [&](const std::string& place, const std::string& law) {
    for (const hysteresis::Entry& entry : hysteresis::catalogue())
      if (entry.name == law && !entry.replaced_by.empty() && named.insert(law).second)
        warnings.add("superseded",
                     "{} has the law {}, which its authors replaced (OpenSees issue 537); type {}, with twice Lambda_K",
                     place, law, entry.replaced_by);
  };
  for (const Structure& s : model.structures)
    for (const YieldingPart& part : s.yielding) look_at(fmt::format("structure {}: {}", s.name, part.name), part.law);
  for (const Device& device : model.devices)
    if (device.parts.law) look_at("device " + device.name, device.parts.law->law);
}

// Isolators stick until they slide, and dampers have no limit.
void warn_about_yielding(const Structure& s, Warnings& warnings) {
  const auto first_warning = [&](const char* name, auto&& text_of) {
    for (const YieldingPart& part : s.yielding)
      if (const std::string text = text_of(part); !text.empty()) {
        warnings.add(name, "structure {}: {} {}", s.name, part.name, text);
        return;
      }
  };
  first_warning("yield", [](const YieldingPart& part) -> std::string {
    const double first = std::min(part.limits.positive, part.limits.negative);
    if (part.kind == YieldingPart::Kind::storey && first < min_yield_drift)
      return fmt::format("yields at {}, under 0.01 mm; a bare force is in N, type its unit, as in 900 kN",
                         format_quantity(first, dimension::length));
    if (part.kind == YieldingPart::Kind::hinge && first < min_yield_rotation)
      return fmt::format(
          "yields at {:.4g} mrad, under 0.02 mrad; a bare moment is in N m, type its unit, as in 250 kN m",
          1e3 * first);
    return {};
  });
  first_warning("rotation", [](const YieldingPart& part) -> std::string {
    const double ultimate = part.hinge ? part.hinge->ultimate_rotation.value_or(0) : 0;
    if (!(ultimate > largest_ultimate_rotation)) return {};
    return fmt::format("has an ultimate rotation of {:.4g} rad, above 0.5 rad; a bare rotation is in rad, as in 0.03",
                       ultimate);
  });
  first_warning("Lambda", [](const YieldingPart& part) -> std::string {
    const bool is_hinge = part.kind == YieldingPart::Kind::hinge;
    const std::string plastic = is_hinge ? "theta_p" : "dp";
    const double theta_p = part.parameter(plastic);
    for (const char* const name : {"Lambda_S", "Lambda_C", "Lambda_A", "Lambda_K"})
      if (const double value = part.parameter(name); value > largest_capacity)
        return fmt::format(
            "has {0} = {1:.4g}, above {2:g}; {0} is lambda {3} and has its unit: with lambda = {1:.4g} "
            "and {3} = {4:.4g}, type {0}: {5:.4g}{6}",
            name, value, largest_capacity, plastic, theta_p, value * theta_p, is_hinge ? "" : " m");
    return {};
  });
}

// Force at which an isolator starts to move [N]; NaN if its law does not define one.
double strength(const YieldingPart& part) {
  if (const double sliding = part.parameter("friction") * part.parameter("weight"); !std::isnan(sliding))
    return sliding;
  const double characteristic = part.parameter("strength");
  return std::isnan(characteristic) ? part.parameter("yield_force") : characteristic;
}

// Strength of all isolators together; in space each is listed once per axis.
void warn_about_isolators(const Structure& s, Warnings& warnings) {
  const double weight = s.total_mass().x() * standard_gravity;
  double sum = 0;
  for (const YieldingPart& part : s.yielding)
    if (isolates(part)) sum += strength(part);
  if (s.dimension == 3) sum /= 2;
  if (!(weight > 0) || !(sum > 0) || (sum >= weakest_isolators * weight && sum <= weight)) return;
  warnings.add("isolator",
               "structure {}: its isolators start to move at {}, {:.3g} % of its weight of {}, 2 % to 15 % are "
               "typical; a bare force is in N, type its unit, as in 375 kN",
               s.name, format_quantity(sum, dimension::force), 100 * sum / weight,
               format_quantity(weight, dimension::force));
}

void warn_about_start(const Structure& s, Warnings& warnings) {
  const auto largest = [](const Eigen::VectorXd& values) {
    return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
  };
  if (const double moved = largest(s.initial_displacement); moved > largest_start)
    warnings.add("initial",
                 "structure {}: initial displacement of {}, above {:g} m; a bare "
                 "length is in m, type its unit, as in -5 mm",
                 s.name, format_quantity(moved, dimension::length), largest_start);
  if (const double velocity = largest(s.initial_velocity); velocity > fastest_start)
    warnings.add("initial",
                 "structure {}: initial velocity of {}, above {:g} m/s; a bare velocity is in m/s, type its unit, as "
                 "in 0.5 m/s",
                 s.name, format_quantity(velocity, dimension::velocity), fastest_start);
}

void warn_about_ground(const Model& model, Warnings& warnings) {
  double peak = 0;
  const auto take = [&](const GroundComponents& components) {
    for (const GroundMotion& motion : components) peak = std::max(peak, motion.peak());
  };
  take(model.ground.components);
  for (const Structure& s : model.structures)
    for (const Support& support : s.supports)
      if (support.motion) take(*support.motion);
  if (peak <= strongest_ground) return;
  warnings.add("scale",
               "ground motion: its peak acceleration is {:.4g} g, above {:g} g; scale is a factor on the record in "
               "its own unit, as in 1.5, and pga: 0.35 g gives the peak itself",
               peak / standard_gravity, strongest_ground / standard_gravity);
}

void warn_about_gaps(const Model& model, Warnings& warnings) {
  const auto widest = std::max_element(model.links.begin(), model.links.end(),
                                       [](const Link& a, const Link& b) { return a.gap < b.gap; });
  if (widest == model.links.end()) return;
  const auto is_narrow = [](const Link& link) { return link.gap > round_off_of_gap && link.gap < narrowest_gap; };
  if (const auto narrow = std::ranges::find_if(model.links, is_narrow); narrow != model.links.end())
    warnings.add(
        "gap", "link {}: the gap is {}, under 0.05 mm; type it with its unit, as in 20 mm, or gap: 0 if the two touch",
        narrow->name, format_quantity(narrow->gap, dimension::length));
  if (widest->gap <= widest_gap) return;
  warnings.add("gap",
               "link {}: the gap is {}, above {:g} m; a bare length is in m, type its unit, as in 20 mm, and check the "
               "origins",
               widest->name, format_quantity(widest->gap, dimension::length), widest_gap);
}

// Calls visit(samples, last arrival [s]) for each record of the ground, of supports and of forces. Copies of a motion
// share their samples.
template <class Visit>
void for_each_record(const Model& model, const Visit& visit) {
  const auto look_at = [&](const GroundMotion& motion, double arrival) {
    if (motion.samples()) visit(*motion.samples(), arrival);
  };
  const double last_arrival = ground_plan(model).last_arrival;
  for (const GroundMotion& component : model.ground.components) look_at(component, last_arrival);
  for (const Structure& s : model.structures) {
    for (const Support& support : s.supports)
      for (std::size_t i = 0; support.motion && i < support.motion->size(); ++i)
        look_at((*support.motion)[i], support.delay);
    for (const AppliedForce& force : s.applied_forces) look_at(force.history, 0);
  }
}

// Closed forms are skipped: their times are typed next to the duration.
void warn_about_duration(const Model& model, Warnings& warnings) {
  std::map<const Samples*, double> arrivals;
  for_each_record(model, [&](const Samples& samples, double arrival) {
    double& latest = arrivals.try_emplace(&samples, arrival).first->second;
    latest = std::max(latest, arrival);
  });
  int cut = 0;
  double worst = 0, needed = 0;
  for (const auto& [samples, arrival] : arrivals) {
    const double lost = arias_fraction_after(*samples, model.analysis.duration - arrival);
    if (!(lost > max_cut)) continue;
    ++cut;
    worst = std::max(worst, lost);
    needed = std::max(needed, arrival + measure(*samples).t95);
  }
  if (cut > 0)
    warnings.add("duration",
                 "analysis: the duration of {:.4g} s cuts {} of {} record{}, by more than 5 % of the Arias intensity "
                 "and up to {:.0f} %; type a duration of at least {:.6g} s, or remove it",
                 model.analysis.duration, cut, arrivals.size(), arrivals.size() == 1 ? "" : "s", 100 * worst,
                 std::ceil(10 * needed) / 10);
}

void warn_about_records(const Model& model, Warnings& warnings) {
  std::set<std::string> known;
  for_each_record(model, [&](const Samples& samples, double) {
    for (const std::string& text : samples.warnings)
      if (known.insert(text).second) warnings.push_back({"record", text});
  });
}

// Ends without a typed face whose gap has room for the columns on both sides: probably drawn at the axes.
void warn_about_faces(const Model& model, Warnings& warnings) {
  for (const Link& link : model.links) {
    const Structure &a = model.structures[link.left.structure], &b = model.structures[link.right.structure];
    if (link.left.face || link.right.face || link.gap < narrowest_between_axes || link.gap > widest_gap ||
        !are_drawn(a, b))
      continue;
    const AxisAdvice advice = advice_on_axes(model, link.left, link.right, side_of(link.direction));
    if (advice.sum() == 0 || link.gap < advice.sum()) continue;
    warnings.add("face",
                 "link {}: the gap is {}, and the columns reach {} and {} beyond their axes; if the frames are drawn "
                 "by axes, type {}, which leaves {} between faces",
                 link.name, format_quantity(link.gap, dimension::length),
                 format_quantity(advice.halves[0], dimension::length),
                 format_quantity(advice.halves[1], dimension::length), advice.text,
                 format_quantity(link.gap - advice.sum(), dimension::length));
    return;
  }
}

// Near a joint a column is so stiff that its short end takes almost the entire impact.
void warn_about_joints(const Model& model, Warnings& warnings) {
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
  warnings.add("joint",
               "link {}: the column of {} is hit {} from a joint, and it is {} deep{}; if the floors are level, type "
               "level_within: {}, or link the floors by their numbers",
               nearest->name, model.structures[hit->structure].name, metres(hit->point.to_joint),
               metres(hit->point.column_depth), others > 0 ? fmt::format(" (and {} more)", others) : "",
               metres(std::ceil(hit->point.to_joint * 100) / 100));
}

// Texts of the warnings that the model does not accept.
std::vector<std::string> texts(const Model& model, const std::vector<Warning>& warnings) {
  std::vector<std::string> all;
  for (const Warning& warning : warnings)
    if (std::find(model.accept.begin(), model.accept.end(), warning.name) == model.accept.end())
      all.push_back(fmt::format("{} (to suppress this warning: accept: [{}])", warning.text, warning.name));
  return all;
}

}  // namespace

std::vector<std::string> implausible(const Model& model) { return implausible(model, model.analysis.tolerance); }

std::vector<std::string> implausible(const Model& model, double tolerance) {
  Warnings warnings{model.read_warnings};
  for (const Structure& s : model.structures) {
    if (!stands(s)) continue;
    warn_about_period(s, warnings);
    warn_about_mass(s, warnings);
    warn_about_members(s, warnings);
    warn_about_yielding(s, warnings);
    warn_about_isolators(s, warnings);
    warn_about_start(s, warnings);
    std::ranges::copy(warnings_about_fibres(s), std::back_inserter(warnings));
  }
  warn_about_laws(model, warnings);
  warn_about_ground(model, warnings);
  warn_about_gaps(model, warnings);
  warn_about_duration(model, warnings);
  warn_about_records(model, warnings);
  warn_about_faces(model, warnings);
  warn_about_joints(model, warnings);
  if (tolerance > coarsest_tolerance)
    warnings.add("tolerance",
                 "analysis: a tolerance of {:g} allows errors of {:g} % in displacements and forces; 1e-4 is typical",
                 tolerance, 100 * tolerance);
  return texts(model, warnings);
}

std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations) {
  Warnings warnings;
  if (!moved)
    warnings.push_back({"motion",
                        "nothing moved: the model has no ground motion, no forces and no initial motion; type one of "
                        "ground_motion:, forces:, "
                        "initial_displacement: and initial_velocity:"});
  const auto deepest = std::max_element(penetrations.begin(), penetrations.end());
  if (deepest != penetrations.end() && *deepest > deepest_penetration)
    warnings.add("penetration",
                 "link {}: the bodies overlap by {}, more than {:g} mm; the contact is too soft; check the unit "
                 "of its stiffness",
                 model.links.at(static_cast<std::size_t>(deepest - penetrations.begin())).name,
                 format_quantity(*deepest, dimension::length), 1e3 * deepest_penetration);
  return texts(model, warnings);
}

std::vector<std::string> implausible_drifts(const Model& model, std::span<const std::vector<double>> drifts) {
  Warnings warnings;
  for (std::size_t k = 0; k < drifts.size(); ++k) {
    const Structure& s = model.structures[k];
    // Members in large rotations are expected to drift far.
    const std::vector<double> heights = s.elastic ? std::vector<double>{} : storey_heights(s);
    // Isolators move far by design, and the lowest floor of a frame on isolators moves with them.
    std::size_t worst = is_isolated(s) ? 1 : 0;
    for (std::size_t i = worst + 1; i < std::min(heights.size(), drifts[k].size()); ++i)
      if (drifts[k][i] / heights[i] > drifts[k][worst] / heights[worst]) worst = i;
    if (worst >= std::min(heights.size(), drifts[k].size()) || !(drifts[k][worst] > largest_drift * heights[worst]))
      continue;
    warnings.add("drift",
                 "structure {}: storey {} drifts by {}, {:.3g} % of its height of {} and above {:g} %, which no "
                 "building survives; check the units of masses, stiffnesses and ground motion, or type analysis: "
                 "{{collapse_drift: 10 %}} to end the run there",
                 s.name, s.floors[worst].label, format_quantity(drifts[k][worst], dimension::length, 4),
                 100 * drifts[k][worst] / heights[worst], format_quantity(heights[worst], dimension::length),
                 100 * largest_drift);
  }
  return texts(model, warnings);
}

}  // namespace pounding
