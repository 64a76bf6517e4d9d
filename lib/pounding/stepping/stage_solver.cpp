#include <pounding/stepping/stage_solver.hpp>

#include <algorithm>

namespace pounding {

bool StageSolver::begin(const EffectiveMatrix& matrix, const std::optional<int>& level) {
  failed_link_ = -1;
  active_.clear();
  for (int i = 0; i < links_.size(); ++i)
    if (i == links_.contacts() && springs_.rests())
      i = links_.frictions_from() - 1;
    else if (links_.is_spring(i) ? springs_.is_active(i) : links_.is_active(i))
      active_.push_back(i);
  if (springs_.holds()) {
    held_push_.setZero(equations_.solver.size());
    equations_.solver.add_forces(1, springs_.held(), held_push_);
  }
  if (equations_.springs.any()) {
    const bool gives_way =
        std::any_of(active_.begin(), active_.end(), [&](int link) { return links_.is_spring(link); });
    held_relief_.setZero(gives_way ? links_.springs() : 0);
    relief_.resize(0, 0);
    if (gives_way) {
      links_.relief().add_relief(1, springs_.held().segment(links_.contacts(), links_.springs()), held_relief_);
      std::vector<int> springs;
      for (const int link : active_) springs.push_back(links_.is_spring(link) ? link - links_.contacts() : -1);
      relief_ = relief_among(links_.relief().flexibility(), springs);
    }
  }
  free_.resize(active_.size());
  free_acceleration_.resize(static_cast<Eigen::Index>(active_.size()));
  active_force_.resize(free_acceleration_.size());
  equations_.solver.set_matrix(matrix, level);
  equations_.tangents.begin_step();
  linearized_.resize(0);
  contraction_ = first_contraction;
  return find_flexibility();
}

// True if all changes that follow this relative one are together a small part of the allowed error.
bool StageSolver::is_solved(double change) const {
  constexpr double part = 0.02;
  return contraction_ / (1 - contraction_) * change <= part * norm_.allowed();
}

bool StageSolver::find_flexibility() {
  if (active_.empty()) return true;
  if (!equations_.solver.flexibility(active_, flexibility_)) return false;
  blocks_.find(flexibility_);
  return true;
}

// Solves for the active forces from their initial guess, writes them to `force` and subtracts their effect from the
// acceleration x.
bool StageSolver::condense(const Stage& stage, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> x) {
  const int count = static_cast<int>(active_.size());
  const CondensedLinks links{active_,    free_,      free_acceleration_, flexibility_,
                             stage.by_u, stage.by_v, stage.weight,       relief_.size() > 0 ? &relief_ : nullptr,
                             &blocks_};
  if (!link_solver_.solve(links, active_force_)) {
    failed_link_ = link_solver_.failed_link();
    return false;
  }
  for (int k = 0; k < count; ++k) force[active_[k]] = active_force_[k];
  equations_.solver.add_response(-stage.weight, active_, active_force_, x);
  return true;
}

}  // namespace pounding
