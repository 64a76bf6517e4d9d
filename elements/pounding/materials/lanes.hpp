#pragma once
/// States of the fibres of one material, and their response in one vector loop.

#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// States of fibres of one material. Branches of at most 16 numbers are stored number by number, so that the loop over
/// fibres vectorizes; larger ones must be the state. Compile with -fno-trapping-math -fno-math-errno.
template <Material M>
class Lanes {
  using State = typename M::State;
  using Branch = typename M::Branch;
  static constexpr std::size_t numbers = sizeof(Branch) / sizeof(double);

 public:
  /// True if branches are stored number by number.
  static constexpr bool in_lanes = sizeof(Branch) % sizeof(double) == 0 && numbers <= 16;
  static_assert(in_lanes || std::is_same_v<Branch, State>);

  /// Undeformed fibres.
  Lanes(const M& law, std::size_t count) : states_(count), branches_(in_lanes ? count * numbers : 0) {
    for (std::size_t i = 0; i < count; ++i) update(law, i);
  }

  std::span<const State> states() const noexcept { return states_; }
  /// Replaces all states, for example by those of a checkpoint; the number of fibres is the same.
  void restore(const M& law, std::span<const State> states) noexcept {
    for (std::size_t i = 0; i < states.size(); ++i) states_[i] = states[i], update(law, i);
  }
  /// Writes or reads all states, see core/archive.hpp.
  template <class Archive>
  void archive(Archive& archive) {
    archive(states_, branches_);
  }
  /// Stresses and slopes of the fibres from index `first` at their strains. The arrays do not overlap.
  void respond(const M& law, std::size_t first, std::size_t count, const double* __restrict strain,
               double* __restrict stress, double* __restrict slope) const noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      const Answer answer = law.respond(branch(first + i), strain[i]);
      stress[i] = answer.force;
      slope[i] = answer.slope;
    }
  }
  /// Accepts the strains of the fibres from index `first`.
  void accept(const M& law, std::size_t first, std::size_t count, const double* __restrict strain) noexcept {
    for (std::size_t i = 0; i < count; ++i) states_[first + i] = law.advance(states_[first + i], strain[i]);
    for (std::size_t i = 0; i < count; ++i) update(law, first + i);
  }
  /// Accepts the strain of one fibre.
  void accept(const M& law, std::size_t i, double strain) noexcept {
    states_[i] = law.advance(states_[i], strain);
    update(law, i);
  }

 private:
  decltype(auto) branch(std::size_t i) const noexcept {
    if constexpr (in_lanes)
      return [&]<std::size_t... n>(std::index_sequence<n...>) {
        return std::bit_cast<Branch>(std::array{branches_[n * states_.size() + i]...});
      }(std::make_index_sequence<numbers>());
    else
      return (states_[i]);
  }
  void update(const M& law, std::size_t i) noexcept {
    if constexpr (in_lanes) {
      const auto values = std::bit_cast<std::array<double, numbers>>(law.branch(states_[i]));
      for (std::size_t n = 0; n < numbers; ++n) branches_[n * states_.size() + i] = values[n];
    }
  }

  std::vector<State> states_;
  std::vector<double> branches_;  // number n of the branch of fibre i at n size + i
};

}  // namespace pounding::materials
