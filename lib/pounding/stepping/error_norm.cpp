#include <pounding/stepping/error_norm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

// Generalized-alpha is of order two: a local error of tolerance^(3/2) gives a global error proportional to the
// tolerance.
constexpr double local_share = 0.25;
// The embedded scheme of ESDIRK4 is of order three; its local error is comparable to the global error of order four.
constexpr double embedded_share = 0.05;

// A contact moves far less than the structures it links. Errors below these fractions of the structural motion are not
// resolved.
constexpr double min_contact_rate = 1e-3;
constexpr double min_contact_penetration = 1e-4;

constexpr std::size_t sums_of_group = 5;

double allowed_error(const Scheme& scheme, double tolerance) {
  const double allowed = scheme.kind == Scheme::Kind::esdirk4 ? embedded_share * tolerance
                                                              : local_share * tolerance * std::sqrt(tolerance);
  return allowed;
}

}  // namespace

ErrorNorm::ErrorNorm(const Equations& equations, const Scheme& scheme, double tolerance)
    : equations_(equations),
      allowed_by_tolerance_(allowed_error(scheme, tolerance)),
      allowed_(std::max(allowed_by_tolerance_, rounding)) {
  const System& system = equations.system;
  const int links = equations.links.size(), groups = static_cast<int>(system.groups.size());
  link_groups_.resize(static_cast<std::size_t>(links));
  for (int i = 0; i < links; ++i)
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it)
      for (int k = 0; k < groups; ++k) {
        const Group& group = system.groups[k];
        std::vector<int>& joined = link_groups_[i];
        if (it.row() >= group.first && it.row() < group.first + group.count &&
            std::find(joined.begin(), joined.end(), k) == joined.end())
          joined.push_back(k);
      }
  rest_size_.assign(system.groups.size(), 0.0);
  const Eigen::VectorXd all_masses = system.mass.diagonal();
  for (int k = 0; k < groups; ++k) {
    const Group& group = system.groups[k];
    if (!group.elastic) continue;
    const Eigen::VectorXd masses = all_masses.segment(group.first, group.count);
    rest_size_[k] = std::sqrt(masses.dot(group.elastic->at_rest().cwiseAbs2()) / masses.sum());
  }
  scales_.displacement.assign(system.groups.size(), 0.0);
  scales_.velocity.assign(system.groups.size(), 0.0);
  rate_scale_.assign(static_cast<std::size_t>(links), 0.0);
  penetration_scale_.assign(static_cast<std::size_t>(links), 0.0);
  stretch_scale_.assign(equations.slips.any() ? static_cast<std::size_t>(equations.slips.size()) : 0, 0.0);
  slow_velocity_.assign(system.groups.size(), 0.0);
  sums_.resize(sums_of_group * system.groups.size());
}

double ErrorNorm::ratio(Trial& trial, const StepError& error, const std::vector<int>& active) {
  const LinkSet& links = equations_.links;
  double worst = group_error(trial, error);
  worst_link_ = -1;
  if (!active.empty() && active.front() < links.contacts()) {
    errors_.resize(error.u.size(), 2);
    errors_.col(0) = error.u;
    errors_.col(1) = error.v;
    equations_.solver.gather(active, errors_, link_errors_);
    for (std::size_t k = 0; k < active.size(); ++k) {
      const int i = active[k];
      if (i >= links.contacts()) break;
      const double own = contact_error(i, static_cast<Eigen::Index>(k), trial);
      if (own <= worst) continue;
      worst = own;
      worst_link_ = i;
    }
  }
  for (const int slip : equations_.slips.slipping()) {
    const double own = slip_error(slip, trial, error.slip[slip]);
    if (own <= worst) continue;
    worst = own;
    worst_link_ = -1;
  }
  return worst / allowed_;
}

// Largest relative error of all groups.
double ErrorNorm::group_error(Trial& trial, const StepError& error) {
  const StructureSolver& solver = equations_.solver;
  const double* w = solver.layout().weights.data();
  const double *u1 = trial.end.at(Instant::u), *v1 = trial.end.at(Instant::v);
  const double *error_u = error.u.data(), *error_v = error.v.data();
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const StructureSolver::Segment& s : solver.layout().segments) {
    double eu = 0, ev = 0, uu = 0, vv = 0;
    for (int i = s.first; i < s.first + s.count; ++i) {
      eu += w[i] * error_u[i] * error_u[i];
      ev += w[i] * error_v[i] * error_v[i];
      uu += w[i] * u1[i] * u1[i];
      vv += w[i] * v1[i] * v1[i];
    }
    double* sums = sums_.data() + sums_of_group * s.group;
    sums[0] += eu, sums[1] += ev, sums[2] += uu, sums[3] += vv;
  }
  if (trial.short_motions) {
    const Eigen::VectorXd slow = trial.end.motion.col(Instant::v) + equations_.short_motions.velocity_at_end(trial);
    for (const StructureSolver::Segment& s : solver.layout().segments)
      for (int i = s.first; i < s.first + s.count; ++i) sums_[sums_of_group * s.group + 4] += w[i] * slow[i] * slow[i];
  }
  solver.combine(sums_);
  double square = 0, all = 0;
  const double* const masses = solver.layout().group_masses.data();
  const std::vector<double>& slow_velocity = equations_.short_motions.any() ? slow_velocity_ : scales_.velocity;
  for (std::size_t k = 0, groups = scales_.displacement.size(); k < groups; ++k) {
    const double* sums = sums_.data() + sums_of_group * k;
    const double mass = masses[k], scale_u = scales_.displacement[k], scale_v = slow_velocity[k];
    const double slow = trial.short_motions ? sums[4] : sums[3];
    trial.squares_u[k] = sums[2];
    trial.squares_v[k] = sums[3];
    trial.squares_slow[k] = slow;
    square = std::max({square, sums[0] / std::max(scale_u * scale_u * mass, sums[2]),
                       sums[1] / std::max(scale_v * scale_v * mass, slow)});
    all += sums[0] + sums[1] + sums[2] + sums[3];
  }
  if (!std::isfinite(all)) return std::numeric_limits<double>::infinity();
  return std::sqrt(square);
}

// `row`: row of the active link in link_errors_.
double ErrorNorm::contact_error(int contact, Eigen::Index row, const Trial& trial) const {
  const double part_d = std::max(min_contact_penetration, rounding / allowed_);
  const double part_r = std::max(min_contact_rate, rounding / allowed_);
  const LinkMotion end = equations_.links.motion(contact, trial.end);
  double wide_d = 0, wide_r = 0;  // of the linked bodies
  for (const int k : link_groups_[contact]) {
    const double mass = equations_.solver.layout().group_masses[k];
    wide_d += std::max(scales_.displacement[k], std::sqrt(trial.squares_u[k] / mass));
    wide_r += std::max(scales_.velocity[k], std::sqrt(trial.squares_v[k] / mass));
  }
  const double scale_d = std::max({penetration_scale_[contact], std::abs(end.penetration), part_d * wide_d});
  const double scale_r = std::max({rate_scale_[contact], std::abs(end.rate), part_r * wide_r});
  return std::max(std::abs(link_errors_(row, 0)) / scale_d, std::abs(link_errors_(row, 1)) / scale_r);
}

// Elongation of the spring in series with the dashpot or slider, which determines its force.
double ErrorNorm::stretch(int slip, const Instant& x) const {
  const LinkMotion motion = equations_.links.motion(equations_.links.contacts() + slip, x);
  return std::abs(motion.penetration - motion.slip);
}

double ErrorNorm::slip_error(int slip, const Trial& trial, double error) const {
  const double part = std::max(min_contact_penetration, rounding / allowed_);
  double wide = 0;  // of the linked bodies
  for (const int k : link_groups_[equations_.links.contacts() + slip])
    wide +=
        std::max(scales_.displacement[k], std::sqrt(trial.squares_u[k] / equations_.solver.layout().group_masses[k]));
  // Between two fixed ends, only the spring's own motion defines the scale.
  const double scale = std::max({stretch_scale_[slip], stretch(slip, trial.end), part * wide});
  return scale > 0 ? std::abs(error) / scale : 0;
}

void ErrorNorm::measure(const Instant& x, std::vector<double>& squares_u, std::vector<double>& squares_v) {
  const StructureSolver& solver = equations_.solver;
  const Eigen::VectorXd& w = solver.layout().weights;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (const StructureSolver::Segment& s : solver.layout().segments)
    for (int i = s.first; i < s.first + s.count; ++i) {
      const double ui = x.at(Instant::u)[i], vi = x.at(Instant::v)[i];
      sums_[sums_of_group * s.group + 2] += w[i] * ui * ui;
      sums_[sums_of_group * s.group + 3] += w[i] * vi * vi;
    }
  solver.combine(sums_);
  for (std::size_t k = 0; k < squares_u.size(); ++k) {
    squares_u[k] = sums_[sums_of_group * k + 2];
    squares_v[k] = sums_[sums_of_group * k + 3];
  }
}

void ErrorNorm::raise(std::vector<double>& scales, const std::vector<double>& squares) const {
  const double* const masses = equations_.solver.layout().group_masses.data();
  for (std::size_t k = 0; k < scales.size(); ++k)
    if (squares[k] > scales[k] * scales[k] * masses[k]) scales[k] = std::sqrt(squares[k] / masses[k]);
}

void ErrorNorm::start(const Instant& now) {
  const std::vector<Group>& groups = equations_.system.groups;
  std::vector<double> squares_u(groups.size()), squares_v(groups.size());
  measure(now, squares_u, squares_v);
  raise(scales_.displacement, squares_u);
  raise(scales_.velocity, squares_v);
  raise(slow_velocity_, squares_v);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    scales_.displacement[k] = std::max(scales_.displacement[k], groups[k].displacement_floor);
    scales_.velocity[k] = std::max(scales_.velocity[k], groups[k].velocity_floor);
    slow_velocity_[k] = std::max(slow_velocity_[k], groups[k].velocity_floor);
  }
}

void ErrorNorm::learn(const Trial& kept) {
  raise(scales_.displacement, kept.squares_u);
  raise(scales_.velocity, kept.squares_v);
  if (equations_.short_motions.any())
    raise(slow_velocity_, kept.squares_slow);  // otherwise it equals the scale of the full velocity
  for (const int slip : equations_.slips.slipping())
    stretch_scale_[slip] = std::max(stretch_scale_[slip], stretch(slip, kept.end));
}

void ErrorNorm::learn(int contact, const LinkMotion& end) {
  rate_scale_[contact] = std::max(rate_scale_[contact], std::abs(end.rate));
  penetration_scale_[contact] = std::max(penetration_scale_[contact], std::abs(end.penetration));
}

void ErrorNorm::begin_impact(int contact, double rate) {
  rate_scale_[contact] = std::abs(rate);
  penetration_scale_[contact] = 0;
}

double ErrorNorm::relative_size(const Eigen::VectorXd& change, const Eigen::VectorXd& displacement) const {
  const StructureSolver& solver = equations_.solver;
  const std::size_t groups = rest_size_.size();
  std::vector<double> sums(2 * groups, 0.0);
  const Eigen::VectorXd& w = solver.layout().weights;
  for (const StructureSolver::Segment& s : solver.layout().segments)
    for (int i = s.first; i < s.first + s.count; ++i) {
      sums[2 * s.group] += w[i] * change[i] * change[i];
      sums[2 * s.group + 1] += w[i] * displacement[i] * displacement[i];
    }
  solver.combine(sums);
  double worst = 0;
  for (std::size_t k = 0; k < groups; ++k) {
    if (const Group& group = equations_.system.groups[k]; !group.elastic && !group.tangent) continue;
    const double mass = solver.layout().group_masses[k];
    const double size = std::max({scales_.displacement[k], rest_size_[k], std::sqrt(sums[2 * k + 1] / mass)});
    const double ratio = std::sqrt(sums[2 * k] / mass) / size;
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

double ErrorNorm::min_energy() const {
  double energy = 0;
  for (std::size_t k = 0; k < rest_size_.size(); ++k) {
    const double velocity = equations_.system.groups[k].velocity_floor;
    energy += 0.5 * equations_.solver.layout().group_masses[k] * velocity * velocity;
  }
  return energy;
}

double ErrorNorm::product(const Eigen::VectorXd& p, const Eigen::VectorXd& q) const {
  double sum = (equations_.solver.layout().weights.array() * p.array() * q.array()).sum();
  equations_.solver.combine({&sum, 1});
  return sum;
}

void ErrorNorm::archive(Archive& archive) {
  archive(scales_.displacement, scales_.velocity, slow_velocity_, rate_scale_, penetration_scale_, stretch_scale_);
}

void add_simpson_error(const ShortMotions& short_motions, const Instant& begin, const Trial& t, double part,
                       StepError& error) {
  using enum Instant::Column;
  const double h = t.h;
  const double *u0 = begin.at(u), *v0 = begin.at(v), *a0 = begin.at(a);
  const double *u1 = t.end.at(u), *v1 = t.end.at(v), *a1 = t.end.at(a), *am = t.a_middle.data();
  double *error_u = error.u.data(), *error_v = error.v.data();
  const int n = static_cast<int>(error.u.size());
  const auto add = [&](const auto& ground_in_u, const auto& ground_in_v) {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double ev = part * (h / 6 * (a0[i] + 4 * am[i] + a1[i]) - (v1[i] - v0[i]) + ground_in_v(i));
      const double eu = part * (h * h / 6 * (a0[i] + 2 * am[i]) - (u1[i] - u0[i] - h * v0[i]) + ground_in_u(i));
      error_v[i] = std::abs(ev) > std::abs(error_v[i]) ? ev : error_v[i];
      error_u[i] = std::abs(eu) > std::abs(error_u[i]) ? eu : error_u[i];
    }
  };
  if (!t.short_motions) {
    const auto none = [](int) { return 0.0; };
    return add(none, none);
  }
  const Eigen::MatrixXd &x = t.short_motions->begin, &m = t.short_motions->middle, &y = t.short_motions->end;
  const Eigen::VectorXd missed_u =
      short_motions.shift(h * h / 6 * (x.col(a) + 2 * m.col(a)) - (y.col(u) - x.col(u) - h * x.col(v)));
  const Eigen::VectorXd missed_v =
      short_motions.shift(h / 6 * (x.col(a) + 4 * m.col(a) + y.col(a)) - (y.col(v) - x.col(v)));
  add([&](int i) { return missed_u[i]; }, [&](int i) { return missed_v[i]; });
}

}  // namespace pounding
