#pragma once
/// Arrays over modes and links, of a size that the compiler knows where there are few of them.

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <pounding/study/linear_model.hpp>

namespace pounding::study {

/// N numbers; as many as asked for where N is 0.
template <int N, class T = double>
using Numbers = std::conditional_t<(N > 0), std::array<T, static_cast<std::size_t>(N > 0 ? N : 1)>, std::vector<T>>;

template <int N, class T = double>
Numbers<N, T> numbers(int count, const T& value = {}) {
  if constexpr (N > 0) {
    Numbers<N, T> all;
    all.fill(value);
    return all;
  } else {
    return Numbers<N, T>(static_cast<std::size_t>(count), value);
  }
}

/// The modes and how the links close by them.
template <int M, int L>
struct Structures {
  explicit Structures(const LinearModel& model)
      : count(model.modes()), link_count(static_cast<int>(model.links.size())), k(numbers<M>(count)), c(k), p(k),
        closing(numbers<L, Numbers<M>>(link_count, k)) {
    for (std::size_t j = 0; j < model.stiffness.size(); ++j) k[j] = model.stiffness[j], c[j] = model.damping[j], p[j] = model.load[j];
    for (std::size_t l = 0; l < model.links.size(); ++l)
      for (std::size_t j = 0; j < model.stiffness.size(); ++j) closing[l][j] = model.links[l].closing[j];
  }

  std::size_t modes() const noexcept { return M > 0 ? static_cast<std::size_t>(M) : static_cast<std::size_t>(count); }
  std::size_t links() const noexcept { return L > 0 ? static_cast<std::size_t>(L) : static_cast<std::size_t>(link_count); }
  /// closing^T x of a link.
  double closes(std::size_t link, const Numbers<M>& x) const noexcept {
    double sum = 0;
    for (std::size_t j = 0; j < modes(); ++j) sum += closing[link][j] * x[j];
    return sum;
  }

  int count, link_count;
  Numbers<M> k, c, p;                 ///< stiffness, damping, load
  Numbers<L, Numbers<M>> closing;     ///< B
};

/// Straight acceleration of the ground in one interval: at + slope t.
struct Ground {
  double at = 0, slope = 0;
  double operator()(double t) const noexcept { return at + slope * t; }
};

/// Modal displacements and velocities.
template <int M>
struct ModalState {
  Numbers<M> q, v;
};

}  // namespace pounding::study
