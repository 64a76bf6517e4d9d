#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>
#include <pounding/frames/frame_dofs.hpp>
#include <pounding/structures/make_spring.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

std::string moment(double size) { return fmt::format("{:.4g} kN m", size / 1e3); }

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

// Forces on the ends of the member, in local axes, and on its nodes, in global axes, per unit force of a hinge in
// addition to k d.
struct HingeForces {
  double k;
  Vector12 on_ends, on_nodes;
};

HingeForces forces_of(const Frame& frame, int number) {
  const Hinge& hinge = frame.hinges()[number];
  const Beam& beam = frame.beam(hinge.member);
  const Matrix12& stiffness = beam.local_stiffness();
  const int at = hinge.place();
  double k = stiffness(at, at);
  if (!hinge.is_rigid_plastic())
    k = hinge.stiffness > 0 ? hinge.stiffness : hinge.stiffness_factor * frame.bending_stiffness(hinge);
  if (!(k > 0))
    refuse(fmt::format(
        "hinge {}: the end of its member has no rotational stiffness under the axial force at rest; the member buckles",
        frame.hinge_name(number)));
  const Vector12 on_ends = stiffness.col(at) / k;
  return {k, on_ends, beam.at_nodes(on_ends)};
}

// Law of the end moment, with post-yield ratio b, for a positive sagging moment where it has a backbone.
hysteresis::HingeLaw law_of(const Hinge& hinge, double k, double b) {
  hysteresis::HingeLaw law = hinge.law;
  const double hogging = hinge.hogging_moment.value_or(hinge.yield_moment);
  std::visit(
      [&]<class L>(L& made) {
        made.initial_stiffness = k;
        made.yield_force = hinge.yield_moment;
        if constexpr (requires { made.s1n; }) {
          if (hinge.hogging_moment) made.s1n = -hogging;
        } else {
          made.hardening = b;
          if constexpr (requires { made.negative_yield_force; }) made.negative_yield_force = hogging;
          if (hinge.sags_positive()) return;
          if constexpr (requires { made.is_mirrored; })
            made.is_mirrored = true;
          else if constexpr (requires { made.negative_yield_force; })
            std::swap(made.yield_force, *made.negative_yield_force);
        }
      },
      law);
  return law;
}

// Ratio of the post-yield stiffness to k.
double hardening_of(const Frame& frame, const Hinge& hinge, double k) {
  const double a = hinge.hardening, of_member = frame.bending_stiffness(hinge);
  if (hinge.is_rigid_plastic()) {
    const double h = a * of_member / (1 - a);
    return h / (k + h);
  }
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.hardening_ratio(); }) return law.hardening_ratio();
        return hinge.spring_hardening.value_or(a / (1 + k / of_member * (1 - a)));
      },
      law_of(hinge, k, 0));
}

std::unique_ptr<Spring> spring_of(const Hinge& hinge, double k, double b) {
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.mirrored(); })
          if (!hinge.sags_positive()) return make_spring(hysteresis::AnyLaw(law.mirrored()));
        return make_spring(hysteresis::AnyLaw(law));
      },
      law_of(hinge, k, b));
}

// Springs of all hinges; joints whose hinges all yield retain a small stiffness.
std::vector<std::unique_ptr<Spring>> springs_of(const FrameModel& model, const AssembledFrame& assembled,
                                                const std::vector<HingeForces>& forces) {
  const std::vector<Hinge>& hinges = model.frame.hinges();
  std::vector<std::unique_ptr<Spring>> springs;
  std::vector<bool> keeps_nothing;
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    springs.push_back(spring_of(hinges[i], forces[i].k, hardening_of(model.frame, hinges[i], forces[i].k)));
    keeps_nothing.push_back(1 + slope_far_behind_yield(*springs.back()) / forces[i].k < min_hardening);
  }
  const std::vector<bool> loose = at_loose_joints(model.frame, assembled, keeps_nothing);
  for (std::size_t i = 0; i < hinges.size(); ++i)
    if (loose[i]) springs[i] = spring_of(hinges[i], forces[i].k, min_hardening);
  return springs;
}

// Rotational stiffness at the end of the whole member without its hinges: 4EI/L, or 3EI/L if the other end is released.
double end_stiffness(const Frame& frame, const Hinge& hinge) {
  const Beam& part = frame.beam(hinge.member);
  const BeamOptions options{.start_releases = part.options().start_releases,
                            .end_releases = part.options().end_releases,
                            .axial_force = part.axial_force()};
  const double length = hinge.member_length > 0 ? hinge.member_length : part.length();
  return Beam(Vector3d::Zero(), {length, 0, 0}, part.section(), part.material(), options)
      .local_stiffness()(hinge.place(), hinge.place());
}

// The elastic deformation is that of the spring in series, or of the subdivided member between its nodes.
YieldLimits limits_of(const Frame& frame, const Hinge& hinge, double k, const Spring& spring) {
  YieldLimits limits(spring);
  const bool is_cut = hinge.member_length > 0 && hinge.member_length != frame.beam(hinge.member).length();
  if (hinge.is_rigid_plastic() && !is_cut) return limits;
  limits.flexibility = 1 / end_stiffness(frame, hinge) - 1 / k;
  limits.positive_force = hinge.yield_moment;
  limits.negative_force = hinge.hogging_moment.value_or(hinge.yield_moment);
  if (!hinge.sags_positive()) std::swap(limits.positive_force, limits.negative_force);
  return limits;
}

std::string word_of(const Hinge& hinge) {
  if (hinge.is_rigid_plastic()) return "hinge";
  return std::visit([]<class L>(const L&) { return std::string(L::name); }, hinge.law);
}

YieldingPart::Hinge values_of(const Frame& frame, const Hinge& hinge, double k) {
  YieldingPart::Hinge values{.is_rigid_plastic = hinge.is_rigid_plastic(),
                             .sagging = hinge.yield_moment,
                             .hogging = hinge.hogging_moment.value_or(hinge.yield_moment),
                             .ultimate_rotation = hinge.ultimate_rotation};
  const double of_member = frame.bending_stiffness(hinge);
  const auto in_series = [of_member](double spring) { return of_member * spring / (of_member + spring); };
  values.end_stiffness = values.is_rigid_plastic ? of_member : in_series(k);
  values.end_tangent =
      values.is_rigid_plastic ? hinge.hardening * of_member : in_series(hardening_of(frame, hinge, k) * k);
  return values;
}

std::vector<YieldingPart::Parameter> parameters_of(const Frame& frame, const Hinge& hinge, double k,
                                                   const YieldingPart::Hinge& values) {
  std::vector<YieldingPart::Parameter> all{{"yield_moment", hinge.yield_moment}};
  if (hinge.hogging_moment) all.push_back({"hogging_moment", *hinge.hogging_moment});
  std::visit(
      [&all]<class L>(const L& law) {
        for (const auto& parameter : L::parameters)
          if (const auto value = parameter.get(law); value && !is_set_by_hinge(parameter))
            all.push_back({std::string(name_at(hysteresis::Use::hinge, parameter.info)), *value});
      },
      hinge.law);
  const bool is_of_spring = hinge.spring_hardening || hinge.has_backbone();
  all.push_back({"hardening", is_of_spring ? values.end_tangent / values.end_stiffness : hinge.hardening});
  if (!values.is_rigid_plastic) all.push_back({"spring_hardening", hardening_of(frame, hinge, k)});
  all.push_back({values.is_rigid_plastic ? "member_stiffness" : "stiffness", k});
  all.push_back({"end_stiffness", values.end_stiffness});
  all.push_back({"end_tangent", values.end_tangent});
  if (hinge.ultimate_rotation) all.push_back({"ultimate_rotation", *hinge.ultimate_rotation});
  return all;
}

// End moment at rest divided by k. Weights of consistent masses bend the member between its ends like loads.
double deformation_at_rest(const FrameModel& model, const Hinge& hinge, const Row& deformation, double k,
                           const Structure& s) {
  if (!model.is_loaded()) return 0;
  return deformation.dot(s.at_rest) +
         model.frame.fixed_end_forces(hinge.member, model.has_gravity())[hinge.place()] / k;
}

// Laws with corners are linear up to the first one. Smooth laws deform inelastically before yield, and the run starts
// from there.
void require_unyielded_at_rest(const YieldingPart& part, const HingeForces& forces) {
  const LoadedSpring spring(part.spring());
  const double at = part.at_rest, yield = part.yield_deformation();
  const std::optional<double> corner = spring.corner(at);
  const bool is_smooth = !spring.corner(1e3 * yield) && !spring.corner(-1e3 * yield);
  if (corner || (is_smooth && std::abs(at) > yield))
    refuse(
        fmt::format("hinge {}: its moment at rest, under gravity and loads, is {}, but it yields at {}; increase its "
                    "yield moment or reduce the loads",
                    part.name, moment(forces.k * at), moment(forces.k * corner.value_or(std::copysign(yield, at)))));
}

Row deformation_row(const Frame& frame, const AssembledFrame& assembled, const Hinge& hinge,
                    const HingeForces& forces) {
  VectorXd sum = VectorXd::Zero(assembled.size());
  const auto [start, end] = frame.ends(hinge.member);
  for (const auto& [node, first] : {std::pair(start, 0), {end, 6}})
    for (const Dof dof : dofs_of(frame.dimension()))
      sum += forces.on_nodes[first + static_cast<int>(dof)] * assembled.motion(node, dof);
  // Entries of 1e-16 relative to the largest are sums that should vanish.
  const double minimum = 1e-15 * (sum.size() > 0 ? sum.cwiseAbs().maxCoeff() : 0);
  return sum.unaryExpr([&](double value) { return std::abs(value) > minimum ? value : 0.0; }).eval().sparseView();
}

// R: couples the hinges of one member.
SparseMatrix flexibility(const Frame& frame, const std::vector<HingeForces>& forces) {
  const int count = static_cast<int>(forces.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const Hinge &a = frame.hinges()[i], &b = frame.hinges()[j];
      if (a.member != b.member || (i == j && a.is_rigid_plastic())) continue;
      const double coupling =
          frame.beam(a.member).local_stiffness()(a.place(), b.place()) / (forces[i].k * forces[j].k);
      const double value = (i == j ? 1 / forces[i].k : 0) - coupling;
      if (value != 0) entries.emplace_back(i, j, value);
    }
  return sparse_matrix(count, count, entries);
}

// Storey shears due to the hinges, transmitted by the members.
void add_to_shears(const FrameModel& model, const std::vector<HingeForces>& forces,
                   const std::vector<std::vector<bool>>& above, Structure& s) {
  const int directions = model.frame.dimension() - 1, count = static_cast<int>(forces.size());
  for (std::size_t floor = 0; floor < above.size(); ++floor) {
    std::vector<Row>& rows = s.floors[floor].storey_shear_by_yielding;
    rows.assign(directions, Row(count));
    for (int i = 0; i < count; ++i) {
      const int member = model.frame.hinges()[i].member;
      const auto [start, end] = model.frame.ends(member);
      if (above[floor][start] == above[floor][end]) continue;
      const Vector3d on_upper_end =
          model.frame.beam(member).axes().transpose() * forces[i].on_ends.segment<3>(above[floor][start] ? 0 : 6);
      for (int d = 0; d < directions; ++d) rows[d].coeffRef(i) = on_upper_end[d];
    }
  }
}

void add_to_internal_forces(const FrameModel& model, const Frame::Reactions& reactions,
                            const std::vector<HingeForces>& forces, Structure& s) {
  const std::vector<int>& places = s.forces.places;
  const int of_member = static_cast<int>(places.size()), first_reaction = model.frame.members() * of_member;
  const auto dofs = dofs_of(model.frame.dimension());
  const int count = static_cast<int>(forces.size()), per_node = static_cast<int>(dofs.size());
  std::vector<Eigen::Triplet<double>> entries, nodal;
  for (int i = 0; i < count; ++i) {
    const int member = model.frame.hinges()[i].member;
    for (int j = 0; j < of_member; ++j)
      if (const double value = forces[i].on_ends[places[j]]; value != 0)
        entries.emplace_back(member * of_member + j, i, value);
    const auto [start, end] = model.frame.ends(member);
    for (int j = 0; j < per_node; ++j) {
      nodal.emplace_back(start * per_node + j, i, forces[i].on_nodes[static_cast<int>(dofs[j])]);
      nodal.emplace_back(end * per_node + j, i, forces[i].on_nodes[6 + static_cast<int>(dofs[j])]);
    }
  }
  const SparseMatrix on_nodes = sparse_matrix(model.frame.nodes() * per_node, count, nodal);
  const SparseMatrix on_ground = SparseMatrix(reactions.by_forces) * on_nodes;
  for (int i = 0; i < count; ++i)
    for (SparseMatrix::InnerIterator it(on_ground, i); it; ++it)
      if (it.value() != 0) entries.emplace_back(first_reaction + static_cast<int>(it.row()), i, it.value());
  s.forces.by_yielding.resize(s.forces.rows.rows(), count);
  s.forces.by_yielding.setFromTriplets(entries.begin(), entries.end());
}

void require_sound(const Hinge& hinge, const std::string& where) {
  const double of_member = hinge.hardening, of_spring = hinge.spring_hardening.value_or(0);
  if (!is_positive(hinge.yield_moment) || !is_positive(hinge.hogging_moment.value_or(1)))
    refuse(where + "the yield moments must be positive and finite");
  if (hinge.hogging_moment && !hinge.takes_two_moments())
    refuse(where + word_of(hinge) + " has the same yield moment in both directions; remove hogging_moment");
  if (!(of_member >= 0 && of_member < 1)) refuse(where + "hardening must be in [0, 1)");
  if (!(of_spring >= 0 && of_spring < 1)) refuse(where + "spring_hardening must be in [0, 1)");
  if (hinge.spring_hardening && hinge.is_rigid_plastic())
    refuse(where +
           "spring_hardening applies only to springs in series; give hardening instead, or add stiffness or "
           "stiffness_factor");
  if (hinge.spring_hardening && of_member != 0)
    refuse(where + "give either hardening (of the member end) or spring_hardening, not both");
  if (hinge.has_backbone() && (of_member != 0 || hinge.spring_hardening))
    refuse(fmt::format("{}the backbone of {} defines its hardening; remove hardening and spring_hardening", where,
                       word_of(hinge)));
  if (!is_positive(hinge.ultimate_rotation.value_or(1)))
    refuse(where + "ultimate_rotation must be positive and finite");
  for (const double value : {hinge.stiffness, hinge.stiffness_factor, hinge.member_length})
    if (!(value >= 0 && std::isfinite(value)))
      refuse(where + "stiffness, stiffness_factor and member_length must be finite and not negative");
  if (hinge.stiffness > 0 && hinge.stiffness_factor > 0)
    refuse(where + "give either stiffness or stiffness_factor, not both");
  if (hinge.is_rigid_plastic() && !std::holds_alternative<hysteresis::Bilinear>(hinge.law))
    refuse(where + "laws apply only to springs in series; give stiffness or stiffness_factor");
  std::visit(
      [&]<class L>(const L& law) {
        for (const auto& parameter : L::parameters)
          if (is_set_by_hinge(parameter) && parameter.get(law).value_or(0) != 0)
            refuse(fmt::format("{}{} of its law is set by the hinge; give it to the hinge, not to the law", where,
                               name_at(hysteresis::Use::hinge, parameter.info)));
      },
      hinge.law);
}

}  // namespace

int Frame::add_hinge(const Hinge& hinge) {
  Member& member = of(hinge.member);
  const char* const end = hinge.at == MemberEnd::start ? "start" : "end";
  const std::string where = fmt::format("member {}: the hinge at its {}: ", member_name(hinge.member), end);
  if (member.beam.is_truss()) refuse(where + "a truss carries no moment and cannot have a hinge");
  if (dimension_ == 2 && hinge.about != BendingAxis::y) refuse(where + "a plane frame bends only about y");
  if (member.beam.is_released(hinge.place()))
    refuse(fmt::format("{}{} is released there, so the hinge carries no moment; remove the release or the hinge", where,
                       name(static_cast<Dof>(hinge.place() % 6))));
  for (const Hinge& other : hinges_)
    if (other.member == hinge.member && other.place() == hinge.place())
      refuse(where + "a hinge is already defined there");
  require_sound(hinge, where);
  try {
    const bool is_rigid = hinge.is_rigid_plastic();
    const double k = is_rigid              ? 1  // any, as its law has no further condition
                     : hinge.stiffness > 0 ? hinge.stiffness
                                           : hinge.stiffness_factor * bending_stiffness(hinge);
    std::visit(
        []<class L>(const L& law) {
          if constexpr (requires { law.check(hysteresis::Use::hinge); })
            law.check(hysteresis::Use::hinge);
          else
            law.check();
        },
        law_of(hinge, k, hardening_of(*this, hinge, k)));
    if (!is_rigid) member.beam.set_end_spring(hinge.place(), k);
  } catch (const std::invalid_argument& error) {
    refuse(where + error.what());
  }
  hinges_.push_back(hinge);
  return static_cast<int>(hinges_.size()) - 1;
}

std::string Frame::hinge_name(int number) const {
  const Hinge& hinge = hinges_.at(number);
  const char* const axis = dimension_ == 2 ? "" : hinge.about == BendingAxis::y ? " y" : " z";
  return fmt::format("{} {}{}", member_name(hinge.member), hinge.at == MemberEnd::start ? "start" : "end", axis);
}

double Frame::bending_stiffness(const Hinge& hinge) const {
  const Beam& beam = of(hinge.member).beam;
  const double inertia = hinge.about == BendingAxis::y ? beam.section().inertia_y : beam.section().inertia_z;
  return 6 * beam.material().young * inertia / (hinge.member_length > 0 ? hinge.member_length : beam.length());
}

void let_hinges_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                      const std::vector<std::vector<bool>>& above, Structure& s) {
  const std::vector<Hinge>& hinges = model.frame.hinges();
  if (hinges.empty()) return;
  if (!model.is_linear())
    refuse(fmt::format("hinge {}: hinges are not available with {}; {}", model.frame.hinge_name(0),
                       model.nonlinear_key(), instead_of_nonlinear(model, "the hinges")));
  if (s.supports.size() > 1)
    refuse(
        fmt::format("hinge {}: a frame with hinges needs the same motion at all supports; remove their delay and "
                    "ground_motion, or the hinges",
                    model.frame.hinge_name(0)));
  std::vector<HingeForces> forces;
  for (int i = 0; i < static_cast<int>(hinges.size()); ++i) forces.push_back(forces_of(model.frame, i));
  std::vector<std::unique_ptr<Spring>> springs = springs_of(model, frame, forces);
  for (int i = 0; i < static_cast<int>(hinges.size()); ++i) {
    const double k = forces[i].k;
    const YieldingPart::Hinge values = values_of(model.frame, hinges[i], k);
    YieldingPart& part = s.yielding.emplace_back(
        model.frame.hinge_name(i), deformation_row(model.frame, frame, hinges[i], forces[i]), word_of(hinges[i]),
        parameters_of(model.frame, hinges[i], k, values), std::move(springs[i]));
    part.kind = YieldingPart::Kind::hinge;
    part.hinge = values;
    part.limits = limits_of(model.frame, hinges[i], k, part.spring());
    part.at_rest = deformation_at_rest(model, hinges[i], part.deformation, k, s);
    require_unyielded_at_rest(part, forces[i]);
  }
  s.yielding_flexibility = flexibility(model.frame, forces);
  add_to_shears(model, forces, above, s);
  add_to_internal_forces(model, reactions, forces, s);
}

}  // namespace pounding
