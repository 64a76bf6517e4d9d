#pragma once
/// Laws that are another law with different parameters.

#include <optional>

#include <pounding/hysteresis/law.hpp>

namespace pounding::hysteresis {

/// Base of a law Self that is the law Inner with different parameters: Self provides `Inner made() const noexcept` and
/// check().
template <class Self, Law Inner>
struct MadeOf {
  /// State of the other law.
  using State = typename Inner::State;
  static constexpr bool has_corners = hysteresis::has_corners<Inner>;

  double stiffness() const noexcept { return inner().stiffness(); }
  double yield_deformation() const noexcept { return inner().yield_deformation(); }
  Answer respond(const State& kept, double d) const noexcept { return inner().respond(kept, d); }
  State advance(const State& kept, double d) const noexcept { return inner().advance(kept, d); }
  double stored(const State& kept) const noexcept { return inner().stored(kept); }
  double work(const State& kept, double d) const noexcept { return inner().work(kept, d); }
  std::optional<double> corner(const State& kept, double d) const noexcept { return inner().corner(kept, d); }
  Answer excess(const State& kept, double d) const noexcept { return hysteresis::excess(inner(), kept, d); }
  double lost(const State& kept, double d) const noexcept { return hysteresis::lost(inner(), kept, d); }
  double stored_excess(const State& kept) const noexcept { return hysteresis::stored_excess(inner(), kept); }

 private:
  Inner inner() const noexcept { return static_cast<const Self&>(*this).made(); }
};

}  // namespace pounding::hysteresis
