#include <pounding/linear/sparse_solver.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pounding::petsc {
namespace {

// Columns of Z are solved in blocks of this many, always the same ones, so that their bits do not depend on which links
// pressed first; several at once cost a third of one after the other.
constexpr int columns_together = 8;
// Off the ladder a factor of its own costs as much as conjugate gradients for this many right-hand sides: some 60 solves
// against some 12 each.
constexpr int max_links_by_gradients = 4;

bool same(const EffectiveMatrix& a, const EffectiveMatrix& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

// But for rounding of the step's length.
bool alike(const EffectiveMatrix& a, const EffectiveMatrix& b) {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 1e-8 * std::abs(y); };
  return close(a.mass, b.mass) && close(a.damping, b.damping) && close(a.stiffness, b.stiffness);
}

// Of a step that is longer by this power of two; exact for whole ones.
EffectiveMatrix scaled(const EffectiveMatrix& s, double doublings) {
  const double factor = std::exp2(doublings);
  return {s.mass, s.damping * factor, s.stiffness * factor * factor};
}

}  // namespace

// One matrix A with what was solved with it. Off the ladder there is a factor or the nearest rung.
struct SparseSolver::Level {
  std::optional<int> rung;
  EffectiveMatrix shift;
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

SparseSolver::~SparseSolver() = default;

SparseSolver::SparseSolver(MPI_Comm comm, const System& system, const SparseOptions& options)
    : system_(system), options_(options), matrices_(comm, system, options.prefix), ends_(system, matrices_) {
  PetscReal memory = options_.memory;
  PetscInt direct_below = options_.direct_below;
  check(PetscOptionsGetReal(nullptr, options_.prefix.c_str(), "-memory", &memory, nullptr));
  check(PetscOptionsGetInt(nullptr, options_.prefix.c_str(), "-direct_below", &direct_below, nullptr));
  options_.memory = memory;
  options_.direct_below = static_cast<int>(direct_below);

  const int first = matrices_.first(), rows = matrices_.rows();
  load_.resize(rows, system.load.cols());
  if (load_.size() > 0) load_ = system.load.middleRows(first, rows);
  outputs_.resize(rows, system.outputs.cols());
  if (outputs_.size() > 0) outputs_ = system.outputs.middleRows(first, rows);
  weights_ = matrices_.diagonal_mass();
  segments_ = matrices_.segments();
  const Eigen::VectorXd masses = system.mass.diagonal();
  for (const Group& group : system.groups) group_masses_.push_back(masses.segment(group.first, group.count).sum());
  work_.resize(size());
}

void SparseSolver::combine(std::span<double> sums) const { matrices_.combine(sums); }

void SparseSolver::stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const {
  matrices_.stiffness_times(x, y);
}

void SparseSolver::damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                               Eigen::Ref<Eigen::MatrixXd> y) const {
  matrices_.damping_times(x, kx, y);
}

void SparseSolver::mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const {
  matrices_.mass_times(x, y);
}

void SparseSolver::accelerate(Eigen::Ref<Eigen::VectorXd> r) const { matrices_.accelerate(r); }
void SparseSolver::recover(Eigen::Ref<Eigen::VectorXd> x) const { matrices_.recover(x); }

void SparseSolver::factor(Level& level) {
  const std::vector<double> a = matrices_.values(level.shift);
  if (!level.rung && spare_ && spare_->refactor(a))
    level.factor = std::move(spare_);
  else
    level.factor = std::make_unique<Factor>(matrices_.solving_comm(), matrices_.pattern(), a, options_.prefix);
  if (!matrices_.agreed(level.factor->ok())) {
    level.factor.reset();
    matrices_.name_singular(level.shift);
  }
  level.bytes = matrices_.largest(level.factor->memory());
}

SparseSolver::Level& SparseSolver::rung(int number, const EffectiveMatrix& shift) {
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
void SparseSolver::make_room(const Level* needed) {
  for (;;) {
    double bytes = (off_ ? off_->memory() : 0) + (spare_ ? spare_->memory() : 0);
    for (const auto& level : rungs_) bytes += level->memory();
    if (matrices_.largest(bytes) <= options_.memory * 1e6) return;
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

void SparseSolver::drop_off() {
  if (!off_) return;
  if (off_->gradients) finished_iterations_ += off_->gradients->iterations();
  if (current_ == off_.get()) current_ = nullptr;
  if (off_->factor) spare_ = std::move(off_->factor);
  off_.reset();
}

// A step may be that of a rung but for rounding of its length: it has the rung's factor near, and no factor of its own.
void SparseSolver::set_matrix(const EffectiveMatrix& s, std::optional<int> number) {
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
    off_->gradients = std::make_unique<NearSolver>(matrices_.solving_comm(), matrices_.pattern(), matrices_.values(s),
                                                   *off_->near->factor, options_.prefix + "off_");
  } else {
    factor(*off_);
    ++factorizations_;
    make_room(off_.get());
  }
  current_ = off_.get();
}

bool SparseSolver::solve(Eigen::Ref<Eigen::VectorXd> x) {
  work_ = x;
  Level& level = *current_;
  if (level.factor) return solve_by(*level.factor, x);
  if (matrices_.agreed(level.gradients->solve(work_.data(), x.data(), false))) return true;
  factor(level);
  ++factorizations_;
  return solve_by(*level.factor, x);
}

// What iterates by the user's choice may fail on one process only.
bool SparseSolver::solve_by(const Factor& factor, Eigen::Ref<Eigen::VectorXd> x) const {
  const bool solved = factor.solve(work_.data(), x.data());
  return factor.is_direct() ? solved : matrices_.agreed(solved);
}

// Appends columns of z.
void SparseSolver::add_columns(Level& level, Eigen::MatrixXd columns) const {
  level.ends.conservativeResize(ends_.slots(), level.ends.cols() + columns.cols());
  level.ends.rightCols(columns.cols()) = ends_.by_slot(columns);
  level.z.push_back(std::move(columns));
  for (const auto column : level.z.back().colwise()) level.columns.push_back(column.data());
}

// Appends columns `first` .. of z, the links of which stand in `place`.
bool SparseSolver::columns_by_factor(Level& level, int first, int count) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(size(), count), z;
  ends_.add_columns(level.place, first, b);
  const bool solved = level.factor->solve(b, z);
  add_columns(level, std::move(z));
  return matrices_.agreed(solved);
}

bool SparseSolver::ensure(Level& level, std::span<const int> links) {
  if (std::all_of(links.begin(), links.end(), [&](int i) { return level.place[i] >= 0; })) return true;
  if (level.rung) {
    for (const int link : links) {
      if (level.place[link] >= 0) continue;
      const int begin = ends_.bundle_of(link) - ends_.bundle_of(link) % columns_together;
      const int end = std::min(begin + columns_together, ends_.bundles());
      const int first = static_cast<int>(level.columns.size());
      for (int k = begin; k < end; ++k)
        for (const int i : ends_.bundle(k)) level.place[i] = first + k - begin;
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
  level.ends.resize(ends_.slots(), 0);
  if (!level.factor && count > max_links_by_gradients) {
    factor(level);
    ++factorizations_;
  }
  if (!level.factor) {
    Level& near = *level.near;
    if (!ensure(near, links)) return false;
    for (int j = 0; j < count; ++j) level.place[links[j]] = j;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(size(), count), z = b;
    ends_.add_columns(level.place, 0, b);
    bool solved = true;
    for (int j = 0; j < count && solved; ++j) {
      work_ = b.col(j);
      for (const Segment& s : segments_)
        if (ends_.joins(links[j], s.group))
          z.col(j).segment(s.first, s.count) = Eigen::VectorXd::Map(near.columns[near.place[links[j]]] + s.first, s.count);
      solved = level.gradients->solve(work_.data(), z.col(j).data(), true);
    }
    if (matrices_.agreed(solved)) {
      add_columns(level, std::move(z));
      return true;
    }
    factor(level);
    ++factorizations_;
  }
  level.place.assign(system_.links(), -1);
  std::vector<int> column(ends_.bundles(), -1);
  int columns = 0;
  for (const int link : links) {
    int& at = column[ends_.bundle_of(link)];
    if (at < 0) at = columns++;
    level.place[link] = at;
  }
  return columns_by_factor(level, 0, columns);
}

bool SparseSolver::flexibility(std::span<const int> links, Eigen::MatrixXd& g) {
  Level& level = *current_;
  if (!ensure(level, links)) return false;
  const int count = static_cast<int>(links.size());
  g.setZero(count, count);
  std::vector<char> own(system_.groups.size(), 0);
  for (int j = 0; j < count; ++j) {
    const auto ends = level.ends.col(level.place[links[j]]);
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
  const Level& level = *current_;
  std::vector<const double*> columns;
  std::vector<double> scales;
  for (const Segment& s : segments_) {
    columns.clear();
    scales.clear();
    for (std::size_t j = 0; j < links.size(); ++j) {
      if (!ends_.joins(links[j], s.group)) continue;
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

void SparseSolver::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const { ends_.gather(x, relative); }

void SparseSolver::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  ends_.add_forces(factor, f, y);
}

void SparseSolver::add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  y += f.segment(matrices_.first(), size());
}

void SparseSolver::observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
  values.setZero(outputs_.cols(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (int i = 0; i < outputs_.outerSize(); ++i)
      for (SparseMatrix::InnerIterator it(outputs_, i); it; ++it) values(i, j) += it.value() * x(it.row(), j);
  combine({values.data(), static_cast<std::size_t>(values.size())});
}

Eigen::VectorXd SparseSolver::coordinates(const Eigen::VectorXd& physical) const {
  return physical.segment(matrices_.first(), size());
}

void SparseSolver::physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const { matrices_.spread(x, u); }

int SparseSolver::levels() const { return static_cast<int>(rungs_.size()) + (off_ && off_->factor ? 1 : 0); }

double SparseSolver::memory() const {
  double bytes = (off_ ? off_->memory() : 0) + (spare_ ? spare_->memory() : 0);
  for (const auto& level : rungs_) bytes += level->memory();
  return bytes * 1e-6;
}

long SparseSolver::iterations() const {
  return finished_iterations_ + (off_ && off_->gradients ? off_->gradients->iterations() : 0);
}

std::string SparseSolver::description() const {
  const Factor* any = nullptr;
  for (const auto& level : rungs_) any = level->factor.get();
  if (!any && off_) any = off_->factor.get();
  std::string text = fmt::format("{} unknowns", system_.size());
  if (matrices_.processes() > 1)
    text += fmt::format(" on {} processes, {}", matrices_.processes(),
                        matrices_.whole_groups() ? "each with whole structures of its own" : "one factor for all");
  text += fmt::format(", {}", any ? any->package() : "nothing factored yet");
  text += fmt::format(", {} factorizations, {} factors held in {:.1f} MB", factorizations_, levels(), memory());
  if (iterations() > 0) text += fmt::format(", {} iterations of conjugate gradients off the ladder", iterations());
  return text;
}

}  // namespace pounding::petsc
