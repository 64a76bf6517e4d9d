#pragma once
/// A column of fibre members in statics: fixed base, loads and prescribed displacements at the tip.

#include <Eigen/LU>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/fibre_member.hpp>

namespace pounding::test {

/// Members along global z from the origin; in space along x. One Newton iteration for displacements, basic forces and
/// section deformations together, as in the product.
class FibreColumn {
 public:
  /// In the plane dofs ux, uz, ry of each node; in space all six.
  FibreColumn(std::shared_ptr<const sections::FibreSection> section, const FibreMemberOptions& options, double height,
              int parts, int dimension, const BeamOptions& orientation = {})
      : dofs_(dimension == 2 ? std::vector<int>{0, 2, 4} : std::vector<int>{0, 1, 2, 3, 4, 5}), parts_(parts) {
    const Eigen::Vector3d axis = dimension == 2 ? Eigen::Vector3d(0, 0, height) : Eigen::Vector3d(height, 0, 0);
    for (int i = 0; i < parts; ++i) {
      members_.emplace_back(axis * i / parts, axis * (i + 1) / parts, orientation, section, options, dimension);
      states_.push_back(members_.back().undeformed());
    }
    iterates_.resize(members_.size());
    u_ = Eigen::VectorXd::Zero(6 * (parts + 1));
    load_ = Eigen::VectorXd::Zero(6 * (parts + 1));
  }

  /// Load at the tip.
  void set_load(Dof dof, double force) { load_[tip(dof)] = force; }
  int tip(Dof dof) const { return 6 * parts_ + static_cast<int>(dof); }
  /// Equilibrium with these displacements of the tip, accepted as the end of a step. Returns the reactions to them.
  std::vector<double> step(const std::vector<std::pair<Dof, double>>& prescribed = {}, int max_iterations = 60) {
    std::vector<int> free;
    for (int node = 1; node <= parts_; ++node)
      for (const int dof : dofs_) free.push_back(6 * node + dof);
    for (const auto& [dof, value] : prescribed) {
      u_[tip(dof)] = value;
      std::erase(free, tip(dof));
    }
    for (std::size_t m = 0; m < members_.size(); ++m) members_[m].begin(states_[m], iterates_[m]);
    changes.clear();
    for (int i = 0;; ++i) {
      const double strain = assemble();
      const Eigen::VectorXd residual = (load_ - force_)(free);
      const Eigen::VectorXd du = tangent_(free, free).partialPivLu().solve(residual);
      const double change = std::max(du.size() > 0 ? du.cwiseAbs().maxCoeff() : 0.0, i > 0 ? strain : 1.0);
      changes.push_back(change);
      if (change < 1e-13) break;
      if (i == max_iterations) throw std::runtime_error("no equilibrium: " + std::to_string(change));
      u_(free) += du;
    }
    for (std::size_t m = 0; m < members_.size(); ++m) members_[m].accept(states_[m], iterates_[m], 0);
    std::vector<double> reactions;
    for (const auto& [dof, value] : prescribed) reactions.push_back(force_[tip(dof)] - load_[tip(dof)]);
    return reactions;
  }
  /// Applies the load in ten steps.
  void apply_load() {
    const Eigen::VectorXd all = load_;
    for (int i = 1; i <= 10; ++i) {
      load_ = all * i / 10;
      step();
    }
  }

  const Eigen::VectorXd& displacements() const { return u_; }
  const Eigen::VectorXd& forces() const { return force_; }
  const std::vector<FibreMember>& members() const { return members_; }
  std::vector<FibreMember::State>& states() { return states_; }
  double stored() const {
    double sum = 0;
    for (std::size_t m = 0; m < members_.size(); ++m)
      sum += members_[m].stored(states_[m]) + members_[m].potential(u_.segment<12>(6 * static_cast<int>(m)));
    return sum;
  }
  double dissipated() const {
    double sum = 0;
    for (std::size_t m = 0; m < members_.size(); ++m) sum += members_[m].dissipated(states_[m]);
    return sum;
  }

  std::vector<double> changes;  ///< of displacements and strains in the iterations of the last step

 private:
  double assemble() {
    force_ = Eigen::VectorXd::Zero(u_.size());
    tangent_ = Eigen::MatrixXd::Zero(u_.size(), u_.size());
    double strain = 0;
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const int first = 6 * static_cast<int>(m);
      Vector12 f;
      Matrix12 k;
      strain = std::max(strain, members_[m].linearize(states_[m], iterates_[m], u_.segment<12>(first), f, k));
      force_.segment<12>(first) += f;
      tangent_.block<12, 12>(first, first) += k;
    }
    return strain;
  }

  std::vector<int> dofs_;
  int parts_;
  std::vector<FibreMember> members_;
  std::vector<FibreMember::State> states_;
  std::vector<FibreMember::Iterate> iterates_;
  Eigen::VectorXd u_, load_, force_;
  Eigen::MatrixXd tangent_;
};

}  // namespace pounding::test
