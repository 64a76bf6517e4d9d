#include <pounding/recording/recorder.hpp>

#include <algorithm>
#include <cmath>
#include <span>

#include <pounding/recording/histories.hpp>

namespace pounding {

Recorder::Recorder(const Model& model, const StepView& stepper, Results& results)
    : model_(model),
      stepper_(stepper),
      results_(results),
      plan_(ground_plan(model)),
      response_(model, plan_),
      links_(model, stepper, results.links),
      devices_(model, stepper, results.devices),
      structures_(model, plan_, response_, stepper, results.structures),
      springs_(model, response_, stepper, results.structures),
      step_motion_(response_, stepper),
      floors_(model, response_, results.structures),
      collapse_(model, floors_, results.structures),
      storeys_(model, stepper, results),
      forces_(model, plan_, stepper, results) {
  results_.shakes_y = plan_.supports.front().at_first(1) >= 0;
  results_.shakes_z = plan_.supports.front().at_first(2) >= 0;
}

void Recorder::accelerations_of_ground(double time) {
  ground_.resize(static_cast<int>(plan_.motions.size()));
  for (std::size_t g = 0; g < plan_.motions.size(); ++g)
    ground_[static_cast<int>(g)] = plan_.motions[g].acceleration(time);
}

void Recorder::begin() {
  motion_ = stepper_.outputs().motion;
  accelerations_of_ground(stepper_.time());
  response_.complete(motion_, stepper_.time(), ground_);
  sample(stepper_.time(), false);
  ++outputs_;
  floors_.begin(motion_, stepper_.time());
  storeys_.begin(motion_);
  forces_.begin();
  links_.begin();
  devices_.begin();
  springs_.begin();
  sample_energy();
}

void Recorder::sample(double time, bool inside) {
  results_.time.push_back(time);
  const int along_x = plan_.supports.front().at_first(0);
  results_.ground_acceleration.push_back(along_x < 0 ? 0.0 : ground_[along_x]);
  if (results_.shakes_y) results_.ground_acceleration_y.push_back(ground_[plan_.supports.front().at_first(1)]);
  if (results_.shakes_z) results_.ground_acceleration_z.push_back(ground_[plan_.supports.front().at_first(2)]);
  structures_.sample({time, inside, motion_, ground_});
  devices_.sample(time, inside);
  springs_.sample(time, inside);
}

void Recorder::sample_outputs_until(double end) {
  const double rounding = 1e-12 * std::max(1.0, end);
  for (double time = outputs_ * model_.analysis.output_step; time <= end + rounding;
       time = ++outputs_ * model_.analysis.output_step) {
    // At the end of a step the state just after it is used, because the ground motion, forces and velocities may jump
    // there.
    const bool inside = time < end - rounding;
    accelerations_of_ground(inside ? time : end);
    if (inside)
      stepper_.interpolate_outputs(time, motion_);
    else
      motion_ = stepper_.outputs().motion;
    response_.complete(motion_, time, ground_);
    sample(time, inside);
  }
}

bool Recorder::step() {
  const long before = outputs_;
  sample_outputs_until(stepper_.outputs_end_minus().time);
  const bool output_due = outputs_ > before;
  step_motion_.take();
  floors_.step(step_motion_);
  storeys_.step(step_motion_);
  forces_.step(step_motion_);
  links_.step(output_due);
  devices_.step();
  springs_.step();
  if (output_due) sample_energy();
  return output_due;
}

void Recorder::sample_energy() {
  EnergyHistory& e = results_.energy;
  const Energies now = stepper_.energies();
  const double error = now.imbalance();
  e.time.push_back(stepper_.time());
  e.input.push_back(now.input);
  e.kinetic.push_back(now.kinetic);
  e.strain.push_back(now.strain);
  e.damping.push_back(now.damping);
  e.hysteretic.push_back(now.hysteretic);
  e.impact.push_back(now.impact);
  e.devices.push_back(now.devices);
  e.error.push_back(error);
  max_input_ = std::max(max_input_, std::abs(now.input));
  max_imbalance_ = std::max(max_imbalance_, std::abs(error));
}

void Recorder::end() {
  links_.end();
  storeys_.show();
  forces_.end();
  if (results_.energy.time.empty() || results_.energy.time.back() < stepper_.state().time) sample_energy();
  results_.impacts = impacts_in_order();
}

void Recorder::with_present_state(const std::function<void()>& write) {
  results_.impacts = impacts_in_order();
  links_.show_unfinished();
  storeys_.show();
  forces_.show();
  write();
  links_.hide_unfinished();
}

void Recorder::archive(Archive& archive) {
  archive(outputs_);
  for (StructureHistory& structure : results_.structures) archive(structure.envelope);
  archive(results_.approach);
  step_motion_.archive(archive);
  floors_.archive(archive);
  forces_.archive(archive);
  links_.archive(archive);
  devices_.archive(archive);
  springs_.archive(archive);
  archive(max_input_, max_imbalance_);
  archive_length(archive, tables::of_results, results_, "energy", results_.energy.time);
}

int Recorder::impacts() const {
  std::size_t count = 0;
  for (const ContactMemory& contact : stepper_.memory().contacts) count += contact.impacts().size();
  return static_cast<int>(count);
}

std::vector<ImpactRow> Recorder::impacts_in_order() const {
  std::vector<ImpactRow> all;
  for (const ContactMemory& contact : stepper_.memory().contacts)
    all.insert(all.end(), contact.impacts().begin(), contact.impacts().end());
  std::ranges::stable_sort(all, {}, &ImpactRow::t_start);
  return all;
}

void Recorder::summarize(Summary& summary) const {
  summary.structures.clear();
  summary.links.clear();
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    summary.structures.push_back(floors_.summary(model_.structures[k], static_cast<int>(k)));
    springs_.summarize(static_cast<int>(k), summary.structures.back());
  }
  if (has_links()) {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      const Link& link = model_.links[i];
      LinkSummary& found = summary.links.emplace_back(summary_of(link.name, stepper_.memory().contacts[i].impacts()));
      found.largest_opening = std::max(0.0, links_.openings().max[i]);
      found.t_opening = links_.openings().t_max[i];
      found.seat = link.seat;
    }
    const std::vector<Friction>& frictions = stepper_.system().frictions;
    const std::vector<double> stored = stepper_.friction_stored();
    for (std::size_t f = 0; f < frictions.size(); ++f)
      summary.links[frictions[f].contact].energy_lost += stepper_.friction_work()[f] - stored[f];
  }
  summary.devices = devices_.summary();
  summary.impacts = impacts_in_order();
  const EnergyHistory& e = results_.energy;
  if (e.time.empty()) return;
  summary.energy = {e.input.back(),
                    e.kinetic.back(),
                    e.strain.back(),
                    e.damping.back(),
                    e.hysteretic.back(),
                    e.impact.back(),
                    results_.has_devices() ? e.devices.back() : 0,
                    max_input_ > 0 ? max_imbalance_ / max_input_ : 0};
}

}  // namespace pounding
