// Accepted states of a fibre member: stages, reversals, energies.

#include <pounding/frames/fibre_member.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

#include <pounding/laws/checks.hpp>

namespace pounding {

void FibreMember::Iterate::archive(Archive& archive) {
  for (auto* const values : {&forces, &deformations, &residual}) archive.raw(values->data(), sizeof *values);
  archive.raw(stiffness.data(), sizeof stiffness);
  archive(change, slow);
  for (Section& section : sections) {
    archive(section.deformation, section.change, section.residual);
    archive.raw(section.flexibility.data(), sizeof section.flexibility);
  }
}

void FibreMember::State::archive(Archive& archive) {
  for (sections::FibreStates& states : fibres)
    for (auto& lanes : states) std::visit([&](auto& of_material) { of_material.archive(archive); }, lanes);
  archive(deformations, forces, basic_deformations, work, largest_strain);
}

FibreMember::State FibreMember::undeformed() const {
  State state;
  state.fibres.assign(shapes_.size(), section_->states());
  state.deformations.resize(shapes_.size());
  return state;
}

void FibreMember::record_stage(Iterate& iterate, double time) const {
  if (!(time > 0)) laws::refuse("time of a stage since the beginning of its step", time, "positive");
  iterate.change = 0, iterate.slow = 0;
  iterate.times.push_back(time);
  for (const auto& section : iterate.sections) iterate.stages.push_back(section.deformation);
}

bool FibreMember::accept(State& state, const Iterate& iterate, double min_reversal) const {
  const std::size_t stages = iterate.times.size();
  std::vector<std::size_t> order(stages);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return iterate.times[i]; });
  std::vector<double> times{0};
  for (const std::size_t i : order) times.push_back(iterate.times[i]);
  std::vector<sections::Deformation> samples(stages + 1);
  const auto& [low, high] = section_->extent();
  bool any = false;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const sections::Deformation& end = iterate.sections[k].deformation;
    sections::FibreStates& fibres = state.fibres[k];
    if (stages >= 2) {
      samples.front() = state.deformations[k];
      for (std::size_t i = 0; i < stages; ++i) samples[i + 1] = iterate.stages[order[i] * shapes_.size() + k];
      samples.back() = end;
      const sections::Accepted accepted = section_->accept(fibres, {times, samples}, min_reversal);
      any = any || accepted.reversed;
      state.work += weights_[k] * accepted.work;
    } else {
      state.work += weights_[k] * section_->work(fibres, end);
      section_->accept(fibres, end);
    }
    for (const double y : {low.y, high.y})
      for (const double z : {low.z, high.z})
        state.largest_strain = std::max(state.largest_strain, std::abs(end[0] + z * end[1] - y * end[2]));
    state.deformations[k] = end;
  }
  Eigen::Map<Iterate::Vector6>(state.forces.data()) = iterate.forces;
  Eigen::Map<Iterate::Vector6>(state.basic_deformations.data()) = iterate.deformations;
  return any;
}

double FibreMember::stored(const State& state) const {
  const Eigen::Map<const Iterate::Vector6> q(state.forces.data());
  double sum = 0.5 * q.dot(elastic_flexibility_ * q);
  for (std::size_t k = 0; k < shapes_.size(); ++k) sum += weights_[k] * section_->stored(state.fibres[k]);
  return sum;
}

double FibreMember::dissipated(const State& state, double stored) const {
  const Eigen::Map<const Iterate::Vector6> q(state.forces.data());
  return state.work + 0.5 * q.dot(elastic_flexibility_ * q) - stored;
}

}  // namespace pounding
