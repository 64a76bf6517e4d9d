#pragma once
/// One stage of a step: one structural solve followed by the link forces, repeated if there are pseudo-forces.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <pounding/stepping/anderson.hpp>
#include <pounding/stepping/equations.hpp>
#include <pounding/stepping/error_norm.hpp>
#include <pounding/stepping/links/link_solver.hpp>
#include <pounding/stepping/springs/active_springs.hpp>

namespace pounding {

/// How the acceleration x of a stage enters: u = free u + by_u x and v = free v + by_v x. Link forces and pseudo-forces
/// have the factor `weight` in its equations A x = r.
struct Stage {
  double by_u = 0;  ///< [s^2]
  double by_v = 0;  ///< [s]
  double weight = 1;
};

/// Solves the stages of one trial step, all with the same matrix A and active links.
///
/// `FreeMotion` is a function (link, g, motion) of the scheme, where g is the closing acceleration B^T A^-1 r of a
/// link. It sets the motion of the link in the stage without active link forces and returns its closing acceleration
/// [m/s^2].
class StageSolver {
 public:
  /// Both arguments must outlive this object.
  StageSolver(Equations& equations, const ErrorNorm& norm)
      : equations_(equations), norm_(norm), links_(equations.links), springs_(links_, equations.ranges) {}

  /// Chooses the active springs of a trial of length h [s] from `now`.
  void choose_springs(const Instant& now, double h) {
    if (equations_.springs.any()) springs_.begin(now, h);  // otherwise all are always active
  }
  /// True if the trial activated more springs; then it must be solved again.
  bool add_springs(const Trial& trial) { return equations_.springs.any() && springs_.grow(trial); }

  /// Chooses the active links and the matrix; `level` as in StructureSolver::set_matrix. False if the flexibility G =
  /// B^T A^-1 B cannot be computed.
  bool begin(const EffectiveMatrix& matrix, const std::optional<int>& level);

  /// Links whose force is an unknown, in ascending order.
  const std::vector<int>& active() const { return active_; }
  /// True if there are any.
  bool linked() const { return !active_.empty(); }
  /// True if any of them is a contact.
  bool presses() const { return linked() && active_.front() < links_.contacts(); }
  /// True if any link may have a force, including springs with constant force.
  bool forced() const { return linked() || springs_.holds(); }

  /// Replaces `r`, the sum of all forces except link forces, by the acceleration of the stage. `force` of all links [N]
  /// is the initial guess and becomes the solution. False if the equations cannot be solved.
  template <class FreeMotion>
  bool solve(const Stage& stage, const FreeMotion& free_motion, Eigen::Ref<Eigen::VectorXd> r, Eigen::VectorXd& force) {
    if (springs_.holds()) r -= stage.weight * held_push_;
    if (!equations_.solver.solve(r)) return false;
    if (active_.empty()) {
      if (springs_.holds()) force = springs_.held();
      return true;
    }
    equations_.solver.gather(active_, r, gathered_);
    for (std::size_t k = 0; k < active_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      active_force_[row] = force[active_[k]];
      free_acceleration_[row] = free_motion(active_[k], gathered_(row, 0), free_[k]);
      if (held_relief_.size() > 0 && links_.is_spring(active_[k]))
        free_[k].penetration -= held_relief_[active_[k] - links_.contacts()];
    }
    if (springs_.holds())
      force = springs_.held();
    else
      force.setZero();
    return condense(stage, force, r);
  }

  /// Solves the stage with pseudo-forces at its displacement, free_displacement + by_u x, by fixed-point iteration from
  /// x = guess.
  template <class FreeMotion>
  bool solve_with_pseudo_forces(const Stage& stage, const Eigen::VectorXd& free_displacement,
                                const Eigen::VectorXd& guess, const FreeMotion& free_motion,
                                Eigen::Ref<Eigen::VectorXd> r, Eigen::VectorXd& force) {
    const Eigen::VectorXd others = r;
    Eigen::VectorXd displacement, found;
    const auto map = [&](const Eigen::VectorXd& x, Eigen::VectorXd& image) {
      displacement = free_displacement + stage.by_u * x;
      equations_.pseudo_force(displacement, pseudo_force_);
      image = others - stage.weight * pseudo_force_;
      if (!solve(stage, free_motion, image, force)) return false;
      ++repetitions_;
      return true;
    };
    const auto size = [&](const Eigen::VectorXd& residual) {
      return norm_.relative_size(stage.by_u * residual, displacement);
    };
    const auto product = [this](const Eigen::VectorXd& p, const Eigen::VectorXd& q) { return norm_.product(p, q); };
    if (!solve_fixed_point(guess, found, map, size, product)) return false;
    r = found;
    return true;
  }

  /// Solves the stage with structures whose forces have a memory, by Newton's method for their displacements and the
  /// unknowns of their members together. The first solution, by the last linearization, is the predictor. Pseudo-forces
  /// of other structures follow by fixed-point iteration.
  template <class FreeMotion>
  bool solve_with_tangents(const Stage& stage, const Eigen::VectorXd& free_displacement, const FreeMotion& free_motion,
                           Eigen::Ref<Eigen::VectorXd> r, Eigen::VectorXd& force) {
    const Eigen::VectorXd others = r;
    Eigen::VectorXd displacement = free_displacement;
    double strain = 0, last_change = 0;
    for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
      equations_.elastic_pseudo_force(displacement, pseudo_force_);
      equations_.tangents.add_pseudo_force(free_displacement, pseudo_force_);
      r = others - stage.weight * pseudo_force_;
      if (!solve(stage, free_motion, r, force)) return false;
      ++repetitions_;
      displacement = free_displacement + stage.by_u * r;
      const bool has_change = linearized_.size() > 0;
      const double change = has_change ? norm_.relative_size(displacement - linearized_, displacement) : 0;
      if (!std::isfinite(change)) return false;
      if (iteration > 0) {
        const double ratio = last_change > 0 ? std::min(change / last_change, 1.0) : 1;
        if (iteration > 1) contraction_ = std::clamp(ratio, 0.5 * contraction_, 0.9);
        if (is_solved(std::max(change, part_of_strain * ratio * strain))) return true;
      }
      last_change = change;
      strain = equations_.tangents.linearize(displacement);
      equations_.tangents.set_tangents();
      linearized_ = displacement;
      if (!find_flexibility()) return false;
    }
    return false;
  }

  /// Closing acceleration of active link number k in the last solved stage [m/s^2], without ground acceleration.
  double link_acceleration(std::size_t k) const {
    return gathered_(static_cast<Eigen::Index>(k), 0) - relief_by_forces(static_cast<Eigen::Index>(k));
  }

  /// Motion of active link number k in the last solved stage, which must be `stage`. The link must not be a spring with
  /// relief.
  LinkMotion link_motion(const Stage& stage, std::size_t k) const {
    const double relief = relief_by_forces(static_cast<Eigen::Index>(k));
    LinkMotion motion = free_[k];
    motion.penetration -= stage.weight * stage.by_u * relief;
    motion.rate -= stage.weight * stage.by_v * relief;
    return motion;
  }

  /// Link at which a solve since begin() failed; -1 if none did.
  int failed_link() const { return failed_link_; }
  /// Number of iterations for link forces and pseudo-forces since the start of the run.
  long iterations() const { return link_solver_.iterations() + repetitions_; }
  void archive(Archive& archive) { archive(link_solver_, repetitions_); }

 private:
  bool find_flexibility();
  bool is_solved(double change) const;
  bool condense(const Stage& stage, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> x);

  // Reduction of the closing acceleration of active link number k by the active forces.
  double relief_by_forces(Eigen::Index k) const {
    const auto [first, end] = blocks_.range(k);
    double relief = 0;
    for (Eigen::Index l = first; l < end; ++l) relief += flexibility_(k, l) * active_force_[l];
    return relief;
  }

  Equations& equations_;
  const ErrorNorm& norm_;
  const LinkSet& links_;
  ActiveSprings springs_;
  LinkSolver link_solver_{links_};
  static constexpr int max_newton_iterations = 40;
  long repetitions_ = 0;
  static constexpr double first_contraction = 0.3;
  static constexpr double part_of_strain = 0.1;  // sections follow the displacements with smaller weights
  // Of Newton's method: ratio of successive changes, carried from stage to stage of a step; displacements of the last
  // linearization, empty in a new step.
  double contraction_ = first_contraction;
  Eigen::VectorXd linearized_;
  int failed_link_ = -1;
  std::vector<int> active_;
  Eigen::VectorXd held_push_,
      held_relief_;                       // B F and S F of springs with constant force; the latter empty without relief
  Eigen::MatrixXd flexibility_, relief_;  // G and S of the active links; S empty without relief
  LinkBlocks blocks_;                     // of G
  std::vector<LinkMotion> free_;          // of the active links
  Eigen::VectorXd free_acceleration_, active_force_;
  Eigen::MatrixXd gathered_;  // B^T x of the active links without their forces
  Eigen::VectorXd pseudo_force_;
};

}  // namespace pounding
