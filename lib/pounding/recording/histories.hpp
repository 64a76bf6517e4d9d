#pragma once
/// Link forces inside a step; columns of histories that grow independently of the output times, and their truncation.

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/dense_output.hpp>
#include <pounding/stepping/links/link_set.hpp>

namespace pounding {

/// Link force inside its last accepted step, s from 0 to 1 [N]: the parabola through both ends and the middle.
inline double force_inside(const LinkStep& step, double s) {
  const Parabola parabola(s);
  return parabola.begin * step.force_begin + parabola.middle * step.force_middle + parabola.end * step.force_end;
}

/// Force of a yielding part inside its last accepted step, at a deformation [m], as by Spring::evaluate() [N].
inline double spring_force(const LinkSet& links, int link, const LinkStep& step, double time, double deformation) {
  return links.inside(link, step, (time - step.begin) / (step.end - step.begin), deformation).force;
}

/// Contribution of yielding parts and devices to the shear of a storey that is a spring [N]; `force(part)` is the force
/// of a part [N].
template <class ForceOf>
double shear_by_devices(const Floor& floor, const ForceOf& force) {
  double sum = 0;
  if (!floor.storey_shear_by_yielding.empty())
    for (Row::InnerIterator it(floor.storey_shear_by_yielding.front()); it; ++it)
      sum += it.value() * force(static_cast<std::size_t>(it.index()));
  return sum;
}

inline std::array<std::vector<double>*, 5> columns(LinkHistory& h) {
  return {&h.time, &h.penetration, &h.velocity, &h.force, &h.energy};
}

inline std::array<std::vector<double>*, 9> columns(EnergyHistory& e) {
  return {&e.time, &e.input, &e.kinetic, &e.strain, &e.damping, &e.hysteretic, &e.impact, &e.devices, &e.error};
}

/// Truncates every column of a history to a length.
template <class History>
void cut_columns(History& history, std::size_t length) {
  for (std::vector<double>* values : columns(history)) values->resize(length);
}

/// Writes the length of a history; reading truncates the history to it. Throws std::runtime_error if it is shorter.
template <class History>
void archive_length(Archive& archive, History& history) {
  std::size_t length = history.time.size();
  archive(length);
  if (length > history.time.size()) throw std::runtime_error("a history is shorter than it was");
  cut_columns(history, length);
}

}  // namespace pounding
