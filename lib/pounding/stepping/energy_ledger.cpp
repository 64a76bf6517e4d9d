#include <pounding/stepping/energy_ledger.hpp>

namespace pounding {

using enum Instant::Column;

void EnergyLedger::add_step(const Equations& equations, const Instant& x, const Trial& kept,
                            std::span<const LinkStep> links) {
  const double h = kept.h;
  const Instant& y = kept.end;
  const int n = equations.solver.size();
  const Eigen::MatrixXd& load = equations.short_motions.other_load();
  const double *v0 = x.at(v), *v1 = y.at(v), *a0 = x.at(a), *a1 = y.at(a);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  vm_.resize(n);
  cvm_.resize(n);
  double *vm = vm_.data(), *cvm = cvm_.data();
  const double eighth = h / 8;
  // Stored with the width of the reads below: a wider read of freshly stored values would stall.
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    vm[i] = 0.5 * (v0[i] + v1[i]) + eighth * (a0[i] - a1[i]);
    cvm[i] = 0.5 * (cv0[i] + cv1[i]) + eighth * (ca0[i] - ca1[i]);
  }
  if (kept.short_motions) {
    const GroundDefect missed = ShortMotions::of_cubic(*kept.short_motions, h);
    vm_ += equations.short_motions.shift(missed.v);
    cvm_ += equations.short_motions.damping(missed.v);
    input_ += equations.short_motions.work(x, kept);
  }
  double input = 0, damping = 0;
  const std::vector<StructureSolver::Segment>& segments = equations.solver.layout().segments;
  for (const StructureSolver::Segment& s : segments)
    for (int i = s.first; i < s.first + s.count; ++i)
      damping += simpson_sum(v0[i], cv0[i], vm[i], cvm[i], v1[i], cv1[i]);
  for (Eigen::Index k = 0; k < load.cols(); ++k) {
    const double* p = load.col(k).data();
    const double begin = x.ground[k], middle = kept.ground_middle[k], end = y.ground[k];
    if (k > 0 && begin == 0 && middle == 0 && end == 0) continue;
    for (const StructureSolver::Segment& s : segments)
      for (int i = s.first; i < s.first + s.count; ++i)
        input += p[i] * simpson_sum(begin, v0[i], middle, vm[i], end, v1[i]);
  }
  input_ -= h / 6 * input;
  damping_ += h / 6 * damping;
  if (equations.links.driven())
    for (int i = 0; i < equations.links.size(); ++i)
      on_ground_ += h / 6 *
                    simpson_sum(links[i].force_begin, x.by_ground(i, v), links[i].force_middle,
                                kept.by_ground_middle(i, v), links[i].force_end, y.by_ground(i, v));
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const Friction& friction = equations.links.frictions()[k];
    for (const LinkStep& step : links.subspan(friction.first, friction.count))
      friction_[k] += h / 6 *
                      simpson_sum(step.force_begin, step.motion_begin.rate, step.force_middle, step.motion_middle.rate,
                                  step.force_end, step.motion_end.rate);
  }
}

Energies EnergyLedger::energies(const Equations& equations, const Instant& now) const {
  const StructureSolver& solver = equations.solver;
  const Eigen::MatrixXd& x = now.motion;
  Eigen::VectorXd momentum(solver.size());
  solver.mass_times(x.col(v), momentum);
  std::vector<double> sums{input_, damping_, 0, 0};
  for (const StructureSolver::Segment& s : solver.layout().segments) {
    sums[2] += 0.5 * momentum.segment(s.first, s.count).dot(x.col(v).segment(s.first, s.count));
    sums[3] += 0.5 * x.col(u).segment(s.first, s.count).dot(x.col(ku).segment(s.first, s.count));
  }
  solver.combine(sums);
  Energies e;
  e.input = given_ + on_ground_ + sums[0];
  e.damping = sums[1];
  e.kinetic = sums[2];
  e.strain = sums[3];
  if (equations.pseudo_forces.any()) {
    e.strain += equations.pseudo_forces.energy(solver.physical(x.col(u)));
  }
  if (equations.tangents.any()) {
    const TangentForces::Energy members = equations.tangents.energy(x.col(u));
    e.strain += members.stored;
    e.hysteretic += members.dissipated;
  }
  const LinkMemory& memory = equations.links.memory();
  for (std::size_t i = 0; i < equations.system.elements.size(); ++i) {
    const ElementEnergy own = equations.system.elements[i]->energy(memory.elements[static_cast<int>(i)]);
    e.hysteretic += own.lost;
    e.devices += own.damped;
    e.strain += own.stored_correction;
  }
  // With u = u_m - W F, the degrees of freedom store u.K u/2 = u_m.K u_m/2 + F.B_s^T W F/2. They do work on a spring at
  // the rate F d(B^T u)/dt = F dd/dt + F.R dF/dt. The spring stores or dissipates the first term. The stored total is
  // therefore F.S F/2 with S = B_s^T W + R.
  if (equations.springs.any())
    e.strain += 0.5 * now.force.segment(equations.links.contacts(), equations.links.springs()).dot(now.relief);
  for (const ContactMemory& contact : memory.contacts) e.impact += contact.log.work();
  for (const double work : friction_) e.impact += work;
  return e;
}

void EnergyLedger::archive(Archive& archive) { archive(input_, damping_, on_ground_, friction_, given_); }

}  // namespace pounding
