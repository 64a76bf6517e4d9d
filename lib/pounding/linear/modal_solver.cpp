#include <pounding/linear/modal_solver.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/column_sums.hpp>
#include <pounding/structures/damping.hpp>

namespace pounding {
namespace {

// Off-diagonal modal damping below this fraction of the largest entry is round-off.
constexpr double rounding = 1e-11;
// From this number on Eigen goes through the columns of a matrix in pieces, which stay in the cache.
constexpr Eigen::Index many_modes = 128;

MassSplit split_of(const System& system, const Group& group) {
  for (int i = group.first; i < group.first + group.count; ++i)
    if (!(system.mass.coeff(i, i) >= 0)) throw std::invalid_argument("the mass matrix is not positive definite");
  return split_by_mass(system.mass, group.first, group.count);
}

// y = diag(d) x from column `first` of x on; y overlaps neither.
void multiply_columns(const Eigen::VectorXd& d, const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Index first, Eigen::Ref<Eigen::MatrixXd>& y) {
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
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (k < groups.size() && groups[k]) {
      add_reduced(system, system.groups[k], groups[k]->modes, false);
      reduced_.push_back(groups[k]->made);
    } else {
      add_natural(system, system.groups[k]);
    }
  const int counted = static_cast<int>(stiffness_.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (!groups[k] || !groups[k]->shadow) continue;
    blocks_[k].shadowed = true;
    add_reduced(system, system.groups[k], *groups[k]->shadow, true);
  }
  const int n = static_cast<int>(stiffness_.size());
  shadow_ = n - counted;
  for (const Block& block : blocks_) classical_ = classical_ && block.damping.size() == 0;
  if (!classical_) {
    for (Block& block : blocks_)
      if (block.damping.size() == 0) {
        const int count = static_cast<int>(block.shapes.cols());
        block.damping = Eigen::MatrixXd(damping_.segment(block.coordinate, count).asDiagonal());
      }
    factors_.resize(blocks_.size());
  }
  if (n == unknowns_ && std::all_of(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.shapes.size() == 1; })) {
    single_.resize(n);
    for (const Block& block : blocks_) single_[block.first] = block.shapes(0, 0);
  }
  load_.resize(n, system.load.cols());
  weights_ = Eigen::VectorXd::Ones(n);
  weights_.tail(shadow_).setZero();
  inverse_.resize(n);
  for (const Block& block : blocks_)
    for (Eigen::Index j = 0; j < load_.cols(); ++j)
      load_.col(j).segment(block.coordinate, block.shapes.cols()) =
          block.shapes.transpose() * system.load.col(j).segment(block.first, block.shapes.rows());
  outputs_ = static_cast<int>(system.outputs.cols());
  for (const Block& block : blocks_) {
    if (!block.shadow) add_view(system.outputs, block, views_);
    if (shadow_ > 0 && !block.shadowed) add_view(system.outputs, block, shadow_views_);
  }
  gap_jacobian_ = columns_of_links(system, false);
  if (shadow_ > 0) shadow_ends_ = columns_of_links(system, true);
}

// In the blocks that count, or in the shadow and the blocks that have none.
LinkColumns ModalSolver::columns_of_links(const System& system, bool shadow) const {
  LinkColumns made(system.links());
  for (const Block& block : blocks_) {
    if (shadow ? block.shadowed : block.shadow) continue;
    std::vector<int> links;
    Eigen::MatrixXd columns(block.shapes.cols(), system.links());
    for (int i = 0; i < system.links(); ++i) {
      Eigen::VectorXd part = Eigen::VectorXd::Zero(block.shapes.rows());
      for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it)
        if (it.row() >= block.first && it.row() < block.first + part.size()) part[it.row() - block.first] = it.value();
      if (part.isZero(0)) continue;
      for (int k = 0; k < part.size() && !is_spring(system, i); ++k)
        if (part[k] != 0 && !(system.mass.coeff(block.first + k, block.first + k) > 0))
          throw std::invalid_argument(fmt::format("link {} acts on unknown {}, which has no mass", i, block.first + k));
      auto column = columns.col(static_cast<Eigen::Index>(links.size()));
      if (block.few()) {
        column.setZero();
        for (int k = 0; k < part.size(); ++k)
          if (part[k] != 0) column += part[k] * block.shapes.row(k).transpose();
      } else {
        column = block.shapes.transpose() * part;
      }
      links.push_back(i);
    }
    columns.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(links.size()));
    made.add_block(block.coordinate, std::move(links), std::move(columns));
  }
  return made;
}

void ModalSolver::add_natural(const System& system, const Group& group) {
  const auto [dynamic, massless] = split_of(system, group);
  const int count = static_cast<int>(dynamic.size());
  Eigen::MatrixXd stiffness = dense_submatrix(system.stiffness, dynamic, dynamic, group.first);
  const Eigen::MatrixXd mass = dense_submatrix(system.mass, dynamic, dynamic, group.first);
  Eigen::MatrixXd recovery;  // of the massless degrees of freedom from the dynamic ones
  if (!massless.empty()) {
    const Eigen::MatrixXd coupling = dense_submatrix(system.stiffness, massless, dynamic, group.first);
    const Eigen::SimplicialLLT<SparseMatrix> solver(submatrix(system.stiffness, massless, massless, group.first));
    if (solver.info() != Eigen::Success)
      throw std::invalid_argument("the stiffness leaves an unknown without mass loose");
    recovery = -solver.solve(coupling);
    stiffness += coupling.transpose() * recovery;
    stiffness = 0.5 * (stiffness + stiffness.transpose().eval());
    if (!dense_submatrix(system.damping, massless, massless, group.first).isZero(0) ||
        !dense_submatrix(system.damping, massless, dynamic, group.first).isZero(0))
      throw std::invalid_argument("a dashpot acts on an unknown without mass");
  }
  const auto [values, phi] = count > small_structure ? petsc::all_modes(mass, stiffness) : eigenpairs(mass, stiffness);
  Block block;
  block.shapes = Eigen::MatrixXd::Zero(group.count, count);
  block.shapes(dynamic, Eigen::all) = phi;
  if (recovery.size() > 0) block.shapes(massless, Eigen::all) = recovery * phi;
  if (!block.few()) {
    block.project = Eigen::MatrixXd::Zero(count, group.count);
    block.project(Eigen::all, dynamic) = phi.transpose() * mass;
  }
  Eigen::VectorXd squares = values.cwiseMax(0);
  squares.head(std::min<Eigen::Index>(group.rigid_motions, count)).setZero();
  group_masses_.push_back(mass.diagonal().sum());
  add_block(system, group, std::move(block), squares,
            phi.transpose() * dense_submatrix(system.damping, dynamic, dynamic, group.first) * phi);
}

void ModalSolver::add_reduced(const System& system, const Group& group, const GroupModes& modes, bool shadow) {
  const auto [dynamic, massless] = split_of(system, group);
  if (modes.shapes.rows() != group.count || modes.shapes.cols() != modes.squares.size())
    throw std::logic_error("the modes do not belong to this group");
  const SparseMatrix damping = system.damping.block(group.first, group.first, group.count, group.count);
  for (const int i : massless)
    for (SparseMatrix::InnerIterator it(damping, i); it; ++it)
      if (it.value() != 0) throw std::invalid_argument("a dashpot acts on an unknown without mass");
  const SparseMatrix mass = system.mass.block(group.first, group.first, group.count, group.count);
  Block block;
  block.shadow = shadow;
  block.reduced = true;
  block.shapes = modes.shapes;
  if (!shadow) group_masses_.push_back(mass.diagonal().sum());
  const Eigen::Index count = modes.squares.size();
  const Eigen::MatrixXd rest = damping.nonZeros() == 0 ? Eigen::MatrixXd(Eigen::MatrixXd::Zero(count, count))
                                                       : symmetric_product(modes.shapes, damping * modes.shapes);
  add_block(system, group, std::move(block), modes.squares, rest);
}

// `rest` is the damping of the modes without Rayleigh's.
void ModalSolver::add_block(const System& system, const Group& group, Block block, const Eigen::VectorXd& squares, const Eigen::MatrixXd& rest) {
  const int count = static_cast<int>(squares.size()), number = static_cast<int>(&group - system.groups.data());
  block.first = group.first;
  block.coordinate = static_cast<int>(stiffness_.size());
  Eigen::VectorXd diagonal = rest.diagonal() + group.by_stiffness * squares;
  diagonal.array() += group.by_mass;
  Eigen::MatrixXd coupled = rest;
  coupled.diagonal().setZero();
  if (coupled.cwiseAbs().maxCoeff() > rounding * diagonal.cwiseAbs().maxCoeff()) {
    block.damping = rest;
    block.damping.diagonal() = diagonal;
  }
  stiffness_.conservativeResize(block.coordinate + count);
  damping_.conservativeResize(block.coordinate + count);
  stiffness_.tail(count) = squares;
  damping_.tail(count) = diagonal;
  if (block.few()) {
    block.by_unknown = block.shapes.transpose();
    block.mass = system.mass.block(group.first, group.first, group.count, group.count);
  }
  if (!block.shadow) segments_.push_back({block.coordinate, count, number});
  blocks_.push_back(std::move(block));
}

void ModalSolver::add_view(const SparseMatrix& outputs, const Block& block, std::vector<View>& views) const {
  View view{block.coordinate, {}, {}};
  const auto inside = [&](Eigen::Index row) { return row >= block.first && row < block.first + block.shapes.rows(); };
  for (int j = 0; j < outputs_; ++j)
    for (SparseMatrix::InnerIterator it(outputs, j); it; ++it)
      if (inside(it.row()) && (view.rows.empty() || view.rows.back() != j)) view.rows.push_back(j);
  if (view.rows.empty()) return;
  view.factors = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(view.rows.size()), block.shapes.cols());
  for (std::size_t i = 0; i < view.rows.size(); ++i)
    for (SparseMatrix::InnerIterator it(outputs, view.rows[i]); it; ++it)
      if (inside(it.row())) view.factors.row(static_cast<Eigen::Index>(i)) += it.value() * block.shapes.row(it.row() - block.first);
  views.push_back(std::move(view));
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
    cx.middleRows(block.coordinate, count).noalias() = block.damping * x.block(block.coordinate, first, count, cx.cols());
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
    for (Eigen::Index i = 0; i < n; ++i) inverse_[i] = 1 / (s.mass + s.damping * damping_[i] + s.stiffness * stiffness_[i]);
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

// Coupled modes: each block has a factor.
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

void ModalSolver::add_response(double factor, std::span<const int> /*links*/, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  const auto add = [&](const LinkColumns& columns, int from) {
    if (classical_)
      columns.add_response(factor, f, inverse_, y, from);
    else
      columns.add_response(factor, f, solve_block(), y, from);
  };
  add(gap_jacobian_, 0);
  if (shadow_ > 0) add(shadow_ends_, counted());
}

void ModalSolver::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const { gap_jacobian_.gather(x, relative); }
void ModalSolver::gather(std::span<const int> /*links*/, Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
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
  for (const Block& block : blocks_)
    y.segment(block.coordinate, block.shapes.cols()).noalias() += block.shapes.transpose() * f.segment(block.first, block.shapes.rows());
}

void ModalSolver::observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const { observe(views_, x, values); }
void ModalSolver::observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  observe(shadow_ > 0 ? shadow_views_ : views_, x, values);
}

void ModalSolver::observe(const std::vector<View>& views, const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& values) const {
  values.setZero(outputs_, x.cols());
  for (const View& view : views) {
    const Eigen::Index rows = view.factors.rows(), count = view.factors.cols();
    add_products({view.factors.data(), rows, count, rows}, {x.data() + view.first, count, x.cols(), x.outerStride()}, view.rows, values, sums_);
  }
}

Eigen::VectorXd ModalSolver::coordinates(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x(stiffness_.size());
  for (const Block& block : blocks_)
    x.segment(block.coordinate, block.shapes.cols()) =
        block.few() ? Eigen::VectorXd(block.by_unknown * (block.mass * u.segment(block.first, block.shapes.rows())))
                    : Eigen::VectorXd(block.project * u.segment(block.first, block.project.cols()));
  return x;
}

void ModalSolver::Block::displace(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> u) const {
  const Eigen::Index rows = shapes.rows(), modes = shapes.cols();
  if (few()) {
    const Eigen::MatrixXd own = x.middleRows(coordinate, modes).transpose();
    auto to = u.middleCols(first, rows);
    to.setZero();
    add_products({own.data(), own.rows(), modes, own.rows()}, {by_unknown.data(), modes, rows, modes}, to.data(), u.outerStride());
    return;
  }
  Eigen::VectorXd one(rows);
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    displace_one(x.col(j), one);
    u.row(j).segment(first, rows) = one;
  }
}

void ModalSolver::Block::displace_one(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> u) const {
  if (shapes.cols() < many_modes)
    sum_columns(shapes, x.data() + coordinate, u.data());
  else
    u.noalias() = shapes * x.segment(coordinate, shapes.cols());
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
      block.displace_one(x, u.segment(block.first, block.shapes.rows()));
  }
}

void ModalSolver::physical_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const {
  if (single_.size() > 0) return StructureSolver::physical_of_columns(x, u);
  u.resize(x.cols(), unknowns_);
  for (const Block& block : blocks_)
    if (!block.shadow) block.displace(x, u);
}

void ModalSolver::physical_shadow_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const {
  u.resize(x.cols(), unknowns_);
  for (const Block& block : blocks_)
    if (!block.shadowed) block.displace(x, u);
}

std::optional<StructureSolver::FewModes> ModalSolver::few_modes(int group) const {
  const Block& block = blocks_[group];
  if (!block.few()) return std::nullopt;
  return FewModes{block.shapes, block.coordinate};
}

std::string ModalSolver::description() const {
  if (!reduced_.empty()) {
    std::string text = fmt::format("{} coordinates for {} unknowns, {}", counted(), unknowns_, classical_ ? "decoupled" : "coupled by the damping");
    for (const ReducedStructure& each : reduced_) text += "; " + each.size_text();
    return text;
  }
  return classical_ ? fmt::format("all {} modes of {} unknowns, decoupled", stiffness_.size(), unknowns_)
                    : fmt::format("all {} modes of {} unknowns, coupled by the damping, {} factorizations", stiffness_.size(),
                                  unknowns_, factorizations_);
}

}  // namespace pounding
