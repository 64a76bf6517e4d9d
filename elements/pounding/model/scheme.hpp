#pragma once
/// The time-stepping scheme that a model asks for.

#include <array>
#include <cstddef>
#include <string_view>

namespace pounding {

/// The scheme that a run is stepped with.
struct Scheme {
  /// By its name in the input, see names.
  enum class Kind { generalized_alpha, esdirk4 };
  Kind kind = Kind::esdirk4;
  double spectral_radius = 1.0;  ///< at infinite frequency, 0 to 1; generalized-alpha alone has it

  /// Names in input files and options, in the order of Kind.
  static constexpr std::array<std::string_view, 2> names{"generalized_alpha", "esdirk4"};
  static Kind kind_of(std::string_view name) { return name == names[1] ? Kind::esdirk4 : Kind::generalized_alpha; }
  std::string_view name() const { return names[static_cast<std::size_t>(kind)]; }

  /// The error that is estimated in one step falls with this power of its length.
  int error_order() const { return kind == Kind::esdirk4 ? 4 : 3; }
};

}  // namespace pounding
