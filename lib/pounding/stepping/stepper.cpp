#include <pounding/stepping/stepper.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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

Stepper::Stepper(const System& system, StructureSolver& base, const StepperOptions& options)
    : system_(system),
      base_(base),
      options_(options),
      alpha_(GeneralizedAlpha::of(options.scheme.spectral_radius)),
      excess_(system) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) throw std::invalid_argument("tolerance must lie in (0, 1)");
  if (!(options.max_step > 0)) throw std::invalid_argument("max_step must be positive");
  const bool esdirk = options.scheme.kind == Scheme::Kind::esdirk4;
  carries_ = !esdirk && options.scheme.spectral_radius != 1;
  allowed_ = esdirk ? embedded_share * options.tolerance : local_share * options.tolerance * std::sqrt(options.tolerance);
  allowed_ = std::max(allowed_, rounding);

  const int n = base.size(), m = system.links();
  check_parts();
  const Eigen::Index grounds = static_cast<Eigen::Index>(system.grounds.size());
  moving_ = !system.gap_by_ground.isZero(0) || !system.gravity_offset.isZero(0);
  if (std::any_of(system.contacts.begin(), system.contacts.end(), [](const Contact* c) { return c->is_rigid(); })) {
    rigid_response_ = Eigen::MatrixXd::Zero(n, system.contact_count());
    for (int i = 0; i < system.contact_count(); ++i) {
      base.add_forces(1, Eigen::VectorXd::Unit(m, i), rigid_response_.col(i));
      base.accelerate(rigid_response_.col(i));
      base.recover(rigid_response_.col(i));
    }
    base.gather(rigid_response_, rigid_flexibility_);
  }
  for (Instant* instant : {&changed_[0], &changed_[1], &trial_->end, &kept_->end, &previous_->end}) {
    instant->motion = Eigen::MatrixXd::Zero(n, columns);
    instant->force = Eigen::VectorXd::Zero(m);
    instant->relative = Eigen::MatrixXd::Zero(m, width());
    instant->ground = Eigen::VectorXd::Zero(grounds);
    if (moving_) instant->by_ground = Eigen::MatrixXd::Zero(m, 3);
    if (excess_.any()) instant->excess = Eigen::VectorXd::Zero(n);
  }
  for (Trial* trial : {trial_.get(), kept_.get(), previous_.get()}) {
    trial->a_middle = Eigen::VectorXd::Zero(n);
    trial->force_middle = Eigen::VectorXd::Zero(m);
    trial->middle.resize(m);
    trial->ground_middle = Eigen::VectorXd::Zero(grounds);
    trial->squares_u.assign(system.groups.size(), 0.0);
    trial->squares_v.assign(system.groups.size(), 0.0);
  }
  link_groups_.resize(m);
  for (int i = 0; i < m; ++i)
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it)
      for (int k = 0; k < static_cast<int>(system.groups.size()); ++k) {
        const Group& group = system.groups[k];
        std::vector<int>& joined = link_groups_[i];
        if (it.row() >= group.first && it.row() < group.first + group.count && std::find(joined.begin(), joined.end(), k) == joined.end())
          joined.push_back(k);
      }
  for (const StructureSolver::Segment& segment : base.segments()) own_groups_.push_back(segment.group);
  rest_size_.assign(system.groups.size(), 0.0);
  for (std::size_t k = 0; k < system.groups.size(); ++k) {
    const Group& group = system.groups[k];
    if (!group.elastic) continue;
    const auto masses = Eigen::VectorXd(system.mass.diagonal()).segment(group.first, group.count).eval();
    rest_size_[k] = std::sqrt(masses.dot(group.elastic->at_rest().cwiseAbs2()) / masses.sum());
  }
  outputs_need_recovery_ = excess_.any() && excess_.corrects(system.outputs);
  displacement_scale_.assign(system.groups.size(), 0.0);
  velocity_scale_.assign(system.groups.size(), 0.0);
  rate_scale_.assign(m, 0.0);
  penetration_scale_.assign(m, 0.0);
  link_steps_.resize(m);
  sums_.resize(4 * system.groups.size());
  friction_work_.assign(system.frictions.size(), 0.0);
  r_ = error_u_ = error_v_ = work_ = push_ = Eigen::VectorXd::Zero(n);
  stage_ground_ = Eigen::VectorXd::Zero(grounds);
  if (esdirk) stages_ = Eigen::MatrixXd::Zero(n, 3 * esdirk4::stages);
}

// Columns of B that belong to frictions are found here too.
void Stepper::check_parts() {
  const System& s = system_;
  const Eigen::Index grounds = static_cast<Eigen::Index>(s.grounds.size()), links = s.links();
  if (base_.load().cols() != grounds) throw std::invalid_argument("System::load needs one column a ground motion");
  if (s.gap_by_ground.size() > 0 && (s.gap_by_ground.rows() != links || s.gap_by_ground.cols() != grounds))
    throw std::invalid_argument("System::gap_by_ground needs one row a link and one column a ground motion");
  if (s.gravity_offset.size() > 0 && s.gravity_offset.size() != links)
    throw std::invalid_argument("System::gravity_offset needs one value a link");
  frictions_from_ = s.contact_count() + static_cast<int>(s.springs.size());
  if (frictions_from_ > links) throw std::invalid_argument("System::gap_jacobian needs one column a contact and a spring");
  contact_of_friction_.assign(static_cast<std::size_t>(links - frictions_from_), -1);
  for (const Friction& friction : s.frictions) {
    if (!(friction.coefficient >= 0 && std::isfinite(friction.coefficient)))
      throw std::invalid_argument("the coefficient of a friction must not be negative");
    if (!(friction.sliding > 0 && std::isfinite(friction.sliding)))
      throw std::invalid_argument("the sliding velocity of a friction must be positive");
    if (friction.contact < 0 || friction.contact >= s.contact_count())
      throw std::invalid_argument("a friction belongs to a contact that does not exist");
    if (s.contacts[friction.contact]->is_rigid())
      throw std::invalid_argument("a rigid contact takes no friction: its force is not known while it strikes");
    if (friction.count < 1 || friction.count > 2 || friction.first < frictions_from_ || friction.first + friction.count > links)
      throw std::invalid_argument("a friction needs one or two columns of System::gap_jacobian behind those of the springs");
    for (int i = friction.first; i < friction.first + friction.count; ++i)
      if (std::exchange(contact_of_friction_[i - frictions_from_], friction.contact) >= 0)
        throw std::invalid_argument("two frictions share a column of System::gap_jacobian");
  }
  if (std::find(contact_of_friction_.begin(), contact_of_friction_.end(), -1) != contact_of_friction_.end())
    throw std::invalid_argument("a column of System::gap_jacobian belongs to no contact, spring or friction");
}

double Stepper::deformation(int link, double relative_displacement) const {
  return link < system_.contact_count() ? system_.contacts[link]->penetration(relative_displacement) : relative_displacement;
}

LinkMotion Stepper::motion(int link, const Instant& instant) const {
  const double relative_displacement = instant.relative(link, u), rate = instant.relative(link, v);
  if (!moving_) return {deformation(link, relative_displacement), rate};
  return {deformation(link, relative_displacement + instant.by_ground(link, u)), rate + instant.by_ground(link, v)};
}

laws::Response Stepper::law(int link, const LinkMotion& motion) const {
  const int contacts = system_.contact_count();
  return link < contacts ? system_.contacts[link]->evaluate(motion) : system_.springs[link - contacts]->evaluate(motion);
}

bool Stepper::works(int link) const {
  if (link >= frictions_from_) link = contact_of_friction_[link - frictions_from_];
  return link >= system_.contact_count() || presses(system_.contacts[link]->phase());
}

bool Stepper::held(int link) const {
  return link < system_.contact_count() && system_.contacts[link]->phase() == ContactPhase::resting;
}

// P times the accelerations of the grounds.
const double* Stepper::push(const Eigen::VectorXd& ground) {
  const Eigen::MatrixXd& load = base_.load();
  const int n = base_.size();
  double* const sum = push_.data();
  for (Eigen::Index k = 0; k < ground.size(); ++k) {
    const double* const p = load.col(k).data();
    const double a = ground[k];
    if (k == 0)
      for (int i = 0; i < n; ++i) sum[i] = a * p[i];
    else if (a != 0)
      for (int i = 0; i < n; ++i) sum[i] += a * p[i];
  }
  return sum;
}

void Stepper::ground_at(double time, Eigen::VectorXd& ground, bool before) const {
  for (std::size_t k = 0; k < system_.grounds.size(); ++k)
    ground[static_cast<Eigen::Index>(k)] =
        before ? system_.grounds[k].acceleration_before(time) : system_.grounds[k].acceleration(time);
}

// Corners of delayed motions that only rounding keeps apart are one: no step fits between them. A step ends at the last
// and looks back from the first, before any of them has jumped.
void Stepper::find_break_after(double time) {
  break_begins_ = std::numeric_limits<double>::infinity();
  for (const GroundMotion& motion : system_.grounds) break_begins_ = std::min(break_begins_, motion.next_break(time));
  next_break_ = break_begins_;
  if (!std::isfinite(break_begins_)) return;
  const double same = break_begins_ + rounding * std::max(1.0, std::abs(break_begins_));
  for (const GroundMotion& motion : system_.grounds)
    for (double t = motion.next_break(time); t <= same; t = motion.next_break(t)) next_break_ = std::max(next_break_, t);
}

// S times displacements, velocities and the given accelerations of the grounds, and what has closed at rest.
void Stepper::closings_by_ground(double time, const Eigen::VectorXd& ground, Eigen::MatrixXd& by_ground) const {
  by_ground.setZero(system_.links(), 3);
  if (system_.gravity_offset.size() > 0) by_ground.col(u) = system_.gravity_offset;
  if (system_.gap_by_ground.size() == 0) return;
  for (std::size_t k = 0; k < system_.grounds.size(); ++k) {
    const auto column = system_.gap_by_ground.col(static_cast<Eigen::Index>(k));
    by_ground.col(u) += system_.grounds[k].displacement(time) * column;
    by_ground.col(v) += system_.grounds[k].velocity(time) * column;
    by_ground.col(a) += ground[static_cast<Eigen::Index>(k)] * column;
  }
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
void Stepper::balance(std::span<const LinkMotion> motions, const Eigen::MatrixXd& by_ground, bool inside_step,
                      Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> r) const {
  std::vector<int> held_links;
  bool any = false;
  for (int i = 0; i < frictions_from_; ++i) {
    force[i] = 0;
    if (held(i))
      held_links.push_back(i);
    else if (works(i))
      force[i] = law(i, motions[i]).force;
    if (inside_step && i < system_.contact_count()) force[i] = system_.contacts[i]->acting_force(force[i]);
    any = any || force[i] != 0;
  }
  for (const Friction& friction : system_.frictions) {
    Sliding rates{};
    for (int j = 0; j < friction.count; ++j) rates[j] = motions[friction.first + j].rate;
    const FrictionForce answer = friction_force(friction, {.force = force[friction.contact]}, rates);
    for (int j = 0; j < friction.count; ++j) force[friction.first + j] = answer.force[j];
  }
  if (any) base_.add_forces(-1, force, r);
  base_.accelerate(r);
  if (held_links.empty()) return;
  base_.gather(r, work_relative_);
  const int count = static_cast<int>(held_links.size());
  Eigen::MatrixXd g(count, count);
  Eigen::VectorXd relative(count);
  for (int i = 0; i < count; ++i) {
    relative[i] = work_relative_(held_links[i], 0) + ground_part(by_ground, held_links[i], a);
    for (int j = 0; j < count; ++j) g(i, j) = rigid_flexibility_(held_links[i], held_links[j]);
  }
  const Eigen::VectorXd forces = g.completeOrthogonalDecomposition().solve(relative);
  for (int i = 0; i < count; ++i) {
    force[held_links[i]] = forces[i];
    r -= forces[i] * rigid_response_.col(held_links[i]);
  }
}

Stepper::Instant& Stepper::change_now() {
  if (now_ == &changed_[0] || now_ == &changed_[1]) return *now_;
  Instant& own = changed_[before_ == &changed_[0] ? 1 : 0];
  own = *now_;
  now_ = &own;
  return own;
}

// The acceleration that balances the equations now, of a motion whose K u is known.
void Stepper::balance_now() {
  Instant& now = change_now();
  Eigen::MatrixXd& x = now.motion;
  base_.stiffness_times(x.col(v), x.col(kv));
  base_.damping_times(x.col(v), x.col(kv), x.col(cv));
  gather_now();
  auto a_now = x.col(a);
  ground_at(now.time, now.ground);
  if (moving_) closings_by_ground(now.time, now.ground, now.by_ground);
  push(now.ground);
  a_now = -push_ - x.col(ku) - x.col(cv);
  if (excess_.any()) a_now -= now.excess;
  now_motions_.resize(system_.links());
  for (int i = 0; i < system_.links(); ++i) now_motions_[i] = motion(i, now);
  balance(now_motions_, now.by_ground, false, now.force, a_now);
  base_.recover(a_now);
  x.col(c) = x.col(a);
  products(now, a, width() - a);
  gather_now();
  states_.has_now = outputs_.has_now = false;
  changed_at_end_ = true;
}

void Stepper::gather_now() {
  Instant& now = change_now();
  base_.gather(now.motion.leftCols(width()), now.relative);
}

void Stepper::start(double time, const Eigen::VectorXd& u0, const Eigen::VectorXd& v0) {
  const Energies before = started_ ? energies() : Energies{};
  Instant& now = change_now();
  now.time = time;
  find_break_after(time);
  now.motion.setZero();
  now.motion.col(u) = base_.coordinates(u0);
  now.motion.col(v) = base_.coordinates(v0);
  base_.recover(now.motion.col(u));
  base_.recover(now.motion.col(v));
  base_.stiffness_times(now.motion.col(u), now.motion.col(ku));
  if (excess_.any()) excess_at(now.motion.col(u), now.excess);
  balance_now();
  kept_->end = trial_->end = now;
  before_ = &kept_->end;
  kept_->h = 0;
  kept_->a_middle = now.motion.col(a);
  forget_views();
  const Energies after = energies();
  given_ += after.kinetic + after.strain - before.kinetic - before.strain;
  measure(now, kept_->squares_u, kept_->squares_v);
  update_scales();
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    displacement_scale_[k] = std::max(displacement_scale_[k], system_.groups[k].displacement_floor);
    velocity_scale_[k] = std::max(velocity_scale_[k], system_.groups[k].velocity_floor);
  }
  started_ = true;
}

double Stepper::step_towards(double wanted, double left) const {
  if (!base_.prefers_dyadic_steps()) {
    // Sixteen lengths an octave, so that rounding in the error of a step does not show in the length of the next.
    int exponent = 0;
    const double mantissa = std::frexp(wanted * (1 + 1e-9), &exponent);
    const double even = std::ldexp(std::floor(32 * mantissa) / 32, exponent);
    return left / std::ceil(left / even * (1 - 1e-9));
  }
  const double ratio = std::log2(options_.max_step / (wanted * (1 + 1e-9)));
  const double rung = std::ldexp(options_.max_step, -std::max(0, static_cast<int>(std::ceil(ratio))));
  return left <= rung * (1 + 1e-9) ? left : rung;
}

void Stepper::set_shift(double h) {
  EffectiveMatrix shift = options_.scheme.kind == Scheme::Kind::esdirk4
                    ? EffectiveMatrix{1, esdirk4::shift * h, esdirk4::shift * esdirk4::shift * h * h}
                    : EffectiveMatrix{alpha_.alpha_m, alpha_.alpha_f * alpha_.gamma * h, alpha_.alpha_f * alpha_.beta * h * h};
  if (!base_.prefers_dyadic_steps()) return base_.set_matrix(shift, std::nullopt);
  int exponent = 0;
  const double mantissa = std::frexp(options_.max_step / h, &exponent);
  if (std::abs(mantissa - 0.5) < 1e-9 && exponent >= 1) return base_.set_matrix(shift, exponent - 1);
  base_.set_matrix(shift, std::nullopt);
}

bool Stepper::try_step(double h, std::optional<double> end) {
  Trial& t = *trial_;
  located_.clear();
  t.h = h;
  t.end.time = end.value_or(now_->time + h);
  ground_at(now_->time + 0.5 * h, t.ground_middle);
  ground_at(std::min(t.end.time, break_begins_), t.end.ground, true);
  if (moving_) {
    closings_by_ground(now_->time + 0.5 * h, t.ground_middle, t.by_ground_middle);
    closings_by_ground(t.end.time, t.end.ground, t.end.by_ground);
  }
  active_.clear();
  for (int i = 0; i < system_.links(); ++i)
    if (works(i)) active_.push_back(i);
  if (!system_.frictions.empty()) find_sliders();
  set_shift(h);
  if (!active_.empty() && !base_.flexibility(active_, flexibility_)) return false;
  const bool solved = options_.scheme.kind == Scheme::Kind::esdirk4 ? attempt_esdirk(h) : attempt_alpha(h);
  if (!solved) return false;
  finish_error();
  return std::isfinite(t.error);
}

// Motion of the links at the middle by cubic interpolation, and the accelerations that balance the equations there.
void Stepper::evaluate_middle() {
  Trial& t = *trial_;
  const double h = t.h;
  const Instant &x = *now_, &y = t.end;
  for (int i = 0; i < system_.links(); ++i) {
    const double relative_displacement =
        0.5 * (x.relative(i, u) + y.relative(i, u)) + h / 8 * (x.relative(i, v) - y.relative(i, v));
    const double rate = 0.5 * (x.relative(i, v) + y.relative(i, v)) + h / 8 * (x.relative(i, a) - y.relative(i, a));
    t.middle[i] = {deformation(i, relative_displacement + ground_part(t.by_ground_middle, i, u)),
                   rate + ground_part(t.by_ground_middle, i, v)};
  }
  const int n = base_.size();
  const double *ku0 = x.at(ku), *ku1 = y.at(ku), *kv0 = x.at(kv), *kv1 = y.at(kv);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  const double* pushed = push(t.ground_middle);
  double* r = t.a_middle.data();
  for (int i = 0; i < n; ++i)
    r[i] = -pushed[i] - 0.5 * (ku0[i] + ku1[i] + cv0[i] + cv1[i]) -
           h / 8 * (kv0[i] - kv1[i] + ca0[i] - ca1[i]);
  if (excess_.any()) {
    work_ = 0.5 * (x.motion.col(u) + y.motion.col(u)) + h / 8 * (x.motion.col(v) - y.motion.col(v));
    excess_at(work_, excess_forces_);
    t.a_middle -= excess_forces_;
  }
  balance(t.middle, t.by_ground_middle, true, t.force_middle, t.a_middle);
}

void Stepper::measure(const Instant& instant, std::vector<double>& squares_u, std::vector<double>& squares_v) {
  const Eigen::VectorXd& w = base_.weights();
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const StructureSolver::Segment& s : base_.segments())
    for (int i = s.first; i < s.first + s.count; ++i) {
      const double ui = instant.at(u)[i], vi = instant.at(v)[i];
      sums_[4 * s.group + 2] += w[i] * ui * ui;
      sums_[4 * s.group + 3] += w[i] * vi * vi;
    }
  base_.combine(sums_);
  for (std::size_t k = 0; k < squares_u.size(); ++k) {
    squares_u[k] = sums_[4 * k + 2];
    squares_v[k] = sums_[4 * k + 3];
  }
}

// The errors against the motion, both as root mean squares weighed by the masses of a group, and those of the links that
// press against the motion of their impact.
void Stepper::finish_error() {
  Trial& t = *trial_;
  const double* w = base_.weights().data();
  const double *u1 = t.end.at(u), *v1 = t.end.at(v);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const StructureSolver::Segment& s : base_.segments()) {
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
  double square = 0;
  troublesome_ = -1;
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const double* sums = sums_.data() + 4 * k;
    const double mass = base_.group_masses()[k];
    const double scale_u = displacement_scale_[k], scale_v = velocity_scale_[k];
    t.squares_u[k] = sums[2];
    t.squares_v[k] = sums[3];
    square = std::max({square, sums[0] / std::max(scale_u * scale_u * mass, sums[2]),
                       sums[1] / std::max(scale_v * scale_v * mass, sums[3])});
    if (!std::isfinite(sums[0] + sums[1] + sums[2] + sums[3])) square = std::numeric_limits<double>::infinity();
  }
  double worst = std::sqrt(square);
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
        const double mass = base_.group_masses()[k];
        wide_d += std::max(displacement_scale_[k], std::sqrt(t.squares_u[k] / mass));
        wide_r += std::max(velocity_scale_[k], std::sqrt(t.squares_v[k] / mass));
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
  const auto grow = [](double& scale, double square, double mass) {
    if (square > scale * scale * mass) scale = std::sqrt(square / mass);
  };
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    grow(displacement_scale_[k], kept_->squares_u[k], base_.group_masses()[k]);
    grow(velocity_scale_[k], kept_->squares_v[k], base_.group_masses()[k]);
  }
}

double Stepper::largest_u() const { return *std::max_element(displacement_scale_.begin(), displacement_scale_.end()); }
double Stepper::largest_v() const { return *std::max_element(velocity_scale_.begin(), velocity_scale_.end()); }

bool Stepper::in_contact() const {
  return std::any_of(system_.contacts.begin(), system_.contacts.end(),
                     [](const Contact* contact) { return contact->phase() != ContactPhase::open; });
}

void Stepper::accept() {
  const double h = trial_->h;
  before_ = now_;
  previous_.swap(kept_);
  kept_.swap(trial_);
  now_ = &kept_->end;
  states_.move_on();
  outputs_.move_on();
  has_outputs_middle_ = false;
  changed_at_end_ = false;

  const Instant &x = *before_, &y = *now_;
  const int n = base_.size();
  const Eigen::MatrixXd& load = base_.load();
  const double *v0 = x.at(v), *v1 = y.at(v), *a0 = x.at(a), *a1 = y.at(a);
  const double *cv0 = x.at(cv), *cv1 = y.at(cv), *ca0 = x.at(ca), *ca1 = y.at(ca);
  double input = 0, damping = 0;
  for (int i = 0; i < n; ++i) {
    const double vm = 0.5 * (v0[i] + v1[i]) + h / 8 * (a0[i] - a1[i]);
    const double cvm = 0.5 * (cv0[i] + cv1[i]) + h / 8 * (ca0[i] - ca1[i]);
    damping += v0[i] * cv0[i] + 4 * vm * cvm + v1[i] * cv1[i];
  }
  for (Eigen::Index k = 0; k < load.cols(); ++k) {
    const double* p = load.col(k).data();
    const double begin = x.ground[k], middle = kept_->ground_middle[k], end = y.ground[k];
    if (k > 0 && begin == 0 && middle == 0 && end == 0) continue;
    for (int i = 0; i < n; ++i) {
      const double vm = 0.5 * (v0[i] + v1[i]) + h / 8 * (a0[i] - a1[i]);
      input += p[i] * (begin * v0[i] + 4 * middle * vm + end * v1[i]);
    }
  }
  input_work_ -= h / 6 * input;
  damping_work_ += h / 6 * damping;
  const int contacts = system_.contact_count();
  for (int i = 0; i < system_.links(); ++i) {
    LinkStep& step = link_steps_[i];
    step = {x.time,     y.time,     motion(i, x), kept_->middle[i], motion(i, y),
            x.force[i], kept_->force_middle[i],    y.force[i],
            x.relative(i, a) + ground_part(x.by_ground, i, a), y.relative(i, a) + ground_part(y.by_ground, i, a)};
    if (moving_)
      carried_work_ += h / 6 * (step.force_begin * x.by_ground(i, v) + 4 * step.force_middle * kept_->by_ground_middle(i, v) +
                                step.force_end * y.by_ground(i, v));
    if (i >= frictions_from_) continue;
    if (i >= contacts) {
      system_.springs[i - contacts]->accept(step);
      continue;
    }
    system_.contacts[i]->accept(step);
    rate_scale_[i] = std::max(rate_scale_[i], std::abs(step.motion_end.rate));
    penetration_scale_[i] = std::max(penetration_scale_[i], std::abs(step.motion_end.penetration));
  }
  for (std::size_t k = 0; k < friction_work_.size(); ++k)
    for (int j = 0; j < system_.frictions[k].count; ++j) {
      const LinkStep& step = link_steps_[system_.frictions[k].first + j];
      friction_work_[k] += h / 6 * (step.force_begin * step.motion_begin.rate + 4 * step.force_middle * step.motion_middle.rate +
                                    step.force_end * step.motion_end.rate);
    }
  update_scales();
  bool ground_jumps = false;
  if (now_->time >= next_break_) {
    ground_at(now_->time, stage_ground_);
    ground_jumps = stage_ground_ != now_->ground;
    find_break_after(now_->time);
  }
  if (!located_.empty())
    enter_phases(false);
  else if (ground_jumps)
    balance_now();
}

void Stepper::apply_event() {
  kept_->end = *now_;
  before_ = &kept_->end;
  forget_views();
  enter_phases(true);
}

void Stepper::Instant::archive(Archive& archive) {
  archive(time);
  archive(ground);
  archive(motion);
  archive(force);
  archive(relative);
  archive(by_ground);
  archive(excess);
}

void Stepper::Trial::archive(Archive& archive) {
  archive(h);
  archive(end);
  archive(a_middle);
  archive(force_middle);
  archive(middle);
  archive(ground_middle);
  archive(by_ground_middle);
  archive(error);
  archive(squares_u);
  archive(squares_v);
}

void Stepper::archive(Archive& archive) {
  if (archive.reading()) {
    now_ = &changed_[0];
    before_ = &previous_->end;
  }
  archive(*now_);
  archive(*before_);
  archive(*kept_);
  archive(link_steps_);
  archive(input_work_);
  archive(damping_work_);
  archive(carried_work_);
  archive(friction_work_);
  archive(given_);
  archive(started_);
  archive(displacement_scale_);
  archive(velocity_scale_);
  archive(rate_scale_);
  archive(penetration_scale_);
  archive(iterations_);
  archive(events_);
  archive(changed_at_end_);
  archive(break_begins_);
  archive(next_break_);
  for (Contact* contact : system_.contacts) contact->archive(archive);
  for (Spring* spring : system_.springs) spring->archive(archive);
  forget_views();
}

}  // namespace pounding
