#include <pounding/linear/lowest_modes.hpp>

#include <fmt/format.h>
#include <slepceps.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <pounding/linear/factor.hpp>
#include <pounding/linear/mode_count.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding::petsc {

template <>
struct Destroyer<EPS> {
  static PetscErrorCode destroy(EPS* object) { return EPSDestroy(object); }
};

namespace {

constexpr const char* modes_prefix = "pounding_modes_";
// Numbers of dynamic and total degrees of freedom up to which dense matrices are faster.
constexpr std::size_t max_dense_dynamic = 300;
constexpr Eigen::Index max_dense = 1500;
// Shifts s as fractions of the largest stiffness-to-mass ratio, far above round-off. With small masses they may exceed
// the lowest w^2; this costs iterations, not accuracy.
constexpr double negative_shifts[] = {-1e-8, -1e-6, -1e-4};
// Relative residual of each eigenvalue; the error of its frequency is its square.
constexpr double close_modes = 1e-12;
// Frequencies are counted up to the first relative gap of this size after the last requested one: far above the
// round-off of equal frequencies.
constexpr double gap = 1e-3;

SparseMatrix shifted(const SparseMatrix& mass, const SparseMatrix& stiffness, double shift) {
  SparseMatrix a = stiffness;
  if (shift != 0) a -= shift * mass;
  a.makeCompressed();
  return a;
}

// L with M = L L^T: n x dynamic degrees of freedom.
SparseMatrix root_of(const SparseMatrix& mass, const std::vector<int>& dynamic) {
  const Eigen::SimplicialLLT<SparseMatrix> llt(submatrix(mass, dynamic, dynamic));
  if (llt.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
  SparseMatrix spread(mass.rows(), static_cast<int>(dynamic.size()));
  for (std::size_t k = 0; k < dynamic.size(); ++k) spread.insert(dynamic[k], static_cast<int>(k)) = 1;
  return spread * SparseMatrix(llt.permutationPinv() * SparseMatrix(llt.matrixL()));
}

// Silences the warning of CHOLMOD for each matrix that is not positive definite, which is how free bodies are detected
// here.
class QuietCholmod {
 public:
  QuietCholmod() {
    PetscBool given = PETSC_FALSE;
    check(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &given));
    ours_ = !given;
    if (ours_) check(PetscOptionsSetValue(nullptr, name.c_str(), "0"));
  }
  ~QuietCholmod() {
    if (ours_) PetscOptionsClearValue(nullptr, name.c_str());
  }
  QuietCholmod(const QuietCholmod&) = delete;
  QuietCholmod& operator=(const QuietCholmod&) = delete;

 private:
  const std::string name = fmt::format("-{}mat_cholmod_print", modes_prefix);
  bool ours_ = false;
};

// L^T (K - s M)^-1 L as a PETSc matrix.
class Flexibility {
 public:
  Flexibility(const SparseMatrix& mass, const SparseMatrix& stiffness, const SparseMatrix& root, double shift)
      : root_(root),
        shift_(shift),
        a_(shifted(mass, stiffness, shift)),
        factor_(PETSC_COMM_SELF, pattern_of(a_), values_of(a_), modes_prefix) {
    const PetscInt m = size();
    check(MatCreateShell(PETSC_COMM_SELF, m, m, m, m, this, shell_.out()));
    check(MatShellSetOperation(shell_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(MatSetOption(shell_, MAT_HERMITIAN, PETSC_TRUE));
  }
  Flexibility(const Flexibility&) = delete;
  Flexibility& operator=(const Flexibility&) = delete;

  bool ok() const { return factor_.ok(); }
  PetscInt size() const { return static_cast<PetscInt>(root_.cols()); }
  double shift() const { return shift_; }
  Mat matrix() const { return shell_; }

  /// (K - s M)^-1 L y.
  Eigen::VectorXd shape(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd force = root_ * y;
    Eigen::VectorXd u(force.size());
    if (!factor_.solve(force.data(), u.data())) throw SolverError("the linear solver of the modes did not converge");
    return u;
  }

 private:
  static PetscErrorCode multiply(Mat shell, Vec from, Vec to) {
    void* self = nullptr;
    const PetscScalar* x = nullptr;
    PetscScalar* y = nullptr;
    std::exception_ptr failure;
    PetscFunctionBegin;
    PetscCall(MatShellGetContext(shell, &self));
    PetscCall(VecGetArrayRead(from, &x));
    PetscCall(VecGetArrayWrite(to, &y));
    try {
      const auto& me = *static_cast<const Flexibility*>(self);
      Eigen::VectorXd::Map(y, me.size()) = me.root_.transpose() * me.shape(Eigen::VectorXd::Map(x, me.size()));
    } catch (...) {
      failure = std::current_exception();
    }
    PetscCall(VecRestoreArrayRead(from, &x));
    PetscCall(VecRestoreArrayWrite(to, &y));
    if (failure) PetscFunctionReturn(fail(failure));
    PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  }

  const SparseMatrix& root_;
  double shift_;
  SparseMatrix a_;
  Factor factor_;
  Handle<Mat> shell_;
};

// Orthonormal eigenvectors of a Flexibility, and 1 / (w^2 - s), decreasing.
struct Pairs {
  std::vector<double> values;
  std::vector<Eigen::VectorXd> vectors;

  std::size_t size() const { return values.size(); }
  void add(double value, Eigen::VectorXd vector) {
    const auto at = std::upper_bound(values.begin(), values.end(), value, std::greater<>()) - values.begin();
    values.insert(values.begin() + at, value);
    vectors.insert(vectors.begin() + at, std::move(vector));
  }
};

// Starting vector with components in all shapes, symmetric or not; different in each round.
Eigen::VectorXd start(PetscInt size, std::size_t round) {
  Eigen::VectorXd x(size);
  for (PetscInt i = 0; i < size; ++i)
    x[i] = 1 + std::sin(1.7 * i + 0.3 * std::sqrt(2.0 + i) + static_cast<double>(round));
  return x;
}

Handle<Vec> copy_of(const Eigen::VectorXd& x) {
  Handle<Vec> vec;
  check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(x.size()), vec.out()));
  PetscScalar* values = nullptr;
  check(VecGetArrayWrite(vec, &values));
  Eigen::VectorXd::Map(values, x.size()) = x;
  check(VecRestoreArrayWrite(vec, &values));
  return vec;
}

// Adds at least `count` pairs, orthogonal to the known ones.
void find(const Flexibility& flexibility, int count, Pairs& pairs) {
  Handle<EPS> eps;
  check(EPSCreate(PETSC_COMM_SELF, eps.out()));
  check(EPSSetOptionsPrefix(eps, modes_prefix));
  check(EPSSetOperators(eps, flexibility.matrix(), nullptr));
  check(EPSSetProblemType(eps, EPS_HEP));
  check(EPSSetType(eps, EPSKRYLOVSCHUR));
  check(EPSSetWhichEigenpairs(eps, EPS_LARGEST_REAL));
  check(EPSSetDimensions(eps, count, PETSC_DEFAULT, PETSC_DEFAULT));
  check(EPSSetTolerances(eps, close_modes, PETSC_DEFAULT));
  std::vector<Handle<Vec>> known;
  std::vector<Vec> raw;
  for (const Eigen::VectorXd& vector : pairs.vectors) raw.push_back(known.emplace_back(copy_of(vector)));
  if (!raw.empty()) check(EPSSetDeflationSpace(eps, static_cast<PetscInt>(raw.size()), raw.data()));
  Handle<Vec> first = copy_of(start(flexibility.size(), pairs.size()));
  Vec raw_first = first;
  check(EPSSetInitialSpace(eps, 1, &raw_first));
  check(EPSSetFromOptions(eps));
  check(EPSSolve(eps));
  PetscInt found = 0, iterations = 0;
  check(EPSGetConverged(eps, &found));
  check(EPSGetIterationNumber(eps, &iterations));
  if (found < count)
    throw SolverError(
        fmt::format("{} of {} modes found in {} iterations; type -{}eps_max_it {} for more iterations, or -{}eps_ncv "
                    "{} for a larger subspace",
                    found, count, iterations, modes_prefix, std::max(100, 4 * iterations), modes_prefix,
                    std::min(flexibility.size(), 4 * count + 30)));
  Handle<Vec> vector = copy_of(Eigen::VectorXd::Zero(flexibility.size()));
  for (PetscInt i = 0; i < found; ++i) {
    PetscScalar value = 0;
    check(EPSGetEigenpair(eps, i, &value, nullptr, vector, nullptr));
    const PetscScalar* entries = nullptr;
    check(VecGetArrayRead(vector, &entries));
    pairs.add(value, Eigen::VectorXd::Map(entries, flexibility.size()));
    check(VecRestoreArrayRead(vector, &entries));
  }
}

// Upper limit of the count as w^2 - s: after the first gap beyond the last requested pair.
double behind(const Pairs& pairs, int count) {
  std::size_t last = count - 1;
  const auto distance = [&](std::size_t i) { return 1 / pairs.values[i]; };
  while (last + 1 < pairs.size() && distance(last + 1) < distance(last) * (1 + gap)) ++last;
  return distance(last) * (1 + gap / 2);
}

// Finds the `count` lowest pairs without omissions. False if K - s M is not positive definite, which not every factor
// reports.
bool find_all(const SparseMatrix& mass, const SparseMatrix& stiffness, const Flexibility& flexibility, int count,
              Pairs& pairs) {
  const auto modes_below = [&](double square) {
    return count_modes_below(shifted(mass, stiffness, square), square, modes_prefix);
  };
  find(flexibility, count, pairs);
  while (static_cast<PetscInt>(pairs.size()) < flexibility.size()) {
    if (pairs.values[count - 1] <= 0) return false;
    const double limit = behind(pairs, count);
    const int known = static_cast<int>(
        std::count_if(pairs.values.begin(), pairs.values.end(), [&](double value) { return 1 / value < limit; }));
    const int there = modes_below(flexibility.shift() + limit);
    if (there == known) break;
    if (modes_below(flexibility.shift()) > 0) return false;
    if (there < known)
      throw SolverError(
          fmt::format("found {} modes, but the pivots of the stiffness give {}: the stiffness is too ill-conditioned "
                      "for its lowest modes",
                      known, there));
    find(flexibility, there - known, pairs);
  }
  return pairs.values.back() > 0;
}

// The modes for one shift; nullopt if K - s M is not positive definite.
std::optional<Eigenmodes> modes_by_shift(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                         const SparseMatrix& root, int count, double shift) {
  const Flexibility flexibility(mass, stiffness, root, shift);
  if (!flexibility.ok()) return {};
  Pairs pairs;
  if (!find_all(mass, stiffness, flexibility, count, pairs)) return {};
  Eigen::MatrixXd shapes(mass.rows(), count);
  for (int j = 0; j < count; ++j) shapes.col(j) = flexibility.shape(pairs.vectors[j]);
  return modes_of_shapes(mass, stiffness, shapes);
}

}  // namespace

Eigenmodes sparse_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count) {
  const std::vector<int> dynamic = split_by_mass(mass).dynamic;
  require_mode_count(count, dynamic.size());
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(mass.rows(), 0)};
  const SparseMatrix root = root_of(mass, dynamic);
  const LibraryLock lock;
  const QuietCholmod quiet;
  // A mode of frequency 0 would dominate the iteration without a shift.
  if (auto modes = modes_by_shift(mass, stiffness, root, count, 0); modes && modes->frequencies[0] > 0)
    return *std::move(modes);
  double scale = 0;
  for (const int i : dynamic) scale = std::max(scale, stiffness.coeff(i, i) / mass.coeff(i, i));
  for (const double part : negative_shifts)
    if (auto modes = modes_by_shift(mass, stiffness, root, count, part * scale)) return *std::move(modes);
  require_static_stiffness(mass, stiffness);
  throw std::invalid_argument("the stiffness is negative for some motion: the structure buckles");
}

Eigenmodes lowest_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count) {
  const bool dense = mass.rows() <= max_dense && split_by_mass(mass).dynamic.size() <= max_dense_dynamic;
  return dense ? dense_modes(mass, stiffness, count) : sparse_modes(mass, stiffness, count);
}

}  // namespace pounding::petsc
