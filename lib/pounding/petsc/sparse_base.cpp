#include <pounding/petsc/sparse_base.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/modal_base.hpp>
#include <pounding/petsc/factor.hpp>

namespace pounding::petsc {
namespace {

// Unknowns with mass in one structure up to which its modes are computed.
constexpr int most_modes = 500;
// Columns of Z are solved in blocks of this many, always the same ones, so that their bits do not depend on which links
// pressed first; several at once cost a third of one after the other.
constexpr int columns_together = 8;
// Off the ladder a factor of its own costs as much as conjugate gradients for this many right-hand sides: some 60 solves
// against some 12 each.
constexpr int most_links_by_gradients = 4;
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

bool same(const Shift& a, const Shift& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

// But for rounding of the step's length.
bool alike(const Shift& a, const Shift& b) {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 1e-8 * std::abs(y); };
  return close(a.mass, b.mass) && close(a.damping, b.damping) && close(a.stiffness, b.stiffness);
}

// Of a step that is longer by this power of two; exact for whole ones.
Shift scaled(const Shift& s, double doublings) {
  const double factor = std::exp2(doublings);
  return {s.mass, s.damping * factor, s.stiffness * factor * factor};
}

// First row of each process: whole groups, the borders where the entries of the stiffness come nearest to even parts.
std::vector<int> whole_groups(const System& system, int processes) {
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
    for (SparseMatrix::InnerIterator it(system.closing, i); it; ++it)
      if (it.value() != 0 && !has_mass(it.row()))
        throw std::invalid_argument(fmt::format("link {} acts on unknown {}, which has no mass", i, it.row()));
}

}  // namespace

// Rows of this process. K, M and C share one pattern, so that any A is a sum of their values. With whole groups a column
// counts from the first row of this process, else from that of all.
struct SparseBase::Matrices {
  Pattern pattern;
  std::vector<double> stiffness, mass, damping;  // mass is empty when diagonal, damping when there is none
  Eigen::VectorXd diagonal_mass;
  std::unique_ptr<Product> shared_stiffness, shared_mass, shared_damping;  // rows that touch other processes
};

// One matrix A with what was solved with it. Off the ladder there is a factor or the nearest rung.
struct SparseBase::Level {
  std::optional<int> rung;
  Shift shift;
  std::unique_ptr<Factor> factor;
  Level* near = nullptr;
  std::unique_ptr<NearSolver> gradients;
  std::vector<Eigen::MatrixXd> z;      // blocks of columns A^-1 b
  std::vector<const double*> columns;  // of all blocks; a link's own is what stands in its groups
  Eigen::MatrixXd ends;                // [slot, column] of B^T Z
  std::vector<int> place;              // of a link's column, -1 for none
  double bytes = 0;                    // of the factor, on the process where it is largest
  long used = 0;

  double memory() const {
    Eigen::Index numbers = ends.size();
    for (const Eigen::MatrixXd& block : z) numbers += block.size();
    return bytes + sizeof(double) * static_cast<double>(numbers);
  }
};

// A block of a matrix at some of the unknowns, with its factor.
struct SparseBase::Subset {
  std::vector<int> rows;  // on this process
  std::unique_ptr<Factor> factor;
  Eigen::VectorXd b, x;

  // `wanted` tells of every unknown; columns count as in `solving`, the first row of those that share the factor.
  Subset(MPI_Comm comm, const SparseMatrix& matrix, const std::vector<bool>& wanted, int solving, int first, int end,
         const std::string& prefix) {
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
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_SUM, comm);
    if (all > 0) factor = std::make_unique<Factor>(comm, pattern, values, prefix);
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

SparseBase::~SparseBase() = default;

SparseBase::SparseBase(MPI_Comm comm, const System& system, const SparseOptions& options)
    : comm_(comm), solving_comm_(comm), system_(system), options_(options), matrices_(std::make_unique<Matrices>()) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &processes_);
  PetscReal memory = options_.memory;
  PetscInt direct_below = options_.direct_below;
  check(PetscOptionsGetReal(nullptr, options_.prefix.c_str(), "-memory", &memory, nullptr));
  check(PetscOptionsGetInt(nullptr, options_.prefix.c_str(), "-direct_below", &direct_below, nullptr));
  options_.memory = memory;
  options_.direct_below = static_cast<int>(direct_below);
  const int n = system.size();
  if (n < processes_)
    throw std::invalid_argument(fmt::format("{} unknowns on {} processes; type mpirun -n {}, or fewer", n, processes_, n));
  require_groups(system);
  const Eigen::VectorXd masses = system.mass.diagonal();
  require_masses(system, masses);

  const bool whole = static_cast<int>(system.groups.size()) >= processes_;
  if (whole) {
    first_row_ = whole_groups(system, processes_);
    solving_comm_ = PETSC_COMM_SELF;
  } else {
    for (int r = 0; r <= processes_; ++r) first_row_.push_back(static_cast<int>(static_cast<long>(n) * r / processes_));
  }
  const int first = first_row_[rank_], end = first_row_[rank_ + 1], solving = whole ? first : 0;

  bool lumped = true;
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(system.mass, j); it; ++it) lumped = lumped && (it.row() == j || it.value() == 0);
  bool dashpots = false;
  for (int j = 0; j < system.damping.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(system.damping, j); it; ++it) dashpots = dashpots || it.value() != 0;
  Matrices& m = *matrices_;
  m.diagonal_mass = masses.segment(first, end - first);
  // Columns of a symmetric matrix are its rows.
  Eigen::VectorXd k_row = Eigen::VectorXd::Zero(n), m_row = k_row, c_row = k_row;
  std::vector<int> columns;
  for (int i = first; i < end; ++i) {
    columns.assign(1, i);
    const auto scatter = [&](const SparseMatrix& from, Eigen::VectorXd& row) {
      if (from.cols() == 0) return;
      for (SparseMatrix::InnerIterator it(from, i); it; ++it) {
        row[it.row()] = it.value();
        columns.push_back(static_cast<int>(it.row()));
      }
    };
    scatter(system.stiffness, k_row);
    scatter(system.mass, m_row);
    scatter(system.damping, c_row);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const int j : columns) {
      m.pattern.columns.push_back(j - solving);
      m.stiffness.push_back(k_row[j]);
      if (!lumped) m.mass.push_back(m_row[j]);
      if (dashpots) m.damping.push_back(c_row[j]);
      k_row[j] = m_row[j] = c_row[j] = 0;
    }
    m.pattern.begin.push_back(static_cast<PetscInt>(m.pattern.columns.size()));
  }
  if (!whole) {
    m.shared_stiffness = std::make_unique<Product>(make_matrix(comm, m.pattern, m.stiffness));
    if (!lumped) m.shared_mass = std::make_unique<Product>(make_matrix(comm, m.pattern, m.mass));
    if (dashpots) m.shared_damping = std::make_unique<Product>(make_matrix(comm, m.pattern, m.damping));
  }

  load_.resize(end - first, system.load.cols());
  if (load_.size() > 0) load_ = system.load.middleRows(first, end - first);
  observed_.resize(end - first, system.observed.cols());
  if (observed_.size() > 0) observed_ = system.observed.middleRows(first, end - first);
  weights_ = m.diagonal_mass;
  for (std::size_t k = 0; k < system.groups.size(); ++k) {
    const Group& group = system.groups[k];
    group_masses_.push_back(masses.segment(group.first, group.count).sum());
    const int from = std::max(first, group.first), to = std::min(end, group.first + group.count);
    if (from < to) segments_.push_back({from - first, to - from, static_cast<int>(k)});
  }
  std::vector<bool> heavy(n);
  for (int i = 0; i < n; ++i) heavy[i] = masses[i] > 0;
  any_massless_ = std::find(heavy.begin(), heavy.end(), false) != heavy.end();
  if (!lumped) {
    heavy_ = std::make_unique<Subset>(solving_comm_, system.mass, heavy, solving, first, end, options_.prefix);
    if (!agreed(heavy_->ok())) name_singular(system.mass, "the mass matrix");
  }

  slots_.resize(system.links());
  for (int i = 0; i < system.links(); ++i)
    for (const Group& group : system.groups) {
      Part part{i, slot_count_, {}};
      bool joined = false;
      for (SparseMatrix::InnerIterator it(system.closing, i); it; ++it) {
        if (it.value() == 0 || it.row() < group.first || it.row() >= group.first + group.count) continue;
        joined = true;
        if (it.row() >= first && it.row() < end) part.entries.emplace_back(static_cast<int>(it.row()) - first, it.value());
      }
      if (!joined) continue;
      slots_[i].push_back(slot_count_++);
      group_of_slot_.push_back(static_cast<int>(&group - system.groups.data()));
      if (!part.entries.empty()) parts_.push_back(std::move(part));
    }
  bundle_links();
  work_.resize(size());
}

bool SparseBase::joins(int link, int group) const {
  return std::any_of(slots_[link].begin(), slots_[link].end(), [&](int slot) { return group_of_slot_[slot] == group; });
}

// Each link goes to the first bundle that has none of its groups.
void SparseBase::bundle_links() {
  std::vector<std::vector<bool>> taken;
  bundle_of_.resize(slots_.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto is_free = [&](const std::vector<bool>& groups) {
      return std::none_of(slots_[i].begin(), slots_[i].end(), [&](int slot) { return groups[group_of_slot_[slot]]; });
    };
    const std::size_t to = std::find_if(taken.begin(), taken.end(), is_free) - taken.begin();
    if (to == taken.size()) {
      taken.emplace_back(system_.groups.size());
      bundles_.emplace_back();
    }
    for (const int slot : slots_[i]) taken[to][group_of_slot_[slot]] = true;
    bundles_[to].push_back(static_cast<int>(i));
    bundle_of_[i] = static_cast<int>(to);
  }
}

bool SparseBase::agreed(bool mine) const {
  int all = mine;
  if (processes_ > 1) MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm_);
  return all != 0;
}

void SparseBase::combine(std::span<double> sums) const {
  if (processes_ > 1)
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

void SparseBase::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  const Matrices& m = *matrices_;
  if (m.shared_stiffness) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) (*m.shared_stiffness)(x.col(j).data(), y.col(j).data());
    return;
  }
  const Eigen::Index ldx = x.outerStride(), ldy = y.outerStride();
  for (Eigen::Index j = 0; j < x.cols();) {
    const double* from = x.data() + j * ldx;
    double* to = y.data() + j * ldy;
    switch (const Eigen::Index left = std::min<Eigen::Index>(4, x.cols() - j); left) {
      case 1: multiply<1>(m.pattern, m.stiffness, from, ldx, to, ldy); break;
      case 2: multiply<2>(m.pattern, m.stiffness, from, ldx, to, ldy); break;
      case 3: multiply<3>(m.pattern, m.stiffness, from, ldx, to, ldy); break;
      default: multiply<4>(m.pattern, m.stiffness, from, ldx, to, ldy);
    }
    j += 4;
  }
}

void SparseBase::mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const {
  const Matrices& m = *matrices_;
  if (m.shared_mass)
    (*m.shared_mass)(x.data(), y.data());
  else if (!m.mass.empty())
    multiply<1>(m.pattern, m.mass, x.data(), x.size(), y.data(), y.size());
  else
    y = m.diagonal_mass.cwiseProduct(x);
}

void SparseBase::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                               Eigen::Ref<Eigen::MatrixXd> y) const {
  const Matrices& m = *matrices_;
  Eigen::VectorXd product;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double* inertia = nullptr;
    if (heavy_) {
      product.resize(x.rows());
      mass_times(x.col(j), product);
      inertia = product.data();
    }
    for (const Segment& s : segments_) {
      const double by_mass = system_.groups[s.group].by_mass, by_stiffness = system_.groups[s.group].by_stiffness;
      const double *xj = x.col(j).data(), *kj = kx.col(j).data(), *mass = m.diagonal_mass.data();
      double* yj = y.col(j).data();
      for (int i = s.first; i < s.first + s.count; ++i)
        yj[i] = by_mass * (inertia ? inertia[i] : mass[i] * xj[i]) + by_stiffness * kj[i];
    }
    if (m.damping.empty()) continue;
    product.resize(x.rows());
    if (m.shared_damping)
      (*m.shared_damping)(x.col(j).data(), product.data());
    else
      multiply<1>(m.pattern, m.damping, x.col(j).data(), x.rows(), product.data(), x.rows());
    y.col(j) += product;
  }
}

void SparseBase::accelerate(Eigen::Ref<Eigen::VectorXd> r) const {
  const Eigen::VectorXd& mass = matrices_->diagonal_mass;
  if (heavy_) {
    heavy_->solve(r, 1);
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (mass[i] == 0) r[i] = 0;
    return;
  }
  for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = mass[i] > 0 ? r[i] / mass[i] : 0;
}

// K_ss x_s = -K_sm x_m.
void SparseBase::follow(Eigen::Ref<Eigen::VectorXd> x) const {
  if (!any_massless_) return;
  if (!massless_) {
    std::vector<bool> loose(system_.size());
    const Eigen::VectorXd masses = system_.mass.diagonal();
    for (int i = 0; i < system_.size(); ++i) loose[i] = masses[i] == 0;
    const int first = first_row_[rank_];
    massless_ = std::make_unique<Subset>(solving_comm_, system_.stiffness, loose, matrices_->shared_stiffness ? 0 : first,
                                         first, first_row_[rank_ + 1], options_.prefix);
    if (!agreed(massless_->ok())) {
      massless_.reset();
      name_singular(system_.stiffness, "the stiffness at the unknowns without mass");
    }
  }
  for (const int i : massless_->rows) x[i] = 0;
  Eigen::VectorXd pull(x.size());
  stiffness_times(x, pull);
  massless_->solve(pull, -1);
  for (const int i : massless_->rows) x[i] = pull[i];
}

// A of this shift, in the pattern.
std::vector<double> SparseBase::values(const Shift& shift) const {
  const Matrices& m = *matrices_;
  std::vector<double> a(m.stiffness.size());
  const int diagonal = m.shared_stiffness ? first_row_[rank_] : 0;
  for (const Segment& s : segments_) {
    const Group& group = system_.groups[s.group];
    const double by_mass = shift.mass + shift.damping * group.by_mass;
    const double by_stiffness = shift.stiffness + shift.damping * group.by_stiffness;
    for (int i = s.first; i < s.first + s.count; ++i)
      for (PetscInt p = m.pattern.begin[i]; p < m.pattern.begin[i + 1]; ++p) {
        a[p] = by_stiffness * m.stiffness[p];
        if (!m.mass.empty())
          a[p] += by_mass * m.mass[p];
        else if (m.pattern.columns[p] == i + diagonal)
          a[p] += by_mass * m.diagonal_mass[i];
        if (!m.damping.empty()) a[p] += shift.damping * m.damping[p];
      }
  }
  return a;
}

void SparseBase::factor(Level& level) {
  const std::vector<double> a = values(level.shift);
  if (!level.rung && spare_ && spare_->refactor(a))
    level.factor = std::move(spare_);
  else
    level.factor = std::make_unique<Factor>(solving_comm_, matrices_->pattern, a, options_.prefix);
  if (!agreed(level.factor->ok())) {
    level.factor.reset();
    const Shift& s = level.shift;
    SparseMatrix a = s.mass * system_.mass + s.stiffness * system_.stiffness;
    name_singular(a, "mass and stiffness together");
  }
  level.bytes = level.factor->memory();
  if (processes_ > 1) MPI_Allreduce(MPI_IN_PLACE, &level.bytes, 1, MPI_DOUBLE, MPI_MAX, comm_);
}

// Every process looks at the whole matrix and finds the same unknown.
void SparseBase::name_singular(const SparseMatrix& matrix, const char* what) const {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> unknowns, number(system_.size(), -1);
  for (int i = 0; i < system_.size(); ++i)
    if (&matrix == &system_.stiffness ? system_.mass.coeff(i, i) == 0 : matrix.coeff(i, i) != 0) {
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

SparseBase::Level& SparseBase::rung(int number, const Shift& shift) {
  for (const auto& level : rungs_)
    if (*level->rung == number && same(level->shift, shift)) {
      level->used = ++clock_;
      return *level;
    }
  auto level = std::make_unique<Level>();
  level->rung = number;
  level->shift = shift;
  level->place.assign(system_.links(), -1);
  level->used = ++clock_;
  factor(*level);
  ++factorizations_;
  rungs_.push_back(std::move(level));
  Level& made = *rungs_.back();
  make_room(&made);
  return made;
}

// The same on every process: they have the same levels with the same bytes.
void SparseBase::make_room(const Level* needed) {
  for (;;) {
    double bytes = (off_ ? off_->memory() : 0) + (spare_ ? spare_->memory() : 0);
    for (const auto& level : rungs_) bytes += level->memory();
    if (processes_ > 1) MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_MAX, comm_);
    if (bytes <= options_.memory * 1e6) return;
    spare_.reset();
    auto oldest = rungs_.end();
    for (auto level = rungs_.begin(); level != rungs_.end(); ++level) {
      const bool kept = level->get() == needed || level->get() == last_rung_ || (off_ && off_->near == level->get());
      if (!kept && (oldest == rungs_.end() || (*level)->used < (*oldest)->used)) oldest = level;
    }
    if (oldest == rungs_.end()) return;
    if (oldest->get() == current_) current_ = nullptr;
    rungs_.erase(oldest);
  }
}

void SparseBase::drop_off() {
  if (!off_) return;
  if (off_->gradients) finished_iterations_ += off_->gradients->iterations();
  if (current_ == off_.get()) current_ = nullptr;
  if (off_->factor) spare_ = std::move(off_->factor);
  off_.reset();
}

// A step may be that of a rung but for rounding of its length: it has the rung's factor near, and no factor of its own.
void SparseBase::shift(const Shift& s, std::optional<int> number) {
  if (number) {
    if (!ladder_ || !alike(scaled(ladder_->shift, ladder_->rung - *number), s)) ladder_ = Ladder{*number, s};
    if (same(scaled(ladder_->shift, ladder_->rung - *number), s)) {
      drop_off();
      if (!current_ || current_->rung != number || !same(current_->shift, s)) current_ = last_rung_ = &rung(*number, s);
      return;
    }
  }
  if (off_ && !off_->gradients && same(off_->shift, s)) {
    current_ = off_.get();
    return;
  }
  drop_off();
  off_ = std::make_unique<Level>();
  off_->shift = s;
  off_->place.assign(system_.links(), -1);
  // The stiffness counts with the square of the step.
  const double halvings = ladder_ ? 0.5 * std::log2(ladder_->shift.stiffness / s.stiffness) : 0;
  if (system_.size() >= options_.direct_below && ladder_ && alike(scaled(ladder_->shift, -halvings), s)) {
    const int nearest = std::max(0, static_cast<int>(std::lround(ladder_->rung + halvings)));
    off_->near = &rung(nearest, scaled(ladder_->shift, ladder_->rung - nearest));
    off_->gradients = std::make_unique<NearSolver>(solving_comm_, matrices_->pattern, values(s), *off_->near->factor,
                                                   options_.prefix + "off_");
  } else {
    factor(*off_);
    ++factorizations_;
    make_room(off_.get());
  }
  current_ = off_.get();
}

bool SparseBase::solve(Eigen::Ref<Eigen::VectorXd> x) {
  work_ = x;
  Level& level = *current_;
  if (level.factor) return solve_by(*level.factor, x);
  if (agreed(level.gradients->solve(work_.data(), x.data(), false))) return true;
  factor(level);
  ++factorizations_;
  return solve_by(*level.factor, x);
}

// What iterates by the user's choice may fail on one process only.
bool SparseBase::solve_by(const Factor& factor, Eigen::Ref<Eigen::VectorXd> x) const {
  const bool solved = factor.solve(work_.data(), x.data());
  return factor.is_direct() ? solved : agreed(solved);
}

// Appends columns of z.
void SparseBase::add_columns(Level& level, Eigen::MatrixXd columns) const {
  gather_ends(columns);
  level.ends.conservativeResize(slot_count_, level.ends.cols() + columns.cols());
  level.ends.rightCols(columns.cols()) = Eigen::MatrixXd::Map(ends_.data(), slot_count_, columns.cols());
  level.z.push_back(std::move(columns));
  for (const auto column : level.z.back().colwise()) level.columns.push_back(column.data());
}

// Appends columns `first` .. of z, the links of which stand in `place`.
bool SparseBase::columns_by_factor(Level& level, int first, int count) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(size(), count), z;
  for (const Part& part : parts_)
    if (const int at = level.place[part.link]; at >= first)
      for (const auto& [row, value] : part.entries) b(row, at - first) += value;
  const bool solved = level.factor->solve(b, z);
  add_columns(level, std::move(z));
  return agreed(solved);
}

bool SparseBase::ensure(Level& level, std::span<const int> links) {
  if (std::all_of(links.begin(), links.end(), [&](int i) { return level.place[i] >= 0; })) return true;
  if (level.rung) {
    for (const int link : links) {
      if (level.place[link] >= 0) continue;
      const int begin = bundle_of_[link] - bundle_of_[link] % columns_together;
      const int end = std::min(begin + columns_together, static_cast<int>(bundles_.size()));
      const int first = static_cast<int>(level.columns.size());
      for (int k = begin; k < end; ++k)
        for (const int i : bundles_[k]) level.place[i] = first + k - begin;
      if (!columns_by_factor(level, first, end - begin)) return false;
    }
    make_room(&level);
    return true;
  }
  const int count = static_cast<int>(links.size());
  // Off the ladder a level serves one trial: its links do not change but for stages of the same step.
  level.place.assign(system_.links(), -1);
  level.z.clear();
  level.columns.clear();
  level.ends.resize(slot_count_, 0);
  if (!level.factor && count > most_links_by_gradients) {
    factor(level);
    ++factorizations_;
  }
  if (!level.factor) {
    Level& near = *level.near;
    if (!ensure(near, links)) return false;
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(size(), count);
    bool solved = true;
    for (int j = 0; j < count && solved; ++j) {
      work_.setZero();
      for (const Part& part : parts_)
        if (part.link == links[j])
          for (const auto& [row, value] : part.entries) work_[row] += value;
      for (const Segment& s : segments_)
        if (joins(links[j], s.group))
          z.col(j).segment(s.first, s.count) = Eigen::VectorXd::Map(near.columns[near.place[links[j]]] + s.first, s.count);
      solved = level.gradients->solve(work_.data(), z.col(j).data(), true);
    }
    if (agreed(solved)) {
      add_columns(level, std::move(z));
      for (int j = 0; j < count; ++j) level.place[links[j]] = j;
      return true;
    }
    factor(level);
    ++factorizations_;
  }
  std::vector<int> column(bundles_.size(), -1);
  int columns = 0;
  for (const int link : links) {
    int& at = column[bundle_of_[link]];
    if (at < 0) at = columns++;
    level.place[link] = at;
  }
  return columns_by_factor(level, 0, columns);
}

bool SparseBase::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  Level& level = *current_;
  if (!ensure(level, links)) return false;
  const int count = static_cast<int>(links.size());
  g.setZero(count, count);
  std::vector<char> own(system_.groups.size(), 0);
  for (int j = 0; j < count; ++j) {
    const auto ends = level.ends.col(level.place[links[j]]);
    for (const int slot : slots_[links[j]]) own[group_of_slot_[slot]] = 1;
    for (int i = 0; i < count; ++i)
      for (const int slot : slots_[links[i]])
        if (own[group_of_slot_[slot]]) g(i, j) += ends[slot];
    for (const int slot : slots_[links[j]]) own[group_of_slot_[slot]] = 0;
  }
  return g.allFinite();
}

void SparseBase::add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                              Eigen::Ref<Eigen::VectorXd> y) const {
  const Level& level = *current_;
  std::vector<const double*> columns;
  std::vector<double> scales;
  for (const Segment& s : segments_) {
    columns.clear();
    scales.clear();
    for (std::size_t j = 0; j < links.size(); ++j) {
      if (!joins(links[j], s.group)) continue;
      columns.push_back(level.columns[level.place[links[j]]]);
      scales.push_back(factor * f[static_cast<Eigen::Index>(j)]);
    }
    // Z comes from far memory: four columns at a time, each read straight through, keep it busy.
    std::size_t j = 0;
    double* to = y.data();
    const int end = s.first + s.count;
    for (; j + 4 <= columns.size(); j += 4) {
      const double *z0 = columns[j], *z1 = columns[j + 1], *z2 = columns[j + 2], *z3 = columns[j + 3];
      const double f0 = scales[j], f1 = scales[j + 1], f2 = scales[j + 2], f3 = scales[j + 3];
      for (int i = s.first; i < end; ++i) to[i] += f0 * z0[i] + f1 * z1[i] + f2 * z2[i] + f3 * z3[i];
    }
    for (; j < columns.size(); ++j)
      for (int i = s.first; i < end; ++i) to[i] += scales[j] * columns[j][i];
  }
}

// B^T x by slot and column, the same on every process.
void SparseBase::gather_ends(Eigen::Ref<const Eigen::MatrixXd> x) const {
  ends_.assign(static_cast<std::size_t>(slot_count_ * x.cols()), 0.0);
  for (const Part& part : parts_)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      double sum = 0;
      for (const auto& [row, value] : part.entries) sum += value * x(row, j);
      ends_[part.slot + slot_count_ * j] = sum;
    }
  combine(ends_);
}

void SparseBase::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& closings) const {
  gather_ends(x);
  closings.resize(system_.links(), x.cols());
  for (int i = 0; i < system_.links(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      double sum = 0;
      for (const int slot : slots_[i]) sum += ends_[slot + slot_count_ * j];
      closings(i, j) = sum;
    }
}

void SparseBase::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  for (const Part& part : parts_) {
    const double scale = factor * f[part.link];
    if (scale == 0) continue;
    for (const auto& [row, value] : part.entries) y[row] += scale * value;
  }
}

void SparseBase::observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  values.setZero(observed_.cols(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (int i = 0; i < observed_.outerSize(); ++i)
      for (SparseMatrix::InnerIterator it(observed_, i); it; ++it) values(i, j) += it.value() * x(it.row(), j);
  combine({values.data(), static_cast<std::size_t>(values.size())});
}

Eigen::VectorXd SparseBase::coordinates(const Eigen::VectorXd& physical) const {
  return physical.segment(first_row_[rank_], size());
}

void SparseBase::physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const {
  if (processes_ == 1) {
    u = x;
    return;
  }
  u.resize(system_.size());
  std::vector<int> counts(processes_);
  for (int r = 0; r < processes_; ++r) counts[r] = first_row_[r + 1] - first_row_[r];
  MPI_Allgatherv(x.data(), size(), MPI_DOUBLE, u.data(), counts.data(), first_row_.data(), MPI_DOUBLE, comm_);
}

int SparseBase::levels() const { return static_cast<int>(rungs_.size()) + (off_ && off_->factor ? 1 : 0); }

double SparseBase::memory() const {
  double bytes = (off_ ? off_->memory() : 0) + (spare_ ? spare_->memory() : 0);
  for (const auto& level : rungs_) bytes += level->memory();
  return bytes * 1e-6;
}

long SparseBase::iterations() const {
  return finished_iterations_ + (off_ && off_->gradients ? off_->gradients->iterations() : 0);
}

std::string SparseBase::description() const {
  const Factor* any = nullptr;
  for (const auto& level : rungs_) any = level->factor.get();
  if (!any && off_) any = off_->factor.get();
  std::string text = fmt::format("{} unknowns", system_.size());
  if (processes_ > 1)
    text += fmt::format(" on {} processes, {}", processes_,
                        matrices_->shared_stiffness ? "one factor for all" : "each with whole structures of its own");
  text += fmt::format(", {}", any ? any->package() : "nothing factored yet");
  text += fmt::format(", {} factorizations, {} factors held in {:.1f} MB", factorizations_, levels(), memory());
  if (iterations() > 0) text += fmt::format(", {} iterations of conjugate gradients off the ladder", iterations());
  return text;
}

std::unique_ptr<Base> make_base(const System& system, BaseKind kind, MPI_Comm comm) {
  const bool modal = kind == BaseKind::modal || (kind == BaseKind::automatic && ModalBase::largest_block(system) <= most_modes);
  if (modal) return std::make_unique<ModalBase>(system);
  return std::make_unique<SparseBase>(comm, system);
}

}  // namespace pounding::petsc
