#include <pounding/stepping/stage_solver.hpp>

namespace pounding {

bool StageSolver::begin(const EffectiveMatrix& matrix, std::optional<int> level) {
  failed_link_ = -1;
  active_.clear();
  for (int i = 0; i < links_.size(); ++i)
    if (links_.is_active(i)) active_.push_back(i);
  equations_.solver.set_matrix(matrix, level);
  return active_.empty() || equations_.solver.flexibility(active_, flexibility_);
}

// Solves for the active forces from the guess, enters them in `force` and takes what they do off the acceleration x.
bool StageSolver::condense(const Stage& stage, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> x) {
  const int count = static_cast<int>(active_.size());
  active_force_.resize(count);
  for (int k = 0; k < count; ++k) active_force_[k] = guess_[active_[k]];
  const CondensedLinks links{active_, free_, free_acceleration_, flexibility_, stage.by_u, stage.by_v, stage.weight};
  if (!link_solver_.solve(links, active_force_)) {
    failed_link_ = link_solver_.failed_link();
    return false;
  }
  for (int k = 0; k < count; ++k) force[active_[k]] = active_force_[k];
  equations_.solver.add_response(-stage.weight, active_, active_force_, x);
  return true;
}

}  // namespace pounding
