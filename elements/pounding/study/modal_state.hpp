#pragma once
/// Structures as stored by the kernel, and their motion.

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pounding/study/lanes.hpp>
#include <pounding/study/linear_model.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// Modes, and the closing of the links in terms of them.
template <int M, int L>
struct Structures {
  /// `order`: of the polynomials of the motion.
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

/// Ground acceleration from the beginning of an interval: a straight line, for contacts including the following one.
struct Ground {
  double at = 0, slope = 0;
  double corner = std::numeric_limits<double>::infinity();  ///< start of the second line
  double bend = 0;                                          ///< increase of the slope there

  double line(double t) const noexcept { return at + slope * t; }
  /// Time since the corner, or 0.
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
