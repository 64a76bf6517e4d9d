#include <pounding/linear/system_matrices.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace pounding::petsc {
namespace {

// Of its diagonal, a pivot of a singular matrix.
constexpr double no_pivot = 1e-12;

// y = A x, `Columns` of them in one pass over the matrix.
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

// First row of each process: whole groups, the borders where the entries of the stiffness come nearest to even parts.
std::vector<int> whole_groups_of(const System& system, int processes) {
  const int groups = static_cast<int>(system.groups.size());
  std::vector<double> entries(groups + 1, 0.0);
  for (int k = 0; k < groups; ++k) {
    const Group& group = system.groups[k];
    entries[k + 1] = entries[k] + 1;
    for (int j = group.first; j < group.first + group.count; ++j)
      for (SparseMatrix::InnerIterator it(system.stiffness, j); it; ++it) entries[k + 1] += 1;
  }
  std::vector<int> first{0};
  int border = 0;
  for (int r = 1; r < processes; ++r) {
    const double even = entries[groups] * r / processes;
    ++border;
    while (border < groups - (processes - r) && std::abs(entries[border + 1] - even) < std::abs(entries[border] - even))
      ++border;
    first.push_back(system.groups[border].first);
  }
  first.push_back(system.size());
  return first;
}

void require_groups(const System& system) {
  std::vector<int> group_of(system.size(), -1);
  int next = 0;
  for (std::size_t k = 0; k < system.groups.size(); ++k) {
    const Group& group = system.groups[k];
    if (group.first != next || group.count < 1)
      throw std::invalid_argument(fmt::format("group {} begins at unknown {}, not at {}", k, group.first, next));
    next += group.count;
    for (int i = group.first; i < std::min(next, system.size()); ++i) group_of[i] = static_cast<int>(k);
  }
  if (next != system.size())
    throw std::invalid_argument(fmt::format("the groups hold {} unknowns of {}", next, system.size()));
  for (const SparseMatrix* matrix : {&system.mass, &system.damping, &system.stiffness})
    for (int j = 0; j < matrix->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
        if (group_of[it.row()] != group_of[j])
          throw std::invalid_argument(fmt::format("an entry joins the unknowns {} and {} of two groups", it.row(), j));
}

void require_masses(const System& system, const Eigen::VectorXd& diagonal) {
  const Eigen::VectorXd stiffness = system.stiffness.diagonal();
  const auto has_mass = [&](Eigen::Index i) { return diagonal[i] > 0; };
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (!(diagonal[i] >= 0)) throw std::invalid_argument(fmt::format("the mass of unknown {} is negative", i));
    if (!has_mass(i) && !(stiffness[i] > 0))
      throw std::invalid_argument(fmt::format("the stiffness leaves unknown {}, which has no mass, loose", i));
  }
  for (int j = 0; j < system.damping.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(system.damping, j); it; ++it)
      if (it.value() != 0 && !(has_mass(j) && has_mass(it.row())))
        throw std::invalid_argument(fmt::format("a dashpot acts on unknown {}, which has no mass", has_mass(j) ? it.row() : j));
  for (int i = 0; i < system.links(); ++i)
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it)
      if (it.value() != 0 && !has_mass(it.row()))
        throw std::invalid_argument(fmt::format("link {} acts on unknown {}, which has no mass", i, it.row()));
}

// Every process looks at the whole matrix and finds the same unknown.
[[noreturn]] void fail_singular(const System& system, const SparseMatrix& matrix, const char* what) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> unknowns, number(system.size(), -1);
  for (int i = 0; i < system.size(); ++i)
    if (&matrix == &system.stiffness ? system.mass.coeff(i, i) == 0 : matrix.coeff(i, i) != 0) {
      number[i] = static_cast<int>(unknowns.size());
      unknowns.push_back(i);
    }
  for (const int j : unknowns)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      if (number[it.row()] >= 0) entries.emplace_back(number[it.row()], number[j], it.value());
  const int count = static_cast<int>(unknowns.size());
  SparseMatrix part(count, count);
  part.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<SparseMatrix> factor(part);
  std::string place;
  if (factor.vectorD().size() == count) {
    const Eigen::VectorXd pivots = factor.permutationPinv() * Eigen::VectorXd(factor.vectorD());
    for (int i = 0; i < count && place.empty(); ++i)
      if (!(pivots[i] > no_pivot * part.coeff(i, i))) place = fmt::format(": a motion with unknown {} meets nothing", unknowns[i]);
  }
  throw SolverError(fmt::format("{} is singular or not positive definite{}", what, place));
}

}  // namespace

// A block of a matrix at some of the unknowns, with its factor.
struct SystemMatrices::Subset {
  std::vector<int> rows;  // on this process
  std::unique_ptr<Factor> factor;
  Eigen::VectorXd b, x;

  // `wanted` tells of every unknown.
  Subset(const SystemMatrices& whole, const SparseMatrix& matrix, const std::vector<bool>& wanted) {
    const int first = whole.first(), end = first + whole.rows(), solving = whole.first_column();
    std::vector<PetscInt> number(wanted.size(), -1);
    PetscInt count = 0;
    for (int i = solving; i < static_cast<int>(wanted.size()); ++i)
      if (wanted[i]) number[i] = count++;
    Pattern pattern;
    std::vector<double> values;
    for (int i = first; i < end; ++i) {
      if (!wanted[i]) continue;
      rows.push_back(i - first);
      for (SparseMatrix::InnerIterator it(matrix, i); it; ++it)
        if (wanted[it.row()]) {
          pattern.columns.push_back(number[it.row()]);
          values.push_back(it.value());
        }
      pattern.begin.push_back(static_cast<PetscInt>(pattern.columns.size()));
    }
    b.resize(static_cast<Eigen::Index>(rows.size()));
    x.resize(b.size());
    int all = static_cast<int>(rows.size());
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_SUM, whole.solving_comm_);
    if (all > 0) factor = std::make_unique<Factor>(whole.solving_comm_, pattern, values, whole.prefix_);
  }

  bool ok() const { return !factor || factor->ok(); }
  // Entries of r at these rows become those of A^-1 r.
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
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &processes_);
  const int n = system.size();
  if (n < processes_)
    throw std::invalid_argument(fmt::format("{} unknowns on {} processes; type mpirun -n {}, or fewer", n, processes_, n));
  require_groups(system);
  const Eigen::VectorXd masses = system.mass.diagonal();
  require_masses(system, masses);

  whole_ = static_cast<int>(system.groups.size()) >= processes_;
  if (whole_) {
    first_row_ = whole_groups_of(system, processes_);
    solving_comm_ = PETSC_COMM_SELF;
  } else {
    for (int r = 0; r <= processes_; ++r) first_row_.push_back(static_cast<int>(static_cast<long>(n) * r / processes_));
  }
  diagonal_mass_ = masses.segment(first(), rows());
  find_segments();
  fill();
  if (!whole_) {
    shared_stiffness_ = std::make_unique<Product>(make_matrix(comm, pattern_, stiffness_));
    if (!mass_.empty()) shared_mass_ = std::make_unique<Product>(make_matrix(comm, pattern_, mass_));
    if (!damping_.empty()) shared_damping_ = std::make_unique<Product>(make_matrix(comm, pattern_, damping_));
  }
  std::vector<bool> heavy(n);
  for (int i = 0; i < n; ++i) heavy[i] = masses[i] > 0;
  any_massless_ = std::find(heavy.begin(), heavy.end(), false) != heavy.end();
  if (!mass_.empty()) {
    heavy_ = std::make_unique<Subset>(*this, system.mass, heavy);
    if (!agreed(heavy_->ok())) fail_singular(system, system.mass, "the mass matrix");
  }
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
    for (SparseMatrix::InnerIterator it(system_.mass, j); it; ++it) lumped = lumped && (it.row() == j || it.value() == 0);
  bool dashpots = false;
  for (int j = 0; j < system_.damping.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(system_.damping, j); it; ++it) dashpots = dashpots || it.value() != 0;
  // Columns of a symmetric matrix are its rows.
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
    scatter(system_.damping, c_row);
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
    if (heavy_) {
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
  if (heavy_) {
    heavy_->solve(r, 1);
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (mass[i] == 0) r[i] = 0;
    return;
  }
  for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = mass[i] > 0 ? r[i] / mass[i] : 0;
}

// K_ss x_s = -K_sm x_m.
void SystemMatrices::recover(Eigen::Ref<Eigen::VectorXd> x) const {
  if (!any_massless_) return;
  if (!massless_) {
    std::vector<bool> loose(system_.size());
    const Eigen::VectorXd masses = system_.mass.diagonal();
    for (int i = 0; i < system_.size(); ++i) loose[i] = masses[i] == 0;
    massless_ = std::make_unique<Subset>(*this, system_.stiffness, loose);
    if (!agreed(massless_->ok())) {
      massless_.reset();
      fail_singular(system_, system_.stiffness, "the stiffness at the unknowns without mass");
    }
  }
  for (const int i : massless_->rows) x[i] = 0;
  Eigen::VectorXd pull(x.size());
  stiffness_times(x, pull);
  massless_->solve(pull, -1);
  for (const int i : massless_->rows) x[i] = pull[i];
}

// A of this shift, in the pattern.
std::vector<double> SystemMatrices::values(const EffectiveMatrix& shift) const {
  std::vector<double> a(stiffness_.size());
  const int diagonal = first() - first_column();
  for (const StructureSolver::Segment& s : segments_) {
    const Group& group = system_.groups[s.group];
    const double by_mass = shift.mass + shift.damping * group.by_mass;
    const double by_stiffness = shift.stiffness + shift.damping * group.by_stiffness;
    for (int i = s.first; i < s.first + s.count; ++i)
      for (PetscInt p = pattern_.begin[i]; p < pattern_.begin[i + 1]; ++p) {
        a[p] = by_stiffness * stiffness_[p];
        if (!mass_.empty())
          a[p] += by_mass * mass_[p];
        else if (pattern_.columns[p] == i + diagonal)
          a[p] += by_mass * diagonal_mass_[i];
        if (!damping_.empty()) a[p] += shift.damping * damping_[p];
      }
  }
  return a;
}

void SystemMatrices::name_singular(const EffectiveMatrix& shift) const {
  const SparseMatrix a = shift.mass * system_.mass + shift.stiffness * system_.stiffness;
  fail_singular(system_, a, "mass and stiffness together");
}

void SystemMatrices::spread(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& all) const {
  if (processes_ == 1) {
    all = x;
    return;
  }
  all.resize(system_.size());
  std::vector<int> counts(processes_);
  for (int r = 0; r < processes_; ++r) counts[r] = first_row_[r + 1] - first_row_[r];
  MPI_Allgatherv(x.data(), rows(), MPI_DOUBLE, all.data(), counts.data(), first_row_.data(), MPI_DOUBLE, comm_);
}

bool SystemMatrices::agreed(bool mine) const {
  int all = mine;
  if (processes_ > 1) MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm_);
  return all != 0;
}

void SystemMatrices::combine(std::span<double> sums) const {
  if (processes_ > 1)
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

double SystemMatrices::largest(double mine) const {
  if (processes_ > 1) MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return mine;
}

}  // namespace pounding::petsc
