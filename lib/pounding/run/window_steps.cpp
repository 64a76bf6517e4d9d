#include <pounding/run/window_steps.hpp>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/stepping/interpolation.hpp>
#include <pounding/stepping/step_controller.hpp>

namespace pounding {
namespace {

constexpr std::size_t min_steps = 200;

std::size_t steps_in(const ImpactWindow& window) { return std::max(min_steps, window.steps.size()); }

// Times of equal steps through a window.
std::vector<double> times_of(const ImpactWindow& window) {
  const std::size_t count = steps_in(window);
  std::vector<double> times(count + 1);
  for (std::size_t i = 0; i <= count; ++i)
    times[i] = window.begin() + (window.end() - window.begin()) * static_cast<double>(i) / static_cast<double>(count);
  times.back() = window.end();
  return times;
}

GroundMotion sampled(const std::vector<double>& times, std::vector<double> values) {
  return GroundMotion(Samples{.times = times, .accelerations = std::move(values), .uniform = evenly_spaced(times)});
}

// Forces at these times of every active link in a window: the parabola through the three forces of each step of the
// run.
std::map<int, std::vector<double>> forces_at(const std::vector<double>& times, const ImpactWindow& window) {
  std::map<int, std::vector<double>> forces;
  std::size_t k = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (k + 1 < window.steps.size() && times[i] > window.steps[k].end) ++k;
    const ImpactWindow::Step& step = window.steps[k];
    const Parabola part((times[i] - step.begin) / (step.end - step.begin));
    for (const ImpactWindow::Force& f : step.forces) {
      std::vector<double>& of_link = forces[f.link];
      of_link.resize(times.size());
      of_link[i] = f.begin * part.begin + f.middle * part.middle + f.end * part.end;
    }
  }
  return forces;
}

SparseMatrix block(const SparseMatrix& matrix, const Group& group) {
  return matrix.block(group.first, group.first, group.count, group.count);
}

// Load of a link on a group. Its effect on massless degrees of freedom is the same in both solutions (SpringRelief).
Eigen::VectorXd load_of(const System& system, const SpringRelief& relief, int link, const Group& group) {
  const bool eased = is_spring(system, link) && relief.push().cols() > 0;
  const SparseMatrix column = eased ? SparseMatrix(relief.push().col(link - system.contact_count()))
                                    : SparseMatrix(system.gap_jacobian.col(link));
  return Eigen::VectorXd(column.col(0)).segment(group.first, group.count);
}

// The group alone, with link forces as prescribed loads instead of links. Outputs are the closings of the contacts,
// then the requested ones.
System by_itself(const System& system, const SpringRelief& relief, const Group& group, std::span<const int> outputs,
                 const ImpactWindow& window) {
  const std::vector<double> times = times_of(window);
  System alone;
  alone.mass = block(system.mass, group);
  alone.damping = block(system.damping, group);
  alone.stiffness = block(system.stiffness, group);
  if (system.has_modal_matrix(group)) alone.modal_damping = block(system.modal_damping, group);
  alone.groups = {group};
  alone.groups[0].first = 0;
  alone.gap_jacobian.resize(group.count, 0);
  alone.load = system.load.middleRows(group.first, group.count);
  for (const GroundMotion& ground : system.grounds) {
    std::vector<double> values;
    for (const double time : times) values.push_back(ground.acceleration(time));
    alone.grounds.push_back(sampled(times, std::move(values)));
  }
  for (auto& [link, forces] : forces_at(times, window)) {
    const Eigen::VectorXd load = load_of(system, relief, link, group);
    if (load.isZero(0)) continue;
    alone.load.conservativeResize(Eigen::NoChange, alone.load.cols() + 1);
    alone.load.rightCols(1) = load;
    alone.grounds.push_back(sampled(times, std::move(forces)));
  }
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const SparseMatrix& matrix, int column, int to) {
    for (SparseMatrix::InnerIterator it(matrix, column); it; ++it)
      if (it.row() >= group.first && it.row() < group.first + group.count)
        entries.emplace_back(static_cast<int>(it.row()) - group.first, to, it.value());
  };
  for (int i = 0; i < system.contact_count(); ++i) add(system.gap_jacobian, i, i);
  int to = system.contact_count();
  for (const int output : outputs) add(system.outputs, output, to++);
  alone.outputs.resize(group.count, to);
  alone.outputs.setFromTriplets(entries.begin(), entries.end());
  return alone;
}

struct Followed {
  Eigen::MatrixXd u, v;  // [output, step of the window]
};

Followed follow(const System& alone, StructureSolver& solver, const ImpactWindow& window, const Eigen::VectorXd& u,
                const Eigen::VectorXd& v) {
  const double h = (window.end() - window.begin()) / static_cast<double>(steps_in(window));
  Stepper stepper(alone, solver, {.max_step = h});
  stepper.start(window.begin(), u, v);
  StepController controller(stepper);
  FixedSteps steps;
  Followed found{Eigen::MatrixXd(alone.outputs.cols(), static_cast<Eigen::Index>(window.steps.size())), {}};
  found.v = found.u;
  Eigen::MatrixXd motion;
  for (Eigen::Index k = 0; k < found.u.cols(); ++k) {
    const double time = window.steps[static_cast<std::size_t>(k)].end;
    while (stepper.view().time() < time) controller.advance(h, window.end(), steps);
    stepper.view().interpolate_outputs(time, motion);
    found.u.col(k) = motion.col(0);
    found.v.col(k) = motion.col(1);
  }
  return found;
}

}  // namespace

WindowDifferences differences_in_window(const System& system, const StructureSolver& base, int group,
                                        std::span<const int> outputs, const ImpactWindow& window) {
  const Group& of = system.groups[static_cast<std::size_t>(group)];
  const StructureSolver::Segment& own =
      *std::ranges::find(base.layout().segments, group, &StructureSolver::Segment::group);
  if (!own.modes) throw std::invalid_argument("only a reduced structure can be checked");
  const System alone = by_itself(system, base.layout().relief, of, outputs, window);
  const auto motion_of = [&](const Eigen::VectorXd& coordinates) -> Eigen::VectorXd {
    return base.physical(coordinates).col(0).segment(of.first, of.count);
  };
  const Eigen::VectorXd u = motion_of(window.u), v = motion_of(window.v);
  petsc::SparseSolver by_factors(PETSC_COMM_SELF, alone);
  ModalSolver by_modes(alone, {ReducedGroup{.modes = own.modes}});
  const Followed whole = follow(alone, by_factors, window, u, v), reduced = follow(alone, by_modes, window, u, v);
  const Eigen::Index contacts = system.contact_count(), others = static_cast<Eigen::Index>(outputs.size());
  return {(whole.u - reduced.u).topRows(contacts), (whole.v - reduced.v).topRows(contacts),
          (whole.u - reduced.u).bottomRows(others)};
}

}  // namespace pounding
