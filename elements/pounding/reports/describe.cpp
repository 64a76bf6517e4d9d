#include <pounding/reports/describe.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/reports/fibre_report.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {
namespace {

// "structure left: frame, 8 floors, 960 t, first periods 1.43 s and 0.46 s"
std::string describe(const Structure& s) {
  std::string text = fmt::format("structure {}: {}", s.name, s.kind);
  if (s.is_rigid()) return text;
  if (!s.is_free) text += fmt::format(", {} floor{}", s.floors.size(), s.floors.size() == 1 ? "" : "s");
  text += ", " + format_quantity(s.total_mass()[0], dimension::mass, 6);
  if (s.is_free) return text;
  if (s.rigid_motions > 0) text += ", without supports";
  const auto period = [&](int mode) { return fmt::format("{:.4g} s", 2 * M_PI / s.frequencies[mode]); };
  return text + (s.frequencies.size() > 1 ? fmt::format(", first periods {} and {}", period(0), period(1))
                                          : ", period " + period(0));
}

std::string range(const std::string& from, const std::string& to) { return from == to ? from : from + " to " + to; }

// "     4 isolators, lead_rubber: stiffness 8.75 MN/m, yield displacement 13.2 mm at 115.8 kN, isolated period 3.096 s,
// capacity 300 mm"
std::string describe_isolators(const Structure& s) {
  constexpr double none = std::numeric_limits<double>::infinity();
  struct Range {
    double minimum = none, largest = 0;
    void take(double value) { minimum = std::min(minimum, value), largest = std::max(largest, value); }
    std::string text(const Dimension& dimension) const {
      const auto shown = [&](double value) { return format_quantity(value, dimension, 4); };
      return range(shown(minimum), shown(largest));
    }
  };
  Range stiffness, yield, force, capacity;
  int count = 0;
  bool is_coupled = false;
  std::string laws;
  for (const YieldingPart& part : s.yielding) {
    if (!isolates(part)) continue;
    ++count;
    is_coupled = is_coupled || !part.has_spring();
    const double k = part.stiffness(), d = part.yield_deformation();
    stiffness.take(k), yield.take(d), force.take(k * d);
    if (const double limit = part.parameter("capacity"); std::isfinite(limit)) capacity.take(limit);
    if (laws.find(part.law) == std::string::npos) laws += (laws.empty() ? "" : ", ") + part.law;
  }
  if (s.dimension == 3) count /= 2;  // parts along x and y
  const double period = isolated_period(s);
  std::string text =
      fmt::format("     {}, {}{}: stiffness {}, yield displacement {} at {}, ",
                  s.dimension == 1 ? "isolators" : fmt::format("{} isolator{}", count, count == 1 ? "" : "s"), laws,
                  is_coupled ? ", coupled along x and y" : "", stiffness.text(dimension::stiffness),
                  yield.text(dimension::length), force.text(dimension::force));
  text += std::isfinite(period) ? fmt::format("isolated period {:.4g} s", period)
                                : "no isolated period(no restoring force)";
  if (capacity.largest > 0) text += ", capacity " + capacity.text(dimension::length);
  return text + '\n';
}

// "     8 hinges: yield moments 180 kN m to 250 kN m, yield rotations 0.000192 to 0.000208, at rest up to 31 % of them"
std::string describe_hinges(const Structure& s) {
  double weakest = std::numeric_limits<double>::infinity(), strongest = 0, minimum = weakest, largest = 0, at_rest = 0;
  int count = 0;
  for (const YieldingPart& part : s.yielding) {
    if (part.kind != YieldingPart::Kind::hinge) continue;
    ++count;
    for (const double rotation : {part.limits.positive, part.limits.negative}) {
      const double moment = rotation * part.stiffness();
      weakest = std::min(weakest, moment), strongest = std::max(strongest, moment);
      minimum = std::min(minimum, rotation), largest = std::max(largest, rotation);
    }
    at_rest = std::max({at_rest, part.at_rest / part.limits.positive, -part.at_rest / part.limits.negative});
  }
  const auto moment = [](double value) { return fmt::format("{:.4g} kN m", value / 1e3); };
  if (count == 0) return {};
  std::string text = fmt::format("     {} hinge{}: yield moment {}, yield rotation {}", count, count == 1 ? "" : "s",
                                 range(moment(weakest), moment(strongest)),
                                 range(fmt::format("{:.4g}", minimum), fmt::format("{:.4g}", largest)));
  if (at_rest > 0) text += fmt::format(", at rest up to {:.3g} % of it", 100 * at_rest);
  return text + '\n';
}

// " between faces (300 mm from the axis of column 1.3 and 250 mm as typed)"; empty for ends without a face.
std::string faces_of(const Link& link) {
  if (!link.left.face && !link.right.face) return {};
  const auto face = [](const LinkEnd& end) {
    const std::string distance = format_quantity(end.face.value_or(0), dimension::length, 6);
    return end.face_column.empty() ? fmt::format("{} as typed", distance)
                                   : fmt::format("{} from the axis of {}", distance, end.face_column);
  };
  const std::string left = link.left.face ? face(link.left) : "", right = link.right.face ? face(link.right) : "";
  return fmt::format(" between faces ({}{}{})", left, left.empty() || right.empty() ? "" : " and ", right);
}

// ", floors 10 mm apart in height"; empty for floors that are level within round-off, and for other ends.
std::string heights_of(const Model& model, const Link& link) {
  if (link.left.floor < 0 || link.right.floor < 0) return {};
  const auto elevation = [&](const LinkEnd& end) {
    return model.structures[end.structure].floors[end.floor].elevation;
  };
  const auto left = elevation(link.left), right = elevation(link.right);
  if (!left || !right || std::abs(*left - *right) <= drawn_rounding) return {};
  return fmt::format(", floors {} apart in height", format_quantity(std::abs(*left - *right), dimension::length));
}

}  // namespace

std::string end_name(const Model& model, const LinkEnd& end) {
  const Structure& s = model.structures[end.structure];
  if (end.floor >= 0) return fmt::format("{}.{}", s.name, end.floor + 1);
  return end.label.empty() ? s.name : fmt::format("{}, {}", s.name, end.label);
}

std::string describe(const Model& model) {
  std::string text = model.title.empty() ? "" : model.title + "\n";
  if (!model.project.empty()) text += model.project + "\n";
  constexpr const char* axes[] = {"", " along y", " along z"};
  for (int i = 0; i < 3; ++i) {
    const GroundMotion& motion = model.ground.components[i];
    if (motion.is_still()) continue;
    text += fmt::format("ground motion{}  {}, peak {:.4g} m/s^2 ({:.4g} g)\n", axes[i], motion.source(), motion.peak(),
                        motion.peak() / standard_gravity);
  }
  for (const Structure& s : model.structures) {
    text += describe(s) + '\n';
    if (s.dimension > 1) text += describe_hinges(s);
    if (is_isolated(s)) text += describe_isolators(s);
    text += describe_fibres(s);
    for (const YieldingPart& part : s.yielding)
      if (part.is_device()) text += fmt::format("     device {}: {}\n", part.name, part.device);
    for (const AppliedForce& force : s.applied_forces)
      text += fmt::format("     force on {}: {}\n", force.place, force.history.source());
  }
  text += describe_joined(model);
  for (const Link& link : model.links) {
    text += fmt::format("link {}: {}{}{}, gap {:.6g} mm", link.name, link.law, link.formula.empty() ? "" : ", ",
                        link.formula, 1e3 * link.gap);
    text += faces_of(link);
    text += heights_of(model, link);
    if (link.preload) text += ", preloaded";
    if (link.seat) text += fmt::format(", seat {:.6g} mm", 1e3 * *link.seat);
    if (link.reduced_mass > 0)
      text += fmt::format(", reduced mass {:.6g} t {}", link.reduced_mass / 1e3,
                          link.reduced_mass_given ? "(as given)" : "(of the two ends)");
    text += '\n';
    if (!link.stiffness_from.empty())
      for (const laws::ResolvedValue& value : link.parameters)
        if (value.name == "stiffness")
          text += fmt::format("     stiffness {:.4g} {} ({})\n", value.value, value.unit, link.stiffness_from);
  }
  for (const Device& device : model.devices) text += describe(model, device);
  return text;
}

}  // namespace pounding
