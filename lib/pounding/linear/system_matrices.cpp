#include <pounding/linear/system_matrices.hpp>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/linear/damping_matrix.hpp>
#include <pounding/linear/system_checks.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {
namespace {

// y = A x for several columns in one pass over the matrix.
template <int Columns>
void multiply(const Pattern& a, const std::vector<double>& values, const double* x, Eigen::Index ldx, double* y,
              Eigen::Index ldy) {
  const PetscInt rows = a.rows();
  for (PetscInt i = 0; i < rows; ++i) {
    double sums[Columns] = {};
    for (PetscInt p = a.begin[i]; p < a.begin[i + 1]; ++p) {
      const double value = values[p];
      const double* at = x + a.columns[p];
      for (int j = 0; j < Columns; ++j) sums[j] += value * at[j * ldx];
    }
    for (int j = 0; j < Columns; ++j) y[i + j * ldy] = sums[j];
  }
}

}  // namespace

// Rows and columns of a matrix at some degrees of freedom, with their factor.
struct SystemMatrices::Subset {
  std::vector<int> rows;  // on this process
  std::unique_ptr<Factor> factor;
  Eigen::VectorXd b, x;

  // `dofs` are ascending indices of the whole system.
  Subset(const SystemMatrices& whole, const SparseMatrix& matrix, const std::vector<int>& dofs) {
    const int first = whole.first(), end = first + whole.rows(), solving = whole.first_column();
    std::vector<PetscInt> number(static_cast<std::size_t>(matrix.rows()), -1);
    PetscInt count = 0;
    for (const int i : dofs)
      if (i >= solving) number[i] = count++;
    Pattern pattern;
    std::vector<double> values;
    for (const int i : dofs) {
      if (i < first || i >= end) continue;
      rows.push_back(i - first);
      for (SparseMatrix::InnerIterator it(matrix, i); it; ++it)
        if (number[it.row()] >= 0) {
          pattern.columns.push_back(number[it.row()]);
          values.push_back(it.value());
        }
      pattern.begin.push_back(static_cast<PetscInt>(pattern.columns.size()));
    }
    b.resize(static_cast<Eigen::Index>(rows.size()));
    x.resize(b.size());
    const LibraryLock lock;
    int all = static_cast<int>(rows.size());
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_SUM, whole.solving_comm_);
    if (all > 0) factor = std::make_unique<Factor>(whole.solving_comm_, pattern, values, whole.prefix_);
  }

  bool ok() const { return !factor || factor->ok(); }
  // Replaces the entries of r at these rows with sign A^-1 r.
  void solve(Eigen::Ref<Eigen::VectorXd> r, double sign) {
    if (!factor) return;
    for (std::size_t i = 0; i < rows.size(); ++i) b[static_cast<Eigen::Index>(i)] = sign * r[rows[i]];
    if (!factor->solve(b.data(), x.data())) x.setConstant(std::nan(""));
    for (std::size_t i = 0; i < rows.size(); ++i) r[rows[i]] = x[static_cast<Eigen::Index>(i)];
  }
};

SystemMatrices::~SystemMatrices() = default;

SystemMatrices::SystemMatrices(MPI_Comm comm, const System& system, const std::string& prefix)
    : comm_(comm), solving_comm_(comm), system_(system), prefix_(prefix) {
  const LibraryLock lock;
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &processes_);
  const int n = system.size();
  if (n < processes_)
    throw std::invalid_argument(
        fmt::format("{} degrees of freedom cannot be distributed over {} processes; type mpirun -n {}, or fewer", n,
                    processes_, n));
  require_groups(system);
  const Eigen::VectorXd masses = system.mass.diagonal();
  require_masses(system, masses);

  whole_ = shares_whole_groups(system, processes_);
  if (whole_) solving_comm_ = PETSC_COMM_SELF;
  first_row_ = first_rows(system, processes_);
  diagonal_mass_ = masses.segment(first(), rows());
  find_segments();
  fill();
  if (!whole_) {
    shared_stiffness_ = std::make_unique<Product>(make_matrix(comm, pattern_, stiffness_));
    if (!mass_.empty()) shared_mass_ = std::make_unique<Product>(make_matrix(comm, pattern_, mass_));
    if (!damping_.empty()) shared_damping_ = std::make_unique<Product>(make_matrix(comm, pattern_, damping_));
  }
  const MassSplit dofs = split_by_mass(system.mass);
  if (!mass_.empty()) {
    dynamic_ = std::make_unique<Subset>(*this, system.mass, dofs.dynamic);
    if (!agreed(dynamic_->ok())) fail_singular(system.mass, dofs.dynamic, "the mass matrix");
  }
  if (dofs.massless.empty()) return;
  massless_ = std::make_unique<Subset>(*this, system.stiffness, dofs.massless);
  if (!agreed(massless_->ok()))
    fail_singular(system.stiffness, dofs.massless, "the stiffness at the massless degrees of freedom");
}

void SystemMatrices::find_segments() {
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const Group& group = system_.groups[k];
    const int from = std::max(first(), group.first), to = std::min(first() + rows(), group.first + group.count);
    if (from < to) segments_.push_back({from - first(), to - from, static_cast<int>(k)});
  }
}

void SystemMatrices::fill() {
  const int n = system_.size(), solving = first_column();
  bool lumped = true;
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(system_.mass, j); it; ++it)
      lumped = lumped && (it.row() == j || it.value() == 0);
  bool dashpots = false;
  const SparseMatrix damping = damping_matrix(system_);
  for (int j = 0; j < damping.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(damping, j); it; ++it) dashpots = dashpots || it.value() != 0;
  // Columns of a symmetric matrix equal its rows.
  Eigen::VectorXd k_row = Eigen::VectorXd::Zero(n), m_row = k_row, c_row = k_row;
  std::vector<int> columns;
  for (int i = first(); i < first() + rows(); ++i) {
    columns.assign(1, i);
    const auto scatter = [&](const SparseMatrix& from, Eigen::VectorXd& row) {
      if (from.cols() == 0) return;
      for (SparseMatrix::InnerIterator it(from, i); it; ++it) {
        row[it.row()] = it.value();
        columns.push_back(static_cast<int>(it.row()));
      }
    };
    scatter(system_.stiffness, k_row);
    scatter(system_.mass, m_row);
    scatter(damping, c_row);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const int j : columns) {
      pattern_.columns.push_back(j - solving);
      stiffness_.push_back(k_row[j]);
      if (!lumped) mass_.push_back(m_row[j]);
      if (dashpots) damping_.push_back(c_row[j]);
      k_row[j] = m_row[j] = c_row[j] = 0;
    }
    pattern_.begin.push_back(static_cast<PetscInt>(pattern_.columns.size()));
  }
}

void SystemMatrices::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  if (shared_stiffness_) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) (*shared_stiffness_)(x.col(j).data(), y.col(j).data());
    return;
  }
  const Eigen::Index ldx = x.outerStride(), ldy = y.outerStride();
  for (Eigen::Index j = 0; j < x.cols();) {
    const double* from = x.data() + j * ldx;
    double* to = y.data() + j * ldy;
    switch (const Eigen::Index left = std::min<Eigen::Index>(4, x.cols() - j); left) {
      case 1: multiply<1>(pattern_, stiffness_, from, ldx, to, ldy); break;
      case 2: multiply<2>(pattern_, stiffness_, from, ldx, to, ldy); break;
      case 3: multiply<3>(pattern_, stiffness_, from, ldx, to, ldy); break;
      default: multiply<4>(pattern_, stiffness_, from, ldx, to, ldy);
    }
    j += 4;
  }
}

void SystemMatrices::mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const {
  if (shared_mass_)
    (*shared_mass_)(x.data(), y.data());
  else if (!mass_.empty())
    multiply<1>(pattern_, mass_, x.data(), x.size(), y.data(), y.size());
  else
    y = diagonal_mass_.cwiseProduct(x);
}

void SystemMatrices::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                                   Eigen::Ref<Eigen::MatrixXd> y) const {
  Eigen::VectorXd product;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double* inertia = nullptr;
    if (dynamic_) {
      product.resize(x.rows());
      mass_times(x.col(j), product);
      inertia = product.data();
    }
    for (const StructureSolver::Segment& s : segments_) {
      const double by_mass = system_.groups[s.group].by_mass, by_stiffness = system_.groups[s.group].by_stiffness;
      const double *xj = x.col(j).data(), *kj = kx.col(j).data(), *mass = diagonal_mass_.data();
      double* yj = y.col(j).data();
      for (int i = s.first; i < s.first + s.count; ++i)
        yj[i] = by_mass * (inertia ? inertia[i] : mass[i] * xj[i]) + by_stiffness * kj[i];
    }
    if (damping_.empty()) continue;
    product.resize(x.rows());
    if (shared_damping_)
      (*shared_damping_)(x.col(j).data(), product.data());
    else
      multiply<1>(pattern_, damping_, x.col(j).data(), x.rows(), product.data(), x.rows());
    y.col(j) += product;
  }
}

void SystemMatrices::accelerate(Eigen::Ref<Eigen::VectorXd> r) const {
  const Eigen::VectorXd& mass = diagonal_mass_;
  if (dynamic_) {
    dynamic_->solve(r, 1);
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (mass[i] == 0) r[i] = 0;
    return;
  }
  for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = mass[i] > 0 ? r[i] / mass[i] : 0;
}

// Solves K_ss x_s = -K_sm x_m.
void SystemMatrices::recover(Eigen::Ref<Eigen::VectorXd> x) const {
  if (!massless_) return;
  for (const int i : massless_->rows) x[i] = 0;
  Eigen::VectorXd pull(x.size());
  stiffness_times(x, pull);
  massless_->solve(pull, -1);
  for (const int i : massless_->rows) x[i] = pull[i];
}

// The entries of A, in the pattern.
std::vector<double> SystemMatrices::values(const EffectiveMatrix& step) const {
  std::vector<double> a(stiffness_.size());
  const int diagonal = first() - first_column();
  for (const StructureSolver::Segment& s : segments_) {
    const Group& group = system_.groups[s.group];
    const double by_mass = step.mass + step.damping * group.by_mass;
    const double by_stiffness = step.stiffness + step.damping * group.by_stiffness;
    for (int i = s.first; i < s.first + s.count; ++i)
      for (PetscInt p = pattern_.begin[i]; p < pattern_.begin[i + 1]; ++p) {
        a[p] = by_stiffness * stiffness_[p];
        if (!mass_.empty())
          a[p] += by_mass * mass_[p];
        else if (pattern_.columns[p] == i + diagonal)
          a[p] += by_mass * diagonal_mass_[i];
        if (!damping_.empty()) a[p] += step.damping * damping_[p];
      }
  }
  return a;
}

void SystemMatrices::name_singular(const EffectiveMatrix& step) const {
  const SparseMatrix a = step.mass * system_.mass + step.stiffness * system_.stiffness;
  std::vector<int> dofs;
  for (int i = 0; i < system_.size(); ++i)
    if (a.coeff(i, i) != 0) dofs.push_back(i);
  fail_singular(a, dofs, "mass and stiffness together");
}

Eigen::MatrixXd SystemMatrices::spread(Eigen::Ref<const Eigen::MatrixXd> x) const {
  if (processes_ == 1) return x;
  Eigen::MatrixXd all(system_.size(), x.cols());
  const LibraryLock lock;
  std::vector<int> counts(processes_);
  for (int r = 0; r < processes_; ++r) counts[r] = first_row_[r + 1] - first_row_[r];
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    MPI_Allgatherv(x.col(j).data(), rows(), MPI_DOUBLE, all.col(j).data(), counts.data(), first_row_.data(), MPI_DOUBLE,
                   comm_);
  return all;
}

bool SystemMatrices::agreed(bool mine) const {
  if (processes_ == 1) return mine;
  const LibraryLock lock;
  int all = mine;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm_);
  return all != 0;
}

void SystemMatrices::combine(std::span<double> sums) const {
  if (processes_ == 1) return;
  const LibraryLock lock;
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

double SystemMatrices::largest(double mine) const {
  if (processes_ == 1) return mine;
  const LibraryLock lock;
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return mine;
}

}  // namespace pounding::petsc
