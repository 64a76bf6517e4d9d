#pragma once
/// Lowest frequencies of a structure, and its damping from fractions of critical damping.

#include <array>
#include <optional>
#include <variant>

#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Number of lowest modes computed for every structure.
inline constexpr int modes_of_a_structure = 6;

/// Damping ratio in two modes of the structure, or at two periods. Default: modes 1 and 2.
struct RayleighDamping {
  double ratio = 0;                                ///< in [0, 1)
  std::optional<std::array<int, 2>> modes{};       ///< numbered from 1
  std::optional<std::array<double, 2>> periods{};  ///< [s]
};

/// A single damping ratio for all modes.
struct ModalDamping {
  double ratio = 0;  ///< in [0, 1)
};

/// Damping of a structure. A plain ratio is the fraction of critical damping of an oscillator, and for structures with
/// several modes Rayleigh damping in modes 1 and 2.
class Damping {
 public:
  Damping(double ratio) : how_(ratio) {}
  Damping(RayleighDamping rayleigh) : how_(rayleigh) {}
  Damping(ModalDamping modal) : how_(modal) {}
  const std::variant<double, RayleighDamping, ModalDamping>& how() const noexcept { return how_; }  ///< as given

 private:
  std::variant<double, RayleighDamping, ModalDamping> how_;
};

/// Number of modes of a structure: its unknowns with mass.
int count_of_modes(const Structure& structure);

/// Computes the lowest frequencies of a structure, at most modes_of_a_structure; zero for a body. Throws
/// std::invalid_argument like `modes`.
void set_frequencies(Structure& structure, const ModeSolver& modes = dense_modes);

/// Adds damping to a structure with known frequencies, and describes it in damping_note. Modal damping stores only the
/// ratio, except on isolators, which are not damped: there it forms the matrix. Throws std::invalid_argument for a
/// ratio outside [0, 1), nonexistent modes, periods that are not positive, modes given together with periods, and modal
/// damping of too many modes on isolators.
void set_damping(Structure& structure, const Damping& damping, const ModeSolver& modes = dense_modes);

}  // namespace pounding
