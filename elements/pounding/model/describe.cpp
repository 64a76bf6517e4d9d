#include <pounding/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

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
  return text + (s.frequencies.size() > 1 ? fmt::format(", first periods {} and {}", period(0), period(1)) : ", period " + period(0));
}

// "     8 hinges: yield moments 180 kN m to 250 kN m, yield rotations 0.000192 to 0.000208, at rest up to 31 % of them"
std::string describe_hinges(const Structure& s) {
  double weakest = std::numeric_limits<double>::infinity(), strongest = 0, least = weakest, largest = 0, at_rest = 0;
  for (const YieldingPart& part : s.yielding) {
    if (part.is_device()) continue;
    const double rotation = part.spring->yield_deformation(), moment = rotation * part.spring->stiffness();
    weakest = std::min(weakest, moment), strongest = std::max(strongest, moment);
    least = std::min(least, rotation), largest = std::max(largest, rotation);
    at_rest = std::max(at_rest, std::abs(part.at_rest) / rotation);
  }
  const auto range = [](const std::string& from, const std::string& to) { return from == to ? from : from + " to " + to; };
  const auto moment = [](double value) { return fmt::format("{:.4g} kN m", value / 1e3); };
  const std::size_t count = s.members_that_yield();
  std::string text = fmt::format("     {} hinge{}: yield moment {}, yield rotation {}", count, count == 1 ? "" : "s", range(moment(weakest), moment(strongest)),
                                 range(fmt::format("{:.4g}", least), fmt::format("{:.4g}", largest)));
  if (at_rest > 0) text += fmt::format(", at rest up to {:.3g} % of it", 100 * at_rest);
  return text + '\n';
}

}  // namespace

std::string describe(const Model& model) {
  std::string text = model.title.empty() ? "" : model.title + "\n";
  constexpr const char* axes[] = {"", " along y", " along z"};
  for (int i = 0; i < 3; ++i) {
    const GroundMotion& motion = model.ground.components[i];
    if (motion.is_still()) continue;
    text += fmt::format("ground motion{}  {}, peak {:.4g} m/s^2 ({:.4g} g)\n", axes[i], motion.source(), motion.peak(),
                        motion.peak() / standard_gravity);
  }
  for (const Structure& s : model.structures) {
    text += describe(s) + '\n';
    if (s.dimension > 1 && s.members_that_yield() > 0) text += describe_hinges(s);
    for (const YieldingPart& part : s.yielding)
      if (part.is_device()) text += fmt::format("     device {}: {}\n", part.name, part.device);
    for (const AppliedForce& force : s.applied_forces) text += fmt::format("     force on {}: {}\n", force.place, force.history.source());
  }
  text += describe_joined(model);
  for (const Link& link : model.links) {
    text += fmt::format("link {}: {}{}{}, gap {:.6g} mm", link.name, link.law, link.formula.empty() ? "" : ", ",
                        link.formula, 1e3 * link.gap);
    if (link.preload) text += ", preloaded";
    if (link.reduced_mass > 0)
      text += fmt::format(", reduced mass {:.6g} t {}", link.reduced_mass / 1e3,
                          link.reduced_mass_given ? "(as given)" : "(of the two floors)");
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
