#include <pounding/run/floor_response.hpp>

namespace pounding {

FloorResponse::FloorResponse(const Model& model) {
  const GroundPlan plan = ground_plan(model);
  grounds_ = plan.motions;
  const int grounds = static_cast<int>(grounds_.size());
  int count = 0;
  for (const Structure& s : model.structures) {
    first_.push_back(count);
    directions_.push_back(s.floors.empty() ? 0 : static_cast<int>(s.floors.front().motion.size()));
    count += static_cast<int>(s.floors.size()) * directions_.back();
  }
  at_rest_ = Eigen::VectorXd::Zero(count);
  ground_of_.assign(static_cast<std::size_t>(count), -1);
  by_difference_ = Eigen::MatrixXd::Zero(count, grounds);
  for (std::size_t k = 0; k < model.structures.size(); ++k) {
    const Structure& s = model.structures[k];
    const std::vector<std::array<int, 3>>& under = plan.under[k];
    for (std::size_t i = 0; i < s.floors.size(); ++i)
      for (int j = 0; j < directions_[k]; ++j) {
        const Row& row = s.floors[i].motion[j];
        const int c = column(static_cast<int>(k), static_cast<int>(i), j);
        if (s.at_rest.size() > 0) at_rest_[c] = row.dot(s.at_rest);
        if (j < 2) ground_of_[c] = under.front()[j];
        for (std::size_t q = 1; q < s.supports.size(); ++q)
          for (int axis = 0; axis < 3; ++axis) {
            const double part = row.dot(s.supports[q].influence.col(axis));
            if (part == 0) continue;
            if (under[q][axis] >= 0) by_difference_(c, under[q][axis]) += part;
            if (under.front()[axis] >= 0) by_difference_(c, under.front()[axis]) -= part;
          }
      }
  }
  if (count == 0 || by_difference_.cwiseAbs().maxCoeff() == 0) by_difference_.resize(0, 0);
}

void FloorResponse::complete(Eigen::MatrixXd& motion, double time, const Eigen::VectorXd& ground) const {
  motion.col(0) += at_rest_;
  complete_accelerations(motion.col(2), ground);
  if (by_difference_.size() == 0) return;
  for (std::size_t g = 0; g < grounds_.size(); ++g) {
    const auto part = by_difference_.col(static_cast<int>(g));
    motion.col(0) += grounds_[g].displacement(time) * part;
    motion.col(1) += grounds_[g].velocity(time) * part;
  }
}

void FloorResponse::complete_accelerations(Eigen::Ref<Eigen::VectorXd> accelerations, const Eigen::VectorXd& ground) const {
  for (std::size_t c = 0; c < ground_of_.size(); ++c)
    if (ground_of_[c] >= 0) accelerations[static_cast<Eigen::Index>(c)] += ground[ground_of_[c]];
  if (by_difference_.size() > 0) accelerations += by_difference_ * ground;
}

}  // namespace pounding
