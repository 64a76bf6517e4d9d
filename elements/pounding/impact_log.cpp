#include <pounding/impact_log.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Slower touches have no restitution worth the name: bodies that lean on each other from rest.
constexpr double slowest_impact = 1e-9;  // m/s

double restitution(double approach, double separation) {
  return approach > slowest_impact ? separation / approach : unknown;
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
  open_ = true;
  known_ = 0;
}

// A force that jumps at the touch has its value there as a first sample.
void ImpactLog::add(const LinkStep& step) {
  ImpactRow& row = rows_.back();
  const double h = step.end - step.begin;
  const double impulse = h / 6 * (step.force_begin + 4 * step.force_middle + step.force_end);
  const double work = h / 6 * (step.force_begin * step.motion_begin.rate + 4 * step.force_middle * step.motion_middle.rate +
                               step.force_end * step.motion_end.rate);
  row.impulse += impulse;
  row.energy_lost += work;
  work_ += work;
  row.peak_penetration = std::max({row.peak_penetration, step.motion_begin.penetration, step.motion_end.penetration});
  if (known_ == 0) follow_peak(step.begin, step.force_begin);
  follow_peak(step.end, step.force_end);
}

void ImpactLog::follow_peak(double time, double force) {
  ImpactRow& row = rows_.back();
  if (force > row.peak_force) {
    row.peak_force = force;
    row.t_peak = time;
  }
  for (int k = 0; k < 2; ++k) {
    times_[k] = times_[k + 1];
    forces_[k] = forces_[k + 1];
  }
  times_[2] = time;
  forces_[2] = force;
  if (++known_ < 3 || !(forces_[1] > forces_[0] && forces_[1] > forces_[2])) return;
  const double left = times_[1] - times_[0], right = times_[2] - times_[1];
  const double slope_left = (forces_[1] - forces_[0]) / left, slope_right = (forces_[2] - forces_[1]) / right;
  const double curvature = (slope_right - slope_left) / (left + right);
  const double slope = (slope_left * right + slope_right * left) / (left + right);
  // A kink is no parabola: at the reversal of an approach-only damper the peak is a kept state already.
  const bool smooth = std::abs(slope_left + slope_right) < 0.9 * (slope_left - slope_right) && left < 4 * right &&
                      right < 4 * left;
  if (!smooth) return;
  const double top = forces_[1] - slope * slope / (4 * curvature);
  if (top <= row.peak_force) return;
  row.peak_force = top;
  row.t_peak = times_[1] - slope / (2 * curvature);
}

void ImpactLog::release(double time) { rows_.back().t_release = time; }

void ImpactLog::engage() { rows_.back().t_release = unknown; }

void ImpactLog::end(double time, double rate) {
  ImpactRow& row = rows_.back();
  row.t_end = time;
  if (std::isnan(row.t_release)) row.t_release = time;
  if (row.peak_force == 0 && row.impulse > 0) row.peak_force = unknown;  // an impulse without duration
  row.v_separation = -rate;
  row.restitution = restitution(row.v_approach, -rate);
  open_ = false;
}

void ImpactLog::push(double impulse, double rate_before, double rate_after) {
  ImpactRow& row = rows_.back();
  const double work = 0.5 * impulse * (rate_before + rate_after);
  row.impulse += impulse;
  row.energy_lost += work;
  work_ += work;
}

void ImpactLog::archive(Archive& archive) {
  archive(open_);
  archive(rows_);
  archive(work_);
  archive(times_);
  archive(forces_);
  archive(known_);
}

}  // namespace pounding
