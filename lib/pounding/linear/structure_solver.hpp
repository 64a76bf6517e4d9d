#pragma once
/// The structures without their links, as the stepper uses them: products, solves, and sums over all processes.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/spring_relief.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// Coefficients of A = mass M + damping C + stiffness K, the matrix of one step.
struct EffectiveMatrix {
  double mass = 1;       ///< [-]
  double damping = 0;    ///< [s]
  double stiffness = 0;  ///< [s^2]

  /// Same coefficients to the last bit.
  bool operator==(const EffectiveMatrix&) const = default;
};

/// Each solver has coordinates of its own, in which vectors have size() entries on this process; coordinates() and
/// physical() convert from and to the degrees of freedom of the system. B is the gap Jacobian: B^T u are the relative
/// displacements of the links. Collective, except accessors that return references or counts.
///
/// Massless degrees of freedom have no equation of motion: they are in static equilibrium with the others at all times.
/// The coordinates are without what they give way to springs, see SpringRelief; B of the springs is B_e wherever forces
/// act.
///
/// Behind the coordinates that count may stand those of a shadow: the same structures in fewer modes, driven by the
/// same forces of links and grounds. Links, outputs, weights and segments are without it; its motion beside theirs
/// tells what the reduction costs.
class StructureSolver {
 public:
  /// Coordinates first .. first + count - 1 on this process, all of one group of the system.
  struct Segment {
    int first = 0, count = 0, group = 0;
  };

  virtual ~StructureSolver() = default;

  /// Number of coordinates on this process.
  int size() const { return static_cast<int>(load_.rows()); }
  /// Number of coordinates that count; those behind them are a shadow's.
  int counted() const { return size() - shadow_; }
  /// Load vectors P, one column per ground motion: the force is -P times the ground acceleration.
  const Eigen::MatrixXd& load() const { return load_; }
  /// Mass weight of each coordinate in the group norm sum(m u^2) [kg]; 0 if massless or a shadow's, 1 if modal.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// Sum of the masses of each group over its degrees of freedom and all processes [kg]: the group norm divided by it
  /// is a mean square.
  const std::vector<double>& group_masses() const { return group_masses_; }
  /// How massless degrees of freedom give way to springs.
  const SpringRelief& relief() const { return relief_; }
  /// The groups on this process.
  std::span<const Segment> segments() const { return segments_; }

  /// y = K x, for each column.
  virtual void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// Both products in one call: `kx` = K x for each column, `cx` = C times the last of them, as many as it has columns.
  virtual void stiffness_and_damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> kx,
                                           Eigen::Ref<Eigen::MatrixXd> cx) const = 0;
  /// y = M x.
  virtual void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Replaces the force r by the acceleration M^-1 r; 0 at massless degrees of freedom.
  virtual void accelerate(Eigen::Ref<Eigen::VectorXd> r) const = 0;
  /// Recovers displacements, velocities or accelerations at massless degrees of freedom from those at the others, by
  /// static equilibrium.
  virtual void recover(Eigen::Ref<Eigen::VectorXd> x) const = 0;

  /// True if steps that are the longest one over 2^k are cheaper than others.
  virtual bool prefers_dyadic_steps() const { return false; }
  /// Whether a step of any other length costs many times as much, for a sparse factor of its own.
  virtual bool needs_dyadic_steps() const { return false; }
  /// Sets A for the next solves. `step_level` = k if the step is the longest over 2^k, so that its factor is cached.
  virtual void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) = 0;
  /// Replaces x by A^-1 x. False when the solve failed.
  virtual bool solve(Eigen::Ref<Eigen::VectorXd> x) = 0;
  /// G = B^T A^-1 B of these links, the same on every process. `g` as the last call has left it may stay, where links
  /// and matrix have. False when a solve failed.
  virtual bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) = 0;
  /// y += factor A^-1 B f for the links of the last flexibility(); f has one force per link of `links`.
  virtual void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                            Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// B^T x for all links [links x columns of x], the same on every process.
  virtual void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const = 0;
  /// B^T x for the links of the last flexibility() alone [links of `links` x columns of x].
  virtual void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
                      Eigen::MatrixXd& relative) const = 0;
  /// y += factor B f; f has one force for each link of the system.
  virtual void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// y += f, in these coordinates; f are forces at all degrees of freedom of the system, the same on every process and
  /// 0 at massless ones.
  virtual void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// Output quantities of x [outputs x columns of x], the same on every process.
  virtual void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const = 0;

  /// The structures that are reduced, without errors.
  virtual std::span<const ReducedStructure> reduced() const { return {}; }
  /// As gather() and observe(), from the shadow for structures that have one.
  virtual void gather_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
    gather(x, relative);
  }
  virtual void observe_shadow(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const {
    observe(x, values);
  }

  /// Coordinates of a displacement or velocity given at all degrees of freedom of the system.
  virtual Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const = 0;
  /// Values u at all degrees of freedom of the system, on every process, of coordinates x; relief() is to be added.
  virtual void physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const = 0;
  /// Values of several columns as physical() gives them, to the bit, a row of `u` each: many together cost less each.
  virtual void physical_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const {
    Eigen::VectorXd one;
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      physical(x.col(j), one);
      if (u.rows() != x.cols() || u.cols() != one.size()) u.resize(x.cols(), one.size());
      u.row(j) = one;
    }
  }
  /// For each column of coordinates x those in which the run would move as the shadow does; behind counted() they mean
  /// nothing.
  virtual void as_shadow(const Eigen::MatrixXd& x, Eigen::MatrixXd& y) const { y = x; }
  /// The modes of a group [unknown of the group, mode] and the first of its coordinates, where these are so few that
  /// sums over them cost less than sums over its unknowns.
  struct FewModes {
    const Eigen::MatrixXd& shapes;
    int first = 0;
  };
  virtual std::optional<FewModes> few_modes(int /*group*/) const { return std::nullopt; }

  /// Sums over all processes, in place.
  virtual void combine(std::span<double> /*sums*/) const {}

  /// One line for a report: the size of the problem and how it is solved.
  virtual std::string description() const = 0;
  /// Number of factorizations so far.
  long factorizations() const { return factorizations_; }

 protected:
  explicit StructureSolver(const System& system) : relief_(system) {}

  SpringRelief relief_;
  Eigen::MatrixXd load_;
  int shadow_ = 0;  // number of its coordinates
  Eigen::VectorXd weights_;
  std::vector<double> group_masses_;
  std::vector<Segment> segments_;
  long factorizations_ = 0;
};

}  // namespace pounding
