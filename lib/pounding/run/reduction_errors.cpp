#include <pounding/run/reduction_errors.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

// The run has more blocks than its shadow and is more accurate, but not uniformly; a factor of two has been observed.
constexpr double safety = 3;
// Minimum fraction of the shadow's error estimate that is used for the run.
constexpr double nearest = 0.04;
// Fraction of the tolerance that the reduction may use; the steps use about half of it.
constexpr double share = 0.3;
// Number of times at which the difference from the shadow is measured.
constexpr double measured_times = 400;

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Forces of a structure as linear functions of its degrees of freedom, followed by the forces of its yielding parts.
RowMajor rows_with_parts(const Structure& s) {
  RowMajor rows(s.forces.rows.rows(), s.size() + static_cast<Eigen::Index>(s.yielding.size()));
  std::vector<Eigen::Triplet<double>> entries;
  add_member_forces(entries, s, 0);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

double ratio(double difference, double largest) { return difference > 0 ? safety * difference / largest : 0; }

double bound_of(const Reduction& requested, double tolerance) {
  return requested.error > 0 ? requested.error : share * tolerance;
}

}  // namespace

ReductionErrors::ReductionErrors(const Model& model, const FloorResponse& response, const StepView& stepper)
    : model_(model), stepper_(stepper), shadowed_(dynamic_cast<const ShadowedSolver*>(&stepper.base())) {
  if (!shadowed_) return;
  for (std::vector<double>* by_link : {&forces_, &peaks_, &shadow_peaks_})
    by_link->assign(static_cast<std::size_t>(stepper.system().contact_count()), 0.0);
  for (int i = 0; i < static_cast<int>(forces_.size()); ++i) nearer_.push_back(nearer(i));
  const std::vector<int> first = offsets(model);
  Eigen::Index parts = 0;
  for (int k = 0; k < static_cast<int>(model.structures.size()); ++k) {
    const Structure& s = model.structures[k];
    const Eigen::Index first_part = std::exchange(parts, parts + static_cast<Eigen::Index>(s.yielding.size()));
    const auto reduced = std::ranges::find(stepper.base().layout().reduced, s.name, &ReducedStructure::name);
    if (reduced == stepper.base().layout().reduced.end() || reduced->link_blocks < 2 || reduced->modes > 0) continue;
    Floors floors;
    floors.structure = k;
    floors.coordinates = *std::ranges::find(stepper.base().layout().segments, k, &StructureSolver::Segment::group);
    floors.first_part = first_part;
    floors.parts = static_cast<Eigen::Index>(s.yielding.size());
    if (const auto count = static_cast<int>(s.forces.members.size() * s.forces.components.size()); count > 0) {
      const auto of_member = [count](int row) { return row < count; };
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.forces.rows.rows());
      floors.forces.emplace(rows_with_parts(s), s.size(), first[k], none, none, of_member, true);
      floors.units.resize(static_cast<std::size_t>(floors.forces->size()));
      for (int row = 0; row < count; ++row) {
        const std::string& component = s.forces.components[static_cast<std::size_t>(row) % s.forces.components.size()];
        const char kind = component[component.find(' ') + 1];
        floors.units[static_cast<std::size_t>(floors.forces->places()[static_cast<std::size_t>(row)].at)] =
            kind == 'M' || kind == 'T' ? 1 : 0;
      }
    }
    floors.rows = response.translations(k);
    floors_.push_back(std::move(floors));
  }
  waiting_.setZero(stepper.base().size(), together);
  last_.setZero(stepper.base().size(), 2);
  kept_.setZero(stepper.base().size(), 2 * together);
  last_forces_.setZero(parts);
  waiting_forces_.setZero(parts, together);
  kept_forces_.setZero(parts, together);
}

void ReductionErrors::step(bool output_due) {
  if (floors_.empty()) return;
  const Instant& end = stepper_.instant_end_minus();
  compare_forces(end);
  shadowed_->observe_shadow(end.motion.leftCols(3), motion_);
  const Eigen::MatrixXd& own = stepper_.outputs_end_minus().motion;
  for (Floors& floors : floors_)
    for (const int row : floors.rows) {
      floors.displacement = std::max(floors.displacement, std::abs(own(row, 0) - motion_(row, 0)));
      floors.acceleration = std::max(floors.acceleration, std::abs(own(row, 2) - motion_(row, 2)));
    }
  const long every = std::max(1L, std::lround(model_.analysis.duration / model_.analysis.output_step / measured_times));
  if (!output_due || outputs_++ % every != 0) return;
  waiting_forces_.col(waits_) = end.force.segment(stepper_.system().contact_count(), waiting_forces_.rows());
  waiting_.col(waits_++) = end.motion.col(Instant::u);
  if (waits_ == together) measure_waiting();
}

std::optional<int> ReductionErrors::Peaks::take(double next) {
  std::optional<int> place;
  const auto minimum = std::ranges::min_element(measures);
  if (last >= before && last > next && last > *minimum) {
    *minimum = last;
    place = static_cast<int>(minimum - measures.begin());
  }
  before = last;
  last = next;
  return place;
}

// Each structure has peaks at different times.
void ReductionErrors::keep_last(Floors& floors, double own, double difference) {
  const auto coordinates = [&](auto&& motion) {
    return motion.segment(floors.coordinates.first, floors.coordinates.count);
  };
  const auto forces = [&](auto&& of_springs) { return of_springs.segment(floors.first_part, floors.parts); };
  if (const std::optional<int> place = floors.own.take(own)) {
    coordinates(kept_.col(*place)) = coordinates(last_.col(0));
    forces(kept_forces_.col(*place)) = forces(last_forces_);
  }
  if (const std::optional<int> place = floors.difference.take(difference))
    coordinates(kept_.col(together + *place)) = coordinates(last_.col(1));
}

void ReductionErrors::measure_waiting() {
  if (waits_ == 0) return;
  const Eigen::MatrixXd differences = shadowed_->difference(waiting_);
  stiffness_times_.resize(waiting_.rows(), 2 * together);
  shadowed_->stiffness_times(waiting_, stiffness_times_.leftCols(together));
  shadowed_->stiffness_times(differences, stiffness_times_.rightCols(together));
  for (int i = 0; i < waits_; ++i) {
    for (Floors& floors : floors_) {
      const int first = floors.coordinates.first, count = floors.coordinates.count;
      keep_last(floors, waiting_.col(i).segment(first, count).dot(stiffness_times_.col(i).segment(first, count)),
                differences.col(i).segment(first, count).dot(stiffness_times_.col(together + i).segment(first, count)));
    }
    last_.col(0) = waiting_.col(i);
    last_.col(1) = differences.col(i);
    last_forces_ = waiting_forces_.col(i);
  }
  waits_ = 0;
}

void ReductionErrors::compare_members() {
  if (kept_.isZero(0)) return;  // before the first peak
  motions_ = shadowed_->physical(kept_).transpose();
  Eigen::VectorXd way;
  for (int i = 0; i < together && kept_forces_.rows() > 0; ++i) {
    way.setZero(motions_.cols());
    shadowed_->layout().relief.add_way(-1, kept_forces_.col(i), way);
    motions_.row(i) += way.transpose();
  }
  for (Floors& floors : floors_) {
    if (!floors.forces) continue;
    floors.forces->evaluate<together>(motions_, {}, {}, evaluated_);
    if (floors.parts > 0) add_yielding(floors);
    floors.members = floors.largest_members = {};
    for (int q = 0; q < floors.forces->size(); ++q) {
      const auto unit = static_cast<std::size_t>(floors.units[static_cast<std::size_t>(q)]);
      floors.largest_members[unit] =
          std::max(floors.largest_members[unit], evaluated_.col(q).head<together>().cwiseAbs().maxCoeff());
      floors.members[unit] = std::max(floors.members[unit], evaluated_.col(q).tail<together>().cwiseAbs().maxCoeff());
    }
  }
}

// The yielding forces are the same in the run and its shadow.
void ReductionErrors::add_yielding(const Floors& floors) {
  Eigen::VectorXd forces;
  for (int i = 0; i < together; ++i) {
    forces.setZero(floors.forces->size());
    floors.forces->add_yielding(kept_forces_.col(i).segment(floors.first_part, floors.parts), forces);
    evaluated_.row(i) += forces.transpose();
  }
}

// Square root of the ratio of the flexibility errors; the ratio itself was six times too small for towers of 20
// storeys. If a structure of the link has no known error, 1: the estimate of the shadow is used for the run.
double ReductionErrors::nearer(int link) const {
  double run = 0, shadow = 0;
  for (const LinkEnd* end : {&model_.links[link].left, &model_.links[link].right}) {
    const auto reduced = std::ranges::find(stepper_.base().layout().reduced, model_.structures[end->structure].name,
                                           &ReducedStructure::name);
    if (reduced == stepper_.base().layout().reduced.end()) continue;
    if (reduced->shadow_flexibility_error == 0) return 1;
    run += reduced->flexibility_error;
    shadow += reduced->shadow_flexibility_error;
  }
  return run < shadow ? std::sqrt(std::max(nearest, run / shadow)) : 1;
}

void ReductionErrors::compare_forces(const Instant& end) {
  const auto step = [&](std::size_t i) -> const LinkStep& { return stepper_.link_step(static_cast<int>(i)); };
  const auto presses = [&](std::size_t i) { return step(i).force_end != 0; };
  bool any = false;
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    any = any || presses(i);
    if (presses(i)) continue;
    forces_[i] = peak_difference(i);
    peaks_[i] = shadow_peaks_[i] = 0;
  }
  if (!any) return;
  shadowed_->gather_shadow(end.motion.leftCols(2), closings_);
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    if (!presses(i)) continue;
    const auto row = static_cast<Eigen::Index>(i);
    const laws::Response law = stepper_.links().law(static_cast<int>(i), step(i).motion_end);
    double difference = law.by_penetration * (end.relative(row, 0) - closings_(row, 0)) +
                        law.by_rate * (end.relative(row, 1) - closings_(row, 1));
    if (!std::isfinite(difference)) difference = 0;
    const double force = step(i).force_end;
    peaks_[i] = std::max(peaks_[i], force);
    shadow_peaks_[i] = std::max(shadow_peaks_[i], force - difference);
  }
}

// Largest difference of peaks up to now. A single impact may agree by chance; many do not.
double ReductionErrors::peak_difference(std::size_t link) const {
  return std::max(forces_[link], std::abs(peaks_[link] - shadow_peaks_[link]));
}

std::vector<ReducedStructure> ReductionErrors::errors(const Summary& summary) const {
  std::vector<ReducedStructure> all(stepper_.base().layout().reduced.begin(), stepper_.base().layout().reduced.end());
  double peak_force = 0;
  for (const LinkSummary& link : summary.links) peak_force = std::fmax(peak_force, link.peak_force);
  const auto peak = [](const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::ranges::max_element(values);
  };
  for (const Floors& floors : floors_) {
    const StructureSummary& s = summary.structures[floors.structure];
    ReducedStructure& one = *std::ranges::find(all, s.name, &ReducedStructure::name);
    double difference = 0;
    for (std::size_t i = 0; i < forces_.size(); ++i)
      if (model_.links[i].hits(floors.structure)) difference = std::max(difference, nearer_[i] * peak_difference(i));
    one.error_force = ratio(difference, peak_force);
    if (!floors.rows.empty()) {
      one.error_displacement = ratio(floors.displacement, peak(s.peak_displacement));
      one.error_acceleration = ratio(floors.acceleration, peak(s.peak_acceleration));
    }
    if (!model_.structures[floors.structure].forces.members.empty())
      one.error_members = std::max(ratio(floors.members[0], floors.largest_members[0]),
                                   ratio(floors.members[1], floors.largest_members[1]));
  }
  return all;
}

// The last measure may be an unfinished peak.
void ReductionErrors::end() {
  if (floors_.empty()) return;
  measure_waiting();
  for (Floors& floors : floors_) keep_last(floors, 0, 0);
  compare_members();
}

void ReductionErrors::archive(Archive& archive) {
  if (floors_.empty()) return;
  measure_waiting();
  if (!archive.reading()) compare_members();
  archive(forces_, peaks_, shadow_peaks_, outputs_);
  for (Floors& floors : floors_) {
    archive(floors.displacement, floors.acceleration, floors.own, floors.difference);
  }
  archive(last_, last_forces_, kept_, kept_forces_);
}

bool check_exceeds(const ReducedStructure& found, const Reduction& requested, double tolerance) {
  const double bound = bound_of(requested, tolerance);
  return found.check_force > bound || found.check_displacement > bound;
}

bool exceeds(const ReducedStructure& errors, const Reduction& requested, double tolerance) {
  const double bound = bound_of(requested, tolerance);
  return errors.error_force > bound || errors.error_displacement > bound ||
         (requested.of_acceleration && errors.error_acceleration > bound) ||
         (requested.of_members && errors.error_members > bound);
}

}  // namespace pounding
