#include <pounding/linear/modal_solver.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

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

// y = diag(d) x; y overlaps neither.
void multiply_columns(const Eigen::VectorXd& d, const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd>& y) {
  const Eigen::Index n = x.rows(), columns = x.cols();
  const double *factor = d.data(), *from = x.data();
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
  for (int i = 0; i < system.links(); ++i) {
    gap_jacobian_.push_back(parts_of(system, i, false));
    if (shadow_ > 0) shadow_ends_.push_back(parts_of(system, i, true));
  }
  make_panels();
}

// A link's column of B in the blocks that count, or in the shadow and the blocks that have none.
std::vector<ModalSolver::Part> ModalSolver::parts_of(const System& system, int link, bool shadow) const {
  std::vector<Part> parts;
  const Eigen::VectorXd column(system.gap_jacobian.col(link));
  const bool springs = is_spring(system, link);
  for (const Block& block : blocks_) {
    if (shadow ? block.shadowed : block.shadow) continue;
    const auto part = column.segment(block.first, block.shapes.rows());
    if (part.isZero(0)) continue;
    for (int k = 0; k < part.size() && !springs; ++k)
      if (part[k] != 0 && !(system.mass.coeff(block.first + k, block.first + k) > 0))
        throw std::invalid_argument(fmt::format("link {} acts on unknown {}, which has no mass", link, block.first + k));
    parts.push_back({block.coordinate, block.shapes.transpose() * part});
  }
  return parts;
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
  const auto [values, phi] = eigenpairs(mass, stiffness);
  Block block;
  block.shapes = Eigen::MatrixXd::Zero(group.count, count);
  block.shapes(dynamic, Eigen::all) = phi;
  if (recovery.size() > 0) block.shapes(massless, Eigen::all) = recovery * phi;
  block.project = Eigen::MatrixXd::Zero(count, group.count);
  block.project(Eigen::all, dynamic) = phi.transpose() * mass;
  Eigen::VectorXd squares = values.cwiseMax(0);
  squares.head(std::min<Eigen::Index>(group.rigid_motions, count)).setZero();
  group_masses_.push_back(mass.diagonal().sum());
  add_block(group, static_cast<int>(&group - system.groups.data()), std::move(block), squares,
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
  block.shapes = modes.shapes;
  block.project = (mass * modes.shapes).transpose();
  if (!shadow) group_masses_.push_back(mass.diagonal().sum());
  const Eigen::MatrixXd damped = damping * modes.shapes;
  add_block(group, static_cast<int>(&group - system.groups.data()), std::move(block), modes.squares, modes.shapes.transpose() * damped);
}

// `rest` is the damping of the modes without Rayleigh's.
void ModalSolver::add_block(const Group& group, int number, Block block, const Eigen::VectorXd& squares, const Eigen::MatrixXd& rest) {
  const int count = static_cast<int>(squares.size());
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
  multiply_columns(stiffness_, x, y);
}

void ModalSolver::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> /*kx*/,
                              Eigen::Ref<Eigen::MatrixXd> y) const {
  if (classical_) {
    multiply_columns(damping_, x, y);
    return;
  }
  for (const Block& block : blocks_) {
    const Eigen::Index count = block.damping.rows();
    y.middleRows(block.coordinate, count).noalias() = block.damping * x.middleRows(block.coordinate, count);
  }
}

void ModalSolver::mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const { y = x; }
void ModalSolver::accelerate(Eigen::Ref<Eigen::VectorXd>) const {}
void ModalSolver::recover(Eigen::Ref<Eigen::VectorXd>) const {}

void ModalSolver::set_matrix(const EffectiveMatrix& s, const std::optional<int>& /*step_level*/) {
  if (s.mass == matrix_.mass && s.damping == matrix_.damping && s.stiffness == matrix_.stiffness) return;
  matrix_ = s;
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

bool ModalSolver::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  const int count = static_cast<int>(links.size());
  g.setZero(count, count);
  for (int j = 0; j < count; ++j)
    for (const Part& part : gap_jacobian_[links[j]]) {
      const Eigen::Index n = part.values.size();
      Eigen::VectorXd solved;
      if (!classical_) {
        solved = part.values;
        for (std::size_t b = 0; b < blocks_.size(); ++b)
          if (blocks_[b].coordinate == part.first) factors_[b].solveInPlace(solved);
      }
      for (int i = 0; i <= j; ++i)
        for (const Part& other : gap_jacobian_[links[i]]) {
          if (other.first != part.first) continue;
          double sum = 0;
          if (classical_)
            for (Eigen::Index k = 0; k < n; ++k) sum += other.values[k] * inverse_[part.first + k] * part.values[k];
          else
            sum = other.values.dot(solved);
          g(i, j) += sum;
          if (i != j) g(j, i) += sum;
        }
    }
  return true;
}

void ModalSolver::add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                             Eigen::Ref<Eigen::VectorXd> y) const {
  const auto add = [&](double scale, const Part& part) {
    const Eigen::Index n = part.values.size();
    if (classical_) {
      for (Eigen::Index k = 0; k < n; ++k)
        y[part.first + k] += scale * inverse_[part.first + k] * part.values[k];
      return;
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (blocks_[b].coordinate == part.first) y.segment(part.first, n) += scale * factors_[b].solve(part.values);
  };
  for (std::size_t j = 0; j < links.size(); ++j) {
    const double scale = factor * f[static_cast<Eigen::Index>(j)];
    for (const Part& part : gap_jacobian_[links[j]]) add(scale, part);
    if (shadow_ == 0) continue;
    for (const Part& part : shadow_ends_[links[j]])
      if (part.first >= counted()) add(scale, part);
  }
}

void ModalSolver::make_panels() {
  const int links = static_cast<int>(gap_jacobian_.size());
  for (int i = 0; i < links;) {
    const auto fits = [&](int other) {
      const std::vector<Part>&own = gap_jacobian_[i], &parts = gap_jacobian_[other];
      return own.size() == 1 && parts.size() == 1 && own[0].first == parts[0].first && own[0].values.size() == parts[0].values.size();
    };
    if (i + 4 > links || !fits(i) || !fits(i + 1) || !fits(i + 2) || !fits(i + 3)) {
      single_links_.push_back(i++);
      continue;
    }
    Panel& panel = panels_.emplace_back(i, gap_jacobian_[i][0].first);
    panel.values.resize(Eigen::NoChange, gap_jacobian_[i][0].values.size());
    for (int row = 0; row < 4; ++row) panel.values.row(row) = gap_jacobian_[i++][0].values.transpose();
  }
}

void ModalSolver::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  const Eigen::Index columns = x.cols(), links = static_cast<Eigen::Index>(gap_jacobian_.size());
  if (relative.rows() != links || relative.cols() != columns) relative.resize(links, columns);
  // Sums in one order, whether four links at once or one.
  for (const Panel& panel : panels_)
    for (Eigen::Index j = 0; j < columns; ++j) {
      Eigen::Array4d sum = Eigen::Array4d::Zero();
      for (Eigen::Index k = 0; k < panel.values.cols(); ++k) sum += panel.values.col(k).array() * x(panel.first + k, j);
      relative.col(j).segment<4>(panel.link) = sum;
    }
  for (const int i : single_links_) {
    double* const sums = relative.data() + i;
    const Eigen::Index stride = relative.rows();
    for (Eigen::Index j = 0; j < columns; ++j) sums[j * stride] = 0;
    for (const Part& part : gap_jacobian_[i]) {
      const Eigen::Index n = part.values.size();
      const double *const values = part.values.data(), *of = x.data() + part.first;
      for (Eigen::Index j = 0; j < columns; ++j, of += x.outerStride()) {
        double sum = sums[j * stride];
        for (Eigen::Index k = 0; k < n; ++k) sum += values[k] * of[k];
        sums[j * stride] = sum;
      }
    }
  }
}

void ModalSolver::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  for (std::size_t i = 0; i < gap_jacobian_.size(); ++i) {
    const double scale = factor * f[static_cast<Eigen::Index>(i)];
    if (scale == 0) continue;
    for (const Part& part : gap_jacobian_[i]) {
      const Eigen::Index n = part.values.size();
      for (Eigen::Index k = 0; k < n; ++k) y[part.first + k] += scale * part.values[k];
    }
    if (shadow_ == 0) continue;
    for (const Part& part : shadow_ends_[i])
      if (part.first >= counted()) y.segment(part.first, part.values.size()) += scale * part.values;
  }
}

void ModalSolver::gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  if (shadow_ == 0) return gather(x, relative);
  relative.setZero(static_cast<Eigen::Index>(shadow_ends_.size()), x.cols());
  for (std::size_t i = 0; i < shadow_ends_.size(); ++i)
    for (const Part& part : shadow_ends_[i])
      relative.row(static_cast<Eigen::Index>(i)).noalias() += part.values.transpose() * x.middleRows(part.first, part.values.size());
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
  std::vector<double> sums(static_cast<std::size_t>(outputs_));  // of one group, beside each other
  for (const View& view : views) {
    const std::size_t count = view.rows.size();
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      sum_columns(view.factors, x.col(j).data() + view.first, sums.data());
      for (std::size_t i = 0; i < count; ++i) values(view.rows[i], j) += sums[i];
    }
  }
}

Eigen::VectorXd ModalSolver::coordinates(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x(stiffness_.size());
  for (const Block& block : blocks_)
    x.segment(block.coordinate, block.project.rows()) = block.project * u.segment(block.first, block.project.cols());
  return x;
}

void ModalSolver::Block::displace(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& u) const {
  if (shapes.cols() < many_modes)
    sum_columns(shapes, x.data() + coordinate, u.data() + first);
  else
    u.segment(first, shapes.rows()).noalias() = shapes * x.segment(coordinate, shapes.cols());
}

void ModalSolver::physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const {
  u.resize(unknowns_);
  if (single_.size() > 0) {
    for (Eigen::Index i = 0; i < single_.size(); ++i) u[i] = single_[i] * x[i];
    return;
  }
  for (const Block& block : blocks_)
    if (!block.shadow) block.displace(x, u);
}

void ModalSolver::physical_shadow(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const {
  physical(x, u);
  for (const Block& block : blocks_)
    if (block.shadow) block.displace(x, u);
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
