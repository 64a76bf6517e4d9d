#include <pounding/frames/fibre_frame.hpp>

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/core/refuse.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using Eigen::VectorXd;

// Loads at rest are applied in this many equal steps, which are halved if one fails.
constexpr int steps_of_rest = 10;
constexpr double shortest_step = 1e-3;  // of the load
constexpr int newton_iterations = 50;
// Equilibrium: relative change of strain, and residual relative to the load; the latter is weighted by the stiffness.
constexpr double at_equilibrium = 1e-10;
// Lower bound of the strain to which changes are relative, far below cracking.
constexpr double smallest_strain = 1e-6;

}  // namespace

/// Accepted states of all members, their iterates at these states and in the step.
struct FibreFrame::States final : TangentForces::Motion {
  std::vector<FibreMember::State> accepted;
  std::vector<FibreMember::Iterate> begin, trial;
  // Basic forces of all members: of the stages of the step by time [s], and at the beginning, middle and end of the
  // last accepted step.
  std::vector<std::pair<double, VectorXd>> stages;
  std::array<VectorXd, 3> forces;

  VectorXd forces_of(const std::vector<FibreMember::Iterate>& iterates) const {
    VectorXd all(6 * static_cast<Eigen::Index>(iterates.size()));
    for (std::size_t i = 0; i < iterates.size(); ++i)
      all.segment<6>(6 * static_cast<Eigen::Index>(i)) = iterates[i].linearized_forces();
    return all;
  }
  void archive(Archive& archive) override { archive(accepted, begin, forces[0], forces[1], forces[2]); }

  double largest_strain(const std::vector<Member>& members) const {
    double largest = 0;
    for (std::size_t i = 0; i < members.size(); ++i)
      largest = std::max(largest, members[i].beam.largest_strain(accepted[i]));
    return largest;
  }
};

FibreFrame::FibreFrame(const FrameModel& model, const AssembledFrame& assembled)
    : load_(assembled.load_at_rest), rest_(VectorXd::Zero(assembled.size())) {
  take_members(model, assembled);
  load_slowly(load_);
}

void FibreFrame::take_members(const FrameModel& model, const AssembledFrame& assembled) {
  const Frame& frame = model.frame;
  std::vector<Eigen::Triplet<double>> taken, pattern;
  const auto take = [&](int number, const MemberUnknowns& unknowns) {
    unknowns.add_entries(frame.beam(number).stiffness(), taken);
    unknowns.add_entries(Matrix12::Ones(), pattern);
  };
  for (const FrameFibres& fibres : model.fibres) {
    const int number = fibres.member;
    const Beam& beam = frame.beam(number);
    const auto [start, end] = frame.ends(number);
    const std::string what = "member " + frame.member_name(number) + ": ";
    BeamOptions options = beam.options();
    const std::shared_ptr<const SectionFibres>& section = beam.section().fibres;
    if (!section) refuse(what + "its section is not of fibres; create it with section_of_fibres()");
    if (beam.is_truss()) refuse(what + "a truss has no sections of fibres; remove it from fibres");
    if (!options.start_releases.empty() || !options.end_releases.empty())
      refuse(what + "a member of fibres has no releases; remove them, or leave the member elastic");
    if (std::ranges::any_of(frame.hinges(), [&](const Hinge& hinge) { return hinge.member == number; }))
      refuse(what + "a member of fibres yields along its length; remove its hinges");
    if (frame.fixed_end_forces(number, model.has_gravity()).any())
      refuse(what + "a member of fibres has no load between its ends; divide it into parts, or load its nodes");
    FibreMemberOptions own = *fibres.options;
    own.geometry = model.geometry;
    own.axial_force = std::exchange(options.axial_force, 0);
    numbers_.push_back(number);
    members_.push_back({FibreMember(assembled.positions[start], assembled.positions[end], options,
                                    {section, &section->section}, own, assembled.dimension),
                        MemberUnknowns(assembled, start, end)});
    take(number, members_.back().unknowns);
  }
  const std::vector<CorotationalMember> all = corotational_members(frame);
  places_.assign(all.size(), 0);
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    places_[static_cast<std::size_t>(numbers_[i])] = static_cast<int>(i);
  for (int number = 0; number < frame.members(); ++number) {
    if (std::ranges::find(numbers_, number) != numbers_.end()) continue;
    const CorotationalMember& m = all[static_cast<std::size_t>(number)];
    places_[static_cast<std::size_t>(number)] = -1 - static_cast<int>(elastic_.size());
    elastic_.push_back({frame.beam(number), {}, MemberUnknowns(assembled, m.start, m.end)});
    if (model.geometry != FrameGeometry::corotational) continue;
    elastic_.back().turning = CorotationalBeam::of(m, assembled);
    take(number, elastic_.back().unknowns);
  }
  const int size = assembled.size();
  others_ = assembled.stiffness - sparse_matrix(size, size, taken) + 0 * sparse_matrix(size, size, pattern);
  others_.makeCompressed();
  for (Member& member : members_) member.unknowns.find_places(others_);
  for (Elastic& member : elastic_)
    if (member.turning) member.unknowns.find_places(others_);
}

std::unique_ptr<TangentForces::Motion> FibreFrame::start() const { return std::make_unique<States>(*at_rest_); }

void FibreFrame::begin_step(Motion& motion) const {
  States& states = static_cast<States&>(motion);
  states.trial = states.begin;
  states.stages.clear();
}

// Forces and tangent at total displacements q.
double FibreFrame::add(States& states, const VectorXd& q, VectorXd& force, Eigen::SparseMatrix<double>& tangent) const {
  force.noalias() = others_ * q;
  tangent = others_;
  double strain = 0;
  Vector12 on_nodes;
  Matrix12 stiffness;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& member = members_[i];
    const double own = member.beam.linearize(states.accepted[i], states.trial[i], member.unknowns.displacements(q),
                                             on_nodes, stiffness);
    if (!(own <= strain)) strain = own;
    member.unknowns.add_force(on_nodes, force);
    member.unknowns.add_to(tangent.valuePtr(), stiffness);
  }
  for (const Elastic& member : elastic_) {
    if (!member.turning) continue;
    const CorotationalBeam::Response response = member.turning->evaluate(member.unknowns.displacements(q), stiffness);
    member.unknowns.add_force(response.force, force);
    member.unknowns.add_to(tangent.valuePtr(), stiffness);
  }
  return strain;
}

double FibreFrame::linearize(Motion& motion, const VectorXd& u, VectorXd& force,
                             Eigen::SparseMatrix<double>& tangent) const {
  States& states = static_cast<States&>(motion);
  const double strain = add(states, rest_ + u, force, tangent);
  force -= load_;
  return strain / std::max(states.largest_strain(members_), smallest_strain);
}

void FibreFrame::record_stage(Motion& motion, const VectorXd& u, double time) const {
  States& states = static_cast<States&>(motion);
  const VectorXd q = rest_ + u;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].beam.update(states.trial[i], members_[i].unknowns.displacements(q));
    members_[i].beam.record_stage(states.trial[i], time);
  }
  states.stages.emplace_back(time, states.forces_of(states.trial));
}

bool FibreFrame::accept(Motion& motion, double min_reversal) const {
  States& states = static_cast<States&>(motion);
  const double smallest = min_reversal * std::max(states.largest_strain(members_), smallest_strain);
  bool reversed = false;
  if (!states.stages.empty()) {
    const auto middle = std::ranges::find(states.stages, 0.5 * states.stages.back().first,
                                          [](const auto& stage) { return stage.first; });
    states.forces[0] = states.forces[2];
    states.forces[2] = states.stages.back().second;
    states.forces[1] =
        middle != states.stages.end() ? middle->second : VectorXd(0.5 * (states.forces[0] + states.forces[2]));
  } else {
    states.forces.fill(states.forces_of(states.trial));
  }
  for (std::size_t i = 0; i < members_.size(); ++i)
    reversed = members_[i].beam.accept(states.accepted[i], states.trial[i], smallest) || reversed;
  if (reversed)
    for (std::size_t i = 0; i < members_.size(); ++i) members_[i].beam.begin(states.accepted[i], states.begin[i]);
  else
    for (std::size_t i = 0; i < members_.size(); ++i) {
      states.begin[i] = states.trial[i];
      states.begin[i].times.clear();
      states.begin[i].stages.clear();
    }
  return reversed;
}

VectorXd FibreFrame::member_forces(const Motion& motion, double s) const {
  const States& states = static_cast<const States&>(motion);
  return (1 - s) * (1 - 2 * s) * states.forces[0] + 4 * s * (1 - s) * states.forces[1] +
         s * (2 * s - 1) * states.forces[2];
}

Vector12 FibreFrame::end_forces(int member, const VectorXd& q, const VectorXd& in_members) const {
  const int place = places_[static_cast<std::size_t>(member)];
  if (place >= 0) {
    const Member& of = members_[static_cast<std::size_t>(place)];
    return of.beam.end_forces(in_members.segment<6>(6 * place), of.unknowns.displacements(q));
  }
  const Elastic& of = elastic_[static_cast<std::size_t>(-1 - place)];
  const Vector12 u = of.unknowns.displacements(q);
  return of.turning ? of.turning->end_forces(u) : of.beam.end_forces(u);
}

Vector12 FibreFrame::nodal_forces(int member, const VectorXd& q, const VectorXd& in_members) const {
  const int place = places_[static_cast<std::size_t>(member)];
  if (place >= 0) {
    const Member& of = members_[static_cast<std::size_t>(place)];
    return of.beam.nodal_forces(in_members.segment<6>(6 * place), of.unknowns.displacements(q));
  }
  const Elastic& of = elastic_[static_cast<std::size_t>(-1 - place)];
  const Vector12 u = of.unknowns.displacements(q);
  return of.turning ? of.turning->evaluate(u).force : Vector12(of.beam.stiffness() * u);
}

Eigen::Matrix3d FibreFrame::axes(int member, const VectorXd& q) const {
  const int place = places_[static_cast<std::size_t>(member)];
  if (place >= 0) refuse("a member of fibres has no load between its ends, which its axes would turn");
  const Elastic& of = elastic_[static_cast<std::size_t>(-1 - place)];
  return of.turning ? of.turning->axes(of.unknowns.displacements(q)) : of.beam.axes();
}

// Energies relative to the undeformed state, at total displacements q.
TangentForces::Energy FibreFrame::energy_of(const States& states, const VectorXd& q) const {
  Energy sum{0.5 * q.dot(others_ * q) - load_.dot(q), 0};
  for (const Elastic& member : elastic_)
    if (member.turning) sum.stored += member.turning->evaluate(member.unknowns.displacements(q)).energy;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const FibreMember& beam = members_[i].beam;
    const double stored = beam.stored(states.accepted[i]);
    sum.stored += stored + beam.potential(members_[i].unknowns.displacements(q));
    sum.dissipated += beam.dissipated(states.accepted[i], stored);
  }
  return sum;
}

TangentForces::Energy FibreFrame::energy(const Motion& motion, const VectorXd& u) const {
  const Energy sum = energy_of(static_cast<const States&>(motion), rest_ + u);
  return {sum.stored - energy_at_rest_.stored, sum.dissipated - energy_at_rest_.dissipated};
}

// Newton's method at this load from the accepted state.
bool FibreFrame::find_equilibrium(States& states, VectorXd& q, const VectorXd& load) const {
  VectorXd force;
  Eigen::SparseMatrix<double> tangent;
  begin_step(states);
  for (int iteration = 0; iteration < newton_iterations; ++iteration) {
    const double strain = add(states, q, force, tangent);
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(tangent);
    if (factor.info() != Eigen::Success) return false;
    const VectorXd step = factor.solve(load - force);
    if (!step.allFinite()) return false;
    q += step;
    const double scale = std::max(q.cwiseAbs().maxCoeff(), 1e-12);
    if (iteration > 0 && strain <= at_equilibrium * std::max(states.largest_strain(members_), smallest_strain) &&
        step.cwiseAbs().maxCoeff() <= at_equilibrium * scale)
      return true;
  }
  return false;
}

void FibreFrame::load_slowly(const VectorXd& load) {
  States states;
  for (const Member& member : members_) {
    states.accepted.push_back(member.beam.undeformed());
    member.beam.begin(states.accepted.back(), states.begin.emplace_back());
  }
  double done = 0;
  for (double part = 1.0 / steps_of_rest; done < 1 && !load.isZero(0);) {
    const double next = std::min(1.0, done + part);
    VectorXd q = rest_;
    if (find_equilibrium(states, q, next * load)) {
      accept(states, 0);
      rest_ = q;
      done = next > 1 - 1e-12 ? 1 : next;
    } else if ((part /= 2) < shortest_step) {
      refuse(fmt::format("the frame has no equilibrium beyond {:.3f} times its loads at rest", done));
    }
  }
  begin_step(states);
  at_rest_ = std::make_shared<const States>(states);
  energy_at_rest_ = energy_of(states, rest_);
}

}  // namespace pounding
