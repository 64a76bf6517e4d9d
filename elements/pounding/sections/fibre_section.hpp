#pragma once
/// Response of a cross-section of fibres.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include <pounding/materials/all.hpp>
#include <pounding/materials/lanes.hpp>
#include <pounding/sections/fibre.hpp>

namespace pounding::sections {

/// Axial strain [-] at the origin, curvatures about y and z [1/m]. The strain of a fibre is e + z ky - y kz.
using Deformation = std::array<double, 3>;

/// Forces N [N], My, Mz [N m] and their derivatives with respect to the deformation: upper triangle, row by row.
struct SectionResponse {
  std::array<double, 3> force{};
  std::array<double, 6> stiffness{};
};

/// Section deformations during a step: at its beginning, at stages in the order of time, and at its end. At least
/// three; times increase, in any unit.
struct StageSamples {
  std::span<const double> times;
  std::span<const Deformation> deformations;
};

/// Extremum of the parabola through the extreme sample and its neighbours, strictly inside the step; `nullopt` if the
/// samples are monotonic.
std::optional<double> find_reversal(std::span<const double> times, std::span<const double> strains) noexcept;

/// Result of accepting a step: whether a fibre followed a reversal inside it, and the work per length [J/m].
struct Accepted {
  bool reversed = false;
  double work = 0;
};

/// States of fibres of one material, of any law.
template <class Any>
struct LanesOf;
template <class... M>
struct LanesOf<std::variant<M...>> {
  using type = std::variant<materials::Lanes<M>...>;
};

/// States of the fibres of a section, as a value: one entry per material.
using FibreStates = std::vector<LanesOf<materials::AnyMaterial>::type>;

/// A cross-section of fibres. Fibres are sorted by material, and each material is one loop. Immutable: all states are
/// in FibreStates.
class FibreSection {
 public:
  /// Throws std::invalid_argument without fibres, if an area is not positive, or a material index is out of range.
  FibreSection(std::vector<materials::AnyMaterial> materials, Fibres fibres);

  /// Undeformed states.
  FibreStates states() const;
  /// Forces and tangent at a deformation reached from accepted states on a straight path. Pure.
  SectionResponse evaluate(const FibreStates& states, const Deformation& deformation) const noexcept;
  /// Accepts a deformation.
  void accept(FibreStates& states, const Deformation& deformation) const noexcept;
  /// Accepts the end of a step. Each fibre first follows its reversal inside the step, if it differs from both ends by
  /// at least `min_reversal` [-].
  Accepted accept(FibreStates& states, const StageSamples& samples, double min_reversal) const;
  /// True if the strain of any fibre may reverse inside the step.
  bool may_reverse(const StageSamples& samples) const noexcept;
  /// Work of the stresses per length on the straight path to a deformation [J/m].
  double work(const FibreStates& states, const Deformation& deformation) const noexcept;
  /// Recoverable energy per length [J/m].
  double stored(const FibreStates& states) const noexcept;
  /// Energy dissipated per length on the straight path to a deformation [J/m].
  double lost(const FibreStates& states, const Deformation& deformation) const noexcept;

  /// Sorted by material.
  std::span<const Fibre> fibres() const noexcept { return fibres_; }
  std::span<const materials::AnyMaterial> materials() const noexcept { return materials_; }
  /// Bounding box of the centroids: low and high corner.
  const std::array<Point, 2>& extent() const noexcept { return extent_; }
  /// False if a material does not forget small reversals, so that no error tolerance applies.
  bool forgets_small_reversals() const noexcept;

 private:
  struct Group {
    std::size_t material, begin, end;
  };
  /// Calls a function with law, lanes, fibre index and index within the lanes.
  template <class States, class Function>
  void each(States& states, const Function& function) const;
  /// Calls a function with law, lanes, index of the first fibre, its index within the lanes, number of fibres, and
  /// their strains.
  template <class States, class Function>
  void each_chunk(States& states, const Deformation& deformation, const Function& function) const;

  std::vector<materials::AnyMaterial> materials_;
  Fibres fibres_;
  std::vector<double> y_, z_, area_;  // of fibres_, and zeros up to a multiple of the width of the sums
  std::vector<Group> groups_;
  std::array<Point, 2> extent_;
  bool is_plane_;  // all fibres at y = 0
};

}  // namespace pounding::sections
