#include <pounding/linear/tangent_solver.hpp>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/linear/system_checks.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::VectorXd;

// K condensed to the degrees of freedom with mass, in all rows and columns.
SparseMatrix condensed(const SparseMatrix& stiffness, const std::vector<int>& dynamic, const std::vector<int>& massless,
                       const Eigen::SimplicialLDLT<SparseMatrix>* massless_stiffness, const SparseMatrix& coupling) {
  if (massless.empty()) return stiffness;
  MatrixXd dense = dense_submatrix(stiffness, dynamic, dynamic);
  dense -= MatrixXd(coupling.transpose()) * massless_stiffness->solve(MatrixXd(coupling));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < dynamic.size(); ++j)
    for (std::size_t i = 0; i < dynamic.size(); ++i)
      if (const double value = dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)); value != 0)
        entries.emplace_back(dynamic[i], dynamic[j], value);
  return sparse_matrix(stiffness.rows(), stiffness.cols(), entries);
}

SparseMatrix rows_of(const SparseMatrix& matrix, int first, int count) {
  return matrix.size() > 0 ? SparseMatrix(matrix.middleRows(first, count)) : SparseMatrix(count, matrix.cols());
}

std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> factor_of(const SparseMatrix& matrix, const char* refusal) {
  if (matrix.rows() == 0) return nullptr;
  auto factor = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(matrix);
  if (factor->info() != Eigen::Success || !(factor->vectorD().minCoeff() > 0)) throw std::invalid_argument(refusal);
  return factor;
}

}  // namespace

TangentSolver::TangentSolver(const System& system, std::unique_ptr<StructureSolver> linear)
    : StructureSolver(system), linear_(std::move(linear)) {
  petsc::require_masses(system, system.mass.diagonal());
  if (linear_) layout_ = linear_->layout();
  layout_.group_masses.resize(system.groups.size());
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (system.groups[k].tangent) add_block(system, static_cast<int>(k));
  const int size = blocks_.back()->coordinate + blocks_.back()->size;
  layout_.load.conservativeResize(size, system.load.cols());
  layout_.weights.conservativeResize(size);
  layout_.step_lengths = linear_ ? linear_->layout().step_lengths : StepLengths::any;
  const VectorXd masses = system.mass.diagonal();
  for (const auto& b : blocks_) {
    layout_.load.middleRows(b->coordinate, b->size) = system.load.middleRows(b->first, b->size);
    layout_.weights.segment(b->coordinate, b->size) = masses.segment(b->first, b->size);
    layout_.group_masses[b->group] = masses.segment(b->first, b->size).sum();
    layout_.segments.push_back({b->coordinate, b->size, b->group});
  }
}

void TangentSolver::add_block(const System& system, int number) {
  const Group& group = system.groups[static_cast<std::size_t>(number)];
  if (group.modal_ratio > 0)
    throw std::invalid_argument("modal damping requires a constant stiffness; type damping: {rayleigh: ...}");
  const int coordinate = blocks_.empty() ? linear_size() : blocks_.back()->coordinate + blocks_.back()->size;
  auto made = std::make_unique<Block>();
  Block& b = *made;
  b.group = number, b.first = group.first, b.size = group.count, b.coordinate = coordinate;
  const auto own = [&](const SparseMatrix& matrix) {
    return SparseMatrix(matrix.block(b.first, b.first, b.size, b.size));
  };
  b.mass = own(system.mass);
  b.stiffness = b.tangent = own(system.stiffness);
  MassSplit split = split_by_mass(b.mass);
  b.dynamic = std::move(split.dynamic), b.massless = std::move(split.massless);
  b.dynamic_mass = factor_of(submatrix(b.mass, b.dynamic, b.dynamic), "the mass matrix is not positive definite");
  b.massless_stiffness =
      factor_of(submatrix(b.stiffness, b.massless, b.massless), "a massless degree of freedom has no stiffness");
  b.coupling = submatrix(b.stiffness, b.massless, b.dynamic);
  b.damping = own(system.damping) + group.by_mass * b.mass;
  if (group.by_stiffness != 0)
    b.damping +=
        group.by_stiffness * condensed(b.stiffness, b.dynamic, b.massless, b.massless_stiffness.get(), b.coupling);
  b.closing = rows_of(system.gap_jacobian, b.first, b.size);
  b.outputs = rows_of(system.outputs, b.first, b.size);
  blocks_.push_back(std::move(made));
}

template <class At>
void TangentSolver::each(At&& at) const {
  for (const auto& block : blocks_) at(*block);
}

VectorXd TangentSolver::coordinates(const VectorXd& physical) const {
  VectorXd x(size());
  if (linear_) x.head(linear_size()) = linear_->coordinates(physical);
  each([&](const Block& b) { x.segment(b.coordinate, b.size) = physical.segment(b.first, b.size); });
  return x;
}

MatrixXd TangentSolver::physical(Ref<const MatrixXd> x) const {
  int rows = 0;
  each([&](const Block& b) { rows = std::max(rows, b.first + b.size); });
  MatrixXd all = linear_ ? linear_->physical(x.topRows(linear_size())) : MatrixXd::Zero(rows, x.cols());
  each([&](const Block& b) { all.middleRows(b.first, b.size) = x.middleRows(b.coordinate, b.size); });
  return all;
}

void TangentSolver::add_physical_forces(const VectorXd& f, Ref<VectorXd> y) const {
  if (linear_) linear_->add_physical_forces(f, y.head(linear_size()));
  each([&](const Block& b) { y.segment(b.coordinate, b.size) += f.segment(b.first, b.size); });
}

void TangentSolver::stiffness_times(Ref<const MatrixXd> x, Ref<MatrixXd> y) const {
  if (linear_) linear_->stiffness_times(x.topRows(linear_size()), y.topRows(linear_size()));
  each([&](const Block& b) {
    y.middleRows(b.coordinate, b.size).noalias() = b.stiffness * x.middleRows(b.coordinate, b.size);
  });
}

void TangentSolver::damping_times(Ref<const MatrixXd> x, Ref<const MatrixXd> kx, Ref<MatrixXd> y) const {
  if (linear_) linear_->damping_times(x.topRows(linear_size()), kx.topRows(linear_size()), y.topRows(linear_size()));
  each([&](const Block& b) {
    y.middleRows(b.coordinate, b.size).noalias() = b.damping * x.middleRows(b.coordinate, b.size);
  });
}

void TangentSolver::mass_times(Ref<const VectorXd> x, Ref<VectorXd> y) const {
  if (linear_) linear_->mass_times(x.head(linear_size()), y.head(linear_size()));
  each([&](const Block& b) { y.segment(b.coordinate, b.size).noalias() = b.mass * x.segment(b.coordinate, b.size); });
}

void TangentSolver::accelerate(Ref<VectorXd> r) const {
  if (linear_) linear_->accelerate(r.head(linear_size()));
  each([&](const Block& b) {
    auto own = r.segment(b.coordinate, b.size);
    const VectorXd force = own(b.dynamic);
    own.setZero();
    own(b.dynamic) = b.dynamic_mass->solve(force);
  });
}

void TangentSolver::recover(Ref<VectorXd> x) const {
  if (linear_) linear_->recover(x.head(linear_size()));
  each([&](const Block& b) {
    if (b.massless.empty()) return;
    auto own = x.segment(b.coordinate, b.size);
    const VectorXd moved = own(b.dynamic);
    own(b.massless) = b.massless_stiffness->solve(-(b.coupling * moved));
  });
}

void TangentSolver::set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) {
  if (linear_) linear_->set_matrix(matrix, step_level);
  if (matrix_ == matrix) return;
  matrix_ = matrix;
  is_factored_ = false;
}

void TangentSolver::set_tangent(int group, const SparseMatrix& tangent) {
  for (const auto& b : blocks_)
    if (b->group == group) b->tangent = tangent;
  is_factored_ = false;
}

bool TangentSolver::factorize() {
  if (is_factored_) return ok_;
  is_factored_ = ok_ = true;
  for (const auto& b : blocks_) {
    const SparseMatrix step = matrix_.mass * b->mass + matrix_.damping * b->damping + matrix_.stiffness * b->tangent;
    if (b->step.rows() == 0) b->step.analyzePattern(step);
    b->step.factorize(step);
    ok_ = ok_ && b->step.info() == Eigen::Success;
    ++factorizations_;
  }
  return ok_;
}

bool TangentSolver::solve(Ref<VectorXd> x) {
  if (linear_ && !linear_->solve(x.head(linear_size()))) return false;
  if (!factorize()) return false;
  each([&](const Block& b) {
    auto own = x.segment(b.coordinate, b.size);
    own = b.step.solve(VectorXd(own)).eval();
  });
  return x.allFinite();
}

void TangentSolver::gather(Ref<const MatrixXd> x, MatrixXd& relative) const {
  if (linear_)
    linear_->gather(x.topRows(linear_size()), relative);
  else
    relative.setZero(blocks_.front()->closing.cols(), x.cols());
  each([&](const Block& b) { relative += b.closing.transpose() * x.middleRows(b.coordinate, b.size); });
}

void TangentSolver::gather(std::span<const int> links, Ref<const MatrixXd> x, MatrixXd& relative) const {
  MatrixXd all;
  gather(x, all);
  relative = all(std::vector<int>(links.begin(), links.end()), Eigen::all);
}

void TangentSolver::add_forces(double factor, const VectorXd& f, Ref<VectorXd> y) const {
  if (linear_) linear_->add_forces(factor, f, y.head(linear_size()));
  each([&](const Block& b) { y.segment(b.coordinate, b.size) += factor * (b.closing * f); });
}

bool TangentSolver::flexibility(std::span<const int> links, MatrixXd& g) {
  const auto count = static_cast<Eigen::Index>(links.size());
  if (linear_ && !linear_->flexibility(links, of_linear_)) return false;
  if (!factorize()) return false;
  if (linear_)
    g = of_linear_;
  else
    g.setZero(count, count);
  for (const auto& b : blocks_) {
    MatrixXd closing = MatrixXd::Zero(b->size, count);
    for (Eigen::Index j = 0; j < count; ++j) closing.col(j) = b->closing.col(links[static_cast<std::size_t>(j)]);
    b->columns = b->step.solve(closing);
    g.noalias() += closing.transpose() * b->columns;
  }
  return g.allFinite();
}

void TangentSolver::add_response(double factor, std::span<const int> links, const VectorXd& f, Ref<VectorXd> y) const {
  if (linear_) linear_->add_response(factor, links, f, y.head(linear_size()));
  each([&](const Block& b) { y.segment(b.coordinate, b.size).noalias() += factor * (b.columns * f); });
}

void TangentSolver::observe(Ref<const MatrixXd> x, MatrixXd& values) const {
  if (linear_)
    linear_->observe(x.topRows(linear_size()), values);
  else
    values.setZero(blocks_.front()->outputs.cols(), x.cols());
  each([&](const Block& b) { values += b.outputs.transpose() * x.middleRows(b.coordinate, b.size); });
}

std::string TangentSolver::description() const {
  int unknowns = 0;
  each([&](const Block& b) { unknowns += b.size; });
  std::string text = fmt::format("{} unknowns with a tangent stiffness, {} factorizations", unknowns, factorizations_);
  return linear_ ? linear_->description() + "; " + text : text;
}

}  // namespace pounding
