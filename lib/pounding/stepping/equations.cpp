#include <pounding/stepping/equations.hpp>

#include <Eigen/QR>
#include <algorithm>

#include <pounding/core/error.hpp>

namespace pounding {
namespace {

const System& checked(const System& system) {
  system.check();
  return system;
}

RigidContacts rigid_contacts(const System& system, const StructureSolver& solver) {
  RigidContacts rigid;
  if (std::none_of(system.contacts.begin(), system.contacts.end(), [](const Contact* c) { return c->is_rigid(); }))
    return rigid;
  rigid.response = Eigen::MatrixXd::Zero(solver.size(), system.contact_count());
  for (int i = 0; i < system.contact_count(); ++i) {
    solver.add_forces(1, Eigen::VectorXd::Unit(system.links(), i), rigid.response.col(i));
    solver.accelerate(rigid.response.col(i));
    solver.recover(rigid.response.col(i));
  }
  solver.gather(rigid.response, rigid.flexibility);
  return rigid;
}

}  // namespace

Equations::Equations(const System& of_system, StructureSolver& of_solver, bool carries)
    : system(checked(of_system)),
      solver(of_solver),
      links(of_system, of_solver.layout().relief),
      springs(links),
      ranges(links),
      slips(links),
      supports(of_system, of_solver),
      short_motions(of_system, of_solver),
      pseudo_forces(of_system),
      tangents(of_system, of_solver),
      rigid(rigid_contacts(of_system, of_solver)),
      width(carries ? 4 : 3) {
  for (const StructureSolver::Segment& segment : solver.layout().segments) own_groups_.push_back(segment.group);
}

Instant Equations::zero_instant() const {
  Instant x;
  x.motion = Eigen::MatrixXd::Zero(solver.size(), Instant::columns);
  x.force = Eigen::VectorXd::Zero(links.size());
  x.relative = Eigen::MatrixXd::Zero(links.size(), width);
  x.ground = x.ground_carried = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system.grounds.size()));
  // The gravity terms are constant; the ground terms are recomputed at every instant.
  if (links.moved()) supports.relative_motion(0, x.ground, x.by_ground);
  if (has_pseudo_forces()) x.pseudo_force = Eigen::VectorXd::Zero(solver.size());
  if (slips.any()) x.slip = x.friction_slip_rate = Eigen::VectorXd::Zero(slips.size());
  if (springs.any()) {
    x.relief = Eigen::VectorXd::Zero(links.springs());
    x.spring_slopes = Eigen::MatrixXd::Zero(links.springs(), springs.width());
    x.force_rates = Eigen::MatrixXd::Zero(links.springs(), 2);
  }
  return x;
}

Trial Equations::zero_trial() const {
  Trial trial;
  trial.end = zero_instant();
  trial.a_middle = Eigen::VectorXd::Zero(solver.size());
  trial.force_middle = Eigen::VectorXd::Zero(links.size());
  trial.middle.resize(static_cast<std::size_t>(links.size()));
  trial.ground_middle = trial.end.ground;
  trial.by_ground_middle = trial.end.by_ground;
  trial.squares_u.assign(system.groups.size(), 0.0);
  trial.squares_v.assign(system.groups.size(), 0.0);
  trial.squares_slow.assign(system.groups.size(), 0.0);
  return trial;
}

void Equations::multiply(Instant& x, int first, int count) const {
  using enum Instant::Column;
  const int damped = std::max(first, static_cast<int>(v));
  const int last = first + count;
  solver.stiffness_times(x.motion.middleCols(first, count), x.motion.middleCols(ku + first, count));
  solver.damping_times(x.motion.middleCols(damped, last - damped), x.motion.middleCols(ku + damped, last - damped),
                       x.motion.middleCols(cv + damped - v, last - damped));
}

void Equations::pseudo_force(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& force) {
  elastic_pseudo_force(displacement, force);
  tangents.add_pseudo_force(displacement, force);
}

void Equations::elastic_pseudo_force(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& force) {
  force.setZero(solver.size());
  if (!pseudo_forces.any()) return;
  whole_ = solver.physical(displacement);
  pseudo_forces.evaluate(own_groups_, whole_, whole_force_);
  solver.add_physical_forces(whole_force_, force);
}

void Equations::balance(std::span<const LinkMotion> motions, const Eigen::MatrixXd& by_ground, bool inside_step,
                        bool springs_stay, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> r) {
  std::vector<int> held;
  bool any = springs_stay && force.segment(links.contacts(), links.springs()).cwiseAbs().sum() != 0;
  for (int i = 0, last = springs_stay ? links.contacts() : links.frictions_from(); i < last; ++i) {
    force[i] = 0;
    if (links.is_held(i)) {
      held.push_back(i);
    } else if (links.is_active(i) && !links.is_coupled(i)) {
      force[i] = links.law(i, motions[i]).force;
      if (inside_step && i < links.contacts()) force[i] = links.contact(i).acting_force(force[i]);
      any = any || force[i] != 0;
    }
  }
  for (const CoupledElement& element : links.coupled()) {
    const ElementResponse answer = links.law(element, motions.subspan(element.first, element.count));
    for (int j = 0; j < element.count; ++j) force[element.first + j] = answer.force[j];
    any = true;
  }
  for (const Friction& friction : links.frictions()) {
    TangentialMotion along;
    for (int j = 0; j < friction.count; ++j) along.set(j, motions[friction.first + j]);
    const FrictionForce answer =
        links.friction(friction, motions[friction.contact], {.force = force[friction.contact]}, along);
    for (int j = 0; j < friction.count; ++j) force[friction.first + j] = answer.force[j];
  }
  if (any) solver.add_forces(-1, force, r);
  solver.accelerate(r);
  if (held.empty()) return;
  solver.gather(r, relative_);
  const int count = static_cast<int>(held.size());
  Eigen::VectorXd relative(count);
  for (int i = 0; i < count; ++i)
    relative[i] = relative_(held[i], 0) + links.ground_part(by_ground, held[i], Instant::a);
  const Eigen::MatrixXd g = rigid.flexibility(held, held);
  const Eigen::VectorXd forces = g.completeOrthogonalDecomposition().solve(relative);
  for (int i = 0; i < count; ++i) {
    force[held[i]] = forces[i];
    r -= forces[i] * rigid.response.col(held[i]);
  }
}

void Equations::balance(Instant& x) {
  using enum Instant::Column;
  tangents.begin_step();
  tangents.recover(x.motion.col(v));
  solver.stiffness_times(x.motion.col(v), x.motion.col(kv));
  solver.damping_times(x.motion.col(v), x.motion.col(kv), x.motion.col(cv));
  gather(x);
  supports.accelerations(x.time, x.ground);
  x.ground_carried = x.ground;
  if (links.driven()) supports.relative_motion(x.time, x.ground, x.by_ground);
  const Eigen::VectorXd& push = supports.push(x.ground);
  auto acceleration = x.motion.col(a);
  acceleration = -push - x.motion.col(ku) - x.motion.col(cv);
  if (has_pseudo_forces()) acceleration -= x.pseudo_force;
  motions_.resize(static_cast<std::size_t>(links.size()));
  for (int i = 0; i < links.size(); ++i) links.without_relief(i, x, motions_[i]);
  if (springs.any() && !springs.settle(motions_, x.force))
    throw SolverError("the hinges of a structure have no equilibrium with its massless degrees of freedom");
  balance(motions_, x.by_ground, false, false, x.force, acceleration);
  solver.recover(acceleration);
  tangents.recover(acceleration);
  x.motion.col(carried) = x.motion.col(a);
  multiply(x, a, width - a);
  gather(x);
  if (springs.any()) springs.find_force_rates(x);
}

LinkMotion Equations::middle_of(int i, const Instant& x, const Trial& trial) {
  using enum Instant::Column;
  const Instant& y = trial.end;
  const double eighth = trial.h / 8;
  return {0.5 * (x.relative(i, u) + y.relative(i, u)) + eighth * (x.relative(i, v) - y.relative(i, v)),
          0.5 * (x.relative(i, v) + y.relative(i, v)) + eighth * (x.relative(i, a) - y.relative(i, a))};
}

bool Equations::balance_middle(const Instant& x, Trial& trial) {
  using enum Instant::Column;
  const double h = trial.h;
  const Instant& y = trial.end;
  std::optional<GroundDefect> missed;
  if (trial.short_motions) missed = ShortMotions::of_cubic(*trial.short_motions, h);
  const double eighth = h / 8;
  const bool apart = moves_ends_apart(trial);
  trial.springs_stay = springs.any() && ranges.stay(x, trial);
  for (int i = 0, count = links.size(); i < count; ++i) {
    if (i == links.contacts() && trial.springs_stay) i = links.frictions_from();
    if (i == count) break;
    LinkMotion& middle = trial.middle[i];
    const LinkMotion between = middle_of(i, x, trial);
    double relative_displacement = between.penetration, rate = between.rate;
    if (missed) {
      relative_displacement += short_motions.closing(i, missed->u);
      rate += short_motions.closing(i, missed->v);
    }
    if (apart) {
      relative_displacement += links.ground_part(trial.by_ground_middle, i, u);
      rate += links.ground_part(trial.by_ground_middle, i, v);
    }
    middle = {links.deformation(i, relative_displacement), rate};
    if (apart && links.is_held(i)) middle = {links.motion(i, x).penetration, 0};
  }
  if (slips.any()) slips.find_middle(x, trial);
  const int n = solver.size();
  const double *ku0 = x.at(ku), *ku1 = y.at(ku), *kv0 = x.at(kv), *kv1 = y.at(kv);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  const double* push = supports.push(trial.ground_middle).data();
  double* r = trial.a_middle.data();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    r[i] = -push[i] - 0.5 * (ku0[i] + ku1[i] + cv0[i] + cv1[i]) - eighth * (kv0[i] - kv1[i] + ca0[i] - ca1[i]);
  if (missed) trial.a_middle -= short_motions.forces(*missed);
  if (has_pseudo_forces()) {
    displacement_ = 0.5 * (x.motion.col(u) + y.motion.col(u)) + eighth * (x.motion.col(v) - y.motion.col(v));
    if (missed) displacement_ += short_motions.shift(missed->u);
    elastic_pseudo_force(displacement_, trial.pseudo_force_middle);
    tangents.add_middle(displacement_, trial.pseudo_force_middle);
    trial.a_middle -= trial.pseudo_force_middle;
  }
  if (trial.springs_stay) {
    trial.force_middle = x.force;
    trial.end.spring_slopes.setZero();
    trial.end.force_rates.setZero();
    trial.force_rates_begin.setZero(links.springs(), 2);
  } else if (springs.any()) {
    trial.force_middle = x.force;
    if (!springs.settle(trial.middle, trial.force_middle)) return false;
    springs.find_rates(x, trial);
  }
  balance(trial.middle, trial.by_ground_middle, true, trial.springs_stay, trial.force_middle, trial.a_middle);
  return true;
}

void Equations::hold_moved_end(const Instant& begin, Trial& trial) {
  std::vector<int> held;
  for (int i = 0; i < links.contacts(); ++i)
    if (links.is_held(i)) held.push_back(i);
  if (held.empty()) return;
  solver.gather(trial.end.motion.leftCols(2), relative_);
  hold_contacts(rigid, links, begin, relative_, held, trial.end);
}

}  // namespace pounding
