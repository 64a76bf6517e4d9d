#include <pounding/frames/frame.hpp>

#include <algorithm>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/frames/frame_dofs.hpp>

namespace pounding {

using namespace frame_dofs;

Frame::Reactions Frame::reactions(const std::vector<int>& nodes, const AssembledFrame& assembled, bool gravity,
                                  bool with_members) const {
  const int all = this->nodes() * dofs(), rows = static_cast<int>(nodes.size()) * dofs();
  // Forces on nodes tied to a fixed one are transmitted to the ground through it.
  const Eigen::SparseMatrix<double, Eigen::RowMajor> to_ground = assembled.supported.transpose();
  Entries gathering, by_springs;
  for (int row = 0; row < rows; ++row) {
    const int at = nodes[row / dofs()] * dofs() + row % dofs();
    if (fixed_.contains(at)) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(to_ground, at); it; ++it)
        gathering.emplace_back(row, it.col(), it.value());
      continue;
    }
    for (const auto& [of, stiffness] : ground_springs_)
      if (of == at) by_springs.emplace_back(row, at, -stiffness);
  }
  Reactions made;
  made.nodes = nodes;
  made.by_forces.resize(rows, all);
  made.by_forces.setFromTriplets(gathering.begin(), gathering.end());
  Eigen::SparseMatrix<double, Eigen::RowMajor> springs(rows, all);
  springs.setFromTriplets(by_springs.begin(), by_springs.end());
  Eigen::SparseMatrix<double> stiffness(all, all);
  if (with_members)
    stiffness = gathered(springs_, &Beam::stiffness);
  else
    stiffness.setFromTriplets(springs_.begin(), springs_.end());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> gathered_stiffness =
      made.by_forces * Eigen::SparseMatrix<double, Eigen::RowMajor>(stiffness);
  made.by_displacements = gathered_stiffness + springs;
  Eigen::VectorXd load = loads();
  if (gravity) {
    Eigen::VectorXd down = Eigen::VectorXd::Zero(all);
    for (int node = 0; node < this->nodes(); ++node) down[index(node, Dof::uz)] = -standard_gravity;
    load += gathered(masses_, &Beam::mass) * down;
  }
  made.at_rest = -(made.by_forces * load);
  return made;
}

Eigen::MatrixX3d Frame::enforced_reactions(const Reactions& reactions, const std::vector<int>& supports,
                                           const Eigen::MatrixX3d& enforced) const {
  Eigen::MatrixX3d forces = reactions.by_displacements * enforced;
  for (std::size_t i = 0; i < reactions.nodes.size(); ++i) {
    if (std::find(supports.begin(), supports.end(), reactions.nodes[i]) == supports.end()) continue;
    for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz}) {
      const int at = place(dimension_, dof);
      if (at < 0 || fixed_.contains(index(reactions.nodes[i], dof))) continue;
      for (const auto& [of, stiffness] : ground_springs_)
        if (of == index(reactions.nodes[i], dof))
          forces(static_cast<int>(i) * dofs() + at, static_cast<int>(dof)) += stiffness;
    }
  }
  return forces;
}

}  // namespace pounding
