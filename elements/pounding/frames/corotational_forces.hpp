#pragma once
/// Elastic forces of a corotational frame relative to its state at rest.

#include <memory>

#include <pounding/frames/corotational.hpp>
#include <pounding/structures/elastic_forces.hpp>

namespace pounding {

/// Displacements u are relative to those at rest; loads at rest are constant and included in the energy.
class CorotationalForces final : public ElasticForces {
 public:
  /// State at rest under `load` (n), which may be zero. Throws std::invalid_argument with the critical load fraction if
  /// the whole load has no stable equilibrium, and if the frame is unsupported, like StaticSolver.
  CorotationalForces(std::shared_ptr<const CorotationalFrame> frame, const Eigen::VectorXd& load);

  /// Displacements from the undeformed state.
  const Eigen::VectorXd& at_rest() const override { return rest_; }
  Eigen::SparseMatrix<double> stiffness() const { return frame_->tangent(rest_); }

  double energy(const Eigen::VectorXd& u) const override;
  Eigen::VectorXd force(const Eigen::VectorXd& u) const override { return frame_->force(rest_ + u) - force_; }
  Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& u) const override { return frame_->tangent(rest_ + u); }

 private:
  std::shared_ptr<const CorotationalFrame> frame_;
  Eigen::VectorXd rest_, force_;
  double energy_;
};

}  // namespace pounding
