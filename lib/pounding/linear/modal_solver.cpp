#include <pounding/linear/modal_solver.hpp>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/linear/column_sums.hpp>
#include <pounding/linear/equal_groups.hpp>

namespace pounding {
namespace {

// From this number on Eigen goes through the columns of a matrix in pieces, which stay in the cache.
constexpr Eigen::Index many_modes = 128;

// y = diag(d) x from column `first` of x on; y overlaps neither.
void multiply_columns(const Eigen::VectorXd& d, const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Index first,
                      Eigen::Ref<Eigen::MatrixXd>& y) {
  const Eigen::Index n = x.rows(), columns = x.cols() - first;
  const double *factor = d.data(), *from = x.data() + first * x.outerStride();
  double* to = y.data();
  for (Eigen::Index j = 0; j < columns; ++j, from += x.outerStride(), to += y.outerStride())
#pragma GCC ivdep
    for (Eigen::Index i = 0; i < n; ++i) to[i] = factor[i] * from[i];
}

}  // namespace

ModalSolver::ModalSolver(const System& system) : ModalSolver(system, {}) {}

ModalSolver::ModalSolver(const System& system, const std::vector<std::optional<ReducedGroup>>& groups)
    : StructureSolver(system), unknowns_(system.size()) {
  const auto is_reduced = [&](std::size_t k) { return k < groups.size() && groups[k].has_value(); };
  const std::vector<int> equals = first_equal_groups(system);
  // by index of the first equal group: first of its groups that uses all natural modes, -1 for none
  std::vector<int> natural(system.groups.size(), -1);
  blocks_.reserve(2 * system.groups.size());
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (is_reduced(k)) {
      add_reduced(system, system.groups[k], *groups[k]);
      reduced_.push_back(groups[k]->made);
    } else {
      int& before = natural[static_cast<std::size_t>(equals[k])];
      add_natural(system, system.groups[k], before < 0 ? nullptr : &blocks_[static_cast<std::size_t>(before)]);
      if (before < 0) before = static_cast<int>(k);
    }
  const int counted = static_cast<int>(stiffness_.size());
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k] && groups[k]->shadow) add_shadow(system, system.groups[k], groups[k]->shadow);
  const int n = static_cast<int>(stiffness_.size());
  shadow_ = n - counted;
  for (const Block& block : blocks_) classical_ = classical_ && block.damping.size() == 0;
  if (!classical_) {
    for (Block& block : blocks_)
      if (block.damping.size() == 0)
        block.damping = Eigen::MatrixXd(damping_.segment(block.coordinate, block.count).asDiagonal());
    factors_.resize(blocks_.size());
  }
  if (n == unknowns_ &&
      std::all_of(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.shapes().size() == 1; })) {
    single_.resize(n);
    for (const Block& block : blocks_) single_[block.first] = block.shapes()(0, 0);
  }
  load_.resize(n, system.load.cols());
  weights_ = Eigen::VectorXd::Ones(n);
  weights_.tail(shadow_).setZero();
  inverse_.resize(n);
  for (const Block& block : blocks_)
    for (Eigen::Index j = 0; j < load_.cols(); ++j) {
      const Eigen::VectorXd by_run =
          block.shapes().transpose() * system.load.col(j).segment(block.first, block.unknowns());
      load_.col(j).segment(block.coordinate, block.count) = block.of_modes(by_run);
    }
  gap_jacobian_ = columns_of_links(system, false);
  outputs_ = columns_of_outputs(system, false);
  if (shadow_ == 0) return;
  shadow_ends_ = columns_of_links(system, true);
  shadow_outputs_ = columns_of_outputs(system, true);
}

// Columns in the physical blocks, or in the shadow and the blocks without one. `column_of(block, j, entries)` computes
// column j in the modes of a block from its nonzero entries (unknown of the block, value).
template <class Column>
LinkColumns ModalSolver::columns_of(const SparseMatrix& matrix, bool shadow, const Column& column_of) const {
  LinkColumns made(static_cast<int>(matrix.cols()));
  for (const Block& block : blocks_) {
    if (shadow ? block.shadowed : block.shadow != nullptr) continue;
    std::vector<int> own;
    std::vector<Eigen::VectorXd> columns;
    std::vector<Entry> entries;
    for (int j = 0; j < matrix.cols(); ++j) {
      entries.clear();
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
        if (it.row() >= block.first && it.row() < block.first + block.unknowns() && it.value() != 0)
          entries.emplace_back(static_cast<int>(it.row()) - block.first, it.value());
      if (entries.empty()) continue;
      own.push_back(j);
      columns.push_back(column_of(block, j, entries));
    }
    Eigen::MatrixXd by_mode(block.shapes().cols(), static_cast<Eigen::Index>(own.size()));
    for (std::size_t i = 0; i < own.size(); ++i) by_mode.col(static_cast<Eigen::Index>(i)) = columns[i];
    made.add_block(block.coordinate, std::move(own), block.of_modes(std::move(by_mode)));
  }
  return made;
}

Eigen::VectorXd ModalSolver::sum_of_shapes(const Block& block, const std::vector<Entry>& entries) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(block.shapes().cols());
  for (const auto& [unknown, value] : entries) sum += value * block.shapes().row(unknown).transpose();
  return sum;
}

LinkColumns ModalSolver::columns_of_links(const System& system, bool shadow) const {
  return columns_of(
      system.gap_jacobian, shadow,
      [&](const Block& block, int i, const std::vector<Entry>& entries) -> Eigen::VectorXd {
        for (const auto& [unknown, value] : entries)
          if (const int at = block.first + unknown; !is_spring(system, i) && !(system.mass.coeff(at, at) > 0))
            throw std::invalid_argument(fmt::format("link {} acts on massless degree of freedom {}", i, at));
        if (block.few()) return sum_of_shapes(block, entries);
        Eigen::VectorXd part = Eigen::VectorXd::Zero(block.unknowns());
        for (const auto& [unknown, value] : entries) part[unknown] = value;
        return block.shapes().transpose() * part;
      });
}

LinkColumns ModalSolver::columns_of_outputs(const System& system, bool shadow) const {
  return columns_of(system.outputs, shadow, [](const Block& block, int, const std::vector<Entry>& entries) {
    return sum_of_shapes(block, entries);
  });
}

void ModalSolver::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  multiply_columns(stiffness_, x, 0, y);
}

void ModalSolver::stiffness_and_damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> kx,
                                              Eigen::Ref<Eigen::MatrixXd> cx) const {
  multiply_columns(stiffness_, x, 0, kx);
  const Eigen::Index first = x.cols() - cx.cols();
  if (classical_) return multiply_columns(damping_, x, first, cx);
  for (const Block& block : blocks_) {
    const Eigen::Index count = block.damping.rows();
    cx.middleRows(block.coordinate, count).noalias() =
        block.damping * x.block(block.coordinate, first, count, cx.cols());
  }
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
    auto part = x.segment(blocks_[b].coordinate, blocks_[b].damping.rows());
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
  const bool others = gap_jacobian_.choose(links);
  if (shadow_ > 0) shadow_ends_.choose(links);
  if (std::exchange(has_flexibility_, true) && !others) return true;
  if (classical_)
    gap_jacobian_.flexibility(inverse_, g);
  else
    gap_jacobian_.flexibility(solve_block(), g);
  return true;
}

void ModalSolver::add_response(double factor, std::span<const int> /*links*/, const Eigen::VectorXd& f,
                               Eigen::Ref<Eigen::VectorXd> y) const {
  const auto add = [&](const LinkColumns& columns, int from) {
    if (classical_)
      columns.add_response(factor, f, inverse_, y, from);
    else
      columns.add_response(factor, f, solve_block(), y, from);
  };
  add(gap_jacobian_, 0);
  if (shadow_ > 0) add(shadow_ends_, counted());
}

void ModalSolver::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  gap_jacobian_.add_forces(factor, f, y);
  if (shadow_ > 0) shadow_ends_.add_forces(factor, f, y, counted());
}

void ModalSolver::add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  for (const Block& block : blocks_) {
    auto to = y.segment(block.coordinate, block.count);
    const auto from = f.segment(block.first, block.unknowns());
    if (block.shadow)
      to += block.shadow->in_modes.transpose() * (block.shapes().transpose() * from);
    else
      to.noalias() += block.shapes().transpose() * from;
  }
}

Eigen::VectorXd ModalSolver::coordinates(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x(stiffness_.size());
  for (const Block& block : blocks_) {
    const auto own = u.segment(block.first, block.unknowns());
    const Projection& projection = *block.projection;
    const Eigen::VectorXd by_run = block.few() ? Eigen::VectorXd(projection.by_unknown * (projection.mass * own))
                                               : Eigen::VectorXd(projection.by_modes * own);
    x.segment(block.coordinate, block.count) = block.of_modes(by_run);
  }
  return x;
}

void ModalSolver::Block::displace(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> u) const {
  const Eigen::Index rows = unknowns();
  if (few()) {
    const Eigen::MatrixXd own = x.middleRows(coordinate, count).transpose();
    const Eigen::Index all = own.cols();
    auto to = u.middleCols(first, rows);
    to.setZero();
    add_products({own.data(), own.rows(), all, own.rows()}, {projection->by_unknown.data(), all, rows, all}, to.data(),
                 u.outerStride());
    return;
  }
  Eigen::VectorXd one(rows);
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    displace_one(x.col(j), one);
    u.row(j).segment(first, rows) = one;
  }
}

void ModalSolver::Block::displace_one(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> u) const {
  if (count < many_modes)
    sum_columns(shapes(), x.data() + coordinate, u.data());
  else
    u.noalias() = shapes() * x.segment(coordinate, count);
}

void ModalSolver::physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const {
  u.resize(unknowns_);
  if (single_.size() > 0) {
    for (Eigen::Index i = 0; i < single_.size(); ++i) u[i] = single_[i] * x[i];
    return;
  }
  for (const Block& block : blocks_) {
    if (block.shadow) continue;
    if (block.few())
      block.displace(x, Eigen::Map<Eigen::MatrixXd>(u.data(), 1, unknowns_));
    else
      block.displace_one(x, u.segment(block.first, block.unknowns()));
  }
}

void ModalSolver::physical_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const {
  if (single_.size() > 0) return StructureSolver::physical_of_columns(x, u);
  u.resize(x.cols(), unknowns_);
  for (const Block& block : blocks_)
    if (!block.shadow) block.displace(x, u);
}

void ModalSolver::as_shadow(const Eigen::MatrixXd& x, Eigen::MatrixXd& y) const {
  y = x;
  for (const Block& block : blocks_) {
    if (!block.shadow) continue;
    const Block& run = *std::ranges::find(blocks_, block.first, &Block::first);
    y.middleRows(run.coordinate, run.count) =
        summed_product(block.shadow->in_modes, x.middleRows(block.coordinate, block.count));
  }
}

std::optional<StructureSolver::FewModes> ModalSolver::few_modes(int group) const {
  const Block& block = blocks_[group];
  if (!block.few()) return std::nullopt;
  return FewModes{block.shapes(), block.coordinate};
}

std::string ModalSolver::description() const {
  if (!reduced_.empty()) {
    std::string text = fmt::format("{} coordinates for {} unknowns, {}", counted(), unknowns_,
                                   classical_ ? "decoupled" : "coupled by the damping");
    for (const ReducedStructure& each : reduced_) text += "; " + each.size_text();
    return text;
  }
  return classical_ ? fmt::format("all {} modes of {} unknowns, decoupled", stiffness_.size(), unknowns_)
                    : fmt::format("all {} modes of {} unknowns, coupled by the damping, {} factorizations",
                                  stiffness_.size(), unknowns_, factorizations_);
}

}  // namespace pounding
