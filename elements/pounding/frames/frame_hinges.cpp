#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

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

// Parameter of a hinge, or of its law if it has one; nullopt if not given.
std::optional<double> number_of(const Hinge& hinge, std::string_view name, const std::optional<double>& without_law) {
  if (!hinge.law) return without_law;
  const auto found = hinge.law->values.find(name);
  return found == hinge.law->values.end() ? std::nullopt : std::optional(found->second);
}

double member_hardening(const Hinge& hinge) { return number_of(hinge, "hardening", hinge.hardening).value_or(0); }

std::optional<double> spring_hardening(const Hinge& hinge) {
  return number_of(hinge, "spring_hardening", hinge.spring_hardening);
}

// Ratio of the post-yield stiffness to k.
double hardening_of(const Frame& frame, const Hinge& hinge, double k) {
  const double a = member_hardening(hinge), of_member = frame.bending_stiffness(hinge);
  if (!hinge.is_rigid_plastic()) return spring_hardening(hinge).value_or(a / (1 + k / of_member * (1 - a)));
  const double h = a * of_member / (1 - a);
  return h / (k + h);
}

// Law of the end moment. Of two yield moments, the first is for sagging and the second for hogging.
hysteresis::Settings law_of(const Frame& frame, const Hinge& hinge, double k) {
  hysteresis::Settings law{.law = "bilinear"};
  if (hinge.law) {
    law = *hinge.law;
    if (law.values.erase("hardening") > 0) law.values["spring_hardening"] = hardening_of(frame, hinge, k);
  } else {
    law.values = {{"yield_moment", hinge.yield_moment}, {"spring_hardening", hardening_of(frame, hinge, k)}};
    if (hinge.hogging_moment) law.values["negative_yield_moment"] = *hinge.hogging_moment;
  }
  law.values["stiffness"] = k;
  const auto sagging = law.values.find("yield_moment"), hogging = law.values.find("negative_yield_moment");
  if (!hinge.sags_positive() && sagging != law.values.end() && hogging != law.values.end())
    std::swap(sagging->second, hogging->second);
  return law;
}

// Springs of all hinges; joints whose hinges all yield retain a small stiffness.
std::vector<std::unique_ptr<Spring>> springs_of(const FrameModel& model, const AssembledFrame& assembled,
                                                const std::vector<HingeForces>& forces) {
  const std::vector<Hinge>& hinges = model.frame.hinges();
  std::vector<std::unique_ptr<Spring>> springs;
  std::vector<bool> keeps_nothing;
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    springs.push_back(make_hinge(law_of(model.frame, hinges[i], forces[i].k)));
    keeps_nothing.push_back(1 + slope_far_behind_yield(*springs.back()) / forces[i].k < min_hardening);
  }
  const std::vector<bool> loose = at_loose_joints(model.frame, assembled, keeps_nothing);
  for (std::size_t i = 0; i < hinges.size(); ++i)
    if (loose[i]) {
      hysteresis::Settings law = law_of(model.frame, hinges[i], forces[i].k);
      law.values["spring_hardening"] = min_hardening;
      springs[i] = make_hinge(law);
    }
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
  const auto& values = law_of(frame, hinge, k).values;
  const auto other_way = values.find("negative_yield_moment");
  limits.positive_force = limits.negative_force = values.at("yield_moment");
  if (other_way != values.end()) limits.negative_force = other_way->second;
  return limits;
}

std::string word_of(const Hinge& hinge) {
  if (hinge.is_rigid_plastic()) return "hinge";
  return hinge.law ? hinge.law->law : "bilinear";
}

// Stiffness at the end of a member in double curvature, before and after yield at both ends [N m/rad].
struct EndTangents {
  double elastic, yielded;
};

EndTangents end_tangents(const Frame& frame, const Hinge& hinge, double k) {
  const double of_member = frame.bending_stiffness(hinge);
  if (hinge.is_rigid_plastic()) return {of_member, hinge.hardening * of_member};
  const auto in_series = [of_member](double spring) { return of_member * spring / (of_member + spring); };
  return {in_series(k), in_series(hardening_of(frame, hinge, k) * k)};
}

std::vector<YieldingPart::Parameter> parameters_of(const Frame& frame, const Hinge& hinge, double k) {
  const EndTangents at_end = end_tangents(frame, hinge, k);
  std::vector<YieldingPart::Parameter> all;
  if (hinge.law) {
    for (const auto& [name, value] : hinge.law->values)
      if (name != "hardening" && name != "spring_hardening") all.push_back({name, value});
  } else {
    all.push_back({"yield_moment", hinge.yield_moment});
    if (hinge.hogging_moment) all.push_back({"hogging_moment", *hinge.hogging_moment});
  }
  const bool is_given = hinge.is_rigid_plastic() || !spring_hardening(hinge);
  all.push_back({"hardening", is_given ? member_hardening(hinge) : at_end.yielded / at_end.elastic});
  if (!hinge.is_rigid_plastic()) all.push_back({"spring_hardening", hardening_of(frame, hinge, k)});
  all.push_back({hinge.is_rigid_plastic() ? "member_stiffness" : "stiffness", k});
  all.push_back({"end_stiffness", at_end.elastic});
  all.push_back({"end_tangent", at_end.yielded});
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

void require_sound_hardening(const Hinge& hinge, const std::string& where) {
  const std::optional<double> of_member = number_of(hinge, "hardening", hinge.hardening),
                              of_spring = spring_hardening(hinge);
  if (!(of_member.value_or(0) >= 0 && of_member.value_or(0) < 1)) refuse(where + "hardening must be in [0, 1)");
  if (!(of_spring.value_or(0) >= 0 && of_spring.value_or(0) < 1)) refuse(where + "spring_hardening must be in [0, 1)");
  if (of_spring && hinge.is_rigid_plastic())
    refuse(where +
           "spring_hardening applies only to springs in series; give hardening instead, or add stiffness or "
           "stiffness_factor");
  if (of_spring && of_member.value_or(0) != 0)
    refuse(where + "give either hardening (of the member end) or spring_hardening, not both");
}

void require_sound(const Hinge& hinge, const std::string& where) {
  if (!hinge.law) {
    if (!is_positive(hinge.yield_moment) || !is_positive(hinge.hogging_moment.value_or(1)))
      refuse(where + "the yield moments must be positive and finite");
  } else if (hinge.law->values.contains("stiffness")) {
    refuse(where + "the stiffness of its law is that of the hinge; remove stiffness from the law");
  }
  require_sound_hardening(hinge, where);
  if (!is_positive(hinge.ultimate_rotation.value_or(1)))
    refuse(where + "ultimate_rotation must be positive and finite");
  for (const double value : {hinge.stiffness, hinge.stiffness_factor, hinge.member_length})
    if (!(value >= 0 && std::isfinite(value)))
      refuse(where + "stiffness, stiffness_factor and member_length must be finite and not negative");
  if (hinge.stiffness > 0 && hinge.stiffness_factor > 0)
    refuse(where + "give either stiffness or stiffness_factor, not both");
  if (hinge.law && hinge.is_rigid_plastic())
    refuse(where + "laws apply only to springs in series; give stiffness or stiffness_factor");
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
    const double k = hinge.stiffness > 0 ? hinge.stiffness : hinge.stiffness_factor * bending_stiffness(hinge);
    make_hinge(law_of(*this, hinge, hinge.is_rigid_plastic() ? 1 : k));
    if (!hinge.is_rigid_plastic()) member.beam.set_end_spring(hinge.place(), k);
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
  if (model.geometry == FrameGeometry::corotational)
    refuse(fmt::format(
        "hinge {}: hinges are not available with geometry: corotational; type geometry: p_delta, or remove the hinges",
        model.frame.hinge_name(0)));
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
    YieldingPart& part =
        s.yielding.emplace_back(model.frame.hinge_name(i), deformation_row(model.frame, frame, hinges[i], forces[i]),
                                word_of(hinges[i]), parameters_of(model.frame, hinges[i], k), std::move(springs[i]));
    part.kind = YieldingPart::Kind::hinge;
    part.limits = limits_of(model.frame, hinges[i], k, part.spring());
    part.at_rest = deformation_at_rest(model, hinges[i], part.deformation, k, s);
    require_unyielded_at_rest(part, forces[i]);
  }
  s.yielding_flexibility = flexibility(model.frame, forces);
  add_to_shears(model, forces, above, s);
  add_to_internal_forces(model, reactions, forces, s);
}

}  // namespace pounding
