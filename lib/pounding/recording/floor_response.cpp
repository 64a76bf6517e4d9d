#include <pounding/recording/floor_response.hpp>

namespace pounding {

FloorResponse::FloorResponse(const Model& model, const GroundPlan& plan) : grounds_(plan.motions) {
  int count = 0;
  for (const Structure& s : model.structures) {
    first_.push_back(count);
    directions_.push_back(s.floors.empty() ? 0 : static_cast<int>(s.floors.front().motion.size()));
    count += static_cast<int>(s.floors.size()) * directions_.back();
  }
  at_rest_ = Eigen::VectorXd::Zero(count);
  ground_of_.assign(static_cast<std::size_t>(count), -1);
  by_difference_ = Eigen::MatrixXd::Zero(count, static_cast<int>(grounds_.size()));
  for (std::size_t k = 0; k < model.structures.size(); ++k) {
    const Structure& s = model.structures[k];
    const SupportMotion& supports = plan.supports[k];
    for (std::size_t i = 0; i < s.floors.size(); ++i)
      for (int j = 0; j < directions_[k]; ++j) {
        const Row& floor = s.floors[i].motion[j];
        const int r = row(static_cast<int>(k), static_cast<int>(i), j);
        if (s.at_rest.size() > 0) at_rest_[r] = floor.dot(s.at_rest);
        if (j < 2) ground_of_[r] = supports.at_first(j);
        supports.project(
            [&](std::size_t support, int axis) { return floor.dot(s.supports[support].influence.col(axis)); },
            by_difference_.row(r));
      }
  }
  if (count == 0 || by_difference_.cwiseAbs().maxCoeff() == 0) by_difference_.resize(0, 0);
}

// In space a floor moves along x and y, and rotates.
std::vector<int> FloorResponse::translations(int structure) const {
  std::vector<int> rows;
  const int directions = directions_[structure];
  for (int row = first_[structure], end = structure + 1 < static_cast<int>(first_.size())
                                              ? first_[structure + 1]
                                              : static_cast<int>(at_rest_.size());
       row < end; ++row)
    if ((row - first_[structure]) % directions < 2) rows.push_back(row);
  return rows;
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

void FloorResponse::complete_accelerations(Eigen::Ref<Eigen::VectorXd> accelerations,
                                           const Eigen::VectorXd& ground) const {
  for (std::size_t r = 0; r < ground_of_.size(); ++r)
    if (ground_of_[r] >= 0) accelerations[static_cast<Eigen::Index>(r)] += ground[ground_of_[r]];
  if (by_difference_.size() > 0) accelerations += by_difference_ * ground;
}

}  // namespace pounding
