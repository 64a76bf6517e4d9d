#include <pounding/reduction/shadowed_solver.hpp>

#include <algorithm>
#include <utility>

#include <pounding/linear/column_sums.hpp>
#include <pounding/linear/dense_products.hpp>

namespace pounding {
namespace {

std::vector<int> shadowed_groups(const ReducedGroups& bases) {
  std::vector<int> groups;
  for (std::size_t k = 0; k < bases.size(); ++k)
    if (bases[k] && bases[k]->shadow) groups.push_back(static_cast<int>(k));
  return groups;
}

// Structures with equal shadows share the modes.
ReducedGroups bases_of_shadows(const ReducedGroups& bases) {
  ReducedGroups made(bases.size());
  const std::vector<int> groups = shadowed_groups(bases);
  for (const int k : groups) {
    const ReducedGroup& of = *bases[static_cast<std::size_t>(k)];
    const int equal = *std::ranges::find(groups, of.shadow,
                                         [&](int other) { return bases[static_cast<std::size_t>(other)]->shadow; });
    made[static_cast<std::size_t>(k)] =
        equal < k ? made[static_cast<std::size_t>(equal)]
                  : ReducedGroup{.modes = std::make_shared<const GroupModes>(GroupModes{
                                     petsc::product(of.modes->shapes, of.shadow->in_modes), of.shadow->squares})};
  }
  return made;
}

}  // namespace

ShadowedSolver::ShadowedSolver(const System& system, const ReducedGroups& bases)
    : StructureSolver(system),
      run_(system, bases),
      shadow_(system, bases_of_shadows(bases), {.groups = shadowed_groups(bases)}) {
  layout_ = run_.layout();
  layout_.load.conservativeResize(run_.size() + shadow_.size(), Eigen::NoChange);
  layout_.load.bottomRows(shadow_.size()) = shadow_.layout().load;
  layout_.weights.conservativeResize(size());
  layout_.weights.tail(shadow_.size()).setZero();
  for (const Segment& shadow : shadow_.layout().segments)
    bases_.push_back({*std::ranges::find(layout_.segments, shadow.group, &Segment::group), shadow.first,
                      bases[static_cast<std::size_t>(shadow.group)]->shadow});
}

// Coordinates of the run, with zeros for structures that have a shadow.
Eigen::MatrixXd ShadowedSolver::others_of(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  Eigen::MatrixXd others = run_of(x);
  for (const Basis& basis : bases_) others.middleRows(basis.run.first, basis.run.count).setZero();
  return others;
}

void ShadowedSolver::gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  shadow_.gather(shadow_of(x), relative);
  if (!has_others()) return;
  Eigen::MatrixXd by_others;
  run_.gather(others_of(x), by_others);
  relative += by_others;
}

void ShadowedSolver::observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  shadow_.observe(shadow_of(x), values);
  if (!has_others()) return;
  Eigen::MatrixXd of_others;
  run_.observe(others_of(x), of_others);
  values += of_others;
}

Eigen::MatrixXd ShadowedSolver::difference(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (const auto& [run, first, modes] : bases_)
    made.middleRows(run.first, run.count) =
        x.middleRows(run.first, run.count) -
        summed_product(modes->in_modes, shadow_of(x).middleRows(first, modes->squares.size()));
  return made;
}

Eigen::VectorXd ShadowedSolver::coordinates(const Eigen::VectorXd& physical) const {
  Eigen::VectorXd x(size());
  x << run_.coordinates(physical), shadow_.coordinates(physical);
  return x;
}

void ShadowedSolver::add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  run_.add_physical_forces(f, run_of(y));
  shadow_.add_physical_forces(f, shadow_of(y));
}

void ShadowedSolver::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  run_.stiffness_times(run_of(x), run_of(y));
  shadow_.stiffness_times(shadow_of(x), shadow_of(y));
}

void ShadowedSolver::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                                   Eigen::Ref<Eigen::MatrixXd> y) const {
  run_.damping_times(run_of(x), run_of(kx), run_of(y));
  shadow_.damping_times(shadow_of(x), shadow_of(kx), shadow_of(y));
}

void ShadowedSolver::set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) {
  run_.set_matrix(matrix, step_level);
  shadow_.set_matrix(matrix, step_level);
}

bool ShadowedSolver::solve(Eigen::Ref<Eigen::VectorXd> x) {
  return run_.solve(run_of(x)) && shadow_.solve(shadow_of(x));
}

void ShadowedSolver::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  run_.add_forces(factor, f, run_of(y));
  shadow_.add_forces(factor, f, shadow_of(y));
}

bool ShadowedSolver::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  shadow_.select(links);
  return run_.flexibility(links, g);
}

void ShadowedSolver::add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                                  Eigen::Ref<Eigen::VectorXd> y) const {
  run_.add_response(factor, links, f, run_of(y));
  shadow_.add_response(factor, links, f, shadow_of(y));
}

}  // namespace pounding
