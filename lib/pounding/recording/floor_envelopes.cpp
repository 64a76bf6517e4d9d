#include <pounding/recording/floor_envelopes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pounding {
namespace {

using ValueAndSlope = std::pair<double, double>;

// Length of a horizontal vector [m] and its rate of change [m/s]: the velocity along the vector.
ValueAndSlope length_and_slope(double x, double y, double vx, double vy) {
  const double length = std::hypot(x, y);
  return {length, length > 0 ? (x * vx + y * vy) / length : 0.0};
}

// Length and rate for a floor, relative to the floor below if there is one.
ValueAndSlope length_and_slope(const Eigen::MatrixXd& motion, int row, int below) {
  double x = motion(row, 0), y = motion(row + 1, 0), vx = motion(row, 1), vy = motion(row + 1, 1);
  if (below >= 0) {
    x -= motion(below, 0);
    y -= motion(below + 1, 0);
    vx -= motion(below, 1);
    vy -= motion(below + 1, 1);
  }
  return length_and_slope(x, y, vx, vy);
}

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

using Plan = std::array<double, 4>;

// The motion of an edge along itself is that of the floor with its rotation: ux - y rz at y, uy + x rz at x.
ValueAndSlope edge_motion(const Eigen::MatrixXd& motion, int row, const Plan& plan, int edge) {
  const bool along_x = edge < 2;
  const int translation = along_x ? row : row + 1;
  const double arm = along_x ? -plan[edge + 2] : plan[edge - 2];
  return {motion(translation, 0) + arm * motion(row + 2, 0), motion(translation, 1) + arm * motion(row + 2, 1)};
}

// Length of the displacement of a corner of a rigid floor, and its rate.
ValueAndSlope corner_motion(const Eigen::MatrixXd& motion, int row, const Plan& plan, int corner) {
  const auto [x, vx] = edge_motion(motion, row, plan, corner / 2);
  const auto [y, vy] = edge_motion(motion, row, plan, 2 + corner % 2);
  return length_and_slope(x, y, vx, vy);
}

// Displacement and velocity of a row, relative to the floor below if there is one.
ValueAndSlope value_and_slope(const Eigen::MatrixXd& motion, int row, int below) {
  if (below < 0) return {motion(row, 0), motion(row, 1)};
  return {motion(row, 0) - motion(below, 0), motion(row, 1) - motion(below, 1)};
}

// Length of a horizontal vector with these component paths.
struct Lengthwise {
  Quartic x, y;
  double at(double s) const { return std::hypot(x.at(s), y.at(s)); }
  // Upper bound on the length.
  double bound() const {
    const auto largest = [](const Quartic& path) {
      const auto [low, high] = path.bounds();
      return std::max(-low, high);
    };
    return std::hypot(largest(x), largest(y));
  }
};

}  // namespace

FloorEnvelopes::FloorEnvelopes(const Model& model, const FloorResponse& response,
                               std::vector<StructureHistory>& histories)
    : response_(response), histories_(histories), lengths_(model.structures.size()) {
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    const Structure& s = model.structures[k];
    const std::size_t floors = s.floors.size(), directions = response.directions(static_cast<int>(k));
    StructureEnvelope& envelope = histories_[k].envelope;
    envelope.displacement = envelope.acceleration = Extremes(floors * directions);
    if (s.has_storeys()) envelope.drift = Extremes(floors * histories_[k].storey_directions());
    if (directions > 1) lengths_[k] = {Extremes(floors), Extremes(floors), Extremes(floors), {}};
    plans_.emplace_back();
    for (const Floor& floor : s.floors) plans_.back().push_back(floor.plan);
    turns_.push_back(std::ranges::any_of(plans_.back(), [](const auto& plan) { return plan.has_value(); }));
    if (!turns_.back()) continue;
    envelope.edge_displacement = Extremes(floors * envelope.edges.size());
    lengths_[k].corner = Extremes(floors);
    Extremes& edges = envelope.edge_displacement;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (!plans_[k][i / envelope.edges.size()])
        edges.min[i] = edges.max[i] = edges.t_min[i] = edges.t_max[i] = no_value;
  }
}

void FloorEnvelopes::begin(const Eigen::MatrixXd& motion, double time) {
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    const int directions = response_.directions(static_cast<int>(k)),
              storey_directions = histories_[k].storey_directions();
    StructureEnvelope& envelope = histories_[k].envelope;
    for (int i = 0; i < static_cast<int>(histories_[k].floors.size()); ++i) {
      const int first = response_.row(static_cast<int>(k), i, 0);
      for (int j = 0; j < directions; ++j) {
        envelope.displacement.update(i * directions + j, time, motion(first + j, 0));
        envelope.acceleration.update(i * directions + j, time, motion(first + j, 2));
        if (envelope.drift.size() == 0 || j >= storey_directions) continue;
        envelope.drift.update(i * storey_directions + j, time,
                              value_and_slope(motion, first + j, i > 0 ? first + j - directions : -1).first);
      }
      if (directions == 1) continue;
      lengths_[k].displacement.update(i, time, length_and_slope(motion, first, -1).first);
      lengths_[k].drift.update(i, time, length_and_slope(motion, first, i > 0 ? first - directions : -1).first);
      lengths_[k].acceleration.update(i, time, std::hypot(motion(first, 2), motion(first + 1, 2)));
      if (!plans_[k][i]) continue;
      for (int part = 0; part < 4; ++part) {
        envelope.edge_displacement.update(4 * i + part, time, edge_motion(motion, first, *plans_[k][i], part).first);
        lengths_[k].corner.update(i, time, corner_motion(motion, first, *plans_[k][i], part).first);
      }
    }
  }
}

void FloorEnvelopes::step(const StepMotion& step) {
  for (int k = 0; k < static_cast<int>(histories_.size()); ++k) {
    step_along(k, step);
    if (response_.directions(k) > 1) step_in_plan(k, step);
    if (turns_[k]) step_of_edges(k, step);
  }
}

void FloorEnvelopes::step_along(int k, const StepMotion& step) {
  const int directions = response_.directions(k), storey_directions = histories_[k].storey_directions();
  const double time = step.begin_time;
  StructureEnvelope& envelope = histories_[k].envelope;
  for (int i = 0; i < static_cast<int>(histories_[k].floors.size()); ++i)
    for (int j = 0; j < directions; ++j) {
      const int row = response_.row(k, i, j);
      const auto update = [&](Extremes& extremes, int at, int below) {
        const auto [begin, slope_begin] = value_and_slope(step.begin, row, below);
        const auto [end, slope_end] = value_and_slope(step.end_minus, row, below);
        return extremes.update(at, time, step.h, begin, slope_begin, end, slope_end);
      };
      const int at = i * directions + j, storey = i * storey_directions + j;
      const bool moved = update(envelope.displacement, at, -1);
      if (envelope.drift.size() > 0 && j < storey_directions) {
        if (i > 0)
          update(envelope.drift, storey, row - directions);
        else if (moved)  // its drift is the displacement of its floor
          envelope.drift.copy(storey, envelope.displacement, at);
      }
      if (step.presses)
        envelope.acceleration.update(at, time, step.h, step.acceleration(row));
      else if (step.has_middle)
        envelope.acceleration.update(at, time, step.h, step.begin(row, 2), step.middle(row, 0), step.end_minus(row, 2));
      else
        envelope.acceleration.update(at, step.end_time(), step.end_minus(row, 2));
      if (step.jumps) envelope.acceleration.update(at, step.end_time(), step.end_plus(row, 2));
    }
}

void FloorEnvelopes::step_in_plan(int k, const StepMotion& step) {
  const int directions = response_.directions(k);
  const double time = step.begin_time;
  for (int i = 0; i < static_cast<int>(histories_[k].floors.size()); ++i) {
    const int row = response_.row(k, i, 0);
    const auto update = [&](Extremes& extremes, int below) {
      const auto [begin, slope_begin] = length_and_slope(step.begin, row, below);
      const auto [end, slope_end] = length_and_slope(step.end_minus, row, below);
      extremes.update(i, time, step.h, begin, slope_begin, end, slope_end);
    };
    update(lengths_[k].displacement, -1);
    update(lengths_[k].drift, i > 0 ? row - directions : -1);
    const auto length = [row](const Eigen::MatrixXd& motion) { return std::hypot(motion(row, 2), motion(row + 1, 2)); };
    Extremes& acceleration = lengths_[k].acceleration;
    if (step.presses) {
      const Lengthwise path{step.acceleration(row), step.acceleration(row + 1)};
      if (path.bound() > acceleration.max[i]) acceleration.update_by_quarters(i, time, step.h, path);
    } else if (step.has_middle)
      acceleration.update(i, time, step.h, length(step.begin), std::hypot(step.middle(row, 0), step.middle(row + 1, 0)),
                          length(step.end_minus));
    else
      acceleration.update(i, step.end_time(), length(step.end_minus));
    if (step.jumps) acceleration.update(i, step.end_time(), length(step.end_plus));
  }
}

void FloorEnvelopes::step_of_edges(int k, const StepMotion& step) {
  Extremes& edges = histories_[k].envelope.edge_displacement;
  for (int i = 0; i < static_cast<int>(plans_[k].size()); ++i) {
    if (!plans_[k][i]) continue;
    const Plan& plan = *plans_[k][i];
    const int row = response_.row(k, i, 0);
    const auto update = [&](Extremes& extremes, int at, auto motion_of, int part) {
      const auto [begin, slope_begin] = motion_of(step.begin, row, plan, part);
      const auto [end, slope_end] = motion_of(step.end_minus, row, plan, part);
      extremes.update(at, step.begin_time, step.h, begin, slope_begin, end, slope_end);
    };
    for (int part = 0; part < 4; ++part) {
      update(edges, 4 * i + part, edge_motion, part);
      update(lengths_[k].corner, i, corner_motion, part);
    }
  }
}

StructureSummary FloorEnvelopes::summary(const Structure& structure, int k) const {
  const StructureEnvelope& envelope = histories_[k].envelope;
  StructureSummary s{structure.name, {}, {}, {}, histories_[k].directions, {}, {}, envelope};
  const bool in_plan = response_.directions(k) > 1;
  for (std::size_t i = 0; i < structure.floors.size(); ++i) {
    s.peak_displacement.push_back((in_plan ? lengths_[k].displacement : envelope.displacement).peak(i));
    if (structure.has_storeys()) s.peak_drift.push_back(peak_drift(k, static_cast<int>(i)));
    s.peak_acceleration.push_back((in_plan ? lengths_[k].acceleration : envelope.acceleration).peak(i));
    if (!turns_[k]) continue;
    const bool rigid = plans_[k][i].has_value();
    s.peak_rotation.push_back(rigid ? envelope.displacement.peak(3 * i + 2) : no_value);
    s.peak_edge_displacement.push_back(rigid ? lengths_[k].corner.peak(i) : no_value);
  }
  return s;
}

}  // namespace pounding
