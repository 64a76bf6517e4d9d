#pragma once
/// The structures as the kernel holds them, and their motion.

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pounding/study/lanes.hpp>
#include <pounding/study/linear_model.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// The modes and how the links close by them.
template <int M, int L>
struct Structures {
  /// `order`: of the polynomials of its motion.
  explicit Structures(const LinearModel& model, int order = taylor_order)
      : count(model.modes()),
        link_count(static_cast<int>(model.links.size())),
        order(order),
        k(count),
        c(count),
        p(count),
        closing(numbers<L, Modes<M>>(link_count, k)) {
    for (std::size_t j = 0; j < model.stiffness.size(); ++j)
      k[j] = model.stiffness[j], c[j] = model.damping[j], p[j] = model.load[j];
    for (std::size_t l = 0; l < model.links.size(); ++l)
      for (std::size_t j = 0; j < model.stiffness.size(); ++j) closing[l][j] = model.links[l].closing[j];
  }

  std::size_t modes() const noexcept { return static_cast<std::size_t>(count); }
  std::size_t links() const noexcept {
    return L > 0 ? static_cast<std::size_t>(L) : static_cast<std::size_t>(link_count);
  }
  /// closing^T x of a link.
  double closes(std::size_t link, const Modes<M>& x) const noexcept { return dot(closing[link], x); }

  int count, link_count, order;
  Modes<M> k, c, p;              ///< stiffness, damping, load
  Numbers<L, Modes<M>> closing;  ///< B
};

/// Acceleration of the ground from the beginning of an interval: a straight line, for contacts also the one that
/// follows it.
struct Ground {
  double at = 0, slope = 0;
  double corner = std::numeric_limits<double>::infinity();  ///< where the second line begins
  double bend = 0;                                          ///< by how much its slope is larger

  double line(double t) const noexcept { return at + slope * t; }
  /// How far a time lies behind the corner, or 0.
  double beyond(double t) const noexcept { return std::max(t - corner, 0.0); }
  double operator()(double t) const noexcept { return line(t) + bend * beyond(t); }
  double slope_at(double t) const noexcept { return t > corner ? slope + bend : slope; }
};

/// Modal displacements and velocities.
template <int M>
struct ModalState {
  Modes<M> q, v;
};

}  // namespace pounding::study
