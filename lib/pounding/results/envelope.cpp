#include <pounding/results/envelope.hpp>

namespace pounding {

double Extremes::peak(std::size_t i) const { return std::max({0.0, -min[i], max[i]}); }

void Extremes::add_cubic(std::size_t i, double time, double h, double begin, double slope_begin, double end,
                         double slope_end) {
  update(i, time + h, end);
  if (slope_begin * slope_end >= 0) return;
  const double s = slope_begin / (slope_begin - slope_end), r = 1 - s;
  update(i, time + s * h,
         r * r * (1 + 2 * s) * begin + s * s * (1 + 2 * r) * end + h * s * r * (r * slope_begin - s * slope_end));
}

void Extremes::update(std::size_t i, double time, std::span<const double> times, double value, double slope,
                      const double* values, const double* slopes) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    update(i, time, times[k] - time, value, slope, values[k], slopes[k]);
    time = times[k];
    value = values[k];
    slope = slopes[k];
  }
}

void Extremes::add_parabola(std::size_t i, double time, double h, double begin, double middle, double end) {
  update(i, time + 0.5 * h, middle);
  update(i, time + h, end);
  const double slope = end - begin,
               bend = 2 * (begin - 2 * middle + end);  // of the parabola at the midpoint, in s from 0 to 1
  if (std::abs(slope) >= std::abs(bend)) return;
  update(i, time + h * (0.5 - 0.5 * slope / bend), middle - slope * slope / (4 * bend));
}

void Extremes::copy(std::size_t i, const Extremes& others, std::size_t from, double factor) {
  const bool opposite = factor < 0;
  min[i] = factor * (opposite ? others.max : others.min)[from];
  max[i] = factor * (opposite ? others.min : others.max)[from];
  t_min[i] = (opposite ? others.t_max : others.t_min)[from];
  t_max[i] = (opposite ? others.t_min : others.t_max)[from];
}

void StructureEnvelope::archive(Archive& archive) {
  for (Extremes* extremes :
       {&displacement, &edge_displacement, &acceleration, &drift, &storey_shear, &member_force, &reaction})
    archive(*extremes);
  for (std::vector<std::string>* names : {&members, &components, &supports, &directions}) archive(*names);
  archive(with_gravity, included);
}

Extremes section_forces(const StructureEnvelope& envelope) {
  Extremes sections(envelope.member_force.size());
  for (std::size_t i = 0; i < sections.size(); ++i)
    sections.copy(i, envelope.member_force, i,
                  envelope.components[i % envelope.components.size()].starts_with("start") ? -1 : 1);
  return sections;
}

Extremes axial_forces(const StructureEnvelope& envelope) {
  const Extremes sections = section_forces(envelope);
  const std::size_t components = envelope.components.size();
  Extremes axial(sections.size() > 0 ? envelope.members.size() : 0);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!envelope.components[i % components].ends_with(" N")) continue;
    axial.update(i / components, sections.t_min[i], sections.min[i]);
    axial.update(i / components, sections.t_max[i], sections.max[i]);
  }
  return axial;
}

}  // namespace pounding
