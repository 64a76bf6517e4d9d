#include <pounding/linear/natural_modes.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/equal_groups.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/structures/damping.hpp>

namespace pounding {
namespace {

// Those without mass follow statically.
GroupModes natural_modes(const System& system, const Group& group) {
  const auto [dynamic, massless] = split_of(system, group);
  const int count = static_cast<int>(dynamic.size());
  const Eigen::MatrixXd mass = dense_submatrix(system.mass, dynamic, dynamic, group.first);
  Eigen::MatrixXd stiffness = dense_submatrix(system.stiffness, dynamic, dynamic, group.first);
  Eigen::MatrixXd recovery;  // of the massless degrees of freedom from the dynamic ones
  if (!massless.empty()) {
    const Eigen::MatrixXd coupling = dense_submatrix(system.stiffness, massless, dynamic, group.first);
    const Eigen::SimplicialLLT<SparseMatrix> solver(submatrix(system.stiffness, massless, massless, group.first));
    if (solver.info() != Eigen::Success)
      throw std::invalid_argument("the stiffness of the massless degrees of freedom is singular; fix or connect them");
    recovery = -solver.solve(coupling);
    stiffness += coupling.transpose() * recovery;
    stiffness = 0.5 * (stiffness + stiffness.transpose().eval());
  }
  const auto [values, phi] = count > small_structure ? petsc::all_modes(mass, stiffness) : eigenpairs(mass, stiffness);
  GroupModes modes{.shapes = Eigen::MatrixXd::Zero(group.count, count), .squares = values.cwiseMax(0)};
  modes.shapes(dynamic, Eigen::all) = phi;
  if (recovery.size() > 0) modes.shapes(massless, Eigen::all) = recovery * phi;
  modes.squares.head(std::min<Eigen::Index>(group.rigid_motions, count)).setZero();
  return modes;
}

}  // namespace

MassSplit split_of(const System& system, const Group& group) {
  for (int i = group.first; i < group.first + group.count; ++i)
    if (!(system.mass.coeff(i, i) >= 0)) throw std::invalid_argument("the mass matrix is not positive definite");
  return split_by_mass(system.mass, group.first, group.count);
}

std::shared_ptr<const GroupModes> NaturalModes::of(const System& system, const Group& group) {
  for (const Structure& known : structures_)
    if (known.mass.rows() == group.count && known.rigid_motions == group.rigid_motions &&
        equal_blocks(known.mass, 0, system.mass, group.first, group.count) &&
        equal_blocks(known.stiffness, 0, system.stiffness, group.first, group.count))
      return known.modes;
  const auto block = [&](const SparseMatrix& matrix) -> SparseMatrix {
    return matrix.block(group.first, group.first, group.count, group.count);
  };
  structures_.push_back({block(system.mass), block(system.stiffness), group.rigid_motions,
                         std::make_shared<const GroupModes>(natural_modes(system, group))});
  return structures_.back().modes;
}

}  // namespace pounding
