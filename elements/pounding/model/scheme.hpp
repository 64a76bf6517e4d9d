#pragma once
/// Time integration scheme of a model.

#include <array>
#include <cstddef>
#include <string_view>

namespace pounding {

/// Time integration scheme.
struct Scheme {
  /// See names.
  enum class Kind { generalized_alpha, esdirk4 };
  Kind kind = Kind::esdirk4;
  double spectral_radius = 1.0;  ///< at infinite frequency, 0 to 1; only for generalized-alpha

  /// Names in input files and options, in the order of Kind.
  static constexpr std::array<std::string_view, 2> names{"generalized_alpha", "esdirk4"};
  static Kind kind_of(std::string_view name) { return name == names[1] ? Kind::esdirk4 : Kind::generalized_alpha; }
  std::string_view name() const { return names[static_cast<std::size_t>(kind)]; }

  /// The error estimate of one step is proportional to this power of its length.
  int error_order() const { return kind == Kind::esdirk4 ? 4 : 3; }
};

}  // namespace pounding
