#include <pounding/linear/modal_solver.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/column_sums.hpp>
#include <pounding/linear/dense_products.hpp>
#include <pounding/linear/equal_groups.hpp>
#include <pounding/structures/damping.hpp>

namespace pounding {
namespace {

// Off-diagonal modal damping below this fraction of the largest entry is round-off.
constexpr double rounding = 1e-11;
// From this number on, Eigen processes the columns of a matrix in pieces that fit in the cache.
constexpr Eigen::Index many_modes = 128;

MassSplit split_of(const System& system, const Group& group) {
  for (int i = group.first; i < group.first + group.count; ++i)
    if (!(system.mass.coeff(i, i) >= 0)) throw std::invalid_argument("the mass matrix is not positive definite");
  return split_by_mass(system.mass, group.first, group.count);
}

// All natural modes of a group; `mass` is dense, on the dynamic degrees of freedom. Massless ones follow statically.
GroupModes natural_modes(const System& system, const Group& group, const Eigen::MatrixXd& mass,
                         const std::vector<int>& dynamic, const std::vector<int>& massless) {
  const int count = static_cast<int>(dynamic.size());
  Eigen::MatrixXd stiffness = dense_submatrix(system.stiffness, dynamic, dynamic, group.first);
  Eigen::MatrixXd recovery;  // massless degrees of freedom from the dynamic ones
  if (!massless.empty()) {
    const Eigen::MatrixXd coupling = dense_submatrix(system.stiffness, massless, dynamic, group.first);
    const Eigen::SimplicialLLT<SparseMatrix> solver(submatrix(system.stiffness, massless, massless, group.first));
    if (solver.info() != Eigen::Success) throw std::invalid_argument("a massless degree of freedom has no stiffness");
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

// y = diag(d) x for the columns of x from `first` on; y overlaps neither.
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

int ModalSolver::max_dynamic_dofs(const System& system) {
  std::size_t largest = 0;
  for (const Group& group : system.groups) largest = std::max(largest, split_of(system, group).dynamic.size());
  return static_cast<int>(largest);
}

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
    throw std::invalid_argument("a dashpot acts on a massless degree of freedom");
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
      if (it.value() != 0) throw std::invalid_argument("a dashpot acts on a massless degree of freedom");
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

// `rest` is the damping in these modes, excluding Rayleigh damping and the modal damping in modal_ratio.
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

void ModalSolver::mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const { y = x; }
void ModalSolver::accelerate(Eigen::Ref<Eigen::VectorXd>) const {}
void ModalSolver::recover(Eigen::Ref<Eigen::VectorXd>) const {}

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

void ModalSolver::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  gap_jacobian_.gather(x, relative);
}
void ModalSolver::gather(std::span<const int> /*links*/, Eigen::Ref<const Eigen::MatrixXd> x,
                         Eigen::MatrixXd& relative) const {
  gap_jacobian_.gather_chosen(x, relative);
}

void ModalSolver::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  gap_jacobian_.add_forces(factor, f, y);
  if (shadow_ > 0) shadow_ends_.add_forces(factor, f, y, counted());
}

void ModalSolver::gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  (shadow_ > 0 ? shadow_ends_ : gap_jacobian_).gather(x, relative);
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

void ModalSolver::observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  outputs_.gather(x, values);
}
void ModalSolver::observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  (shadow_ > 0 ? shadow_outputs_ : outputs_).gather(x, values);
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
