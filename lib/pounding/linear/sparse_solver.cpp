#include <pounding/linear/sparse_solver.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace pounding::petsc {
namespace {

// Columns of Z are solved in fixed blocks of this size, so they do not depend bitwise on the order in which links
// became active. A block takes a third of the time of its columns solved separately.
constexpr int columns_together = 8;
// Off the step levels, a factorization costs as much as conjugate gradients for this many right-hand sides: about 60
// solves versus about 12 each.
constexpr std::size_t max_links_by_gradients = 4;

}  // namespace

SparseSolver::SparseSolver(MPI_Comm comm, const System& system, const SparseOptions& options)
    : StructureSolver(system),
      system_(system),
      options_(options),
      matrices_(comm, system, options.prefix),
      ends_(system, matrices_, layout_.relief),
      factors_(matrices_, options_, system.size(), system.links(), factorizations_) {
  PetscReal memory = options_.memory;
  PetscInt direct_below = options_.direct_below;
  check(PetscOptionsGetReal(nullptr, options_.prefix.c_str(), "-memory", &memory, nullptr));
  check(PetscOptionsGetInt(nullptr, options_.prefix.c_str(), "-direct_below", &direct_below, nullptr));
  options_.memory = memory;
  options_.direct_below = static_cast<int>(direct_below);

  const int first = matrices_.first(), rows = matrices_.rows();
  layout_.step_lengths = StepLengths::needs_dyadic;
  layout_.load.resize(rows, system.load.cols());
  if (layout_.load.size() > 0) layout_.load = system.load.middleRows(first, rows);
  outputs_.resize(rows, system.outputs.cols());
  if (outputs_.size() > 0) outputs_ = system.outputs.middleRows(first, rows);
  layout_.weights = matrices_.diagonal_mass();
  layout_.segments = matrices_.segments();
  const Eigen::VectorXd masses = system.mass.diagonal();
  for (const Group& group : system.groups)
    layout_.group_masses.push_back(masses.segment(group.first, group.count).sum());
  work_.resize(size());
}

bool SparseSolver::solve(Eigen::Ref<Eigen::VectorXd> x) {
  work_ = x;
  CachedFactor& entry = factors_.current();
  if (entry.factor) return solve_by(*entry.factor, x);
  if (matrices_.agreed(entry.gradients->solve(work_.data(), x.data(), false))) return true;
  factors_.factorize(entry);
  return solve_by(*entry.factor, x);
}

// An iterative solver, which the user may select, can fail on one process only.
bool SparseSolver::solve_by(const Factor& factor, Eigen::Ref<Eigen::VectorXd> x) const {
  const bool solved = factor.solve(work_.data(), x.data());
  return factor.is_direct() ? solved : matrices_.agreed(solved);
}

// Appends solved columns of Z.
void SparseSolver::add_columns(CachedFactor& entry, Eigen::MatrixXd columns) const {
  entry.ends.conservativeResize(ends_.slots(), entry.ends.cols() + columns.cols());
  entry.ends.rightCols(columns.cols()) = ends_.by_slot(columns);
  entry.blocks.push_back(std::move(columns));
  for (const auto column : entry.blocks.back().colwise()) entry.columns.push_back(column.data());
}

// Solves for `count` columns of Z from column `first` on, for the links in `column_of`, and appends them.
bool SparseSolver::columns_by_factor(CachedFactor& entry, int first, int count) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(size(), count), z;
  ends_.add_columns(entry.column_of, first, b);
  const bool solved = entry.factor->solve(b, z);
  add_columns(entry, std::move(z));
  return matrices_.agreed(solved);
}

// Solves whole blocks of columns, so each column is always solved together with the same others.
bool SparseSolver::ensure_at_level(CachedFactor& entry, std::span<const int> links) {
  for (const int link : links) {
    if (entry.column_of[link] >= 0) continue;
    const int begin = ends_.batch_of(link) - ends_.batch_of(link) % columns_together;
    const int end = std::min(begin + columns_together, ends_.batches());
    const int first = static_cast<int>(entry.columns.size());
    for (int k = begin; k < end; ++k)
      for (const int i : ends_.batch(k)) entry.column_of[i] = first + k - begin;
    if (!columns_by_factor(entry, first, end - begin)) return false;
  }
  factors_.make_room(&entry);
  return true;
}

// Starts from the columns of the nearest level. False if an iteration does not converge on any process.
bool SparseSolver::columns_by_gradients(CachedFactor& entry, std::span<const int> links) {
  const CachedFactor& nearest = *entry.nearest;
  const int count = static_cast<int>(links.size());
  for (int j = 0; j < count; ++j) entry.column_of[links[j]] = j;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(size(), count), z = b;
  ends_.add_columns(entry.column_of, 0, b);
  bool solved = true;
  for (int j = 0; j < count && solved; ++j) {
    work_ = b.col(j);
    const double* const near_column = nearest.columns[nearest.column_of[links[j]]];
    for (const Segment& s : layout_.segments)
      if (ends_.joins(links[j], s.group))
        z.col(j).segment(s.first, s.count) = Eigen::VectorXd::Map(near_column + s.first, s.count);
    solved = entry.gradients->solve(work_.data(), z.col(j).data(), true);
  }
  if (!matrices_.agreed(solved)) return false;
  add_columns(entry, std::move(z));
  return true;
}

// Ensures the columns of Z of these links. False if a solve fails.
bool SparseSolver::ensure(CachedFactor& entry, std::span<const int> links) {
  if (std::all_of(links.begin(), links.end(), [&](int i) { return entry.column_of[i] >= 0; })) return true;
  if (entry.step_level) return ensure_at_level(entry, links);
  // Off the step levels entries last for one trial step; their links change only between stages.
  entry.column_of.assign(system_.links(), -1);
  entry.blocks.clear();
  entry.columns.clear();
  entry.ends.resize(ends_.slots(), 0);
  if (!entry.factor && links.size() > max_links_by_gradients) factors_.factorize(entry);
  if (!entry.factor) {
    if (!ensure(*entry.nearest, links)) return false;
    if (columns_by_gradients(entry, links)) return true;
    factors_.factorize(entry);
  }
  entry.column_of.assign(system_.links(), -1);
  std::vector<int> column(ends_.batches(), -1);
  int columns = 0;
  for (const int link : links) {
    int& at = column[ends_.batch_of(link)];
    if (at < 0) at = columns++;
    entry.column_of[link] = at;
  }
  return columns_by_factor(entry, 0, columns);
}

bool SparseSolver::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  CachedFactor& entry = factors_.current();
  if (!ensure(entry, links)) return false;
  const int count = static_cast<int>(links.size());
  g.setZero(count, count);
  std::vector<char> own(system_.groups.size(), 0);
  for (int j = 0; j < count; ++j) {
    const auto ends = entry.ends.col(entry.column_of[links[j]]);
    for (const int slot : ends_.slots_of(links[j])) own[ends_.group_of(slot)] = 1;
    for (int i = 0; i < count; ++i)
      for (const int slot : ends_.slots_of(links[i]))
        if (own[ends_.group_of(slot)]) g(i, j) += ends[slot];
    for (const int slot : ends_.slots_of(links[j])) own[ends_.group_of(slot)] = 0;
  }
  return g.allFinite();
}

void SparseSolver::add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                                Eigen::Ref<Eigen::VectorXd> y) const {
  const CachedFactor& entry = factors_.current();
  std::vector<const double*> columns;
  std::vector<double> scales;
  for (const Segment& s : layout_.segments) {
    columns.clear();
    scales.clear();
    for (std::size_t j = 0; j < links.size(); ++j) {
      if (!ends_.joins(links[j], s.group)) continue;
      columns.push_back(entry.columns[entry.column_of[links[j]]]);
      scales.push_back(factor * f[static_cast<Eigen::Index>(j)]);
    }
    // Z exceeds the caches: reading four columns at a time, each in order, uses the memory bandwidth.
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

void SparseSolver::gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
                          Eigen::MatrixXd& relative) const {
  Eigen::MatrixXd all;
  ends_.gather(x, all);
  relative.resize(static_cast<Eigen::Index>(links.size()), x.cols());
  for (std::size_t i = 0; i < links.size(); ++i) relative.row(static_cast<Eigen::Index>(i)) = all.row(links[i]);
}

void SparseSolver::observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  values.setZero(outputs_.cols(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (int i = 0; i < outputs_.outerSize(); ++i)
      for (SparseMatrix::InnerIterator it(outputs_, i); it; ++it) values(i, j) += it.value() * x(it.row(), j);
  combine({values.data(), static_cast<std::size_t>(values.size())});
}

std::string SparseSolver::description() const {
  const std::string package = factors_.package();
  std::string text = fmt::format("{} unknowns", system_.size());
  if (matrices_.processes() > 1)
    text += fmt::format(" on {} processes, {}", matrices_.processes(),
                        matrices_.whole_groups() ? "each with whole structures" : "one factor for all");
  text += fmt::format(", {}", package.empty() ? "no factor yet" : package);
  text += fmt::format(", {} factorizations, {} factors in {:.1f} MB", factorizations_, factors(), memory());
  if (iterations() > 0) text += fmt::format(", {} iterations of conjugate gradients off the step levels", iterations());
  return text;
}

}  // namespace pounding::petsc
