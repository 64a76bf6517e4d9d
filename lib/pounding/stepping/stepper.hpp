#pragma once
/// One step of the equations of motion with link forces condensed out, its error, and the instants at which a
/// contact changes phase inside it. Knows no PETSc: the TS type `pounding` drives it.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/pseudo_forces.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/model/scheme.hpp>
#include <pounding/stepping/coefficients.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// What a run asks of its steps.
struct StepperOptions {
  double tolerance = 1e-4;  ///< relative, on displacements and forces
  Scheme scheme = {};
  double max_step = 0;  ///< longest step [s]; where steps form a ladder they are this divided by powers of two
};

/// Motion at one instant, at the unknowns of the system, those without mass where they truly stand (see PseudoForces). `a`
/// and `force` are those just after it.
struct State {
  double time = 0;
  Eigen::VectorXd u, v;   ///< relative to the ground [m], [m/s]
  Eigen::VectorXd a;      ///< acceleration relative to the ground that balances the equations [m/s^2]
  Eigen::VectorXd force;  ///< of every link [N]
};

/// What a report follows, System::outputs^T times displacements, velocities and accelerations, at one instant.
struct OutputQuantities {
  double time = 0;
  Eigen::MatrixXd motion;  ///< [quantity, u v a]; a just after the instant
};

/// Energies at the last kept state [J]. input = kinetic + strain + damping + hysteretic + impact, but for the error.
struct Energies {
  double input = 0;       ///< work of the ground motion, that of link forces on it included, and the energy at the start
  double kinetic = 0;     ///< of the motion relative to the ground
  double strain = 0;      ///< stored in the structures
  double damping = 0;     ///< dissipated by the damping of the structures
  double hysteretic = 0;  ///< dissipated by yielding
  double impact = 0;      ///< work done on the contacts: lost, friction included, and stored while they press
};

/// Steps of the chosen scheme with the link forces condensed out: the structures are solved once (a stage) with a matrix
/// that does not change, then Newton on the few link forces with their exact slopes. What elastic forces have beyond K u is
/// found by repeating this until it does not change.
///
/// try_step() is pure: a trial that is not accepted leaves no trace.
class Stepper {
 public:
  /// `base` describes the same system. Throws std::invalid_argument when the options are out of range, parts of the system do
  /// not fit each other, or a friction stands at a rigid contact.
  Stepper(const System& system, StructureSolver& base, const StepperOptions& options);

  /// Starts from displacements and velocities with the exact initial acceleration. Unknowns without mass follow the
  /// others, whatever is given for them. Once steps have been made it goes on from a motion that somebody changed; what
  /// that adds to the energy counts as input.
  void start(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

  /// Sets the matrix of steps of length h > 0 without a step: its factor is made, and the options of the factor are read.
  void prepare(double h) { set_shift(h); }
  /// Solves a trial step of length h > 0. False when the equations of the links or of large turns could not be solved.
  /// `end` is the time at its end when that is known better than by adding h.
  bool try_step(double h, std::optional<double> end = std::nullopt);
  /// Error of the trial in one step divided by what the tolerance allows; the trial is good when it is at most 1.
  double error_ratio() const { return trial_->error; }
  /// The error falls with this power of the step.
  int error_order() const { return options_.scheme.error_order(); }
  /// Length of the shortest trial step at whose end a contact reaches the end of its phase, located by re-integrated
  /// steps, with that step as the present trial; nothing when no phase ends inside the trial.
  /// A length of zero means that a phase has already ended at the beginning.
  std::optional<double> locate_event();
  /// Keeps the trial step and enters the phases that begin at its end.
  void accept();
  /// Enters the phases that begin at the present state, without a step (after locate_event() gave a length of zero).
  void apply_event();

  /// Of the present state [s].
  double time() const { return now_->time; }
  /// The next time at which one of the ground motions has a corner or a jump; infinity for none.
  double next_break() const { return next_break_; }
  /// The present state.
  const State& state() const;
  /// The state at the beginning of the last kept step.
  const State& begin() const;
  /// End of the last kept step as the step saw it: accelerations and forces before contacts changed phase. The same
  /// object as state() when nothing changed there.
  const State& end_minus() const;
  /// The same three of what a report follows, without the whole vectors.
  const OutputQuantities& outputs() const;
  const OutputQuantities& outputs_begin() const;
  const OutputQuantities& outputs_end_minus() const;
  /// What a report follows of the accelerations that balance the equations in the middle of the last kept step: [quantity, 1].
  const Eigen::MatrixXd& outputs_middle() const;
  /// Accelerations of the grounds at the same instants [m/s^2].
  const Eigen::VectorXd& ground() const { return now_->ground; }
  const Eigen::VectorXd& ground_begin() const { return before_->ground; }
  const Eigen::VectorXd& ground_middle() const { return kept_->ground_middle; }
  const Eigen::VectorXd& ground_end_minus() const { return kept_->end.ground; }
  const std::vector<LinkStep>& link_steps() const { return link_steps_; }
  /// Forces of all links at the present state [N].
  const Eigen::VectorXd& link_forces() const { return now_->force; }
  Energies energies() const;
  /// Work that each friction of the system has dissipated [J].
  const std::vector<double>& friction_work() const { return friction_work_; }
  bool in_contact() const;
  /// The link whose error was the largest of all, or that would not be solved, in the last trial; -1 for none.
  int troublesome_link() const { return troublesome_; }

  /// Displacement and velocity inside the last kept step: cubic Hermite interpolation.
  void interpolate(double time, Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  /// Acceleration inside the last kept step: the parabola through both ends and the middle.
  void interpolate_acceleration(double time, Eigen::VectorXd& a) const;
  /// The same of what a report follows: [quantity, u v a].
  void interpolate_outputs(double time, Eigen::MatrixXd& motion) const;

  /// The step to try when `wanted` would do and `left` remains until a corner of the ground motion or the end.
  double step_towards(double wanted, double left) const;
  const StepperOptions& options() const { return options_; }
  const System& system() const { return system_; }
  const StructureSolver& base() const { return base_; }
  long iterations() const { return iterations_; }
  long events() const { return events_; }

  /// The whole state between two steps, contacts and springs included: what is read goes on with the same bits.
  void archive(Archive& archive);

 private:
  /// Columns of one matrix: motion in the coordinates of the base and its products with K and C. `c` is the acceleration
  /// that the scheme carries, when it is not a.
  enum Column { u, v, a, c, ku, kv, ka, kc, cv, ca, cc, columns };
  struct Instant {
    double time = 0;
    Eigen::VectorXd ground;     // accelerations, just after, but just before at the end of a step [m/s^2]
    Eigen::MatrixXd motion;     // [coordinate, Column]
    Eigen::VectorXd force;      // of every link
    Eigen::MatrixXd relative;   // B^T of the motion, [link, u v a c]
    Eigen::MatrixXd by_ground;  // what the ground and gravity add to it, [link, u v a]; empty when that is nothing
    Eigen::VectorXd excess;     // see PseudoForces, [coordinate]; empty for none
    const double* at(Column column) const { return motion.col(column).data(); }
    double* at(Column column) { return motion.col(column).data(); }
    void archive(Archive& archive);
  };
  /// A margin that is negative at the end of the trial.
  struct EventBracket {
    int link = 0, margin = 0;
    double from = 0;  // the margin is known to be positive here [s after the beginning], unless at_begin is not
    double at_begin = 0, at_end = 0;
    double guess = 0;  // where it may be zero [s after the beginning]
  };
  struct Trial {
    double h = 0;
    Instant end;
    Eigen::VectorXd force_middle;
    mutable Eigen::VectorXd a_middle;  // unknowns without mass are completed when somebody asks
    std::vector<LinkMotion> middle;                              // motion of every link
    Eigen::VectorXd ground_middle;     // accelerations [m/s^2]
    Eigen::MatrixXd by_ground_middle;  // as Instant::by_ground
    double error = 0;
    std::vector<double> squares_u, squares_v;  // of the motion at the end weighed by the masses, summed by group
    void archive(Archive& archive);
  };

  // What somebody asked for of the present instant, the beginning and the arrived end of the last kept step.
  template <class View>
  struct Views {
    View now, before, arrived;
    bool has_now = false, has_before = false, has_arrived = false;
    void forget() { has_now = has_before = has_arrived = false; }
    // A step was kept: the present becomes what was before.
    void move_on() {
      if (has_now) std::swap(before, now);
      has_before = has_now;
      has_now = has_arrived = false;
    }
  };
  // A friction that acts, by the places of its links among the active ones.
  struct Slider {
    const Friction* friction = nullptr;
    int contact = 0, first = 0;
  };

  int width() const { return carries_ ? 4 : 3; }  // columns of motion that have products
  void set_shift(double h);
  bool attempt_alpha(double h);
  bool attempt_esdirk(double h);
  /// One stage: r_, forces, becomes the acceleration x. Its displacement is free + by_u x, where the excess forces count with
  /// `weight`; `respond` makes x of forces without them. `guess` is an x to begin with.
  bool solve_turning(const Eigen::VectorXd& free, double by_u, double weight, const Eigen::VectorXd& guess,
                     const std::function<bool()>& respond);
  void excess_at(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& excess) const;
  double weighted_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  double relative_size(const Eigen::VectorXd& change, const Eigen::VectorXd& displacement) const;
  /// The acceleration x that a stage has without the forces of active links becomes the one with them, which go to the end
  /// of the trial. The free motions are those that x belongs to; an acceleration changes them by by_u and by_v times
  /// itself, a force counts with `weight` in the equations of the stage.
  bool condense(double by_u, double by_v, double weight, const Eigen::VectorXd& guess, Eigen::Ref<Eigen::VectorXd> x);
  bool solve_one_link(int place, double by_u, double by_v, double weight, double others, double& force);
  bool solve_many_links(double by_u, double by_v, double weight);
  bool solve_slider(const Slider& slider, double by_u, double by_v, Eigen::VectorXd& forces);
  FrictionForce slide(const Slider& slider, double by_u, double by_v, const Eigen::VectorXd& relief) const;
  void hold_end();
  // One number of an Instant::by_ground.
  double ground_part(const Eigen::MatrixXd& by_ground, int link, Column column) const {
    return moving_ ? by_ground(link, column) : 0;
  }
  void check_parts();
  void find_sliders();
  void forget_views();
  void find_break_after(double time);
  const double* push(const Eigen::VectorXd& ground);
  void ground_at(double time, Eigen::VectorXd& ground, bool before = false) const;
  void closings_by_ground(double time, const Eigen::VectorXd& ground, Eigen::MatrixXd& by_ground) const;
  void products(Instant& instant, int first, int count) const;
  void evaluate_middle();
  void measure(const Instant& instant, std::vector<double>& squares_u, std::vector<double>& squares_v);
  void add_simpson_error(double part);
  void finish_error();
  /// r, the forces other than those of links, becomes the acceleration; forces of the links from their motions.
  void balance(std::span<const LinkMotion> motions, const Eigen::MatrixXd& by_ground, bool inside_step, Eigen::VectorXd& force,
               Eigen::Ref<Eigen::VectorXd> r) const;
  Instant& change_now();  // the present instant, to be written
  void balance_now();
  void gather_now();
  /// Penetration of a contact, or deformation of a spring, whose ends have closed by `relative_displacement`.
  double deformation(int link, double relative_displacement) const;
  LinkMotion motion(int link, const Instant& instant) const;
  laws::Response law(int link, const LinkMotion& motion) const;
  bool works(int link) const;  // has a force that depends on the step
  bool held(int link) const;
  double noise_of(int link, int margin, const LinkMotion& motion) const;
  bool ended(int link, int margin, double value, const LinkMotion& motion) const;
  std::vector<EventBracket> event_brackets() const;
  void inner_touch(int link);
  std::optional<double> corner(int link) const;
  void stop_at_corner(int link);
  bool begins_inside(EventBracket& ending, double longest);
  bool locate(const EventBracket& ending, double longest);
  bool touches_now(const EventBracket& ending) const;
  double margin_of_trial(const EventBracket& ending) const;
  void enter_phases(bool without_step);
  void bounce(const std::vector<int>& touching, bool without_step);
  Eigen::VectorXd slowest_rates(const std::vector<int>& closed) const;
  void settle();
  void update_scales();
  double largest_u() const;
  double largest_v() const;
  void show(const Instant& instant, State& state) const;
  void show(const Instant& instant, OutputQuantities& outputs) const;
  template <class View>
  const View& now_in(Views<View>& views) const;
  template <class View>
  const View& before_in(Views<View>& views) const;
  template <class View>
  const View& arrived_in(Views<View>& views) const;

  const System& system_;
  StructureSolver& base_;
  StepperOptions options_;
  GeneralizedAlpha alpha_;
  bool carries_ = false;  // an acceleration of the scheme that is not the balanced one
  double allowed_;  // local error that the tolerance allows
  PseudoForces excess_;
  std::vector<int> own_groups_;  // of which this process has rows
  std::vector<double> rest_size_;  // by group, of the displacements at rest that elastic forces count from
  bool outputs_need_recovery_ = false;  // something outputs does not follow as the base has it
  bool moving_ = false;   // the ground or gravity adds to the relative displacements
  int frictions_from_ = 0;                // the first link that is a column of a friction
  std::vector<int> contact_of_friction_;  // of each of these columns

  Eigen::MatrixXd rigid_response_;     // M^-1 B of the contacts, when one of them is rigid
  Eigen::MatrixXd rigid_flexibility_;  // B^T M^-1 B

  // The present trial, the last kept step and the one before it take turns.
  std::unique_ptr<Trial> trial_ = std::make_unique<Trial>(), kept_ = std::make_unique<Trial>(), previous_ = std::make_unique<Trial>();
  // The end of the kept step until something changes there, then a copy of it; and the beginning of that step.
  Instant* now_ = &changed_[0];
  Instant* before_ = &kept_->end;
  std::array<Instant, 2> changed_;
  std::vector<EventBracket> located_;  // event_brackets at the end of the trial
  std::vector<LinkStep> link_steps_;
  double input_work_ = 0, damping_work_ = 0;  // of this process
  double carried_work_ = 0;  // of the link forces on the motion of the ground
  std::vector<double> friction_work_;
  double given_ = 0;  // energy that was there at the start or came by a changed motion
  bool started_ = false;
  double break_begins_ = 0, next_break_ = 0;  // equal but for rounding

  std::vector<double> displacement_scale_, velocity_scale_;  // by group
  std::vector<double> rate_scale_, penetration_scale_;       // by link, of the present impact
  int troublesome_ = -1;
  long iterations_ = 0, events_ = 0;

  std::vector<std::vector<int>> link_groups_;  // groups that a link joins

  // Room to work in.
  std::vector<int> active_;            // links whose force is sought
  std::vector<Slider> sliders_;        // frictions among them
  std::vector<LinkMotion> free_;       // their motion without their forces
  Eigen::VectorXd free_closing_;       // and their closing acceleration
  Eigen::MatrixXd flexibility_;        // G of the active links
  Eigen::VectorXd active_force_;
  Eigen::VectorXd r_, error_u_, error_v_;
  Eigen::VectorXd push_, stage_ground_;
  Eigen::MatrixXd stage_by_ground_;
  Eigen::MatrixXd gathered_, stages_, stage_closings_, work_errors_;
  std::vector<LinkMotion> now_motions_;
  mutable Eigen::VectorXd work_;
  mutable Eigen::MatrixXd work_relative_;
  mutable Eigen::VectorXd whole_, whole_excess_;  // at all unknowns
  Eigen::VectorXd excess_forces_, stage_free_, stage_guess_, link_guess_;
  std::vector<double> sums_;
  mutable Views<State> states_;
  mutable Views<OutputQuantities> outputs_;
  mutable Eigen::MatrixXd outputs_middle_;
  mutable bool has_outputs_middle_ = false;
  bool changed_at_end_ = false;  // the present state is not the end of the last step
};

}  // namespace pounding
