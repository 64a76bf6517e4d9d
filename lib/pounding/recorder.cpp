#include <pounding/recorder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {
namespace {

constexpr std::size_t most_samples_of_an_impact = 2048;

// The parabola through the power at both ends and the middle.
double work_of_second_half(const LinkStep& step) {
  const double begin = step.force_begin * step.motion_begin.rate, middle = step.force_middle * step.motion_middle.rate,
               end = step.force_end * step.motion_end.rate;
  return (step.end - step.begin) / 24 * (5 * end + 8 * middle - begin);
}

// The force of a spring at an instant of the last kept step. It follows the deformation rather than time: on each branch
// of a bilinear spring that is exact, however long the step.
double spring_force(const LinkStep& step, double time, double deformation) {
  const bool early = time < 0.5 * (step.begin + step.end);
  const double u0 = early ? step.motion_begin.penetration : step.motion_middle.penetration;
  const double u1 = early ? step.motion_middle.penetration : step.motion_end.penetration;
  const double f0 = early ? step.force_begin : step.force_middle, f1 = early ? step.force_middle : step.force_end;
  return u0 == u1 ? f0 : f0 + (f1 - f0) * std::clamp((deformation - u0) / (u1 - u0), 0.0, 1.0);
}

std::array<std::vector<double>*, 5> columns(LinkHistory& h) {
  return {&h.time, &h.penetration, &h.velocity, &h.force, &h.energy};
}

std::array<std::vector<double>*, 8> columns(EnergyHistory& e) {
  return {&e.time, &e.input, &e.kinetic, &e.strain, &e.damping, &e.hysteretic, &e.impact, &e.error};
}

template <class History>
void archive_length(Archive& archive, History& history) {
  std::size_t length = history.time.size();
  archive(length);
  if (length > history.time.size()) throw std::runtime_error("a history is shorter than it was");
  for (auto* values : columns(history)) values->resize(length);
}

}  // namespace

void Peak::follow(double value) { largest_ = std::max(largest_, std::abs(value)); }

void Peak::follow(double h, double begin, double slope_begin, double end, double slope_end) {
  follow(end);
  if (slope_begin * slope_end >= 0) return;
  const double s = slope_begin / (slope_begin - slope_end), r = 1 - s;
  follow(r * r * (1 + 2 * s) * begin + s * s * (1 + 2 * r) * end + h * s * r * (r * slope_begin - s * slope_end));
}

void LinkSampler::apart(double time, const LinkMotion& motion, double energy, LinkHistory& history) const {
  if (!samples_.empty()) return;
  history.time.push_back(time);
  history.penetration.push_back(motion.penetration);
  history.velocity.push_back(motion.rate);
  history.force.push_back(0);
  history.energy.push_back(energy);
}

void LinkSampler::pressed(double time, const LinkMotion& motion, double force, double energy) {
  last_ = {time, motion.penetration, motion.rate, force, energy};
  // A force that jumps at the touch does so from zero.
  if (samples_.empty()) samples_.push_back({time, motion.penetration, motion.rate, 0, energy});
  if (!samples_.empty() && ++skipped_ < stride_) return;
  skipped_ = 0;
  samples_.push_back(last_);
  if (samples_.size() < most_samples_of_an_impact) return;
  // The first two stay: both sides of a jump at the touch.
  for (std::size_t i = 1; 2 * i - 1 < samples_.size(); ++i) samples_[i] = samples_[2 * i - 1];
  samples_.resize(samples_.size() / 2 + 1);
  stride_ *= 2;
}

void LinkSampler::show(LinkHistory& history) const {
  const auto append = [&](const Sample& s) {
    history.time.push_back(s.time);
    history.penetration.push_back(s.penetration);
    history.velocity.push_back(s.velocity);
    history.force.push_back(s.force);
    history.energy.push_back(s.energy);
  };
  for (const Sample& s : samples_) append(s);
  if (!samples_.empty() && samples_.back().time < last_.time) append(last_);
}

void LinkSampler::finish(LinkHistory& history) {
  show(history);
  samples_.clear();
  stride_ = 1;
  skipped_ = 0;
}

void LinkSampler::archive(Archive& archive) {
  archive(samples_);
  archive(last_);
  archive(stride_);
  archive(skipped_);
}

Recorder::Recorder(const Model& model, const Stepper& stepper, Results& results)
    : model_(model), stepper_(stepper), results_(results), first_(offsets(model)), linked_(stepper.system().contact_count() > 0) {
  for (const Structure& s : model.structures) {
    results_.structures.push_back({s.name, s.floors, {}, {}, {}, {}, {}});
    peaks_.emplace_back(s.size());
  }
  if (!linked_) return;
  for (const Link& link : model.links) {
    LinkHistory history;
    history.name = link.name;
    history.gap = link.gap;
    history.law = link.law;
    history.left = {model.structures[link.left].name, link.left_floor + 1};
    history.right = {model.structures[link.right].name, link.right_floor + 1};
    results_.links.push_back(std::move(history));
  }
  samplers_.resize(model.links.size());
}

void Recorder::begin() {
  const State& now = stepper_.state();
  sample(now.time, now.u, now.v, now.a, model_.ground.acceleration(now.time));
  ++outputs_;
  for (std::size_t k = 0; k < peaks_.size(); ++k)
    for (int i = 0; i < model_.structures[k].size(); ++i) {
      FloorPeaks& peaks = peaks_[k][i];
      const int dof = first_[k] + i;
      peaks.displacement.follow(now.u[dof]);
      peaks.drift.follow(now.u[dof] - (i > 0 ? now.u[dof - 1] : 0));
      peaks.acceleration.follow(now.a[dof] + model_.ground.acceleration(now.time));
    }
  sample_energy();
}

void Recorder::sample(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                      double ground) {
  results_.time.push_back(time);
  results_.ground_acceleration.push_back(ground);
  const bool inside = time < stepper_.time();
  std::size_t spring = 0;
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    StructureHistory& history = results_.structures[k];
    for (int i = 0; i < s.size(); ++i) {
      const int dof = first_[k] + i;
      const double drift = u[dof] - (i > 0 ? u[dof - 1] : 0);
      history.displacement.push_back(u[dof]);
      history.velocity.push_back(v[dof]);
      history.acceleration.push_back(a[dof] + ground);
      if (s.storey_stiffness.empty()) continue;
      history.drift.push_back(drift);
      double shear = s.storey_stiffness[i] * drift;
      if (!s.yielding.empty()) {
        const LinkStep& step = stepper_.link_steps()[stepper_.system().contact_count() + spring++];
        shear += inside ? spring_force(step, time, drift) : s.yielding[i].spring->evaluate({.penetration = drift}).force;
      }
      history.storey_shear.push_back(shear);
    }
  }
}

void Recorder::step() {
  const double end = stepper_.arrived().time;
  const double rounding = 1e-12 * std::max(1.0, end);
  for (double time = outputs_ * model_.analysis.output_step; time <= end + rounding;
       time = ++outputs_ * model_.analysis.output_step) {
    energy_due_ = true;
    if (time >= end - rounding) {  // just after what happens there: jumps of the ground, of a force, of a velocity
      const State& now = stepper_.state();
      sample(time, now.u, now.v, now.a, model_.ground.acceleration(end));
      continue;
    }
    stepper_.interpolate(time, u_, v_);
    stepper_.interpolate_acceleration(time, a_);
    sample(time, u_, v_, a_, model_.ground.acceleration(time));
  }
  follow_peaks();
  if (linked_) sample_links();
  if (energy_due_) sample_energy();
  energy_due_ = false;
}

void Recorder::follow_peaks() {
  const State &begin = stepper_.before(), &end = stepper_.arrived(), &now = stepper_.state();
  const double h = end.time - begin.time;
  const double ground = stepper_.ground_before()[0];
  for (std::size_t k = 0; k < peaks_.size(); ++k)
    for (std::size_t i = 0; i < peaks_[k].size(); ++i) {
      FloorPeaks& peaks = peaks_[k][i];
      const int dof = first_[k] + static_cast<int>(i);
      peaks.displacement.follow(h, begin.u[dof], begin.v[dof], end.u[dof], end.v[dof]);
      peaks.acceleration.follow(end.a[dof] + ground);
      peaks.acceleration.follow(now.a[dof] + ground);
      if (i == 0)
        peaks.drift.follow(h, begin.u[dof], begin.v[dof], end.u[dof], end.v[dof]);
      else
        peaks.drift.follow(h, begin.u[dof] - begin.u[dof - 1], begin.v[dof] - begin.v[dof - 1],
                           end.u[dof] - end.u[dof - 1], end.v[dof] - end.v[dof - 1]);
    }
}

void Recorder::sample_links() {
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    const Contact& contact = *model_.links[i].contact;
    const LinkStep& step = stepper_.link_steps()[i];
    const auto rows = contact.impacts();
    const bool begun = !rows.empty();
    const bool presses = begun && std::isnan(rows.back().t_end);
    const bool ends_here = begun && !presses && rows.back().t_end >= step.end;
    LinkSampler& sampler = samplers_[i];
    if (presses || ends_here) {
      if (step.force_middle != 0) sampler.pressed(0.5 * (step.begin + step.end), step.motion_middle, step.force_middle,
                                                  contact.work() - work_of_second_half(step));
      const double force = presses ? stepper_.state().force[i] : step.force_end;
      sampler.pressed(step.end, step.motion_end, force, contact.work());
    }
    if (!presses) sampler.finish(results_.links[i]);
    if (ends_here) sampler.apart(step.end, step.motion_end, contact.work(), results_.links[i]);
    if (!presses && !ends_here && energy_due_) sampler.apart(step.end, step.motion_end, contact.work(), results_.links[i]);
  }
}

void Recorder::sample_energy() {
  EnergyHistory& e = results_.energy;
  const Energies now = stepper_.energies();
  const double error = now.input - (now.kinetic + now.strain + now.damping + now.hysteretic + now.impact);
  e.time.push_back(stepper_.time());
  e.input.push_back(now.input);
  e.kinetic.push_back(now.kinetic);
  e.strain.push_back(now.strain);
  e.damping.push_back(now.damping);
  e.hysteretic.push_back(now.hysteretic);
  e.impact.push_back(now.impact);
  e.error.push_back(error);
  largest_input_ = std::max(largest_input_, std::abs(now.input));
  largest_imbalance_ = std::max(largest_imbalance_, std::abs(error));
}

void Recorder::end() {
  if (linked_)
    for (std::size_t i = 0; i < samplers_.size(); ++i) samplers_[i].finish(results_.links[i]);
  if (results_.energy.time.empty() || results_.energy.time.back() < stepper_.state().time) sample_energy();
  collect_impacts();
}

void Recorder::with_present_state(const std::function<void()>& write) {
  collect_impacts();
  std::vector<std::size_t> finished;
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    finished.push_back(results_.links[i].time.size());
    samplers_[i].show(results_.links[i]);
  }
  write();
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    LinkHistory& history = results_.links[i];
    for (auto* values : columns(history)) values->resize(finished[i]);
  }
}

void Recorder::archive(Archive& archive) {
  archive(outputs_);
  archive(peaks_);
  archive(samplers_);
  archive(largest_input_);
  archive(largest_imbalance_);
  for (LinkHistory& history : results_.links) archive_length(archive, history);
  archive_length(archive, results_.energy);
}

int Recorder::impacts() const {
  std::size_t count = 0;
  if (linked_)
    for (const Link& link : model_.links) count += link.contact->impacts().size();
  return static_cast<int>(count);
}

void Recorder::collect_impacts() {
  results_.impacts.clear();
  if (!linked_) return;
  for (const Link& link : model_.links) {
    const auto rows = link.contact->impacts();
    results_.impacts.insert(results_.impacts.end(), rows.begin(), rows.end());
  }
  std::stable_sort(results_.impacts.begin(), results_.impacts.end(),
                   [](const ImpactRow& a, const ImpactRow& b) { return a.t_start < b.t_start; });
}

void Recorder::summarize(Summary& summary) const {
  summary.structures.clear();
  summary.links.clear();
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    StructureSummary s{model_.structures[k].name, {}, {}, {}};
    for (const FloorPeaks& peaks : peaks_[k]) {
      s.peak_displacement.push_back(peaks.displacement.largest());
      if (!model_.structures[k].storey_stiffness.empty()) s.peak_drift.push_back(peaks.drift.largest());
      s.peak_acceleration.push_back(peaks.acceleration.largest());
    }
    summary.structures.push_back(std::move(s));
  }
  if (linked_)
    for (const Link& link : model_.links) {
      LinkSummary s;
      s.name = link.name;
      if (!link.contact->impacts().empty()) s.peak_force = std::numeric_limits<double>::quiet_NaN();  // until a finite one
      for (const ImpactRow& row : link.contact->impacts()) {
        ++s.impacts;
        s.peak_force = std::fmax(s.peak_force, row.peak_force);
        s.peak_penetration = std::max(s.peak_penetration, row.peak_penetration);
        s.impulse += row.impulse;
        s.energy_lost += row.energy_lost;
      }
      summary.links.push_back(std::move(s));
    }
  const EnergyHistory& e = results_.energy;
  if (e.time.empty()) return;
  summary.energy = {e.input.back(),  e.kinetic.back(), e.strain.back(),
                    e.damping.back(), e.hysteretic.back(), e.impact.back(),
                    largest_input_ > 0 ? largest_imbalance_ / largest_input_ : 0};
}

}  // namespace pounding
