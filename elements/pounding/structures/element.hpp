#pragma once
/// Elements: forces between points in addition to those of the linear structures.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/links/link_step.hpp>

namespace pounding {

/// Memory of one element: the bytes of a trivially copyable struct with an alignment of at most that of double.
using ElementMemory = std::span<std::byte>;
using ConstElementMemory = std::span<const std::byte>;

/// The memory as the struct T of its element.
template <class T>
T& memory_as(ElementMemory memory) noexcept {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(double));
  return *reinterpret_cast<T*>(memory.data());
}
template <class T>
const T& memory_as(ConstElementMemory memory) noexcept {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(double));
  return *reinterpret_cast<const T*>(memory.data());
}

/// Sets the memory to a default T, which determines all bytes.
template <class T>
void reset_as(ElementMemory memory) noexcept {
  std::memset(memory.data(), 0, sizeof(T));
  new (memory.data()) T{};
}

/// Maximum number of deformations of an element.
inline constexpr int max_deformations = 6;

/// Forces of an element and their slopes; only the first deformations() rows and columns are used.
struct ElementResponse {
  std::array<double, max_deformations> force{};  ///< [N]
  /// [i][j]: slope of force i by deformation j [N/m], by its rate [N s/m].
  std::array<std::array<double, max_deformations>, max_deformations> by_deformation{}, by_rate{};
};

/// Energies of an element [J].
struct ElementEnergy {
  double lost = 0;               ///< dissipated by yielding and friction
  double damped = 0;             ///< dissipated by damping
  double stored_correction = 0;  ///< stored, minus the sum of k_i d_i^2/2
};

/// An element with n deformations and n conjugate forces: n successive columns of B. Its forces are those in addition
/// to k_i d_i, with the stiffness k_i that the stiffness matrix contains (zero for a device). Positive forces oppose
/// positive deformations. All functions are const: what changes is the memory, at accepted steps only.
class Element {
 public:
  virtual ~Element() = default;

  /// n, from 1 to max_deformations.
  virtual int deformations() const noexcept = 0;
  /// Size of the memory in bytes.
  virtual std::size_t memory_size() const noexcept = 0;
  /// Sets the memory of an undeformed element.
  virtual void reset(ElementMemory memory) const noexcept = 0;
  /// k_i [N/m].
  virtual double stiffness(int i) const noexcept = 0;
  /// Magnitude of deformation i at first yield with the others at zero [m]; infinite if it stays elastic.
  virtual double yield_deformation(int i) const noexcept = 0;

  /// Forces and slopes at these n motions, from the last accepted state.
  virtual void evaluate(ConstElementMemory memory, std::span<const LinkMotion> motion,
                        ElementResponse& response) const noexcept = 0;
  /// Starts a run at these motions, without loss.
  virtual void start(ElementMemory memory, std::span<const LinkMotion> motion) const = 0;
  /// Loads the element slowly along a straight path from deformations at rest, before a run; counts the loss.
  virtual void load(ElementMemory memory, std::span<const double> from, std::span<const double> to) const {
    constexpr double duration = 1e9;  // without rate effects [s]
    std::array<LinkStep, max_deformations> steps{};
    for (std::size_t i = 0; i < to.size(); ++i) {
      const double rate = (to[i] - from[i]) / duration;
      steps[i] = {.end = duration,
                  .motion_begin = {from[i], rate},
                  .motion_middle = {0.5 * (from[i] + to[i]), rate},
                  .motion_end = {to[i], rate}};
    }
    accept(memory, std::span(steps).first(to.size()));
  }
  /// Accepts a step, one LinkStep per deformation.
  virtual void accept(ElementMemory memory, std::span<const LinkStep> step) const = 0;
  /// Energies at the last accepted state.
  virtual ElementEnergy energy(ConstElementMemory memory) const noexcept = 0;
  /// Energy dissipated by deformation i; their sum is that of the element [J].
  virtual double dissipated(ConstElementMemory memory, int i) const noexcept = 0;
};

/// Motion of an element that decides whether it yields: that of a single deformation, or the resultant of several, as a
/// deformation in direction i. The others are scaled by the ratio of yield deformations. `of(j)` is the motion of
/// deformation j.
template <class Motions>
LinkMotion resultant(const Element& element, int i, Motions&& of) {
  if (element.deformations() == 1) return of(0);
  double square = 0, product = 0;
  for (int j = 0; j < element.deformations(); ++j) {
    const LinkMotion motion = of(j);
    const double scale = element.yield_deformation(i) / element.yield_deformation(j);
    square += scale * scale * motion.penetration * motion.penetration;
    product += scale * scale * motion.penetration * motion.rate;
  }
  const double size = std::sqrt(square);
  return {size, size > 0 ? product / size : 0};
}

/// Memories of several elements, one after another: a plain value.
class ElementMemories {
 public:
  /// Adds the memory of an undeformed element and returns its index.
  int add(const Element& element) {
    first_.push_back(words_.size());
    words_.resize(words_.size() + (element.memory_size() + sizeof(double) - 1) / sizeof(double));
    element.reset(back());
    return static_cast<int>(first_.size()) - 1;
  }
  ElementMemory operator[](int element) noexcept {
    return std::as_writable_bytes(std::span(words_).subspan(first_[static_cast<std::size_t>(element)]));
  }
  ConstElementMemory operator[](int element) const noexcept {
    return std::as_bytes(std::span(words_).subspan(first_[static_cast<std::size_t>(element)]));
  }
  void archive(Archive& archive) { archive(words_); }

 private:
  ElementMemory back() noexcept { return std::as_writable_bytes(std::span(words_).subspan(first_.back())); }

  std::vector<double> words_;
  std::vector<std::size_t> first_;  // word of each element
};

/// Response of an undeformed element to these motions.
inline ElementResponse first_response(const Element& element, std::span<const LinkMotion> motion) {
  ElementMemories undeformed;
  undeformed.add(element);
  ElementResponse response;
  element.evaluate(undeformed[0], motion, response);
  return response;
}

}  // namespace pounding
