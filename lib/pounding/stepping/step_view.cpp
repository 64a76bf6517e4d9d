#include <pounding/stepping/step_view.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace pounding {
namespace {

const StepperOptions& checked(const System& system, const StepperOptions& options) {
  const bool is_esdirk4 = options.scheme.kind == Scheme::Kind::esdirk4;
  if (!is_esdirk4 && system.has_tangents())
    throw std::invalid_argument(
        "members with fibres were given with the integrator generalized_alpha; they need esdirk4");
  // The trapezoidal rule of generalized-alpha misses reversals of the slip within a step.
  if (!is_esdirk4 &&
      std::any_of(system.frictions.begin(), system.frictions.end(), [](const Friction& f) { return f.is_compliant(); }))
    throw std::invalid_argument(
        "friction with a tangential stiffness was given with the integrator generalized_alpha; it needs esdirk4");
  GeneralizedAlpha::of(options.scheme.spectral_radius);
  if (!(options.tolerance > 0 && options.tolerance < 1)) throw std::invalid_argument("tolerance must lie in (0, 1)");
  if (!(options.max_step > 0)) throw std::invalid_argument("max_step must be positive");
  return options;
}

bool carries_acceleration(const Scheme& scheme) {
  return scheme.kind == Scheme::Kind::generalized_alpha && scheme.spectral_radius != 1;
}

std::unique_ptr<TimeScheme> make_scheme(const Scheme& scheme, Equations& equations, StageSolver& stages) {
  if (scheme.kind == Scheme::Kind::esdirk4) return make_esdirk4(equations, stages);
  return make_generalized_alpha(equations, stages, GeneralizedAlpha::of(scheme.spectral_radius));
}

}  // namespace

StepView::StepView(const System& system, StructureSolver& solver, const StepperOptions& options)
    : options_(checked(system, options)),
      equations_(system, solver, carries_acceleration(options.scheme)),
      dyadic_(system, options.max_step),
      norm_(equations_, options.scheme, options.tolerance),
      stages_(equations_, norm_),
      scheme_(make_scheme(options.scheme, equations_, stages_)),
      history_(equations_),
      error_{Eigen::VectorXd::Zero(solver.size()), Eigen::VectorXd::Zero(solver.size())},
      longest_step_(options.max_step),
      functions_(equations_.links, equations_.rigid, norm_.scales(), longest_step_),
      locator_(functions_, equations_.springs),
      ledger_(system),
      budget_(options.tolerance, options.scheme.error_order(), norm_.min_energy()),
      contact_events_(equations_, functions_, norm_, ledger_, options.tolerance),
      held_forces_(equations_),
      output_(equations_, history_),
      described_{std::vector<LinkStep>(static_cast<std::size_t>(system.links()))} {}

double StepView::step_towards(double wanted, double left) const {
  if (equations_.solver.layout().step_lengths == StepLengths::any) {
    // Sixteen lengths per octave, so that round-off in the error does not change the length of the next step.
    constexpr std::uint64_t exponent_and_four_bits = 0xffff'0000'0000'0000;
    const double even =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(wanted * (1 + 1e-9)) & exponent_and_four_bits);
    return left / std::ceil(left / even * (1 - 1e-9));
  }
  const double dyadic = dyadic_.at_most(wanted);
  return left <= dyadic * (1 + 1e-9) ? left : dyadic;
}

std::vector<double> StepView::friction_stored() const {
  const LinkSet& links = equations_.links;
  const Instant& now = history_.now();
  std::vector<double> stored;
  for (const Friction& friction : links.frictions()) {
    Sliding force{};
    for (int j = 0; j < friction.count; ++j) force[j] = now.force[friction.first + j];
    stored.push_back(
        stored_energy(friction, links.contact(friction.contact), links.motion(friction.contact, now), force));
  }
  return stored;
}

bool StepView::in_contact() const {
  return std::ranges::any_of(equations_.links.memory().contacts,
                             [](const ContactMemory& contact) { return contact.phase() != ContactPhase::open; });
}

// Fills the description of a link in a solved step from x.
void StepView::describe(int i, const Instant& x, const Trial& kept, LinkStep& step) const {
  const LinkSet& links = equations_.links;
  const Instant& y = kept.end;
  step.begin = x.time;
  step.end = y.time;
  links.motion(i, x, step.motion_begin);
  if (kept.springs_stay && links.is_spring(i)) {
    step.motion_middle = Equations::middle_of(i, x, kept);
    step.motion_middle.penetration += links.ground_part(y.by_ground, i, Instant::u);
    step.motion_middle.penetration -= y.relief[i - links.contacts()];
  } else {
    step.motion_middle = kept.middle[i];
  }
  links.motion(i, y, step.motion_end);
  step.force_begin = x.force[i];
  step.force_middle = kept.force_middle[i];
  step.force_end = y.force[i];
  step.acceleration_begin = links.acceleration(i, x);
  step.acceleration_end = links.acceleration(i, y);
  if (!links.is_spring(i) || !equations_.springs.any() || kept.springs_stay) return;
  const auto rates = kept.spring_rates.row(i - links.contacts());
  step.motion_begin.rate = rates[0];
  step.acceleration_begin = rates[1];
  step.motion_end.rate = rates[3];
  step.acceleration_end = rates[4];
}

void StepView::deformations(double s, Eigen::VectorXd& d) const {
  const Trial& kept = history_.kept();
  const Instant &x = history_.begin(), &y = kept.end;
  const int first = equations_.links.contacts(), count = equations_.links.springs();
  const double *const begin = kept.spring_paths.data(), *const end = begin + count, h = y.time - x.time;
  const auto column = [first](const Instant& at, Instant::Column which) {
    return at.relative.col(which).data() + first;
  };
  const double *v0 = column(x, Instant::v), *a0 = column(x, Instant::a), *v1 = column(y, Instant::v),
               *a1 = column(y, Instant::a);
  d.resize(count);
  double* const at = d.data();
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) at[i] = Quintic({begin[i], v0[i], a0[i]}, {end[i], v1[i], a1[i]}, h).at(s).x;
}

void StepView::describe_springs() const {
  if (std::exchange(described_.with_springs, true)) return;
  for (int i = equations_.links.contacts(); i < equations_.links.frictions_from(); ++i)
    describe(i, described_.steps[i]);
}

}  // namespace pounding
