#pragma once
/// Ground motion at the supports of one structure. Independent of structures: it contains only indices of ground
/// motions.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Ground motions at the supports of one structure, with the first support as reference.
///
/// The unknowns of a structure are relative to the ground at its first support (support 0). Let f_qi be the value of a
/// quantity for a unit displacement of the ground at support q along axis i, with all other supports and the unknowns
/// at rest. For ground motions g_qi(t), supports that move differently contribute to the quantity
///
///     sum over q >= 1 and i of  f_qi (g_qi(t) - g_0i(t)),
///
/// for displacements, velocities and accelerations. Axes 0, 1, 2 are x, y, z (up). The terms are summed support by
/// support, axis by axis, g_qi before g_0i.
class SupportMotion {
 public:
  /// f_qi of one quantity.
  using Influence = std::function<double(std::size_t support, int axis)>;
  /// Receives one term of the sum: `amount` is g_qi or -g_0i [m], [m/s] or [m/s^2], to be multiplied by f_qi.
  using AddTerm = std::function<void(std::size_t support, int axis, double amount)>;
  /// One row of a matrix with one column per ground motion.
  using Row = Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

  /// `indices`: [support][axis] into `grounds`, the motions of the whole model; -1 if the ground is at rest.
  SupportMotion(std::span<const GroundMotion> grounds, std::vector<std::array<int, 3>> indices);

  /// Index of the ground motion at a support along an axis; -1 if the ground is at rest.
  int at(std::size_t support, int axis) const { return indices_[support][axis]; }
  /// at() of the first support.
  int at_first(int axis) const { return indices_.front()[axis]; }

  /// Adds the coefficients of the sum to a row: f_qi to the column of g_qi, -f_qi to that of g_0i.
  void project(const Influence& influence, Row row) const;
  /// Calls `add` for every term of the sum at time t [s].
  void displacement(double t, const AddTerm& add) const {
    for (const Term& term : terms_) add(term.support, term.axis, term.sign * term.motion.displacement(t));
  }
  void velocity(double t, const AddTerm& add) const {
    for (const Term& term : terms_) add(term.support, term.axis, term.sign * term.motion.velocity(t));
  }
  /// Calls `add` for every term, given the accelerations of all ground motions of the model. A time argument would be
  /// ambiguous at jumps.
  void acceleration(const Eigen::VectorXd& grounds, const AddTerm& add) const {
    for (const Term& term : terms_) add(term.support, term.axis, term.sign * grounds[term.ground]);
  }

 private:
  /// One g_qi or -g_0i.
  struct Term {
    std::size_t support;
    int axis, ground;
    double sign;
    GroundMotion motion;
  };
  std::vector<std::array<int, 3>> indices_;
  std::vector<Term> terms_;
};

}  // namespace pounding
