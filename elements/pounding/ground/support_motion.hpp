#pragma once
/// The ground under the supports of one structure. It knows indices of ground motions and no structure, so it belongs
/// to ground/.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Ground motions under the supports of one structure, the first support being the reference.
///
/// The unknowns of a structure are relative to the ground at its first support (support 0). Let f_qi be what a quantity
/// becomes when the ground moves by one at support q along axis i while all other supports, and the unknowns, stay
/// where they are. With g_qi(t) for the ground, supports that move differently add to the quantity
///
///     sum over q >= 1 and i of  f_qi (g_qi(t) - g_0i(t)),
///
/// to its displacement, its velocity or its acceleration alike. Axes 0, 1, 2 are x, y, z (up). The terms are summed
/// support by support, axis by axis, g_qi before g_0i.
class SupportMotion {
 public:
  /// f_qi of one quantity.
  using Influence = std::function<double(std::size_t support, int axis)>;
  /// Receives one term of the sum: `amount` is g_qi or -g_0i [m], [m/s] or [m/s^2], to be multiplied by f_qi.
  using AddTerm = std::function<void(std::size_t support, int axis, double amount)>;
  /// One row of a matrix with one column a ground motion.
  using Row = Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

  /// `indices`: [support][axis] into `grounds`, the motions of the whole model; -1 where the ground stays at rest.
  SupportMotion(std::span<const GroundMotion> grounds, std::vector<std::array<int, 3>> indices);

  /// Index of the ground motion at a support along an axis; -1 where the ground stays at rest.
  int at(std::size_t support, int axis) const { return indices_[support][axis]; }
  /// at() of the first support.
  int at_first(int axis) const { return indices_.front()[axis]; }

  /// Adds the sum as a row on ground motions: f_qi to the column of g_qi, -f_qi to that of g_0i.
  void project(const Influence& influence, Row row) const;
  /// Calls `add` for every term of the sum at time t [s].
  void displacement(double t, const AddTerm& add) const;
  void velocity(double t, const AddTerm& add) const;
  /// Calls `add` for every term, from the accelerations of all ground motions of the model: a time would not tell which
  /// of the two values is meant where they jump.
  void acceleration(const Eigen::VectorXd& grounds, const AddTerm& add) const;

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
