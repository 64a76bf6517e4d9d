#include <pounding/linear/cached_factors.hpp>

#include <algorithm>
#include <cmath>

namespace pounding::petsc {
namespace {

bool same(const EffectiveMatrix& a, const EffectiveMatrix& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

// Equal up to round-off in the step length.
bool alike(const EffectiveMatrix& a, const EffectiveMatrix& b) {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 1e-8 * std::abs(y); };
  return close(a.mass, b.mass) && close(a.damping, b.damping) && close(a.stiffness, b.stiffness);
}

// Matrix of a step longer by the factor 2^doublings; exact for integers.
EffectiveMatrix scaled(const EffectiveMatrix& matrix, double doublings) {
  const double factor = std::exp2(doublings);
  return {matrix.mass, matrix.damping * factor, matrix.stiffness * factor * factor};
}

std::unique_ptr<CachedFactor> make_entry(std::optional<int> step_level, const EffectiveMatrix& matrix, int links) {
  auto entry = std::make_unique<CachedFactor>();
  entry->step_level = step_level;
  entry->matrix = matrix;
  entry->column_of.assign(links, -1);
  return entry;
}

}  // namespace

double CachedFactor::memory() const {
  Eigen::Index numbers = ends.size();
  for (const Eigen::MatrixXd& block : blocks) numbers += block.size();
  return bytes + sizeof(double) * static_cast<double>(numbers);
}

CachedFactors::CachedFactors(const SystemMatrices& matrices, const SparseOptions& options, int unknowns, int links,
                             long& factorizations)
    : matrices_(matrices), options_(options), unknowns_(unknowns), links_(links), factorizations_(factorizations) {}

void CachedFactors::factorize(CachedFactor& entry) {
  const std::vector<double> a = matrices_.values(entry.matrix);
  if (!entry.step_level && spare_ && spare_->refactor(a))
    entry.factor = std::move(spare_);
  else
    entry.factor = std::make_unique<Factor>(matrices_.solving_comm(), matrices_.pattern(), a, options_.prefix);
  if (!matrices_.agreed(entry.factor->ok())) {
    entry.factor.reset();
    matrices_.name_singular(entry.matrix);
  }
  entry.bytes = matrices_.largest(entry.factor->memory());
  ++factorizations_;
}

CachedFactor& CachedFactors::at_level(int number, const EffectiveMatrix& matrix) {
  for (const auto& level : levels_)
    if (*level->step_level == number && same(level->matrix, matrix)) {
      level->used = ++clock_;
      return *level;
    }
  auto level = make_entry(number, matrix, links_);
  level->used = ++clock_;
  factorize(*level);
  levels_.push_back(std::move(level));
  CachedFactor& made = *levels_.back();
  make_room(&made);
  return made;
}

// All processes have the same levels of the same size, so they evict the same ones.
void CachedFactors::make_room(const CachedFactor* needed) {
  while (matrices_.largest(memory()) > options_.memory * 1e6) {
    spare_.reset();
    auto oldest = levels_.end();
    for (auto level = levels_.begin(); level != levels_.end(); ++level) {
      const bool kept =
          level->get() == needed || level->get() == last_level_ || (off_level_ && off_level_->nearest == level->get());
      if (!kept && (oldest == levels_.end() || (*level)->used < (*oldest)->used)) oldest = level;
    }
    if (oldest == levels_.end()) return;
    if (oldest->get() == current_) current_ = nullptr;
    levels_.erase(oldest);
  }
}

void CachedFactors::drop_off_level() {
  if (!off_level_) return;
  if (off_level_->gradients) finished_iterations_ += off_level_->gradients->iterations();
  if (current_ == off_level_.get()) current_ = nullptr;
  if (off_level_->factor) spare_ = std::move(off_level_->factor);
  off_level_.reset();
}

// A step whose length differs from that of a level by round-off only is off the levels, and is solved with the level's
// factor.
void CachedFactors::select(const EffectiveMatrix& matrix, std::optional<int> step_level) {
  if (step_level) {
    if (!reference_ || !alike(scaled(reference_->matrix, reference_->level - *step_level), matrix))
      reference_ = Reference{*step_level, matrix};
    if (same(scaled(reference_->matrix, reference_->level - *step_level), matrix)) {
      drop_off_level();
      if (!current_ || current_->step_level != step_level || !same(current_->matrix, matrix))
        current_ = last_level_ = &at_level(*step_level, matrix);
      return;
    }
  }
  if (off_level_ && !off_level_->gradients && same(off_level_->matrix, matrix)) {
    current_ = off_level_.get();
    return;
  }
  drop_off_level();
  off_level_ = make_entry(std::nullopt, matrix, links_);
  // The stiffness coefficient is proportional to the square of the step length.
  const double halvings = reference_ ? 0.5 * std::log2(reference_->matrix.stiffness / matrix.stiffness) : 0;
  if (unknowns_ >= options_.direct_below && reference_ && alike(scaled(reference_->matrix, -halvings), matrix)) {
    const int nearest = std::max(0, static_cast<int>(std::lround(reference_->level + halvings)));
    off_level_->nearest = &at_level(nearest, scaled(reference_->matrix, reference_->level - nearest));
    off_level_->gradients =
        std::make_unique<NearSolver>(matrices_.solving_comm(), matrices_.pattern(), matrices_.values(matrix),
                                     *off_level_->nearest->factor, options_.prefix + "off_");
  } else {
    factorize(*off_level_);
    make_room(off_level_.get());
  }
  current_ = off_level_.get();
}

double CachedFactors::memory() const {
  double bytes = (off_level_ ? off_level_->memory() : 0) + (spare_ ? spare_->memory() : 0);
  for (const auto& level : levels_) bytes += level->memory();
  return bytes;
}

std::string CachedFactors::package() const {
  const Factor* any = levels_.empty() ? nullptr : levels_.back()->factor.get();
  if (!any && off_level_) any = off_level_->factor.get();
  return any ? any->package() : std::string();
}

}  // namespace pounding::petsc
