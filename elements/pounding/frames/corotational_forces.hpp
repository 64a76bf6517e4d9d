#pragma once
/// A corotational frame about its state at rest.

#include <memory>

#include <pounding/frames/corotational.hpp>
#include <pounding/structures/elastic_forces.hpp>

namespace pounding {

/// Displacements u are beside those at rest; what acts at rest is constant and in the energy.
class CorotationalForces final : public ElasticForces {
 public:
  /// At rest under `load` (n), which may be zero. Throws std::invalid_argument with the part of the load that the frame
  /// carries where it has no stable equilibrium under the whole, and as StaticSolver where nothing holds it.
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
