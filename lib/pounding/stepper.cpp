#include <pounding/stepper.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {
namespace {

// The order of the scheme is two: a local error of tolerance^(3/2) gives a global error in proportion to the tolerance.
constexpr double local_share = 0.25;

// Sums and differences of the motion carry this much rounding, as part of the motion; no smaller error is asked for.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

// A contact moves far less than the structures that it joins; an error is not resolved below this part of their motion.
constexpr double smallest_contact_rate = 1e-3;
constexpr double smallest_contact_penetration = 1e-4;

// y += scale A x. For the few unknowns of oscillators plain loops beat the call of a matrix kernel.
void add_product(Eigen::VectorXd& y, double scale, const Eigen::MatrixXd& a, const Eigen::VectorXd& x) {
  constexpr Eigen::Index few = 8;
  if (x.size() > few || y.size() > few) {
    y.noalias() += scale * a * x;
    return;
  }
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double factor = scale * x[j];
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += factor * a(i, j);
  }
}

void set_product(Eigen::VectorXd& y, const Eigen::MatrixXd& a, const Eigen::VectorXd& x) {
  y.setZero(a.rows());
  add_product(y, 1, a, x);
}

double peak(const Eigen::VectorXd& x, const Group& group) {
  return group.count > 0 ? x.segment(group.first, group.count).cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace

Stepper::Stepper(const System& system, const StepperOptions& options) : system_(system), options_(options) {
  const double rho = options.spectral_radius;
  if (!(rho >= 0 && rho <= 1)) throw std::invalid_argument("spectral_radius must lie in [0, 1]");
  if (!(options.tolerance > 0 && options.tolerance < 1)) throw std::invalid_argument("tolerance must lie in (0, 1)");
  if (!(options.first_rung > 0)) throw std::invalid_argument("first_rung must be positive");
  alpha_m_ = (2 - rho) / (1 + rho);
  alpha_f_ = 1 / (1 + rho);
  gamma_ = 0.5 + alpha_m_ - alpha_f_;
  beta_ = 0.25 * (1 + alpha_m_ - alpha_f_) * (1 + alpha_m_ - alpha_f_);
  allowed_ = std::max(local_share * options.tolerance * std::sqrt(options.tolerance), rounding);

  const int n = system.size();
  const Eigen::LLT<Eigen::MatrixXd> mass(system.mass);
  if (mass.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
  mass_inverse_ = mass.solve(Eigen::MatrixXd::Identity(n, n));
  rigid_flexibility_ = system.closing.transpose() * mass_inverse_ * system.closing;
  entries_.resize(system.links());
  for (int i = 0; i < system.links(); ++i)
    for (int k = 0; k < n; ++k)
      if (system.closing(k, i) != 0) entries_[i].push_back({k, system.closing(k, i)});
  displacement_scale_.assign(system.groups.size(), 0.0);
  velocity_scale_.assign(system.groups.size(), 0.0);
  rate_scale_.assign(system.links(), 0.0);
  penetration_scale_.assign(system.links(), 0.0);
  free_.resize(system.links());
  free_closing_.resize(system.links());
  link_steps_.resize(system.links());
  work_.resize(n);
}

double Stepper::closing(int link, const Eigen::VectorXd& x) const {
  double sum = 0;
  for (const Entry& entry : entries_[link]) sum += entry.factor * x[entry.unknown];
  return sum;
}

LinkMotion Stepper::motion(int link, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const {
  return {system_.contacts[link]->penetration(closing(link, u)), closing(link, v)};
}

void Stepper::accelerate(const Eigen::VectorXd& u, const Eigen::VectorXd& v, const Eigen::VectorXd& force,
                         double ground, Eigen::VectorXd& a) const {
  work_ = -ground * system_.load;
  add_product(work_, -1, system_.damping, v);
  add_product(work_, -1, system_.stiffness, u);
  add_product(work_, -1, system_.closing, force);
  set_product(a, mass_inverse_, work_);
}

void Stepper::balance(const Eigen::VectorXd& u, const Eigen::VectorXd& v, double ground, Eigen::VectorXd& force,
                      Eigen::VectorXd& a) const {
  std::vector<int> held;
  force.setZero(system_.links());
  for (int i = 0; i < system_.links(); ++i) {
    const Contact& contact = *system_.contacts[i];
    if (contact.phase() == ContactPhase::resting)
      held.push_back(i);
    else if (presses(contact.phase()))
      force[i] = contact.evaluate(motion(i, u, v)).force;
  }
  accelerate(u, v, force, ground, a);
  if (held.empty()) return;
  // Held contacts take the forces that leave no closing acceleration; those that hold the same bodies share them.
  const int count = static_cast<int>(held.size());
  Eigen::MatrixXd g(count, count);
  Eigen::VectorXd relative(count);
  for (int i = 0; i < count; ++i) {
    relative[i] = closing(held[i], a);
    for (int j = 0; j < count; ++j) g(i, j) = rigid_flexibility_(held[i], held[j]);
  }
  const Eigen::VectorXd forces = g.completeOrthogonalDecomposition().solve(relative);
  for (int i = 0; i < count; ++i) force[held[i]] = forces[i];
  accelerate(u, v, force, ground, a);
}

void Stepper::balance_now() {
  balance(now_.u, now_.v, system_.ground.acceleration(now_.time), now_.force, now_.a);
  algorithmic_ = now_.a;
}

void Stepper::start(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  now_.time = time;
  now_.u = u;
  now_.v = v;
  now_.a = Eigen::VectorXd::Zero(system_.size());
  now_.force = Eigen::VectorXd::Zero(system_.links());
  balance_now();
  before_ = kept_.end = trial_.end = now_;
  kept_.h = 0;
  kept_.a_middle = now_.a;
  sums_ = {};
  sums_.input = kinetic_energy() + strain_energy();
  update_scales();
}

double Stepper::rung_below(double h) const {
  const double ratio = std::log2(options_.first_rung / (h * (1 + 1e-9)));
  return std::ldexp(options_.first_rung, -std::max(0, static_cast<int>(std::ceil(ratio))));
}

const Stepper::Level& Stepper::level(double h) {
  int exponent = 0;
  const double mantissa = std::frexp(options_.first_rung / h, &exponent);
  const bool on_ladder = std::abs(mantissa - 0.5) < 1e-9;
  if (on_ladder) {
    const auto found = rungs_.find(exponent);
    if (found != rungs_.end()) return found->second;
  } else if (h == off_ladder_h_) {
    return off_ladder_;
  }
  Level& built = on_ladder ? rungs_[exponent] : off_ladder_;
  if (!on_ladder) off_ladder_h_ = h;
  const double exact = on_ladder ? std::ldexp(options_.first_rung, 1 - exponent) : h;
  const Eigen::MatrixXd matrix = alpha_m_ * system_.mass + alpha_f_ * gamma_ * exact * system_.damping +
                                 alpha_f_ * beta_ * exact * exact * system_.stiffness;
  built.inverse = matrix.inverse();
  built.response.noalias() = built.inverse * system_.closing;
  built.flexibility.noalias() = system_.closing.transpose() * built.response;
  ++factorizations_;
  return built;
}

bool Stepper::attempt(double h, std::optional<double> end) {
  const Level& lev = level(h);
  Trial& t = trial_;
  landed_.clear();
  t.h = h;
  t.end.time = end.value_or(now_.time + h);
  t.ground_begin = system_.ground.acceleration(now_.time);
  t.ground_middle = system_.ground.acceleration(now_.time + 0.5 * h);
  t.ground_end = system_.ground.acceleration_before(t.end.time);

  // With a spectral radius below one the scheme carries the acceleration of a time (alpha_m - alpha_f) h earlier: it goes
  // along when the step changes, else each change would cost an order.
  if (options_.spectral_radius == 1 || kept_.h == 0)
    carried_ = algorithmic_;
  else
    carried_ = now_.a + (h / kept_.h) * (algorithmic_ - now_.a);

  // Predictors: the part of the end state that does not depend on the end acceleration.
  t.end.u = now_.u + h * now_.v + (h * h * (0.5 - beta_)) * carried_;
  t.end.v = now_.v + (h * (1 - gamma_)) * carried_;

  work_ = -(alpha_f_ * t.ground_end + (1 - alpha_f_) * t.ground_begin) * system_.load;
  t.u_middle = alpha_f_ * t.end.u + (1 - alpha_f_) * now_.u;
  t.v_middle = alpha_f_ * t.end.v + (1 - alpha_f_) * now_.v;
  add_product(work_, -1, system_.stiffness, t.u_middle);
  add_product(work_, -1, system_.damping, t.v_middle);
  add_product(work_, alpha_m_ - 1, system_.mass, carried_);
  add_product(work_, alpha_f_ - 1, system_.closing, now_.force);
  set_product(t.algorithmic, lev.inverse, work_);

  t.end.force.setZero(system_.links());
  t.end.u += (h * h * beta_) * t.algorithmic;
  t.end.v += (h * gamma_) * t.algorithmic;
  if (!solve_links(lev.flexibility, h, t.end.u, t.end.v, t.algorithmic, t.end.force)) return false;
  if (!active_.empty()) {
    set_product(work_, lev.response, t.end.force);
    t.algorithmic -= alpha_f_ * work_;
    t.end.u -= (h * h * beta_ * alpha_f_) * work_;
    t.end.v -= (h * gamma_ * alpha_f_) * work_;
  }
  if (!t.end.u.allFinite() || !t.end.v.allFinite()) return false;
  if (options_.spectral_radius == 1)
    t.end.a = t.algorithmic;
  else
    accelerate(t.end.u, t.end.v, t.end.force, t.ground_end, t.end.a);
  evaluate_middle(t);
  estimate_error(t);
  return true;
}

void Stepper::evaluate_middle(Trial& t) {
  const double h = t.h;
  t.u_middle = 0.5 * (now_.u + t.end.u) + (h / 8) * (now_.v - t.end.v);
  t.v_middle = 0.5 * (now_.v + t.end.v) + (h / 8) * (now_.a - t.end.a);
  balance(t.u_middle, t.v_middle, t.ground_middle, t.force_middle, t.a_middle);
}

// The step's own velocities and displacements against Simpson's rule on the accelerations that balance the equations at
// its ends and its middle. It sees forces that are not smooth, such as a dashpot that grows like d^(1/4) from the touch.
void Stepper::estimate_error(Trial& t) {
  const double h = t.h;
  double worst = 0, widest_u = 0, widest_v = 0;
  error_v_ = (h / 6) * (now_.a + 4 * t.a_middle + t.end.a) - (t.end.v - now_.v);
  error_u_ = (h * h / 6) * (now_.a + 2 * t.a_middle) - (t.end.u - now_.u - h * now_.v);
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const Group& group = system_.groups[k];
    const double scale_u = std::max(displacement_scale_[k], peak(t.end.u, group));
    const double scale_v = std::max(velocity_scale_[k], peak(t.end.v, group));
    widest_u = std::max(widest_u, scale_u);
    widest_v = std::max(widest_v, scale_v);
    worst = std::max({worst, peak(error_u_, group) / scale_u, peak(error_v_, group) / scale_v});
  }
  const double least_d = widest_u * std::max(smallest_contact_penetration, rounding / allowed_);
  const double least_r = widest_v * std::max(smallest_contact_rate, rounding / allowed_);
  for (const int i : active_) {
    const LinkMotion end = motion(i, t.end.u, t.end.v);
    const double scale_d = std::max({penetration_scale_[i], std::abs(end.penetration), least_d});
    const double scale_r = std::max({rate_scale_[i], std::abs(end.rate), least_r});
    worst = std::max({worst, std::abs(closing(i, error_u_)) / scale_d, std::abs(closing(i, error_v_)) / scale_r});
  }
  t.error = worst / allowed_;
}

double Stepper::error_ratio() const { return trial_.error; }

void Stepper::update_scales() {
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const Group& group = system_.groups[k];
    displacement_scale_[k] = std::max({displacement_scale_[k], peak(now_.u, group), group.displacement_floor});
    velocity_scale_[k] = std::max({velocity_scale_[k], peak(now_.v, group), group.velocity_floor});
  }
}

bool Stepper::in_contact() const {
  return std::any_of(system_.contacts.begin(), system_.contacts.end(),
                     [](const Contact* c) { return c->phase() != ContactPhase::open; });
}

double Stepper::kinetic_energy() const { return 0.5 * now_.v.dot(system_.mass * now_.v); }
double Stepper::strain_energy() const { return 0.5 * now_.u.dot(system_.stiffness * now_.u); }

double Stepper::contact_work() const {
  double sum = 0;
  for (const Contact* contact : system_.contacts) sum += contact->work();
  return sum;
}

void Stepper::interpolate(double time, Eigen::VectorXd& u, Eigen::VectorXd& v) const {
  const double h = kept_.end.time - before_.time;
  if (!(h > 0)) {
    u = now_.u;
    v = now_.v;
    return;
  }
  const double s = std::clamp((time - before_.time) / h, 0.0, 1.0), r = 1 - s;
  const double begin = r * r * (1 + 2 * s), end = s * s * (1 + 2 * r), slope_begin = h * s * r * r,
               slope_end = -h * s * s * r;
  u = begin * before_.u + end * kept_.end.u + slope_begin * before_.v + slope_end * kept_.end.v;
  v = begin * before_.v + end * kept_.end.v + slope_begin * before_.a + slope_end * kept_.end.a;
}

void Stepper::interpolate_acceleration(double time, Eigen::VectorXd& a) const {
  const double h = kept_.end.time - before_.time;
  if (!(h > 0)) {
    a = now_.a;
    return;
  }
  const double s = std::clamp((time - before_.time) / h, 0.0, 1.0);
  a = (1 - s) * (1 - 2 * s) * before_.a + 4 * s * (1 - s) * kept_.a_middle + s * (2 * s - 1) * kept_.end.a;
}

void Stepper::accept() {
  const double h = trial_.h;
  std::swap(before_, now_);
  std::swap(kept_, trial_);

  const double ground[3] = {kept_.ground_begin, kept_.ground_middle, kept_.ground_end};
  const Eigen::VectorXd* velocity[3] = {&before_.v, &kept_.v_middle, &kept_.end.v};
  for (int k = 0; k < 3; ++k) {
    const double weight = h / 6 * (k == 1 ? 4 : 1);
    sums_.input -= weight * ground[k] * system_.load.dot(*velocity[k]);
    set_product(work_, system_.damping, *velocity[k]);
    sums_.damping += weight * velocity[k]->dot(work_);
  }
  for (int i = 0; i < system_.links(); ++i) {
    LinkStep& step = link_steps_[i];
    step = {before_.time,      kept_.end.time,
            motion(i, before_.u, before_.v), motion(i, kept_.u_middle, kept_.v_middle), motion(i, kept_.end.u, kept_.end.v),
            before_.force[i],  kept_.force_middle[i], kept_.end.force[i]};
    system_.contacts[i]->accept(step);
    rate_scale_[i] = std::max(rate_scale_[i], std::abs(step.motion_end.rate));
    penetration_scale_[i] = std::max(penetration_scale_[i], std::abs(step.motion_end.penetration));
  }
  now_ = kept_.end;
  algorithmic_ = kept_.algorithmic;
  update_scales();
  const bool ground_jumps = system_.ground.acceleration(now_.time) != ground[2];
  if (!landed_.empty())
    enter_phases();
  else if (ground_jumps)
    balance_now();
}

void Stepper::cross_now() {
  before_ = kept_.end = now_;
  enter_phases();
}

}  // namespace pounding
