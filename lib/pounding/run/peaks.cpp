#include <pounding/run/peaks.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {

void Peak::update(double value) { value_ = std::max(value_, std::abs(value)); }

void Peak::update(double h, double begin, double slope_begin, double end, double slope_end) {
  update(end);
  if (slope_begin * slope_end >= 0) return;
  const double s = slope_begin / (slope_begin - slope_end), r = 1 - s;
  update(r * r * (1 + 2 * s) * begin + s * s * (1 + 2 * r) * end + h * s * r * (r * slope_begin - s * slope_end));
}

void Peak::update(double begin, double middle, double end) {
  update(middle);
  update(end);
  const double slope = end - begin, bend = 2 * (begin - 2 * middle + end);  // of the parabola on [0, 1] at the middle
  if (std::abs(slope) >= std::abs(bend)) return;
  update(middle - slope * slope / (4 * bend));
}

FloorPeaks::FloorPeaks(const Model& model, const FloorResponse& response, const Stepper& stepper)
    : response_(response), stepper_(stepper), looks_inside_(stepper.options().scheme.kind == Scheme::Kind::esdirk4) {
  for (const Structure& s : model.structures) peaks_.emplace_back(s.floors.size());
}

void FloorPeaks::begin(const Eigen::MatrixXd& motion) {
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    const int directions = response_.directions(static_cast<int>(k));
    for (std::size_t i = 0; i < peaks_[k].size(); ++i) {
      double u = 0, a = 0, drift = 0;
      for (int j = 0; j < std::min(2, directions); ++j) {
        const int row = response_.row(static_cast<int>(k), static_cast<int>(i), j);
        const double below = i > 0 ? motion(row - directions, 0) : 0;
        u = std::hypot(u, motion(row, 0));
        a = std::hypot(a, motion(row, 2));
        drift = std::hypot(drift, motion(row, 0) - below);
      }
      peaks_[k][i].displacement.update(u);
      peaks_[k][i].acceleration.update(a);
      peaks_[k][i].drift.update(drift);
    }
  }
}

void FloorPeaks::step() {
  const OutputQuantities &first = stepper_.outputs_begin(), &last = stepper_.outputs_end_minus();
  const double h = last.time - first.time;
  begin_ = first.motion;
  response_.complete(begin_, first.time, stepper_.ground_begin());
  end_minus_ = last.motion;
  response_.complete(end_minus_, last.time, stepper_.ground_end_minus());
  has_middle_ = looks_inside_ && h > 0;
  if (has_middle_) {
    middle_ = stepper_.outputs_middle();
    response_.complete_accelerations(middle_.col(0), stepper_.ground_middle());
  }
  jumps_ = &stepper_.outputs() != &last;
  if (jumps_) {
    end_plus_ = stepper_.outputs().motion;
    response_.complete(end_plus_, last.time, stepper_.ground());
  }
  for (int k = 0; k < static_cast<int>(peaks_.size()); ++k) {
    const int directions = response_.directions(k);
    for (int i = 0; i < static_cast<int>(peaks_[k].size()); ++i) {
      const int row = response_.row(k, i, 0);
      if (directions == 1)
        update_along_x(peaks_[k][i], h, row, i == 0);
      else
        update_in_plan(peaks_[k][i], h, row, i == 0 ? -1 : row - directions);
    }
  }
}

void FloorPeaks::update_along_x(Peaks& peaks, double h, int row, bool lowest) {
  const auto &x = begin_, &y = end_minus_;
  peaks.displacement.update(h, x(row, 0), x(row, 1), y(row, 0), y(row, 1));
  if (has_middle_) peaks.acceleration.update(x(row, 2), middle_(row, 0), y(row, 2));
  peaks.acceleration.update(y(row, 2));
  if (jumps_) peaks.acceleration.update(end_plus_(row, 2));
  if (lowest) {
    peaks.drift.update(h, x(row, 0), x(row, 1), y(row, 0), y(row, 1));
    return;
  }
  const int below = row - 1;
  peaks.drift.update(h, x(row, 0) - x(below, 0), x(row, 1) - x(below, 1), y(row, 0) - y(below, 0), y(row, 1) - y(below, 1));
}

namespace {

// Length of a horizontal vector [m], less that of the floor below where there is one, and its rate of change [m/s]: the
// velocity along the vector.
std::pair<double, double> length_and_slope(const Eigen::MatrixXd& motion, int row, int below) {
  double x = motion(row, 0), y = motion(row + 1, 0), vx = motion(row, 1), vy = motion(row + 1, 1);
  if (below >= 0) {
    x -= motion(below, 0);
    y -= motion(below + 1, 0);
    vx -= motion(below, 1);
    vy -= motion(below + 1, 1);
  }
  const double length = std::hypot(x, y);
  return {length, length > 0 ? (x * vx + y * vy) / length : 0.0};
}

}  // namespace

void FloorPeaks::update_in_plan(Peaks& peaks, double h, int row, int below) {
  const auto update_length = [&](Peak& peak, int from) {
    const auto [begin, slope_begin] = length_and_slope(begin_, row, from);
    const auto [end, slope_end] = length_and_slope(end_minus_, row, from);
    peak.update(h, begin, slope_begin, end, slope_end);
  };
  update_length(peaks.displacement, -1);
  update_length(peaks.drift, below);
  const auto acceleration = [row](const Eigen::MatrixXd& motion) { return std::hypot(motion(row, 2), motion(row + 1, 2)); };
  if (has_middle_)
    peaks.acceleration.update(acceleration(begin_), std::hypot(middle_(row, 0), middle_(row + 1, 0)), acceleration(end_minus_));
  peaks.acceleration.update(acceleration(end_minus_));
  if (jumps_) peaks.acceleration.update(acceleration(end_plus_));
}

StructureSummary FloorPeaks::summary(const Structure& structure, int index) const {
  StructureSummary s{structure.name, {}, {}, {}};
  for (const Peaks& peaks : peaks_[index]) {
    s.peak_displacement.push_back(peaks.displacement.value());
    if (structure.has_storeys()) s.peak_drift.push_back(peaks.drift.value());
    s.peak_acceleration.push_back(peaks.acceleration.value());
  }
  return s;
}

}  // namespace pounding
