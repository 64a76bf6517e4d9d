#include <pounding/stepping/stepper.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

namespace pounding {
namespace {

// Smallest reversal of a fibre inside a step that is followed, relative to its largest strain: this part of the
// tolerance.
constexpr double part_of_reversal = 0.5;

}  // namespace

Stepper::Stepper(const System& system, StructureSolver& solver, const StepperOptions& options)
    : StepView(system, solver, options) {}
void Stepper::balance_now() {
  equations_.balance(history_.change_now());
  output_.now_changed();
}

// Updates the next breakpoint and the maximum step until then.
void Stepper::look_ahead() {
  equations_.supports.find_break_after(time());
  longest_step_ = std::min(options_.max_step, equations_.supports.longest_step(time()));
}

void Stepper::start(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  describe_springs();
  const Eigen::VectorXd& rest = equations_.system.loaded_from;
  const bool is_loaded = !started_ && rest.size() > 0;
  if (is_loaded) start_elements([&](int spring) { return LinkMotion{rest[spring], 0}; });
  const Energies before = started_ ? energies() : Energies{};
  const StructureSolver& solver = equations_.solver;
  Instant& now = history_.change_now();
  now.time = time;
  look_ahead();
  now.motion.setZero();
  now.motion.col(Instant::u) = solver.coordinates(u);
  now.motion.col(Instant::v) = solver.coordinates(v);
  solver.recover(now.motion.col(Instant::u));
  solver.recover(now.motion.col(Instant::v));
  equations_.tangents.settle(now.motion.col(Instant::u));
  solver.stiffness_times(now.motion.col(Instant::u), now.motion.col(Instant::ku));
  now.spring_slopes.setZero();
  if (equations_.has_pseudo_forces()) equations_.pseudo_force(now.motion.col(Instant::u), now.pseudo_force);
  balance_now();
  if (equations_.slips.any() && !started_) {
    equations_.slips.start(now);
    balance_now();
  }
  const auto motion_of = [&](int spring) { return equations_.links.motion(equations_.links.contacts() + spring, now); };
  if (is_loaded) load_elements(rest, motion_of);
  start_elements(motion_of);
  equations_.ranges.read();
  history_.restart();
  output_.forget();
  const Energies after = energies();
  ledger_.give(after.kinetic + after.strain - before.kinetic - before.strain);
  if (!started_) ledger_.give(after.impact);      // energy of contacts that press at the start
  if (!started_) ledger_.give(after.hysteretic);  // plastic work of the initial displacement
  norm_.start(now);
  started_ = true;
}

// Calls visit(element, memory, first spring) for each element.
template <class Visit>
void Stepper::visit_elements(Visit&& visit) {
  int spring = 0;
  for (std::size_t i = 0; i < equations_.system.elements.size(); ++i) {
    const Element& element = *equations_.system.elements[i];
    visit(element, equations_.links.memory().elements[static_cast<int>(i)], spring);
    spring += element.deformations();
  }
}

void Stepper::start_elements(const std::function<LinkMotion(int)>& motion_of) {
  visit_elements([&](const Element& element, ElementMemory memory, int spring) {
    std::array<LinkMotion, max_deformations> motions;
    const int count = element.deformations();
    for (int j = 0; j < count; ++j) motions[j] = motion_of(spring + j);
    element.start(memory, std::span(motions).first(static_cast<std::size_t>(count)));
  });
}

// Slow loading from the state at rest.
void Stepper::load_elements(const Eigen::VectorXd& rest, const std::function<LinkMotion(int)>& motion_of) {
  visit_elements([&](const Element& element, ElementMemory memory, int spring) {
    std::array<double, max_deformations> to{};
    const int count = element.deformations();
    for (int j = 0; j < count; ++j) to[j] = motion_of(spring + j).penetration;
    const auto size = static_cast<std::size_t>(count);
    element.load(memory, {rest.data() + spring, size}, std::span(to).first(size));
  });
}

bool Stepper::try_step(double h, std::optional<double> end) {
  const Instant& now = history_.now();
  const SupportExcitation& supports = equations_.supports;
  Trial& trial = history_.trial();
  located_.clear();
  trial.h = h;
  trial.end.time = end.value_or(now.time + h);
  supports.accelerations(now.time + 0.5 * h, trial.ground_middle);
  supports.accelerations_at_end(trial.end.time, trial.end.ground);
  if (equations_.links.driven()) {
    supports.relative_motion(now.time + 0.5 * h, trial.ground_middle, trial.by_ground_middle);
    supports.relative_motion(trial.end.time, trial.end.ground, trial.end.by_ground);
  }
  if (equations_.short_motions.any()) equations_.short_motions.follow(now, trial);
  stages_.choose_springs(now, h);
  do {
    if (!solve_trial()) return false;
  } while (stages_.add_springs(trial));
  if (!equations_.links.coupled().empty()) add_path_error(trial);
  trial.error = norm_.ratio(trial, error_, stages_.active());
  troublesome_link_ = norm_.worst_link();
  return std::isfinite(trial.error);
}

// Solves the trial with its active springs.
bool Stepper::solve_trial() {
  const double h = history_.trial().h;
  if (!stages_.begin(scheme_->matrix(h), step_level(h))) return false;
  if (scheme_->try_step(history_.now(), history_.kept().h, history_.trial(), error_)) return true;
  if (stages_.failed_link() >= 0) troublesome_link_ = stages_.failed_link();
  return false;
}

// Coupled elements follow straight paths in the stages, and the path of the step when it is accepted. The difference of
// their forces at the end is an error that the schemes do not estimate.
void Stepper::add_path_error(const Trial& trial) {
  const LinkSet& links = equations_.links;
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(links.size());
  for (const CoupledElement& coupled : links.coupled()) {
    const auto count = static_cast<std::size_t>(coupled.count);
    std::array<LinkStep, max_deformations> steps;
    std::array<LinkMotion, max_deformations> ends;
    for (int j = 0; j < coupled.count; ++j) {
      const int link = coupled.first + j;
      describe(link, history_.now(), trial, steps[j]);
      ends[j] = steps[j].motion_end;
    }
    const ConstElementMemory now = links.memory().elements[coupled.index];
    std::vector<std::byte> memory(now.begin(), now.end());
    coupled.element->accept(memory, std::span(steps).first(count));
    ElementResponse response;
    coupled.element->evaluate(memory, std::span(ends).first(count), response);
    for (int j = 0; j < coupled.count; ++j)
      jump[coupled.first + j] = response.force[j] - trial.end.force[coupled.first + j];
  }
  Eigen::VectorXd change = Eigen::VectorXd::Zero(equations_.solver.size());
  equations_.solver.add_forces(1, jump, change);
  equations_.solver.accelerate(change);
  const auto add = [](const Eigen::VectorXd& more, Eigen::VectorXd& error) {
    error = (more.array().abs() > error.array().abs()).select(more, error);
  };
  add(0.5 * trial.h * change, error_.v);
  add(trial.h * trial.h / 6 * change, error_.u);
}

std::optional<double> Stepper::locate_event(bool at_corners) {
  std::optional<LocatedEvents> found =
      locator_.locate(history_.now(), history_.trial(), at_corners,
                      [this](double h, std::optional<double> end) { return try_step(h, end); });
  if (!found) return std::nullopt;
  located_ = std::move(found->events);
  return found->step;
}

void Stepper::accept() {
  if (equations_.slips.any()) equations_.slips.release(history_.trial().end);
  history_.keep_trial();
  output_.step_accepted();
  LinkSet& links = equations_.links;
  const Instant &x = history_.begin(), &y = history_.now();
  const Trial& kept = history_.kept();
  held_forces_.record_peaks(x, kept);
  described_.with_springs = !kept.springs_stay;
  for (int i = 0; i < links.size(); ++i) {
    LinkStep& step = described_.steps[i];
    if (kept.springs_stay && links.is_spring(i)) {
      links.spring(i).stay(links.of_spring(i), kept.spring_paths(i - links.contacts(), 1));
      continue;
    }
    describe(i, step);
    if (i < links.contacts()) {
      troublesome_link_ = i;  // in case the contact throws
      links.contact(i).accept(links.of_contact(i), step);
      norm_.learn(i, step.motion_end);
    } else if (links.is_spring(i) && !links.is_coupled(i)) {
      links.spring(i).accept(links.of_spring(i), step);
    }
  }
  for (const CoupledElement& element : links.coupled())
    element.element->accept(links.memory().elements[element.index],
                            std::span(described_.steps).subspan(element.first, element.count));
  troublesome_link_ = norm_.worst_link();
  if (equations_.springs.any() && !kept.springs_stay) equations_.ranges.read();
  ledger_.add_step(equations_, x, kept, described_.steps);
  const bool members_reversed =
      equations_.tangents.accept(y.motion.col(Instant::u), part_of_reversal * options_.tolerance);
  norm_.learn(kept);
  bool ground_jumps = false;
  if (y.time >= next_break()) {
    ground_jumps = equations_.supports.jump(y.time, y.ground);
    look_ahead();
  }
  if (members_reversed) equations_.pseudo_force(y.motion.col(Instant::u), history_.change_now().pseudo_force);
  if (!located_.empty())
    apply_located(false);
  else if (ground_jumps || members_reversed)
    balance_now();
  if (!budget_.is_due()) return;
  budget_.audit(energies());
  norm_.allow(budget_.share());
}

void Stepper::apply_event() {
  describe_springs();
  history_.collapse();
  output_.forget();
  apply_located(true);
}

void Stepper::apply_located(bool in_place) {
  contact_events_.apply(located_, in_place, history_.change_now());
  located_.clear();
  balance_now();
}

StepState Stepper::save() {
  Archive written;
  archive(written);
  return {written.bytes()};
}

void Stepper::restore(const StepState& state) {
  Archive read(state.bytes);
  archive(read);
  read.expect_end();
}

void Stepper::archive(Archive& archive) {
  describe_springs();
  history_.archive(archive);
  archive(described_.steps);
  ledger_.archive(archive);
  budget_.archive(archive);
  archive(started_);
  norm_.archive(archive);
  norm_.allow(budget_.share());
  stages_.archive(archive);
  contact_events_.archive(archive);
  equations_.supports.archive(archive);
  archive(longest_step_);
  archive(equations_.links.memory());
  equations_.tangents.archive(archive);
  equations_.ranges.read();
  output_.forget();
}

}  // namespace pounding
