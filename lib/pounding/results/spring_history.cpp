#include <pounding/results/spring_history.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {

// Multiplied by the sign of the swing, the deformation increases in swings of both directions.
void CycleCounts::follow(std::size_t part, double deformation, const YieldLimits& limits) {
  double& count = swings[part];
  if (count == 0) {
    if (!limits.exceeded_by(deformation)) return;
    count = std::copysign(1.0, deformation);
    turn[part] = deformation;
    return;
  }
  const double way = std::copysign(1.0, count), on = way * (deformation - turn[part]);
  const bool turns = on < -(limits.positive + limits.negative);
  if (turns) count = -(count + way);
  if (on > 0 || turns) turn[part] = deformation;
}

void CycleCounts::archive(Archive& archive) { archive(turn, swings); }

void SpringHistory::archive(Archive& archive) {
  archive(deformations, forces, resultants);
  for (std::vector<double>* values : {&last, &lost, &first_yield, &damping_shear, &plastic}) archive(*values);
  archive(cycles);
}

void SpringSummary::archive(Archive& archive) {
  archive(name, law, is_hinge);
  for (double* value : {&peak, &peak_time, &peak_force, &resultant, &resultant_time, &ductility, &plastic, &ultimate,
                        &cycles, &residual, &energy_lost, &first_yield, &damping_shear})
    archive(*value);
}

std::vector<SpringSummary> summaries(const SpringHistory& springs) {
  std::vector<SpringSummary> all;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    SpringSummary s{.name = springs.names[i], .law = springs.laws[i], .is_hinge = springs.hinges[i]};
    const Extremes& d = springs.deformations;
    if (d.min[i] <= d.max[i]) {
      const bool up = d.max[i] >= -d.min[i];
      s.peak = up ? d.max[i] : d.min[i];
      s.peak_time = up ? d.t_max[i] : d.t_min[i];
      s.peak_force = springs.forces.peak(i);
    }
    s.resultant = std::abs(s.peak);
    s.resultant_time = s.peak_time;
    s.ductility = springs.limits[i].ductility({d.min[i], d.max[i]}, {springs.forces.min[i], springs.forces.max[i]});
    if (const double largest = springs.resultants.max[i]; largest > 0) {
      s.resultant = largest;
      s.resultant_time = springs.resultants.t_max[i];
      s.ductility = largest / springs.limits[i].positive;
    }
    s.plastic = springs.plastic[i];
    s.ultimate = springs.ultimate[i];
    s.cycles = springs.cycles.cycles(i);
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
