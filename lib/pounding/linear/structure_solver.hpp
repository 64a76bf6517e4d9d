#pragma once
/// Structures without their links, as the stepper uses them: products, solves, and sums over all processes.

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

  /// Bitwise equality of the coefficients.
  bool operator==(const EffectiveMatrix&) const = default;
};

/// Each solver uses its own coordinates, in which vectors have size() entries on this process. coordinates() and
/// physical() convert from and to the degrees of freedom of the system. B is the gap Jacobian: B^T u are the relative
/// displacements of the links. Functions are collective, except accessors that return references or counts.
///
/// Massless degrees of freedom have no equation of motion: they are always in static equilibrium with the others. The
/// coordinates exclude their deflection under spring forces, see SpringRelief; spring forces act through B_e.
///
/// The coordinates of an error-estimating shadow may follow the physical ones: the same structures in fewer modes,
/// driven by the same link forces and ground motions. Links, outputs, weights and segments exclude it. Comparing its
/// motion with the physical one estimates the reduction error.
class StructureSolver {
 public:
  /// Coordinates first .. first + count - 1 on this process, all of one group of the system.
  struct Segment {
    int first = 0, count = 0, group = 0;
  };

  virtual ~StructureSolver() = default;

  /// Number of coordinates on this process.
  int size() const { return static_cast<int>(load_.rows()); }
  /// Number of physical coordinates; the coordinates of the error-estimating shadow come last.
  int counted() const { return size() - shadow_; }
  /// Load vectors P, one column per ground motion: the force is -P times the ground acceleration.
  const Eigen::MatrixXd& load() const { return load_; }
  /// Mass weight of each coordinate in the group norm sum(m u^2) [kg]; 0 if massless or in a shadow, 1 if modal.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// Total mass of each group over its degrees of freedom and all processes [kg]: the group norm divided by it is a
  /// mean square.
  const std::vector<double>& group_masses() const { return group_masses_; }
  /// Deflection of massless degrees of freedom under spring forces.
  const SpringRelief& relief() const { return relief_; }
  /// The groups on this process.
  std::span<const Segment> segments() const { return segments_; }

  /// y = K x, for each column.
  virtual void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// Both products in one call: `kx` = K x for each column, and `cx` = C times the last columns of x, as many as `cx`
  /// has.
  virtual void stiffness_and_damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> kx,
                                           Eigen::Ref<Eigen::MatrixXd> cx) const = 0;
  /// y = M x.
  virtual void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Replaces the force r by the acceleration M^-1 r; 0 at massless degrees of freedom.
  virtual void accelerate(Eigen::Ref<Eigen::VectorXd> r) const = 0;
  /// Recovers displacements, velocities or accelerations at massless degrees of freedom from those at the others, by
  /// static equilibrium.
  virtual void recover(Eigen::Ref<Eigen::VectorXd> x) const = 0;

  /// True if steps that are the longest one divided by 2^k are cheaper than others.
  virtual bool prefers_dyadic_steps() const { return false; }
  /// True if a step of any other length is many times as expensive because it needs its own sparse factor.
  virtual bool needs_dyadic_steps() const { return false; }
  /// Sets A for the next solves. `step_level` = k if the step is the longest divided by 2^k, so that its factor is
  /// cached.
  virtual void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) = 0;
  /// Replaces x by A^-1 x. False if the solve failed.
  virtual bool solve(Eigen::Ref<Eigen::VectorXd> x) = 0;
  /// G = B^T A^-1 B of these links, identical on every process. `g` may keep its contents from the last call if links
  /// and matrix are unchanged. False if a solve failed.
  virtual bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) = 0;
  /// y += factor A^-1 B f for the links of the last flexibility(); f has one force per link in `links`.
  virtual void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                            Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// B^T x for all links [links x columns of x], identical on every process.
  virtual void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const = 0;
  /// B^T x for the links of the last flexibility() only [links in `links` x columns of x].
  virtual void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
                      Eigen::MatrixXd& relative) const = 0;
  /// y += factor B f; f has one force per link of the system.
  virtual void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// y += f in these coordinates. f are forces at all degrees of freedom of the system, identical on every process and
  /// 0 at massless ones.
  virtual void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// Output quantities of x [outputs x columns of x], identical on every process.
  virtual void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const = 0;

  /// Reduced structures, without their errors.
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
  /// Values u at all degrees of freedom of the system, on every process, from coordinates x; without relief().
  virtual void physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const = 0;
  /// As physical() for several columns, bitwise identical, one row of `u` per column of x. Cheaper per column.
  virtual void physical_of_columns(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& u) const {
    Eigen::VectorXd one;
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      physical(x.col(j), one);
      if (u.rows() != x.cols() || u.cols() != one.size()) u.resize(x.cols(), one.size());
      u.row(j) = one;
    }
  }
  /// For each column of coordinates x, the coordinates in which the run moves like the shadow; entries beyond counted()
  /// are undefined.
  virtual void as_shadow(const Eigen::MatrixXd& x, Eigen::MatrixXd& y) const { y = x; }
  /// Modes of a group [unknown of the group, mode] and its first coordinate, if sums over the modes cost less than sums
  /// over the unknowns.
  struct FewModes {
    const Eigen::MatrixXd& shapes;
    int first = 0;
  };
  virtual std::optional<FewModes> few_modes(int /*group*/) const { return std::nullopt; }

  /// Sums over all processes, in place.
  virtual void combine(std::span<double> /*sums*/) const {}

  /// One line for a report: problem size and solution method.
  virtual std::string description() const = 0;
  /// Total number of factorizations.
  long factorizations() const { return factorizations_; }

 protected:
  explicit StructureSolver(const System& system) : relief_(system) {}

  SpringRelief relief_;
  Eigen::MatrixXd load_;
  int shadow_ = 0;  // number of shadow coordinates
  Eigen::VectorXd weights_;
  std::vector<double> group_masses_;
  std::vector<Segment> segments_;
  long factorizations_ = 0;
};

}  // namespace pounding
