#include <pounding/links/impact_log.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Below this closing speed bodies come into contact practically at rest, and a restitution has no meaning.
constexpr double min_closing_speed = 1e-9;  // m/s

double restitution(double approach, double separation) {
  return approach > min_closing_speed ? separation / approach : unknown;
}

}  // namespace

void ImpactLog::begin(double time, double closing_speed) {
  ImpactRow row;
  row.link = link_;
  row.t_start = time;
  row.t_end = row.t_release = row.v_separation = row.restitution = unknown;
  row.v_approach = closing_speed;
  row.t_peak = time;
  rows_.push_back(row);
  work_of_impact_ = 0;
  open_ = true;
}

// The force at the beginning is a sample as well: some laws jump at touch.
void ImpactLog::add(const LinkStep& step) {
  ImpactRow& row = rows_.back();
  const double h = step.end - step.begin;
  const double impulse = h / 6 * (step.force_begin + 4 * step.force_middle + step.force_end);
  const double work = h / 6 *
                      (step.force_begin * step.motion_begin.rate + 4 * step.force_middle * step.motion_middle.rate +
                       step.force_end * step.motion_end.rate);
  row.impulse += impulse;
  work_of_impact_ += work;
  work_ += work;
  store(row.energy_stored);
  row.peak_penetration = std::max({row.peak_penetration, step.motion_begin.penetration, step.motion_end.penetration});
  record_peak(step.begin, step.force_begin);
  record_peak(step.end, step.force_end);
}

void ImpactLog::record_peak(double time, double force) {
  ImpactRow& row = rows_.back();
  if (!(force > row.peak_force)) return;
  row.peak_force = force;
  row.t_peak = time;
}

void ImpactLog::release(double time) {
  rows_.back().t_release = time;
  store(0);
}

void ImpactLog::engage() { rows_.back().t_release = unknown; }

void ImpactLog::end(double time, double rate) {
  ImpactRow& row = rows_.back();
  row.t_end = time;
  if (std::isnan(row.t_release)) row.t_release = time;
  if (row.peak_force == 0 && row.impulse > 0) row.peak_force = unknown;  // an impulse without duration
  row.v_separation = -rate;
  row.restitution = restitution(row.v_approach, -rate);
  store(0);
  open_ = false;
}

void ImpactLog::push(double impulse, double work) {
  ImpactRow& row = rows_.back();
  row.impulse += impulse;
  work_of_impact_ += work;
  work_ += work;
  store(row.energy_stored);
}

void ImpactLog::store(double energy) {
  ImpactRow& row = rows_.back();
  row.energy_stored = energy;
  row.energy_lost = work_of_impact_ - energy;
}

void ImpactLog::archive(Archive& archive) { archive(open_, rows_, work_, work_of_impact_); }

}  // namespace pounding
