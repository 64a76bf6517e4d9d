#pragma once
/// Extremes of forces inside frames, of reactions, and of how far the ends of links approach each other.

#include <Eigen/Core>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/knots.hpp>
#include <pounding/recording/linear_quantities.hpp>
#include <pounding/recording/step_motion.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Fills the envelopes of forces of frames. These need all unknowns, so they are taken at knots: ends of steps, of
/// which several may lie between two knots while the cubic between these follows the displacements closely. Extremes
/// between knots are found on it, for several knots at once. While a contact presses on a member between its ends, the
/// forces of such members are followed in every step.
class ForceEnvelopes {
 public:
  /// Fills `results`: the envelopes of its structures, and `approach` in a run without links. All arguments must
  /// outlive this.
  ForceEnvelopes(const Model& model, const GroundPlan& plan, const Stepper& stepper, Results& results);

  /// The present state is the initial one.
  void begin();
  /// One kept step.
  void step(const StepMotion& step);
  /// The run is over: the present state becomes the last knot. Shows the envelopes.
  void end();
  /// Brings the envelopes of the results up to the last knot.
  void show();
  /// For a checkpoint, without the envelopes.
  void archive(Archive& archive);

 private:
  // Quantities of one frame, or of all links.
  struct Block {
    int structure;  // -1: links
    bool loaded;    // contacts may press on members of its forces between their ends, or these members turn
    LinearQuantities quantities;
    Eigen::VectorXd values, rates;  // at the last knot that was followed
    Extremes extremes;
    bool apart = false;  // followed step by step: contacts press so, or parts have yielded, and forces are not linear
                         // between two knots
  };
  // A contact that presses on a member between its ends and so loads them as those of a fixed member, and supports that
  // hold them.
  struct FixedEnds {
    int link, block;
    Eigen::SparseVector<double> by_force;  // on the quantities of the block by a unit force
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
  const Stepper& stepper_;
  Results& results_;
  std::vector<int> first_unknown_;  // by structure
  std::vector<int> first_spring_;   // by structure
  std::vector<Block> blocks_;
  std::vector<FixedEnds> fixed_ends_;
  bool every_step_ = false;  // is a knot: contacts change velocities in no time, or bodies have no strain to measure by
  bool yields_ = false;      // parts of frames may, which add to forces directly
  bool turns_ = false;  // members turn: their forces bend more than the displacements, and each step has a knot inside
  Knots knots_;
  bool jumped_ = false;        // something changed at the end of the last step
  bool acts_ = false;          // parts of frames that yield have forces in the present step
  double followed_ = 0;        // knot up to which the extremes are known [s]
  std::vector<double> times_;  // knots after it whose motions wait [s]
  bool linear_ = false;        // all unknowns follow from the coordinates alone
  Eigen::MatrixXd coordinates_,
      unknowns_;  // where it is so: motions that wait, displacements before velocities, and all unknowns of them
  LinearQuantities::Instants<LinearQuantities::batch> motions_, evaluated_;
  std::vector<int> beyond_;  // quantities that may have new extremes
  LinearQuantities::Instants<1> motion_, evaluated_once_;
  Eigen::VectorXd u_, v_;                   // of all unknowns
  Eigen::VectorXd springs_, spring_rates_;  // forces of all springs at the motion in u_ and v_, and their rates
  Eigen::VectorXd end_, rates_;             // at the knot to come
};

}  // namespace pounding
