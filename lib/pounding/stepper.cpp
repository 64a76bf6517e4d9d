#include <pounding/stepper.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {
namespace {

// The order of generalized-alpha is two: a local error of tolerance^(3/2) gives a global error in proportion to the
// tolerance.
constexpr double local_share = 0.25;
// The embedded scheme of ESDIRK4 is of order three, as an error in one step that is the global error of the fourth.
constexpr double embedded_share = 0.05;

// Sums and differences of the motion carry this much rounding, as part of the motion; no smaller error is asked for.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

// A contact moves far less than the structures that it joins; an error is not resolved below this part of their motion.
constexpr double smallest_contact_rate = 1e-3;
constexpr double smallest_contact_penetration = 1e-4;

}  // namespace

Stepper::Stepper(const System& system, Base& base, const StepperOptions& options)
    : system_(system), base_(base), options_(options), alpha_(GeneralizedAlpha::of(options.scheme.spectral_radius)) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) throw std::invalid_argument("tolerance must lie in (0, 1)");
  if (!(options.first_rung > 0)) throw std::invalid_argument("first_rung must be positive");
  const bool esdirk = options.scheme.kind == Scheme::Kind::esdirk4;
  carries_ = !esdirk && options.scheme.spectral_radius != 1;
  allowed_ = esdirk ? embedded_share * options.tolerance : local_share * options.tolerance * std::sqrt(options.tolerance);
  allowed_ = std::max(allowed_, rounding);

  const int n = base.size(), m = system.links();
  if (std::any_of(system.contacts.begin(), system.contacts.end(), [](const Contact* c) { return c->is_rigid(); })) {
    rigid_response_ = Eigen::MatrixXd::Zero(n, system.contact_count());
    for (int i = 0; i < system.contact_count(); ++i) {
      base.add_forces(1, Eigen::VectorXd::Unit(m, i), rigid_response_.col(i));
      base.accelerate(rigid_response_.col(i));
      base.follow(rigid_response_.col(i));
    }
    base.gather(rigid_response_, rigid_flexibility_);
  }
  for (Instant* instant : {&now_, &before_, &trial_.end, &kept_.end}) {
    instant->motion = Eigen::MatrixXd::Zero(n, columns);
    instant->force = Eigen::VectorXd::Zero(m);
    instant->closings = Eigen::MatrixXd::Zero(m, width());
  }
  for (Trial* trial : {&trial_, &kept_}) {
    trial->a_middle = Eigen::VectorXd::Zero(n);
    trial->force_middle = Eigen::VectorXd::Zero(m);
    trial->middle.resize(m);
    trial->size_u.assign(system.groups.size(), 0.0);
    trial->size_v.assign(system.groups.size(), 0.0);
  }
  link_groups_.resize(m);
  for (int i = 0; i < m; ++i)
    for (SparseMatrix::InnerIterator it(system.closing, i); it; ++it)
      for (int k = 0; k < static_cast<int>(system.groups.size()); ++k) {
        const Group& group = system.groups[k];
        std::vector<int>& joined = link_groups_[i];
        if (it.row() >= group.first && it.row() < group.first + group.count && std::find(joined.begin(), joined.end(), k) == joined.end())
          joined.push_back(k);
      }
  displacement_scale_.assign(system.groups.size(), 0.0);
  velocity_scale_.assign(system.groups.size(), 0.0);
  rate_scale_.assign(m, 0.0);
  penetration_scale_.assign(m, 0.0);
  link_steps_.resize(m);
  sums_.resize(4 * system.groups.size());
  r_ = error_u_ = error_v_ = work_ = Eigen::VectorXd::Zero(n);
  if (esdirk) stages_ = Eigen::MatrixXd::Zero(n, 3 * esdirk4::stages);
}

double Stepper::deformation(int link, double closure) const {
  return link < system_.contact_count() ? system_.contacts[link]->penetration(closure) : closure;
}

LinkMotion Stepper::motion(int link, const Instant& instant) const {
  return {deformation(link, instant.closings(link, u)), instant.closings(link, v)};
}

LinkForce Stepper::law(int link, const LinkMotion& motion) const {
  const int contacts = system_.contact_count();
  return link < contacts ? system_.contacts[link]->evaluate(motion) : system_.springs[link - contacts]->evaluate(motion);
}

bool Stepper::works(int link) const {
  return link >= system_.contact_count() || presses(system_.contacts[link]->phase());
}

bool Stepper::held(int link) const {
  return link < system_.contact_count() && system_.contacts[link]->phase() == ContactPhase::resting;
}

void Stepper::products(Instant& x, int first, int count) const {
  base_.stiffness_times(x.motion.middleCols(first, count), x.motion.middleCols(ku + first, count));
  const int moving = std::max(first, static_cast<int>(v)), left = first + count - moving;
  if (left > 0)
    base_.damping_times(x.motion.middleCols(moving, left), x.motion.middleCols(ku + moving, left),
                        x.motion.middleCols(cv + moving - v, left));
}

// Forces of the links from their motions. Held contacts take the forces that leave no closing acceleration; those that
// hold the same bodies share them.
void Stepper::balance(std::span<const LinkMotion> motions, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> r) const {
  std::vector<int> held_links;
  bool any = false;
  for (int i = 0; i < system_.links(); ++i) {
    force[i] = 0;
    if (held(i))
      held_links.push_back(i);
    else if (works(i))
      force[i] = law(i, motions[i]).force;
    any = any || force[i] != 0;
  }
  if (any) base_.add_forces(-1, force, r);
  base_.accelerate(r);
  if (held_links.empty()) return;
  base_.gather(r, work_closings_);
  const int count = static_cast<int>(held_links.size());
  Eigen::MatrixXd g(count, count);
  Eigen::VectorXd relative(count);
  for (int i = 0; i < count; ++i) {
    relative[i] = work_closings_(held_links[i], 0);
    for (int j = 0; j < count; ++j) g(i, j) = rigid_flexibility_(held_links[i], held_links[j]);
  }
  const Eigen::VectorXd forces = g.completeOrthogonalDecomposition().solve(relative);
  for (int i = 0; i < count; ++i) {
    force[held_links[i]] = forces[i];
    r -= forces[i] * rigid_response_.col(held_links[i]);
  }
}

// The acceleration that balances the equations now, of a motion whose K u is known.
void Stepper::balance_now() {
  Eigen::MatrixXd& x = now_.motion;
  base_.stiffness_times(x.col(v), x.col(kv));
  base_.damping_times(x.col(v), x.col(kv), x.col(cv));
  gather_now();
  auto a_now = x.col(a);
  now_.ground = system_.ground.acceleration(now_.time);
  a_now = -now_.ground * base_.load() - x.col(ku) - x.col(cv);
  now_motions_.resize(system_.links());
  for (int i = 0; i < system_.links(); ++i) now_motions_[i] = motion(i, now_);
  balance(now_motions_, now_.force, a_now);
  base_.follow(a_now);
  x.col(c) = x.col(a);
  products(now_, a, width() - a);
  gather_now();
  state_fresh_ = false;
  changed_at_end_ = true;
}

void Stepper::gather_now() { base_.gather(now_.motion.leftCols(width()), now_.closings); }

void Stepper::start(double time, const Eigen::VectorXd& u0, const Eigen::VectorXd& v0) {
  const Energies before = started_ ? energies() : Energies{};
  now_.time = time;
  next_break_ = system_.ground.next_break(time);
  now_.motion.setZero();
  now_.motion.col(u) = base_.coordinates(u0);
  now_.motion.col(v) = base_.coordinates(v0);
  base_.follow(now_.motion.col(u));
  base_.follow(now_.motion.col(v));
  base_.stiffness_times(now_.motion.col(u), now_.motion.col(ku));
  balance_now();
  before_ = kept_.end = trial_.end = now_;
  kept_.h = 0;
  kept_.a_middle = now_.motion.col(a);
  before_fresh_ = arrived_fresh_ = false;
  const Energies after = energies();
  given_ += after.kinetic + after.strain - before.kinetic - before.strain;
  measure(now_, kept_.size_u, kept_.size_v);
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    displacement_scale_[k] = std::max({displacement_scale_[k], kept_.size_u[k], system_.groups[k].displacement_floor});
    velocity_scale_[k] = std::max({velocity_scale_[k], kept_.size_v[k], system_.groups[k].velocity_floor});
  }
  started_ = true;
}

double Stepper::step_towards(double wanted, double left) const {
  if (!base_.has_ladder()) {
    // Sixteen lengths an octave, so that rounding in the error of a step does not show in the length of the next.
    int exponent = 0;
    const double mantissa = std::frexp(wanted * (1 + 1e-9), &exponent);
    const double even = std::ldexp(std::floor(32 * mantissa) / 32, exponent);
    return left / std::ceil(left / even * (1 - 1e-9));
  }
  const double ratio = std::log2(options_.first_rung / (wanted * (1 + 1e-9)));
  const double rung = std::ldexp(options_.first_rung, -std::max(0, static_cast<int>(std::ceil(ratio))));
  return left <= rung * (1 + 1e-9) ? left : rung;
}

void Stepper::set_shift(double h) {
  Shift shift = options_.scheme.kind == Scheme::Kind::esdirk4
                    ? Shift{1, esdirk4::shift * h, esdirk4::shift * esdirk4::shift * h * h}
                    : Shift{alpha_.alpha_m, alpha_.alpha_f * alpha_.gamma * h, alpha_.alpha_f * alpha_.beta * h * h};
  if (!base_.has_ladder()) return base_.shift(shift, std::nullopt);
  int exponent = 0;
  const double mantissa = std::frexp(options_.first_rung / h, &exponent);
  if (std::abs(mantissa - 0.5) < 1e-9 && exponent >= 1) return base_.shift(shift, exponent - 1);
  base_.shift(shift, std::nullopt);
}

bool Stepper::attempt(double h, std::optional<double> end) {
  Trial& t = trial_;
  landed_.clear();
  t.h = h;
  t.end.time = end.value_or(now_.time + h);
  t.ground_begin = now_.ground;
  t.ground_middle = system_.ground.acceleration(now_.time + 0.5 * h);
  t.ground_end = system_.ground.acceleration_before(t.end.time);
  active_.clear();
  for (int i = 0; i < system_.links(); ++i)
    if (works(i)) active_.push_back(i);
  set_shift(h);
  const bool solved = options_.scheme.kind == Scheme::Kind::esdirk4 ? attempt_esdirk(h) : attempt_alpha(h);
  if (!solved) return false;
  finish_error();
  return std::isfinite(t.error);
}

// Motion of the links at the middle by cubic interpolation, and the accelerations that balance the equations there.
void Stepper::evaluate_middle() {
  Trial& t = trial_;
  const double h = t.h;
  const Instant &x = now_, &y = t.end;
  for (int i = 0; i < system_.links(); ++i) {
    const double closure =
        0.5 * (x.closings(i, u) + y.closings(i, u)) + h / 8 * (x.closings(i, v) - y.closings(i, v));
    t.middle[i] = {deformation(i, closure),
                   0.5 * (x.closings(i, v) + y.closings(i, v)) + h / 8 * (x.closings(i, a) - y.closings(i, a))};
  }
  const int n = base_.size();
  const double *ku0 = x.at(ku), *ku1 = y.at(ku), *kv0 = x.at(kv), *kv1 = y.at(kv);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  const double* p = base_.load().data();
  double* r = t.a_middle.data();
  for (int i = 0; i < n; ++i)
    r[i] = -t.ground_middle * p[i] - 0.5 * (ku0[i] + ku1[i] + cv0[i] + cv1[i]) -
           h / 8 * (kv0[i] - kv1[i] + ca0[i] - ca1[i]);
  balance(t.middle, t.force_middle, t.a_middle);
}

void Stepper::measure(const Instant& instant, std::vector<double>& size_u, std::vector<double>& size_v) {
  const Eigen::VectorXd& w = base_.weights();
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const Base::Segment& s : base_.segments())
    for (int i = s.first; i < s.first + s.count; ++i) {
      const double ui = instant.at(u)[i], vi = instant.at(v)[i];
      sums_[4 * s.group + 2] += w[i] * ui * ui;
      sums_[4 * s.group + 3] += w[i] * vi * vi;
    }
  base_.combine(sums_);
  for (std::size_t k = 0; k < size_u.size(); ++k) {
    size_u[k] = std::sqrt(sums_[4 * k + 2] / base_.group_masses()[k]);
    size_v[k] = std::sqrt(sums_[4 * k + 3] / base_.group_masses()[k]);
  }
}

// The errors against the motion, both as root mean squares weighed by the masses of a group, and those of the links that
// press against the motion of their impact.
void Stepper::finish_error() {
  Trial& t = trial_;
  const double* w = base_.weights().data();
  const double *u1 = t.end.at(u), *v1 = t.end.at(v);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const Base::Segment& s : base_.segments()) {
    double eu = 0, ev = 0, uu = 0, vv = 0;
    for (int i = s.first; i < s.first + s.count; ++i) {
      eu += w[i] * error_u_[i] * error_u_[i];
      ev += w[i] * error_v_[i] * error_v_[i];
      uu += w[i] * u1[i] * u1[i];
      vv += w[i] * v1[i] * v1[i];
    }
    double* sums = sums_.data() + 4 * s.group;
    sums[0] += eu, sums[1] += ev, sums[2] += uu, sums[3] += vv;
  }
  base_.combine(sums_);
  double worst = 0;
  troublesome_ = -1;
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const double* sums = sums_.data() + 4 * k;
    const double each = 1 / base_.group_masses()[k];
    t.size_u[k] = std::sqrt(sums[2] * each);
    t.size_v[k] = std::sqrt(sums[3] * each);
    const double scale_u = std::max(displacement_scale_[k], t.size_u[k]);
    const double scale_v = std::max(velocity_scale_[k], t.size_v[k]);
    worst = std::max({worst, std::sqrt(sums[0] * each) / scale_u, std::sqrt(sums[1] * each) / scale_v});
    if (!std::isfinite(sums[0] + sums[1] + sums[2] + sums[3])) worst = std::numeric_limits<double>::infinity();
  }
  if (!active_.empty() && active_.front() < system_.contact_count()) {
    work_errors_.resize(base_.size(), 2);
    work_errors_.col(0) = error_u_;
    work_errors_.col(1) = error_v_;
    base_.gather(work_errors_, gathered_);
    const double part_d = std::max(smallest_contact_penetration, rounding / allowed_);
    const double part_r = std::max(smallest_contact_rate, rounding / allowed_);
    for (const int i : active_) {
      if (i >= system_.contact_count()) break;
      const LinkMotion end = motion(i, t.end);
      double wide_d = 0, wide_r = 0;  // of the bodies that the link joins
      for (const int k : link_groups_[i]) {
        wide_d += std::max(displacement_scale_[k], t.size_u[k]);
        wide_r += std::max(velocity_scale_[k], t.size_v[k]);
      }
      const double scale_d = std::max({penetration_scale_[i], std::abs(end.penetration), part_d * wide_d});
      const double scale_r = std::max({rate_scale_[i], std::abs(end.rate), part_r * wide_r});
      const double error = std::max(std::abs(gathered_(i, 0)) / scale_d, std::abs(gathered_(i, 1)) / scale_r);
      if (!(error <= worst)) {
        worst = error;
        troublesome_ = i;
      }
    }
  }
  t.error = worst / allowed_;
}

void Stepper::update_scales() {
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    displacement_scale_[k] = std::max(displacement_scale_[k], kept_.size_u[k]);
    velocity_scale_[k] = std::max(velocity_scale_[k], kept_.size_v[k]);
  }
}

double Stepper::largest_u() const { return *std::max_element(displacement_scale_.begin(), displacement_scale_.end()); }
double Stepper::largest_v() const { return *std::max_element(velocity_scale_.begin(), velocity_scale_.end()); }

bool Stepper::in_contact() const {
  return std::any_of(system_.contacts.begin(), system_.contacts.end(),
                     [](const Contact* contact) { return contact->phase() != ContactPhase::open; });
}

void Stepper::accept() {
  const double h = trial_.h;
  before_.swap(now_);
  kept_.swap(trial_);
  if (state_fresh_) {
    std::swap(state_before_.time, state_.time);
    state_before_.u.swap(state_.u);
    state_before_.v.swap(state_.v);
    state_before_.a.swap(state_.a);
    state_before_.force.swap(state_.force);
  }
  before_fresh_ = state_fresh_;
  state_fresh_ = arrived_fresh_ = changed_at_end_ = false;

  const Instant &x = before_, &y = kept_.end;
  const int n = base_.size();
  const double* p = base_.load().data();
  const double *v0 = x.at(v), *v1 = y.at(v), *a0 = x.at(a), *a1 = y.at(a);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  double input = 0, damping = 0;
  for (int i = 0; i < n; ++i) {
    const double vm = 0.5 * (v0[i] + v1[i]) + h / 8 * (a0[i] - a1[i]);
    const double cvm = 0.5 * (cv0[i] + cv1[i]) + h / 8 * (ca0[i] - ca1[i]);
    input += p[i] * (kept_.ground_begin * v0[i] + 4 * kept_.ground_middle * vm + kept_.ground_end * v1[i]);
    damping += v0[i] * cv0[i] + 4 * vm * cvm + v1[i] * cv1[i];
  }
  input_work_ -= h / 6 * input;
  damping_work_ += h / 6 * damping;
  const int contacts = system_.contact_count();
  for (int i = 0; i < system_.links(); ++i) {
    LinkStep& step = link_steps_[i];
    step = {x.time,     y.time,     motion(i, x), kept_.middle[i], motion(i, y),
            x.force[i], kept_.force_middle[i],    y.force[i], x.closings(i, a), y.closings(i, a)};
    if (i >= contacts) {
      system_.springs[i - contacts]->accept(step);
      continue;
    }
    system_.contacts[i]->accept(step);
    rate_scale_[i] = std::max(rate_scale_[i], std::abs(step.motion_end.rate));
    penetration_scale_[i] = std::max(penetration_scale_[i], std::abs(step.motion_end.penetration));
  }
  now_ = kept_.end;
  update_scales();
  now_.ground = kept_.ground_end;
  if (now_.time >= next_break_) {
    now_.ground = system_.ground.acceleration(now_.time);
    next_break_ = system_.ground.next_break(now_.time);
  }
  const bool ground_jumps = now_.ground != kept_.ground_end;
  if (!landed_.empty())
    enter_phases(false);
  else if (ground_jumps)
    balance_now();
}

void Stepper::cross_now() {
  before_ = kept_.end = now_;
  before_fresh_ = arrived_fresh_ = false;
  enter_phases(true);
}

Energies Stepper::energies() const {
  const Eigen::MatrixXd& x = now_.motion;
  base_.mass_times(x.col(v), work_);
  std::vector<double> sums{input_work_, damping_work_, 0.5 * work_.dot(x.col(v)), 0.5 * x.col(u).dot(x.col(ku))};
  base_.combine(sums);
  Energies e;
  e.input = given_ + sums[0];
  e.damping = sums[1];
  e.kinetic = sums[2];
  e.strain = sums[3];
  for (const Spring* spring : system_.springs) {
    e.hysteretic += spring->lost();
    e.strain += spring->stored_correction();
  }
  for (const Contact* contact : system_.contacts) e.impact += contact->work();
  return e;
}

void Stepper::show(const Instant& instant, State& state) const {
  state.time = instant.time;
  base_.physical(instant.motion.col(u), state.u);
  base_.physical(instant.motion.col(v), state.v);
  base_.physical(instant.motion.col(a), state.a);
  state.force = instant.force;
}

const State& Stepper::state() const {
  if (!state_fresh_) show(now_, state_);
  state_fresh_ = true;
  return state_;
}

const State& Stepper::before() const {
  if (!before_fresh_) show(before_, state_before_);
  before_fresh_ = true;
  return state_before_;
}

const State& Stepper::arrived() const {
  if (!changed_at_end_) return state();
  if (!arrived_fresh_) show(kept_.end, state_arrived_);
  arrived_fresh_ = true;
  return state_arrived_;
}

void Stepper::interpolate(double time, Eigen::VectorXd& u_out, Eigen::VectorXd& v_out) const {
  const State &x = before(), &y = arrived();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    u_out = state().u;
    v_out = state().v;
    return;
  }
  const double s = std::clamp((time - x.time) / h, 0.0, 1.0), r = 1 - s;
  const double begin = r * r * (1 + 2 * s), end = s * s * (1 + 2 * r), slope_begin = h * s * r * r,
               slope_end = -h * s * s * r;
  u_out = begin * x.u + end * y.u + slope_begin * x.v + slope_end * y.v;
  v_out = begin * x.v + end * y.v + slope_begin * x.a + slope_end * y.a;
}

void Stepper::interpolate_acceleration(double time, Eigen::VectorXd& out) const {
  const State &x = before(), &y = arrived();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = state().a;
    return;
  }
  const double s = std::clamp((time - x.time) / h, 0.0, 1.0);
  Eigen::VectorXd middle;
  base_.follow(kept_.a_middle);
  base_.physical(kept_.a_middle, middle);
  out = (1 - s) * (1 - 2 * s) * x.a + 4 * s * (1 - s) * middle + s * (2 * s - 1) * y.a;
}

void Stepper::Instant::swap(Instant& other) {
  std::swap(time, other.time);
  std::swap(ground, other.ground);
  motion.swap(other.motion);
  force.swap(other.force);
  closings.swap(other.closings);
}

void Stepper::Trial::swap(Trial& other) {
  std::swap(h, other.h);
  end.swap(other.end);
  a_middle.swap(other.a_middle);
  force_middle.swap(other.force_middle);
  middle.swap(other.middle);
  std::swap(ground_begin, other.ground_begin);
  std::swap(ground_middle, other.ground_middle);
  std::swap(ground_end, other.ground_end);
  std::swap(error, other.error);
  size_u.swap(other.size_u);
  size_v.swap(other.size_v);
}

void Stepper::Instant::archive(Archive& archive) {
  archive(time);
  archive(ground);
  archive(motion);
  archive(force);
  archive(closings);
}

void Stepper::Trial::archive(Archive& archive) {
  archive(h);
  archive(end);
  archive(a_middle);
  archive(force_middle);
  archive(middle);
  archive(ground_begin);
  archive(ground_middle);
  archive(ground_end);
  archive(error);
  archive(size_u);
  archive(size_v);
}

void Stepper::archive(Archive& archive) {
  archive(now_);
  archive(before_);
  archive(kept_);
  archive(link_steps_);
  archive(input_work_);
  archive(damping_work_);
  archive(given_);
  archive(started_);
  archive(displacement_scale_);
  archive(velocity_scale_);
  archive(rate_scale_);
  archive(penetration_scale_);
  archive(iterations_);
  archive(events_);
  archive(changed_at_end_);
  archive(next_break_);
  for (Contact* contact : system_.contacts) contact->archive(archive);
  for (Spring* spring : system_.springs) spring->archive(archive);
  state_fresh_ = before_fresh_ = arrived_fresh_ = false;
}

}  // namespace pounding
