#include <pounding/linear/modal_solver.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/linear/column_sums.hpp>
#include <pounding/linear/dense_products.hpp>
#include <pounding/model/reducible.hpp>

namespace pounding {
namespace {

// Off-diagonal modal damping below this fraction of the largest entry is round-off.
constexpr double rounding = 1e-11;

// y = diag(d) x; y and x do not overlap.
void multiply_columns(const Eigen::VectorXd& d, const Eigen::Ref<const Eigen::MatrixXd>& x,
                      Eigen::Ref<Eigen::MatrixXd>& y) {
  const Eigen::Index n = x.rows();
  const double *factor = d.data(), *from = x.data();
  double* to = y.data();
  for (Eigen::Index j = 0; j < x.cols(); ++j, from += x.outerStride(), to += y.outerStride())
#pragma GCC ivdep
    for (Eigen::Index i = 0; i < n; ++i) to[i] = factor[i] * from[i];
}

void refuse_massless_ends(const System& system) {
  for (int i = 0; i < system.links(); ++i)
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it && !is_spring(system, i); ++it)
      if (it.value() != 0 && !(system.mass.coeff(it.row(), it.row()) > 0))
        throw std::invalid_argument(fmt::format("link {} acts on massless degree of freedom {}", i, it.row()));
}

}  // namespace

int ModalSolver::max_dynamic_dofs(const System& system) {
  std::size_t largest = 0;
  for (const Group& group : system.groups) largest = std::max(largest, split_of(system, group).dynamic.size());
  return static_cast<int>(largest);
}

ModalSolver::ModalSolver(const System& system, const ReducedGroups& bases, const ModalOptions& options)
    : StructureSolver(system), mass_(system.mass) {
  refuse_massless_ends(system);
  std::vector<int> groups(system.groups.size());
  std::iota(groups.begin(), groups.end(), 0);
  NaturalModes own;
  NaturalModes& natural = options.natural ? *options.natural : own;
  layout_.group_masses.assign(groups.size(), 0.0);
  for (const int k : options.groups.value_or(groups)) {
    const auto at = static_cast<std::size_t>(k);
    add_block(system, k, at < bases.size() && bases[at] ? &*bases[at] : nullptr, natural);
  }
  for (const Block& block : blocks_) classical_ = classical_ && block.damping.size() == 0;
  if (!classical_) {
    for (Block& block : blocks_)
      if (block.damping.size() == 0)
        block.damping = Eigen::MatrixXd(damping_.segment(block.coordinate, block.count()).asDiagonal());
    factors_.resize(blocks_.size());
    layout_.step_lengths = StepLengths::prefers_dyadic;
  }
  const Eigen::Index n = stiffness_.size();
  layout_.weights = Eigen::VectorXd::Ones(n);
  layout_.load.resize(n, system.load.cols());
  for (const Block& block : blocks_)
    for (Eigen::Index j = 0; j < system.load.cols(); ++j)
      layout_.load.col(j).segment(block.coordinate, block.count()) =
          block.shapes().transpose() * system.load.col(j).segment(block.first, block.unknowns());
  inverse_.resize(n);
  gap_jacobian_ = columns_of(system.gap_jacobian);
  outputs_ = columns_of(system.outputs);
}

// In all natural modes without a basis.
void ModalSolver::add_block(const System& system, int k, const ReducedGroup* basis, NaturalModes& natural) {
  const Group& group = system.groups[static_cast<std::size_t>(k)];
  const std::vector<int> massless = split_of(system, group).massless;
  Block block{.first = group.first,
              .coordinate = static_cast<int>(stiffness_.size()),
              .modes = basis ? basis->modes : natural.of(system, group),
              .damping = {}};
  const Eigen::VectorXd& squares = block.modes->squares;
  const auto count = static_cast<int>(squares.size());
  if (block.unknowns() != group.count || block.count() != count)
    throw std::logic_error("the modes do not belong to this group");
  const auto own = [&](const SparseMatrix& matrix) -> SparseMatrix {
    return matrix.block(group.first, group.first, group.count, group.count);
  };
  SparseMatrix damping = own(system.damping);
  const bool by_matrix = !basis && system.has_modal_matrix(group);
  if (by_matrix) damping += own(system.modal_damping);
  for (const int i : massless)
    for (SparseMatrix::InnerIterator it(damping, i); it; ++it)
      if (it.value() != 0) throw std::invalid_argument("a dashpot acts on an unknown without mass");
  // Of these modes, without Rayleigh damping and without modal damping given as a ratio.
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(count, count);
  if (damping.nonZeros() > 0) rest = petsc::symmetric_product(block.shapes(), damping * block.shapes());
  Eigen::VectorXd diagonal = rest.diagonal() + group.by_stiffness * squares;
  diagonal.array() += group.by_mass;
  if (!by_matrix && group.modal_ratio > 0) diagonal += 2 * group.modal_ratio * squares.cwiseSqrt();
  Eigen::MatrixXd coupled = rest;
  coupled.diagonal().setZero();
  if (coupled.cwiseAbs().maxCoeff() > rounding * diagonal.cwiseAbs().maxCoeff()) {
    block.damping = std::move(rest);
    block.damping.diagonal() = diagonal;
  }
  stiffness_.conservativeResize(block.coordinate + count);
  damping_.conservativeResize(block.coordinate + count);
  stiffness_.tail(count) = squares;
  damping_.tail(count) = diagonal;
  const bool few = basis || count > small_structure;
  layout_.segments.push_back({block.coordinate, count, k, few ? block.modes : nullptr});
  layout_.group_masses[static_cast<std::size_t>(k)] = own(system.mass).diagonal().sum();
  if (basis) layout_.reduced.push_back(basis->made);
  blocks_.push_back(std::move(block));
}

LinkColumns ModalSolver::columns_of(const SparseMatrix& matrix) const {
  LinkColumns made(static_cast<int>(matrix.cols()));
  for (const Block& block : blocks_) {
    std::vector<int> own;
    std::vector<Eigen::VectorXd> columns;
    for (int j = 0; j < matrix.cols(); ++j) {
      Eigen::VectorXd sum;
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
        const Eigen::Index unknown = it.row() - block.first;
        if (unknown < 0 || unknown >= block.unknowns() || it.value() == 0) continue;
        if (sum.size() == 0) sum.setZero(block.count());
        sum += it.value() * block.shapes().row(unknown).transpose();
      }
      if (sum.size() == 0) continue;
      own.push_back(j);
      columns.push_back(std::move(sum));
    }
    Eigen::MatrixXd by_mode(block.count(), static_cast<Eigen::Index>(own.size()));
    for (std::size_t i = 0; i < own.size(); ++i) by_mode.col(static_cast<Eigen::Index>(i)) = columns[i];
    made.add_block(block.coordinate, std::move(own), std::move(by_mode));
  }
  return made;
}

Eigen::VectorXd ModalSolver::coordinates(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x(stiffness_.size());
  const Eigen::VectorXd momentum = mass_ * u;
  for (const Block& block : blocks_)
    x.segment(block.coordinate, block.count()) =
        block.shapes().transpose() * momentum.segment(block.first, block.unknowns());
  return x;
}

Eigen::MatrixXd ModalSolver::physical(Eigen::Ref<const Eigen::MatrixXd> x) const {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(mass_.rows(), x.cols());
  for (const Block& block : blocks_)
    add_products({block.shapes().data(), block.unknowns(), block.count(), block.unknowns()},
                 {x.data() + block.coordinate, block.count(), x.cols(), x.outerStride()}, u.data() + block.first,
                 u.rows());
  return u;
}

void ModalSolver::add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  for (const Block& block : blocks_)
    y.segment(block.coordinate, block.count()).noalias() +=
        block.shapes().transpose() * f.segment(block.first, block.unknowns());
}

void ModalSolver::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  multiply_columns(stiffness_, x, y);
}

void ModalSolver::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> /*kx*/,
                                Eigen::Ref<Eigen::MatrixXd> y) const {
  if (classical_) return multiply_columns(damping_, x, y);
  for (const Block& block : blocks_)
    y.middleRows(block.coordinate, block.count()).noalias() =
        block.damping * x.middleRows(block.coordinate, block.count());
}

void ModalSolver::set_matrix(const EffectiveMatrix& s, const std::optional<int>& /*step_level*/) {
  if (s == matrix_) return;
  matrix_ = s;
  has_flexibility_ = false;
  if (classical_) {
    const Eigen::Index n = stiffness_.size();
    for (Eigen::Index i = 0; i < n; ++i)
      inverse_[i] = 1 / (s.mass + s.damping * damping_[i] + s.stiffness * stiffness_[i]);
    return;
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    Eigen::MatrixXd a = s.damping * block.damping;
    a.diagonal() += s.stiffness * stiffness_.segment(block.coordinate, a.rows());
    a.diagonal().array() += s.mass;
    factors_[b].compute(a);
  }
  ++factorizations_;
}

bool ModalSolver::solve(Eigen::Ref<Eigen::VectorXd> x) {
  if (classical_) {
    const Eigen::Index n = x.size();
    const double* const inverse = inverse_.data();
    double* const to = x.data();
#pragma GCC ivdep
    for (Eigen::Index i = 0; i < n; ++i) to[i] *= inverse[i];
    return true;
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    auto part = x.segment(blocks_[b].coordinate, blocks_[b].count());
    factors_[b].solveInPlace(part);
  }
  return true;
}

// For coupled modes, in which each block has a factor.
LinkColumns::Solve ModalSolver::solve_block() const {
  return [this](int first, Eigen::VectorXd& column) {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (blocks_[b].coordinate == first) factors_[b].solveInPlace(column);
  };
}

bool ModalSolver::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  select(links);
  if (std::exchange(has_flexibility_, true)) return true;
  if (classical_)
    gap_jacobian_.flexibility(inverse_, g);
  else
    gap_jacobian_.flexibility(solve_block(), g);
  return true;
}

void ModalSolver::add_response(double factor, std::span<const int> /*links*/, const Eigen::VectorXd& f,
                               Eigen::Ref<Eigen::VectorXd> y) const {
  if (classical_)
    gap_jacobian_.add_response(factor, f, inverse_, y);
  else
    gap_jacobian_.add_response(factor, f, solve_block(), y);
}

std::string ModalSolver::description() const {
  const char* const damping = classical_ ? "decoupled" : "coupled by the damping";
  if (layout_.reduced.empty()) {
    std::string text = fmt::format("all {} modes of {} unknowns, {}", stiffness_.size(), mass_.rows(), damping);
    return classical_ ? text : text + fmt::format(", {} factorizations", factorizations_);
  }
  std::string text = fmt::format("{} coordinates for {} unknowns, {}", stiffness_.size(), mass_.rows(), damping);
  for (const ReducedStructure& each : layout_.reduced) text += "; " + each.size_text();
  return text;
}

}  // namespace pounding
