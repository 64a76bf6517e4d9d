#include <pounding/model/start/start.hpp>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/first_yield.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/rounding.hpp>

namespace pounding {
namespace {

[[noreturn]] void refuse_preload(const std::string& text) { throw ModelError(ModelOption::preload, text); }

constexpr int max_iterations = 200;
// Relative Newton step at which the penetration is converged.
constexpr double solved = 1e-14;

using Factor = Eigen::SimplicialLDLT<SparseMatrix>;

void require_linear_start(const Structure& s) {
  if (s.is_free || s.rigid_motions > 0)
    refuse_preload(fmt::format("{} has no stiffness against a preload; use a structure with a stiffness", s.name));
  if (const std::string why = s.why_stiffness_changes(); !why.empty())
    refuse_preload(
        fmt::format("{}: {}, but a preload requires a constant stiffness; remove one of the two", s.name, why));
  if (s.initial_displacement.cwiseAbs().maxCoeff() > 0)
    refuse_preload(
        fmt::format("{} starts displaced, but with a preload it starts in equilibrium; remove one of the two", s.name));
}

// Approach of the two ends of a link [m].
template <class Displacement>
double approach(const Link& link, const std::vector<Structure>& structures, Displacement&& displacement) {
  double sum = 0;
  for (const auto& [end, sign] : {std::pair(&link.left, 1.0), std::pair(&link.right, -1.0)}) {
    const Structure& s = structures[end->structure];
    const Eigen::VectorXd u = displacement(s);
    if (u.size() > 0) sum += sign * motion_along(*end, link.direction, s.size()).dot(u);
  }
  return sum;
}

// Penetrations p = p0 - G F(p): Newton's method, with shorter steps if the residual does not decrease.
Eigen::VectorXd equilibrium(const Eigen::VectorXd& undeformed, const Eigen::MatrixXd& flexibility,
                            const std::vector<const Contact*>& contacts) {
  const auto count = undeformed.size();
  Eigen::VectorXd slopes(count);
  const auto remainder = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd {
    Eigen::VectorXd forces(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const laws::Response r = contacts[static_cast<std::size_t>(i)]->first_loading(p[i]);
      forces[i] = r.force, slopes[i] = r.by_penetration;
    }
    return p - undeformed + flexibility * forces;
  };
  Eigen::VectorXd p = undeformed, left = remainder(p);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Eigen::MatrixXd tangent = Eigen::MatrixXd::Identity(count, count) + flexibility * slopes.asDiagonal();
    const Eigen::VectorXd step = tangent.partialPivLu().solve(-left);
    if (step.norm() <= solved * undeformed.norm()) return p;
    double part = 1;
    Eigen::VectorXd next = remainder(p + step);
    while (next.norm() > left.norm() && part > 1e-3) next = remainder(p + (part /= 2) * step);
    p += part * step;
    left = next;
  }
  refuse_preload("no equilibrium of the preloaded contacts was found; check the units of their stiffness");
}

// The structures are assumed elastic.
void refuse_yield(const Structure& s) {
  for (const YieldingPart& part : s.yielding) {
    if (part.is_device() || part.direction > 0) continue;  // devices are undeformed
    const auto motion = [&](int j) {
      const YieldingPart& one = *(&part + j);
      return LinkMotion{one.at_rest + one.deformation.dot(s.preload_displacement), 0};
    };
    const double strained = resultant(*part.element, 0, motion).penetration;
    if (const auto yield = yields_before(part, strained))
      refuse_preload(fmt::format("deforms {} of {} by {}, but it yields at {}; give less", part.name, s.name,
                                 deformation_text(s, part, strained), deformation_text(s, part, *yield)));
  }
}

}  // namespace

void press_preloaded(std::vector<Structure>& structures, std::vector<Link>& links) {
  std::vector<Link*> pressed;
  for (Link& link : links)
    if (link.preload) pressed.push_back(&link);
  if (pressed.empty()) return;

  const auto count = static_cast<Eigen::Index>(pressed.size());
  // Displacements of each structure for a unit force per link that pushes its ends apart.
  std::map<int, Eigen::MatrixXd> pushed;
  std::map<int, Eigen::MatrixXd> closing;
  for (Eigen::Index i = 0; i < count; ++i)
    for (const auto& [end, sign] : {std::pair(&pressed[i]->left, 1.0), std::pair(&pressed[i]->right, -1.0)}) {
      const Structure& s = structures[end->structure];
      if (s.is_rigid()) continue;
      auto [columns, is_new] = closing.try_emplace(end->structure, Eigen::MatrixXd::Zero(s.size(), count));
      if (is_new) require_linear_start(s);
      columns->second.col(i) += sign * motion_along(*end, pressed[i]->direction, s.size());
    }
  Eigen::MatrixXd flexibility = Eigen::MatrixXd::Zero(count, count);
  for (const auto& [number, columns] : closing) {
    const Factor factor(structures[number].stiffness);
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0))
      refuse_preload(fmt::format("{} has no stiffness against a preload; check its supports", structures[number].name));
    pushed[number] = -factor.solve(columns);
    flexibility -= columns.transpose() * pushed[number];
  }

  Eigen::VectorXd undeformed(count), forces(count);
  std::vector<const Contact*> contacts;
  for (Eigen::Index i = 0; i < count; ++i) {
    contacts.push_back(pressed[i]->contact.get());
    undeformed[i] = approach(*pressed[i], structures, [](const Structure& s) { return s.at_rest; }) - pressed[i]->gap;
  }
  const Eigen::VectorXd penetration = equilibrium(undeformed, flexibility, contacts);
  for (Eigen::Index i = 0; i < count; ++i) {
    Link& link = *pressed[i];
    if (!(penetration[i] > 0))
      refuse_preload(
          fmt::format("{} would start {} apart, opened by the other preloaded links; give it a gap that is more "
                      "negative, or none",
                      link.name, format_quantity(-penetration[i], dimension::length)));
    try {
      ContactMemory memory = link.contact->initial();
      link.contact->press(memory, penetration[i]);  // throws for a contact that cannot start closed
      link.pressed = penetration[i];
    } catch (const std::invalid_argument& error) {
      refuse_preload(fmt::format("{}: {}", link.name, error.what()));
    }
    forces[i] = contacts[i]->first_loading(penetration[i]).force;
  }
  for (const auto& [number, columns] : pushed) {
    structures[number].preload_displacement = columns * forces;
    refuse_yield(structures[number]);
  }

  const auto at_start = [](const Structure& s) -> Eigen::VectorXd {
    if (s.is_rigid()) return {};
    Eigen::VectorXd u = s.initial_displacement;
    if (s.at_rest.size() > 0) u += s.at_rest;
    if (s.preload_displacement.size() > 0) u += s.preload_displacement;
    return u;
  };
  for (const Link& link : links) {
    if (link.preload) continue;
    const double overlap = approach(link, structures, at_start) - link.gap;
    if (!(overlap > 0)) continue;
    double rounding = std::numeric_limits<double>::epsilon() * link.gap;
    for (const LinkEnd* end : {&link.left, &link.right}) {
      const Structure& s = structures[end->structure];
      rounding += displacement_rounding(*end, s, link.direction, at_start(s));
    }
    if (overlap > rounding)
      refuse_preload(
          fmt::format("closes {} as well, by {}; give that link a wider gap, or a negative one and preload: true",
                      link.name, format_quantity(overlap, dimension::length)));
  }
}

}  // namespace pounding
