#include <pounding/results/spring_history.hpp>

#include <algorithm>

namespace pounding {

void SpringHistory::archive(Archive& archive) {
  archive(deformations);
  archive(forces);
  for (std::vector<double>* values : {&last, &lost, &first_yield, &damping_shear}) archive(*values);
}

void SpringSummary::archive(Archive& archive) {
  archive(name);
  archive(law);
  for (double* value : {&peak, &peak_time, &peak_force, &ductility, &residual, &energy_lost, &first_yield, &damping_shear}) archive(*value);
}

std::vector<SpringSummary> summaries(const SpringHistory& springs) {
  std::vector<SpringSummary> all;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    SpringSummary s{springs.names[i], springs.laws[i]};
    const Extremes& d = springs.deformations;
    if (d.min[i] <= d.max[i]) {
      const bool up = d.max[i] >= -d.min[i];
      s.peak = up ? d.max[i] : d.min[i];
      s.peak_time = up ? d.t_max[i] : d.t_min[i];
      s.peak_force = springs.forces.peak(i);
    }
    s.ductility = d.peak(i) / springs.yield_deformation[i];
    s.residual = springs.last[i];
    s.energy_lost = springs.lost[i];
    s.first_yield = springs.first_yield[i];
    s.damping_shear = springs.damping_shear[i];
    all.push_back(std::move(s));
  }
  return all;
}

const SpringSummary* most_ductile(const std::vector<SpringSummary>& springs) {
  const auto largest = std::ranges::max_element(springs, {}, &SpringSummary::ductility);
  return largest == springs.end() ? nullptr : &*largest;
}

}  // namespace pounding
