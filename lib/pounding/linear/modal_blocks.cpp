/// The modes of each group of a ModalSolver.

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/dense_products.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/structures/damping.hpp>

namespace pounding {
namespace {

// Off-diagonal modal damping below this fraction of the largest entry is round-off.
constexpr double rounding = 1e-11;

MassSplit split_of(const System& system, const Group& group) {
  for (int i = group.first; i < group.first + group.count; ++i)
    if (!(system.mass.coeff(i, i) >= 0)) throw std::invalid_argument("the mass matrix is not positive definite");
  return split_by_mass(system.mass, group.first, group.count);
}

// All natural modes of a group; `mass` is dense, at the dynamic degrees of freedom. Those without mass follow
// statically.
GroupModes natural_modes(const System& system, const Group& group, const Eigen::MatrixXd& mass,
                         const std::vector<int>& dynamic, const std::vector<int>& massless) {
  const int count = static_cast<int>(dynamic.size());
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

int ModalSolver::max_dynamic_dofs(const System& system) {
  std::size_t largest = 0;
  for (const Group& group : system.groups) largest = std::max(largest, split_of(system, group).dynamic.size());
  return static_cast<int>(largest);
}

void ModalSolver::add_natural(const System& system, const Group& group, const Block* equal) {
  const auto [dynamic, massless] = split_of(system, group);
  const Eigen::MatrixXd mass = dense_submatrix(system.mass, dynamic, dynamic, group.first);
  Block block;
  block.modes =
      equal ? equal->modes : std::make_shared<const GroupModes>(natural_modes(system, group, mass, dynamic, massless));
  const auto damping = [&](const std::vector<int>& rows, const std::vector<int>& columns) {
    Eigen::MatrixXd formed = dense_submatrix(system.damping, rows, columns, group.first);
    if (system.modal_damping.size() > 0) formed += dense_submatrix(system.modal_damping, rows, columns, group.first);
    return formed;
  };
  if (!massless.empty() && (!damping(massless, massless).isZero(0) || !damping(massless, dynamic).isZero(0)))
    throw std::invalid_argument("a dashpot acts on an unknown without mass");
  const Eigen::MatrixXd phi = block.shapes()(dynamic, Eigen::all);
  if (equal) {
    block.projection = equal->projection;
  } else if (!block.few()) {
    Projection projection{.by_modes = Eigen::MatrixXd::Zero(phi.cols(), group.count), .by_unknown = {}, .mass = {}};
    projection.by_modes(Eigen::all, dynamic) = phi.transpose() * mass;
    block.projection = std::make_shared<const Projection>(std::move(projection));
  }
  group_masses_.push_back(mass.diagonal().sum());
  block.modal_ratio = system.has_modal_matrix(group) ? 0 : group.modal_ratio;
  add_block(system, group, std::move(block), phi.transpose() * damping(dynamic, dynamic) * phi);
}

void ModalSolver::add_reduced(const System& system, const Group& group, const ReducedGroup& reduced) {
  const std::vector<int> massless = split_of(system, group).massless;
  if (reduced.modes->shapes.rows() != group.count || reduced.modes->shapes.cols() != reduced.modes->squares.size())
    throw std::logic_error("the modes do not belong to this group");
  const SparseMatrix damping = system.damping.block(group.first, group.first, group.count, group.count);
  for (const int i : massless)
    for (SparseMatrix::InnerIterator it(damping, i); it; ++it)
      if (it.value() != 0) throw std::invalid_argument("a dashpot acts on an unknown without mass");
  const SparseMatrix mass = system.mass.block(group.first, group.first, group.count, group.count);
  Block block;
  block.reduced = true;
  block.modal_ratio = group.modal_ratio;
  block.modes = reduced.modes;
  group_masses_.push_back(mass.diagonal().sum());
  const Eigen::Index count = reduced.modes->squares.size();
  const Eigen::MatrixXd rest = damping.nonZeros() == 0
                                   ? Eigen::MatrixXd(Eigen::MatrixXd::Zero(count, count))
                                   : petsc::symmetric_product(block.shapes(), damping * block.shapes());
  add_block(system, group, std::move(block), rest);
}

// `rest` is the damping of the modes without Rayleigh's, and without modal damping that the block has as a ratio.
void ModalSolver::add_block(const System& system, const Group& group, Block block, const Eigen::MatrixXd& rest) {
  if (block.few() && !block.projection) {
    const auto equal = std::ranges::find(blocks_, block.modes, &Block::modes);
    block.projection = equal != blocks_.end()
                           ? equal->projection
                           : std::make_shared<const Projection>(Projection{
                                 .by_modes = {},
                                 .by_unknown = block.shapes().transpose(),
                                 .mass = system.mass.block(group.first, group.first, group.count, group.count)});
  }
  block.first = group.first;
  add_coordinates(group, std::move(block), rest);
  segments_.push_back(
      {blocks_.back().coordinate, blocks_.back().count, static_cast<int>(&group - system.groups.data())});
}

void ModalSolver::add_shadow(const System& system, const Group& group,
                             const std::shared_ptr<const ShadowModes>& shadow) {
  Block& shadowed = *std::ranges::find(blocks_, group.first, &Block::first);
  Block block = shadowed;
  shadowed.shadowed = true;
  block.shadow = shadow;
  block.damping.resize(0, 0);
  const SparseMatrix damping = system.damping.block(group.first, group.first, group.count, group.count);
  const Eigen::Index count = shadow->squares.size();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(count, count);
  if (damping.nonZeros() > 0) {
    const Eigen::MatrixXd shapes = petsc::product(block.shapes(), shadow->in_modes);
    rest = petsc::symmetric_product(shapes, damping * shapes);
  }
  add_coordinates(group, std::move(block), rest);
}

// `rest` as in add_block.
void ModalSolver::add_coordinates(const Group& group, Block block, const Eigen::MatrixXd& rest) {
  const Eigen::VectorXd& squares = block.shadow ? block.shadow->squares : block.modes->squares;
  block.count = static_cast<int>(squares.size());
  block.coordinate = static_cast<int>(stiffness_.size());
  Eigen::VectorXd diagonal = rest.diagonal() + group.by_stiffness * squares;
  diagonal.array() += group.by_mass;
  if (block.modal_ratio > 0) diagonal += 2 * block.modal_ratio * squares.cwiseSqrt();
  Eigen::MatrixXd coupled = rest;
  coupled.diagonal().setZero();
  if (coupled.cwiseAbs().maxCoeff() > rounding * diagonal.cwiseAbs().maxCoeff()) {
    block.damping = rest;
    block.damping.diagonal() = diagonal;
  }
  stiffness_.conservativeResize(block.coordinate + block.count);
  damping_.conservativeResize(block.coordinate + block.count);
  stiffness_.tail(block.count) = squares;
  damping_.tail(block.count) = diagonal;
  blocks_.push_back(std::move(block));
}

}  // namespace pounding
