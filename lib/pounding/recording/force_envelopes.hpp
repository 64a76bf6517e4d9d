#pragma once
/// Extremes of internal forces of frames, of reactions, and of the approach of the ends of links.

#include <Eigen/Core>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/knots.hpp>
#include <pounding/recording/linear_quantities.hpp>
#include <pounding/recording/step_motion.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Fills the force envelopes of frames. Forces require all unknowns, so they are evaluated at knots only. A knot is the
/// end of a step; steps are skipped while the cubic between two knots follows the displacements closely. Extremes
/// between knots are found on that cubic, for several knots in one call. While a contact acts on a member between its
/// ends, the forces of such members are evaluated in every step.
class ForceEnvelopes {
 public:
  /// Fills the envelopes of the structures in `results`, and `approach` in a run without links. All arguments must
  /// outlive this.
  ForceEnvelopes(const Model& model, const GroundPlan& plan, const StepView& stepper, Results& results);

  /// Records the initial state.
  void begin();
  /// Records an accepted step.
  void step(const StepMotion& step);
  /// Makes the final state the last knot and completes the envelopes.
  void end();
  /// Updates the envelopes of the results to the last knot.
  void show();
  /// For a checkpoint, without the envelopes.
  void archive(Archive& archive);

 private:
  // Quantities of one frame, or of all links.
  struct Block {
    int structure;  // -1: links
    // contacts may act on its members between their ends, or its members rotate by large angles
    bool loaded;
    LinearQuantities quantities;
    Eigen::VectorXd values, rates;  // at the last knot evaluated
    Extremes extremes;
    // evaluated in every step: contacts act between member ends, or parts have yielded, so forces are not linear
    // between two knots
    bool apart = false;
  };
  // A contact that acts on a member between its ends; the fixed-end forces of its members and supports.
  struct FixedEnds {
    int link, block;
    Eigen::SparseVector<double> by_force;  // on the quantities of the block, per unit force
  };

  void add_frame(int structure);
  void add_block(int structure, bool loaded, LinearQuantities quantities);
  bool presses_on_members() const;
  bool parts_act() const;
  bool is_apart(const Block& block, bool pressed) const;
  void take_begin(const StepMotion& step);
  void take_springs(double time, double other_end);
  void add_yielding(const Block& block, const Eigen::VectorXd& of_springs, Eigen::VectorXd& values) const;
  void start_from(const Instant& instant);
  void close(const Instant& instant, double time, bool pressed);
  void wait(const Instant& instant);
  void follow();
  void follow(Block& block, double begin, double end, bool pressed);
  void evaluate(const Block& block, double time, Eigen::VectorXd& values, Eigen::VectorXd& rates);
  template <class Force>
  void add_fixed_end_forces(const Block& block, Eigen::VectorXd& values, Force&& force) const;

  const Model& model_;
  const GroundPlan& plan_;
  const StepView& stepper_;
  Results& results_;
  std::vector<int> first_unknown_;  // by structure
  std::vector<int> first_spring_;   // by structure
  std::vector<Block> blocks_;
  std::vector<FixedEnds> fixed_ends_;
  // every step is a knot: contacts change velocities instantaneously, or no strain energy exists to measure by
  bool every_step_ = false;
  bool yields_ = false;  // parts of frames may yield, which adds to forces directly
  // members rotate by large angles: their forces vary more than the displacements, and each step has a knot inside
  bool is_nonlinear_ = false;
  Knots knots_;
  bool jumped_ = false;          // a discontinuity at the end of the last step
  bool acts_ = false;            // yielding parts of frames have forces in the current step
  double followed_ = 0;          // knot up to which the extremes are known [s]
  std::vector<double> times_;    // later knots whose motions are pending [s]
  bool linear_ = false;          // all unknowns are linear in the coordinates
  Eigen::MatrixXd coordinates_;  // if linear_: pending motions, displacements before velocities
  LinearQuantities::Instants<LinearQuantities::batch> motions_, evaluated_;
  std::vector<int> beyond_;  // quantities that may have new extremes
  LinearQuantities::Instants<1> motion_, evaluated_once_;
  Eigen::VectorXd u_, v_;                   // all unknowns
  Eigen::VectorXd springs_, spring_rates_;  // forces of all springs for the motion in u_ and v_, and their rates
  Eigen::VectorXd end_, rates_;             // at the next knot
};

}  // namespace pounding
