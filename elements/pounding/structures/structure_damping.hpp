#pragma once
/// The first frequencies of a structure, and its damping from ratios of critical damping.

#include <array>
#include <optional>
#include <variant>

#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Lowest modes that are found of every structure.
inline constexpr int modes_of_a_structure = 6;

/// The ratio in two modes of the structure, or at two periods. Modes 1 and 2 unless something is given.
struct RayleighDamping {
  double ratio = 0;                                ///< in [0, 1)
  std::optional<std::array<int, 2>> modes{};       ///< counted from 1
  std::optional<std::array<double, 2>> periods{};  ///< [s]
};

/// One ratio in every mode.
struct ModalDamping {
  double ratio = 0;  ///< in [0, 1)
};

/// How a structure is damped. A bare ratio is that of an oscillator's critical damping, and with several modes
/// Rayleigh's in the first two.
class Damping {
 public:
  Damping(double ratio) : how_(ratio) {}
  Damping(RayleighDamping rayleigh) : how_(rayleigh) {}
  Damping(ModalDamping modal) : how_(modal) {}
  const std::variant<double, RayleighDamping, ModalDamping>& how() const noexcept { return how_; }  ///< as given

 private:
  std::variant<double, RayleighDamping, ModalDamping> how_;
};

/// Number of modes of a structure: of unknowns with mass.
int count_of_modes(const Structure& structure);

/// Finds the lowest frequencies of a structure, modes_of_a_structure of them where there are so many; zero for a body.
/// Throws std::invalid_argument as `modes` does.
void set_frequencies(Structure& structure, const ModeSolver& modes = dense_modes);

/// Adds the damping to a structure whose frequencies have been set, and notes it in damping_note.
/// Of modal damping it notes the ratio alone, without a matrix, but on isolators, which it leaves out.
/// Throws std::invalid_argument for a ratio outside [0, 1), modes that it has not, periods that are not positive, both
/// of them, and modal damping of too many modes on isolators.
void set_damping(Structure& structure, const Damping& damping, const ModeSolver& modes = dense_modes);

}  // namespace pounding
