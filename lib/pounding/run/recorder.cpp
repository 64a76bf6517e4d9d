#include <pounding/run/recorder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {
namespace {

constexpr std::size_t max_samples_of_an_impact = 2048;

// The parabola through the power at both ends and the middle.
double work_of_second_half(const LinkStep& step) {
  const double begin = step.force_begin * step.motion_begin.rate, middle = step.force_middle * step.motion_middle.rate,
               end = step.force_end * step.motion_end.rate;
  return (step.end - step.begin) / 24 * (5 * end + 8 * middle - begin);
}

// The force of a spring at an instant of the last kept step. It follows the deformation rather than time: on each branch
// of a bilinear spring that is exact, however long the step.
double spring_force(const LinkStep& step, double time, double deformation) {
  const bool early = time < 0.5 * (step.begin + step.end);
  const double u0 = early ? step.motion_begin.penetration : step.motion_middle.penetration;
  const double u1 = early ? step.motion_middle.penetration : step.motion_end.penetration;
  const double f0 = early ? step.force_begin : step.force_middle, f1 = early ? step.force_middle : step.force_end;
  return u0 == u1 ? f0 : f0 + (f1 - f0) * std::clamp((deformation - u0) / (u1 - u0), 0.0, 1.0);
}

double link_force(const LinkStep& step, double time) {
  const double s = std::clamp((time - step.begin) / (step.end - step.begin), 0.0, 1.0);
  return (1 - s) * (1 - 2 * s) * step.force_begin + 4 * s * (1 - s) * step.force_middle + s * (2 * s - 1) * step.force_end;
}

std::array<std::vector<double>*, 5> columns(LinkHistory& h) {
  return {&h.time, &h.penetration, &h.velocity, &h.force, &h.energy};
}

std::array<std::vector<double>*, 8> columns(EnergyHistory& e) {
  return {&e.time, &e.input, &e.kinetic, &e.strain, &e.damping, &e.hysteretic, &e.impact, &e.error};
}

template <class History>
void archive_length(Archive& archive, History& history) {
  std::size_t length = history.time.size();
  archive(length);
  if (length > history.time.size()) throw std::runtime_error("a history is shorter than it was");
  for (auto* values : columns(history)) values->resize(length);
}

}  // namespace

void Peak::follow(double value) { largest_ = std::max(largest_, std::abs(value)); }

void Peak::follow(double h, double begin, double slope_begin, double end, double slope_end) {
  follow(end);
  if (slope_begin * slope_end >= 0) return;
  const double s = slope_begin / (slope_begin - slope_end), r = 1 - s;
  follow(r * r * (1 + 2 * s) * begin + s * s * (1 + 2 * r) * end + h * s * r * (r * slope_begin - s * slope_end));
}

void Peak::follow(double begin, double middle, double end) {
  follow(middle);
  follow(end);
  const double slope = end - begin, bend = 2 * (begin - 2 * middle + end);  // of the parabola on [0, 1] at the middle
  if (std::abs(slope) >= std::abs(bend)) return;
  follow(middle - slope * slope / (4 * bend));
}

void LinkSampler::append(const Sample& s, LinkHistory& history) {
  history.time.push_back(s.time);
  history.penetration.push_back(s.penetration);
  history.velocity.push_back(s.velocity);
  history.force.push_back(s.force);
  history.energy.push_back(s.energy);
  history.friction.insert(history.friction.end(), s.friction.begin(), s.friction.begin() + history.tangents);
}

void LinkSampler::apart(double time, const LinkMotion& motion, double energy, LinkHistory& history) const {
  if (samples_.empty()) append({time, motion.penetration, motion.rate, 0, energy, {}}, history);
}

void LinkSampler::pressed(double time, const LinkMotion& motion, double force, const Friction& friction, double energy) {
  last_ = {time, motion.penetration, motion.rate, force, energy, friction};
  // A force that jumps at the touch does so from zero.
  if (samples_.empty()) samples_.push_back({time, motion.penetration, motion.rate, 0, energy, {}});
  if (!samples_.empty() && ++skipped_ < stride_) return;
  skipped_ = 0;
  samples_.push_back(last_);
  if (samples_.size() < max_samples_of_an_impact) return;
  // The first two stay: both sides of a jump at the touch.
  for (std::size_t i = 1; 2 * i - 1 < samples_.size(); ++i) samples_[i] = samples_[2 * i - 1];
  samples_.resize(samples_.size() / 2 + 1);
  stride_ *= 2;
}

void LinkSampler::show(LinkHistory& history) const {
  for (const Sample& s : samples_) append(s, history);
  if (!samples_.empty() && samples_.back().time < last_.time) append(last_, history);
}

void LinkSampler::finish(LinkHistory& history) {
  show(history);
  samples_.clear();
  stride_ = 1;
  skipped_ = 0;
}

void LinkSampler::archive(Archive& archive) {
  archive(samples_);
  archive(last_);
  archive(stride_);
  archive(skipped_);
}

namespace {

StructureHistory heading(const Structure& s) {
  StructureHistory history;
  history.name = s.name;
  history.kind = s.kind;
  history.dimension = s.is_rigid() ? 1 : s.dimension;
  for (const Floor& floor : s.floors) {
    history.floors.push_back(floor.label);
    history.elevations.push_back(floor.elevation.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (history.dimension == 3) history.directions = {"x", "y", "rz"};
  history.nodes = s.nodes.names;
  history.node_directions = s.nodes.directions;
  history.members = s.members.names;
  history.member_components = s.members.components;
  history.geometry = s.geometry;
  return history;
}

LinkHistory heading(const Link& link, const Model& model) {
  LinkHistory history;
  history.name = link.name;
  history.gap = link.gap;
  history.law = link.law;
  history.left = {model.structures[link.left.structure].name, link.left.floor + 1, link.left.label};
  history.right = {model.structures[link.right.structure].name, link.right.floor + 1, link.right.label};
  for (int i = 0; i < 3; ++i) {
    history.position[i] = link.left.point.position[i];
    history.direction[i] = link.direction[i];
  }
  return history;
}

}  // namespace

Recorder::Recorder(const Model& model, const Stepper& stepper, Results& results)
    : model_(model),
      stepper_(stepper),
      results_(results),
      followed_(model),
      plan_(ground_plan(model)),
      first_(offsets(model)),
      looks_inside_(stepper.options().scheme.kind == Scheme::Kind::esdirk4),
      linked_(stepper.system().contact_count() > 0) {
  for (const Structure& s : model.structures) {
    results_.structures.push_back(heading(s));
    peaks_.emplace_back(s.floors.size());
    whole_ = whole_ || !s.nodes.motion.empty() || !s.members.forces.empty() || (s.has_storeys() && s.storey_stiffness.empty());
  }
  if (!linked_) return;
  for (const Link& link : model.links) results_.links.push_back(heading(link, model));
  for (const Friction& friction : stepper.system().frictions) results_.links[friction.contact].tangents = friction.count;
  samplers_.resize(model.links.size());
}

void Recorder::accelerations_of_ground(double time, Eigen::VectorXd& ground) const {
  ground.resize(static_cast<int>(plan_.motions.size()));
  for (std::size_t g = 0; g < plan_.motions.size(); ++g) ground[static_cast<int>(g)] = plan_.motions[g].acceleration(time);
}

void Recorder::begin() {
  motion_ = stepper_.outputs().motion;
  accelerations_of_ground(stepper_.time(), ground_);
  followed_.complete(motion_, stepper_.time(), ground_);
  sample(stepper_.time(), motion_, ground_, true);
  ++outputs_;
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    const int directions = std::min(2, followed_.directions(static_cast<int>(k)));
    for (std::size_t i = 0; i < peaks_[k].size(); ++i) {
      double u = 0, a = 0, drift = 0;
      for (int j = 0; j < directions; ++j) {
        const int c = followed_.column(static_cast<int>(k), static_cast<int>(i), j);
        const double below = i > 0 ? motion_(c - followed_.directions(static_cast<int>(k)), 0) : 0;
        u = std::hypot(u, motion_(c, 0));
        a = std::hypot(a, motion_(c, 2));
        drift = std::hypot(drift, motion_(c, 0) - below);
      }
      peaks_[k][i].displacement.follow(u);
      peaks_[k][i].acceleration.follow(a);
      peaks_[k][i].drift.follow(drift);
    }
  }
  sample_energy();
}

void Recorder::sample(double time, const Eigen::MatrixXd& motion, const Eigen::VectorXd& ground, bool at_end) {
  results_.time.push_back(time);
  const int along_x = plan_.under.front().front()[0];
  results_.ground_acceleration.push_back(along_x < 0 ? 0.0 : ground[along_x]);
  const bool inside = !at_end;
  for (std::size_t k = 0; k < model_.structures.size(); ++k) sample_structure(static_cast<int>(k), motion, inside, time);
  if (whole_) sample_whole(time, inside);
}

void Recorder::sample_structure(int k, const Eigen::MatrixXd& motion, bool inside, double time) {
  const Structure& s = model_.structures[k];
  StructureHistory& history = results_.structures[k];
  const int directions = followed_.directions(k);
  std::size_t spring = 0;
  for (int earlier = 0; earlier < k; ++earlier) spring += model_.structures[earlier].yielding.size();
  for (int i = 0; i < static_cast<int>(s.floors.size()); ++i)
    for (int j = 0; j < directions; ++j) {
      const int c = followed_.column(k, i, j);
      history.displacement.push_back(motion(c, 0));
      history.velocity.push_back(motion(c, 1));
      history.acceleration.push_back(motion(c, 2));
      if (!s.has_storeys() || j > 1) continue;
      const double drift = motion(c, 0) - (i > 0 ? motion(c - directions, 0) : 0);
      history.drift.push_back(drift);
      if (s.storey_stiffness.empty()) continue;
      double shear = s.storey_stiffness[i] * drift;
      if (!s.yielding.empty()) {
        const LinkStep& step = stepper_.link_steps()[stepper_.system().contact_count() + spring++];
        shear += inside ? spring_force(step, time, drift) : s.yielding[i].spring->evaluate({.penetration = drift}).force;
      }
      history.storey_shear.push_back(shear);
    }
}

namespace {

// Rows of one structure on a vector of all unknowns, or on one of its own.
double value(const Row& row, const Eigen::VectorXd& all, int first) {
  double sum = 0;
  for (Row::InnerIterator it(row); it; ++it) sum += it.value() * all[first + it.index()];
  return sum;
}

void add(const Eigen::VectorXd& more, std::vector<double>& values, std::size_t from) {
  for (Eigen::Index i = 0; i < more.size(); ++i) values[from + i] += more[i];
}

}  // namespace

// Quantities that need every unknown.
void Recorder::sample_whole(double time, bool inside) {
  if (inside) {
    stepper_.interpolate(time, u_, v_);
    stepper_.interpolate_acceleration(time, a_);
  } else {
    const State& now = stepper_.state();
    u_ = now.u;
    v_ = now.v;
    a_ = now.a;
  }
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    if (s.dimension == 1) continue;
    StructureHistory& history = results_.structures[k];
    Eigen::VectorXd u = u_.segment(first_[k], s.size()), v = v_.segment(first_[k], s.size()), a = a_.segment(first_[k], s.size());
    if (s.at_rest.size() > 0) u += s.at_rest;
    // Relative to the ground at the first support, and from there to the accelerations in space.
    const std::vector<std::array<int, 3>>& under = plan_.under[k];
    for (std::size_t q = 1; q < s.supports.size(); ++q)
      for (int axis = 0; axis < 3; ++axis)
        for (const auto& [ground, sign] : {std::pair(under[q][axis], 1.0), std::pair(under.front()[axis], -1.0)}) {
          if (ground < 0) continue;
          const auto part = sign * s.supports[q].influence.col(axis);
          u += plan_.motions[ground].displacement(time) * part;
          v += plan_.motions[ground].velocity(time) * part;
          a += ground_[ground] * part;
        }
    const auto of_ground = [&](const std::string& direction) {
      const int axis = direction == "x" ? 0 : direction == "y" ? 1 : direction == "z" ? 2 : -1;
      return axis < 0 || under.front()[axis] < 0 ? 0.0 : ground_[under.front()[axis]];
    };
    for (const std::vector<Row>& node : s.nodes.motion)
      for (std::size_t j = 0; j < node.size(); ++j) {
        history.node_displacement.push_back(value(node[j], u, 0));
        history.node_velocity.push_back(value(node[j], v, 0));
        history.node_acceleration.push_back(value(node[j], a, 0) + of_ground(s.nodes.directions[j]));
      }
    const std::size_t shears = history.storey_shear.size();
    for (const Floor& floor : s.floors)
      for (const Row& shear : floor.storey_shear) history.storey_shear.push_back(value(shear, u, 0));
    if (s.storey_shears) add(s.storey_shears(u), history.storey_shear, shears);
    sample_members(static_cast<int>(k), u, inside, time);
    if (s.supports.size() > 1) add_enforced(static_cast<int>(k), time);
  }
}

// To what has just been sampled: what the motion of the supports adds to that of the unknowns.
void Recorder::add_enforced(int k, double time) {
  const Structure& s = model_.structures[k];
  StructureHistory& history = results_.structures[k];
  const std::vector<std::array<int, 3>>& under = plan_.under[k];
  const auto add = [](std::vector<double>& values, const auto& factors, double amount) {
    const std::size_t from = values.size() - factors.size();
    for (int i = 0; i < factors.size(); ++i) values[from + i] += amount * factors[i];
  };
  for (std::size_t q = 1; q < s.supports.size(); ++q)
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& [ground, sign] : {std::pair(under[q][axis], 1.0), std::pair(under.front()[axis], -1.0)}) {
        if (ground < 0) continue;
        const Support& support = s.supports[q];
        const double moved = sign * plan_.motions[ground].displacement(time);
        add(history.node_displacement, support.nodes.col(axis), moved);
        add(history.node_velocity, support.nodes.col(axis), sign * plan_.motions[ground].velocity(time));
        add(history.node_acceleration, support.nodes.col(axis), sign * ground_[ground]);
        add(history.storey_shear, support.shears.col(axis), moved);
        add(history.end_forces, support.members.col(axis), moved);
      }
}

// Where a contact presses on a member between its ends, its force goes to them as to held ones.
void Recorder::sample_members(int k, const Eigen::VectorXd& u, bool inside, double time) {
  const Structure& s = model_.structures[k];
  StructureHistory& history = results_.structures[k];
  const std::size_t from = history.end_forces.size();
  const std::size_t components = s.members.components.size();
  for (std::size_t m = 0; m < s.members.forces.size(); ++m)
    for (std::size_t j = 0; j < components; ++j)
      history.end_forces.push_back(value(s.members.forces[m][j], u, 0) + s.members.held[m][j]);
  if (s.end_forces) add(s.end_forces(u), history.end_forces, from);
  if (!linked_) return;
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    const Link& link = model_.links[i];
    for (const auto& [end, sign] : {std::pair(&link.left, -1.0), std::pair(&link.right, 1.0)}) {
      if (end->structure != k || end->point.member < 0) continue;
      const auto found = std::find(s.members.members.begin(), s.members.members.end(), end->point.member);
      if (found == s.members.members.end()) continue;
      const std::size_t m = found - s.members.members.begin();
      const double force = inside ? link_force(stepper_.link_steps()[i], time) : stepper_.link_forces()[static_cast<int>(i)];
      if (force == 0) continue;
      const Eigen::Matrix<double, 12, 1> held = end->point.fixed_ends * (sign * force * link.direction);
      for (std::size_t j = 0; j < components; ++j) history.end_forces[from + m * components + j] += held[s.members.places[j]];
    }
  }
}

void Recorder::step() {
  const double end = stepper_.outputs_end_minus().time;
  const double rounding = 1e-12 * std::max(1.0, end);
  for (double time = outputs_ * model_.analysis.output_step; time <= end + rounding;
       time = ++outputs_ * model_.analysis.output_step) {
    energy_due_ = true;
    // At the end: just after what happens there, jumps of the ground, of a force, of a velocity.
    const bool at_end = time >= end - rounding;
    accelerations_of_ground(at_end ? end : time, ground_);
    if (at_end)
      motion_ = stepper_.outputs().motion;
    else
      stepper_.interpolate_outputs(time, motion_);
    followed_.complete(motion_, time, ground_);
    sample(time, motion_, ground_, at_end);
  }
  follow_peaks();
  if (linked_) sample_links();
  if (energy_due_) sample_energy();
  energy_due_ = false;
}

void Recorder::follow_peaks() {
  const OutputQuantities &first = stepper_.outputs_begin(), &last = stepper_.outputs_end_minus();
  const double h = last.time - first.time;
  begin_ = first.motion;
  followed_.complete(begin_, first.time, stepper_.ground_begin());
  end_ = last.motion;
  followed_.complete(end_, last.time, stepper_.ground_end_minus());
  const bool inside = looks_inside_ && h > 0, jumps = &stepper_.outputs() != &last;
  if (inside) {
    middle_ = stepper_.outputs_middle();
    followed_.complete_accelerations(middle_.col(0), stepper_.ground_middle());
  }
  if (jumps) {
    motion_ = stepper_.outputs().motion;
    followed_.complete(motion_, last.time, stepper_.ground());
  }
  for (int k = 0; k < static_cast<int>(peaks_.size()); ++k) {
    const int directions = followed_.directions(k);
    for (int i = 0; i < static_cast<int>(peaks_[k].size()); ++i) {
      FloorPeaks& peaks = peaks_[k][i];
      const int c = followed_.column(k, i, 0);
      if (directions == 1) {
        peaks.displacement.follow(h, begin_(c, 0), begin_(c, 1), end_(c, 0), end_(c, 1));
        if (inside) peaks.acceleration.follow(begin_(c, 2), middle_(c, 0), end_(c, 2));
        peaks.acceleration.follow(end_(c, 2));
        if (jumps) peaks.acceleration.follow(motion_(c, 2));
        const int below = c - 1;
        if (i == 0)
          peaks.drift.follow(h, begin_(c, 0), begin_(c, 1), end_(c, 0), end_(c, 1));
        else
          peaks.drift.follow(h, begin_(c, 0) - begin_(below, 0), begin_(c, 1) - begin_(below, 1), end_(c, 0) - end_(below, 0),
                             end_(c, 1) - end_(below, 1));
        continue;
      }
      follow_vector(peaks.displacement, h, c, -1);
      follow_vector(peaks.drift, h, c, i == 0 ? -1 : c - directions);
      const auto length = [c](const Eigen::MatrixXd& motion) { return std::hypot(motion(c, 2), motion(c + 1, 2)); };
      if (inside) peaks.acceleration.follow(length(begin_), std::hypot(middle_(c, 0), middle_(c + 1, 0)), length(end_));
      peaks.acceleration.follow(length(end_));
      if (jumps) peaks.acceleration.follow(length(motion_));
    }
  }
}

// The length of a horizontal vector, less that of a floor below: its slope is the rate of change along itself.
void Recorder::follow_vector(Peak& peak, double h, int column, int below) {
  const auto length_and_slope = [&](const Eigen::MatrixXd& motion) {
    double x = motion(column, 0), y = motion(column + 1, 0), vx = motion(column, 1), vy = motion(column + 1, 1);
    if (below >= 0) {
      x -= motion(below, 0);
      y -= motion(below + 1, 0);
      vx -= motion(below, 1);
      vy -= motion(below + 1, 1);
    }
    const double length = std::hypot(x, y);
    return std::pair(length, length > 0 ? (x * vx + y * vy) / length : 0.0);
  };
  const auto [begin, slope_begin] = length_and_slope(begin_);
  const auto [end, slope_end] = length_and_slope(end_);
  peak.follow(h, begin, slope_begin, end, slope_end);
}

int Recorder::tangent_of(int link) const {
  for (const Friction& friction : stepper_.system().frictions)
    if (friction.contact == link) return friction.first;
  return -1;
}

void Recorder::sample_links() {
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    const Contact& contact = *model_.links[i].contact;
    const LinkStep& step = stepper_.link_steps()[i];
    const auto rows = contact.impacts();
    const bool begun = !rows.empty();
    const bool presses = begun && std::isnan(rows.back().t_end);
    const bool ends_here = begun && !presses && rows.back().t_end >= step.end;
    LinkSampler& sampler = samplers_[i];
    if (presses || ends_here) {
      LinkSampler::Friction middle{}, end{};
      for (int j = 0; j < results_.links[i].tangents; ++j) {
        const LinkStep& slide = stepper_.link_steps()[tangent_of(static_cast<int>(i)) + j];
        middle[j] = slide.force_middle;
        end[j] = slide.force_end;
      }
      if (step.force_middle != 0) sampler.pressed(0.5 * (step.begin + step.end), step.motion_middle, step.force_middle, middle,
                                                  contact.work() - work_of_second_half(step));
      const double force = presses ? stepper_.link_forces()[static_cast<int>(i)] : step.force_end;
      sampler.pressed(step.end, step.motion_end, force, end, contact.work());
    }
    if (!presses) sampler.finish(results_.links[i]);
    if (ends_here) sampler.apart(step.end, step.motion_end, contact.work(), results_.links[i]);
    if (!presses && !ends_here && energy_due_) sampler.apart(step.end, step.motion_end, contact.work(), results_.links[i]);
  }
}

void Recorder::sample_energy() {
  EnergyHistory& e = results_.energy;
  const Energies now = stepper_.energies();
  const double error = now.input - (now.kinetic + now.strain + now.damping + now.hysteretic + now.impact);
  e.time.push_back(stepper_.time());
  e.input.push_back(now.input);
  e.kinetic.push_back(now.kinetic);
  e.strain.push_back(now.strain);
  e.damping.push_back(now.damping);
  e.hysteretic.push_back(now.hysteretic);
  e.impact.push_back(now.impact);
  e.error.push_back(error);
  largest_input_ = std::max(largest_input_, std::abs(now.input));
  largest_imbalance_ = std::max(largest_imbalance_, std::abs(error));
}

void Recorder::end() {
  if (linked_)
    for (std::size_t i = 0; i < samplers_.size(); ++i) samplers_[i].finish(results_.links[i]);
  if (results_.energy.time.empty() || results_.energy.time.back() < stepper_.state().time) sample_energy();
  collect_impacts();
}

void Recorder::with_present_state(const std::function<void()>& write) {
  collect_impacts();
  std::vector<std::size_t> finished;
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    finished.push_back(results_.links[i].time.size());
    samplers_[i].show(results_.links[i]);
  }
  write();
  for (std::size_t i = 0; i < samplers_.size(); ++i) {
    LinkHistory& history = results_.links[i];
    for (auto* values : columns(history)) values->resize(finished[i]);
    history.friction.resize(finished[i] * history.tangents);
  }
}

void Recorder::archive(Archive& archive) {
  archive(outputs_);
  archive(peaks_);
  archive(samplers_);
  archive(largest_input_);
  archive(largest_imbalance_);
  for (LinkHistory& history : results_.links) {
    archive_length(archive, history);
    history.friction.resize(history.time.size() * history.tangents);
  }
  archive_length(archive, results_.energy);
}

int Recorder::impacts() const {
  std::size_t count = 0;
  if (linked_)
    for (const Link& link : model_.links) count += link.contact->impacts().size();
  return static_cast<int>(count);
}

void Recorder::collect_impacts() {
  results_.impacts.clear();
  if (!linked_) return;
  for (const Link& link : model_.links) {
    const auto rows = link.contact->impacts();
    results_.impacts.insert(results_.impacts.end(), rows.begin(), rows.end());
  }
  std::stable_sort(results_.impacts.begin(), results_.impacts.end(),
                   [](const ImpactRow& a, const ImpactRow& b) { return a.t_start < b.t_start; });
}

void Recorder::summarize(Summary& summary) const {
  summary.structures.clear();
  summary.links.clear();
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    StructureSummary s{model_.structures[k].name, {}, {}, {}};
    for (const FloorPeaks& peaks : peaks_[k]) {
      s.peak_displacement.push_back(peaks.displacement.largest());
      if (model_.structures[k].has_storeys()) s.peak_drift.push_back(peaks.drift.largest());
      s.peak_acceleration.push_back(peaks.acceleration.largest());
    }
    summary.structures.push_back(std::move(s));
  }
  if (linked_)
    for (const Link& link : model_.links) {
      LinkSummary s;
      s.name = link.name;
      if (!link.contact->impacts().empty()) s.peak_force = std::numeric_limits<double>::quiet_NaN();  // until a finite one
      for (const ImpactRow& row : link.contact->impacts()) {
        ++s.impacts;
        s.peak_force = std::fmax(s.peak_force, row.peak_force);
        s.peak_penetration = std::max(s.peak_penetration, row.peak_penetration);
        s.impulse += row.impulse;
        s.energy_lost += row.energy_lost;
      }
      const std::vector<Friction>& frictions = stepper_.system().frictions;
      for (std::size_t f = 0; f < frictions.size(); ++f)
        if (&model_.links[frictions[f].contact] == &link) s.energy_lost += stepper_.friction_work()[f];
      summary.links.push_back(std::move(s));
    }
  const EnergyHistory& e = results_.energy;
  if (e.time.empty()) return;
  summary.energy = {e.input.back(),  e.kinetic.back(), e.strain.back(),
                    e.damping.back(), e.hysteretic.back(), e.impact.back(),
                    largest_input_ > 0 ? largest_imbalance_ / largest_input_ : 0};
}

}  // namespace pounding
