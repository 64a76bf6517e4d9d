#pragma once
/// One step of the equations of motion with link forces condensed out, its error, and the instants at which a
/// contact changes phase inside it. Knows no PETSc: the TS type `pounding` drives it.

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include <pounding/system.hpp>

namespace pounding {

struct StepperOptions {
  double tolerance = 1e-4;       ///< relative, on displacements and forces
  double spectral_radius = 1.0;  ///< rho at infinite frequency of generalized-alpha, 0 to 1
  double first_rung = 0;         ///< longest step [s]; steps are this divided by powers of two, or end at an event
};

/// Motion at one instant. `a` and `force` are those just after it.
struct State {
  double time = 0;
  Eigen::VectorXd u, v;   ///< relative to the ground [m], [m/s]
  Eigen::VectorXd a;      ///< acceleration relative to the ground that balances the equations [m/s^2]
  Eigen::VectorXd force;  ///< of every link [N]
};

/// What a kept step did to the energies; integrals by Simpson's rule on the step's own interpolation [J].
struct EnergySums {
  double input = 0;    ///< work of the ground motion, and the energy that was there at the start
  double damping = 0;  ///< viscous, of the structures
};

/// Generalized-alpha (Chung and Hulbert 1993) on the displacement form, the forces of all terms averaged between the
/// ends of the step.
///
/// A step solves the linear frame once with a cached factor and then Newton on the few link forces with their exact
/// slopes: u1 = u* - h^2 beta alpha_f A^-1 B F, A = alpha_m M + h gamma alpha_f C + h^2 beta alpha_f K.
///
/// attempt() is pure: a trial that is not accepted leaves no trace.
class Stepper {
 public:
  /// Throws std::invalid_argument when M is not positive definite or the options are out of range.
  Stepper(const System& system, const StepperOptions& options);

  /// Starts from displacements and velocities with the exact initial acceleration.
  void start(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

  /// Solves a trial step of length h > 0. False when the link equations could not be solved.
  /// `end` is the time at its end when that is known better than by adding h.
  bool attempt(double h, std::optional<double> end = std::nullopt);
  /// Error of the trial in one step divided by what the tolerance allows; the trial is good when it is at most 1.
  double error_ratio() const;
  /// Length of the shortest trial step at whose end a contact reaches the end of its phase, located by re-integrated
  /// steps, with that step as the present trial; nothing when no phase ends inside the trial.
  /// A length of zero means that a phase has already ended at the beginning.
  std::optional<double> land();
  /// Keeps the trial step and enters the phases that begin at its end.
  void accept();
  /// Enters the phases that begin at the present state, without a step (after land() gave a length of zero).
  void cross_now();

  const State& state() const { return now_; }
  const State& before() const { return before_; }  ///< the state at the beginning of the last kept step
  /// End of the last kept step as the step saw it: accelerations and forces before contacts changed phase.
  const State& arrived() const { return kept_.end; }
  const std::vector<LinkStep>& link_steps() const { return link_steps_; }
  const EnergySums& energy_sums() const { return sums_; }
  double kinetic_energy() const;
  double strain_energy() const;
  double contact_work() const;
  bool in_contact() const;

  /// Displacement and velocity inside the last kept step: cubic Hermite interpolation.
  void interpolate(double time, Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  /// Acceleration inside the last kept step: the parabola through both ends and the middle.
  void interpolate_acceleration(double time, Eigen::VectorXd& a) const;

  /// The rung at most h (relative slack 1e-9).
  double rung_below(double h) const;
  const StepperOptions& options() const { return options_; }
  const System& system() const { return system_; }
  long iterations() const { return iterations_; }
  long events() const { return events_; }
  long factorizations() const { return factorizations_; }

 private:
  struct Level {
    Eigen::MatrixXd inverse;    // of A
    Eigen::MatrixXd response;   // Z = A^-1 B
    Eigen::MatrixXd flexibility;  // G = B^T Z
  };
  /// A margin that is negative at the end of the trial.
  struct Ending {
    int link = 0, margin = 0;
    double from = 0;  // the margin is known to be positive here [s after the beginning], unless at_begin is not
    double at_begin = 0, at_end = 0;
    double guess = 0;  // where it may be zero [s after the beginning]
  };
  struct Trial {
    double h = 0;
    State end;
    Eigen::VectorXd u_middle, v_middle, a_middle;
    Eigen::VectorXd algorithmic;  // acceleration of the scheme at the end
    Eigen::VectorXd force_middle;
    double ground_begin = 0, ground_middle = 0, ground_end = 0;  // [m/s^2]
    double error = 0;
  };

  const Level& level(double h);
  bool solve_links(const Eigen::MatrixXd& flexibility, double h, const Eigen::VectorXd& u, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& a, Eigen::VectorXd& force);
  bool solve_one_link(int link, double flexibility, double h, double others, double& force);
  bool solve_many_links(const Eigen::MatrixXd& flexibility, double h, Eigen::VectorXd& force);
  void evaluate_middle(Trial& trial);
  void estimate_error(Trial& trial);
  /// Link forces and accelerations that balance the equations in the present phases.
  void balance(const Eigen::VectorXd& u, const Eigen::VectorXd& v, double ground, Eigen::VectorXd& force,
               Eigen::VectorXd& a) const;
  void balance_now();
  void accelerate(const Eigen::VectorXd& u, const Eigen::VectorXd& v, const Eigen::VectorXd& force, double ground,
                  Eigen::VectorXd& a) const;
  double closing(int link, const Eigen::VectorXd& x) const;
  LinkMotion motion(int link, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;
  double noise_of(int link, int margin) const;
  bool ended(int link, int margin, double value) const;
  std::vector<Ending> endings() const;
  void inner_touch(int link);
  bool begins_inside(Ending& ending, double longest);
  bool locate(const Ending& ending, double longest);
  double margin_of_trial(const Ending& ending) const;
  void enter_phases();
  void bounce(const std::vector<int>& touching);
  void release_parting();
  void update_scales();

  const System& system_;
  StepperOptions options_;
  double alpha_m_, alpha_f_, beta_, gamma_;
  double allowed_;  // local error that the tolerance allows

  struct Entry {
    Eigen::Index unknown;
    double factor;
  };
  std::vector<std::vector<Entry>> entries_;  // of the columns of B
  Eigen::MatrixXd mass_inverse_;
  Eigen::MatrixXd rigid_flexibility_;  // B^T M^-1 B
  std::map<int, Level> rungs_;         // by power of two
  Level off_ladder_;
  double off_ladder_h_ = 0;

  State now_, before_;
  Eigen::VectorXd algorithmic_;  // acceleration that the scheme carries, for the length of the last step
  Eigen::VectorXd carried_;      // and for that of the trial
  Trial trial_, kept_;
  std::vector<Ending> landed_;  // endings at the end of the trial
  std::vector<LinkStep> link_steps_;
  EnergySums sums_;

  std::vector<double> displacement_scale_, velocity_scale_;  // by group
  std::vector<double> rate_scale_, penetration_scale_;       // by link, of the present impact
  std::vector<int> active_;                                  // links that press
  std::vector<LinkMotion> free_;                             // motion of the links without their forces
  std::vector<double> free_closing_;                         // their closing acceleration without forces
  mutable Eigen::VectorXd work_;
  Eigen::VectorXd error_u_, error_v_;
  long iterations_ = 0, events_ = 0, factorizations_ = 0;
};

}  // namespace pounding
