#include <pounding/pushover/static_yielding.hpp>

#include <stdexcept>

#include <pounding/frames/static_solver.hpp>

namespace pounding {
namespace {

constexpr double rounding = 1e-12;

SparseMatrix deformation_columns(const Structure& s) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < s.yielding.size(); ++j)
    for (Row::InnerIterator it(s.yielding[j].deformation); it; ++it)
      entries.emplace_back(static_cast<int>(it.index()), static_cast<int>(j), it.value());
  return sparse_matrix(s.size(), static_cast<int>(s.yielding.size()), entries);
}

}  // namespace

StaticYielding::StaticYielding(const Structure& s, const Eigen::VectorXd& load, const Row& control,
                               const Eigen::MatrixXd& follow)
    : at_rest_(static_cast<Eigen::Index>(s.yielding.size())) {
  StaticSolver solver(s.stiffness);
  if (!solver.holds())
    throw std::invalid_argument(solver.buckles() ? "it buckles under gravity" : "it has no supports");
  const SparseMatrix columns = deformation_columns(s);
  const Eigen::VectorXd loaded = solver.solve(load);
  const Eigen::MatrixXd by_parts = solver.solve(Eigen::MatrixXd(columns));
  by_load_ = control.dot(loaded);
  if (!(by_load_ > rounding * loaded.cwiseAbs().maxCoeff()))
    throw std::invalid_argument("the load does not move the controlled displacement in its positive direction");
  for (Eigen::Index j = 0; j < at_rest_.size(); ++j) at_rest_[j] = s.yielding[static_cast<std::size_t>(j)].at_rest;
  by_displacement_ = columns.transpose() * loaded / by_load_;
  held_ = by_parts.transpose() * control;
  flexibility_ = columns.transpose() * by_parts - by_displacement_ * held_.transpose();
  if (s.yielding_flexibility.size() > 0) flexibility_ += s.yielding_flexibility;
  if (follow.size() == 0) {
    followed_by_parts_.resize(0, at_rest_.size());
    return;
  }
  followed_by_load_ = follow * loaded;
  followed_by_parts_ = follow * by_parts;
}

Eigen::VectorXd StaticYielding::deformations(double displacement, const Eigen::VectorXd& forces) const {
  return at_rest_ + displacement * by_displacement_ - flexibility_ * forces;
}

double StaticYielding::factor(double displacement, const Eigen::VectorXd& forces) const {
  return (displacement + held_.dot(forces)) / by_load_;
}

Eigen::VectorXd StaticYielding::followed(double displacement, const Eigen::VectorXd& forces) const {
  return factor(displacement, forces) * followed_by_load_ - followed_by_parts_ * forces;
}

}  // namespace pounding
