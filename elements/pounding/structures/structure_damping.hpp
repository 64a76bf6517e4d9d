#pragma once
/// Lowest frequencies of a structure, and its damping from fractions of critical damping.

#include <array>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

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

/// Rayleigh damping by its two factors, each >= 0: C = alpha M + beta K.
struct RayleighFactors {
  double alpha = 0;  ///< [1/s]
  double beta = 0;   ///< [s]
};

/// Damping proportional to the mass or to the stiffness alone, with the ratio in one mode or at one period.
struct ProportionalDamping {
  /// Matrix to which the damping is proportional.
  enum class To { mass, stiffness };
  To to = To::stiffness;
  double ratio = 0;                ///< in [0, 1)
  std::optional<int> mode{};       ///< numbered from 1; default: 1, unless there is a period
  std::optional<double> period{};  ///< [s]
};

/// A single damping ratio for all modes, or `ratios` for the lowest modes and `ratio` for all others.
struct ModalDamping {
  double ratio = 0;              ///< in [0, 1)
  std::vector<double> ratios{};  ///< in [0, 1), from mode 1
};

/// Stiffness of an isolated structure that defines its damping.
enum class DampedStiffness {
  initial,        ///< of the whole structure, with the initial stiffness of the isolators
  superstructure  ///< without that of the isolators, which are then not damped
};

/// Damping of a structure. A plain ratio is the fraction of critical damping of an oscillator, and for structures with
/// several modes Rayleigh damping in modes 1 and 2.
class Damping {
 public:
  /// A plain ratio or one of the models.
  using Model = std::variant<double, RayleighDamping, RayleighFactors, ProportionalDamping, ModalDamping>;

  Damping(double ratio) : how_(ratio) {}
  Damping(RayleighDamping rayleigh, std::optional<DampedStiffness> of = {}) : how_(rayleigh), of_(of) {}
  Damping(RayleighFactors factors, std::optional<DampedStiffness> of = {}) : how_(factors), of_(of) {}
  Damping(ProportionalDamping one, std::optional<DampedStiffness> of = {}) : how_(one), of_(of) {}
  Damping(ModalDamping modal, std::optional<DampedStiffness> of = {}) : how_(std::move(modal)), of_(of) {}

  const Model& how() const noexcept { return how_; }                         ///< as given
  const std::optional<DampedStiffness>& of() const noexcept { return of_; }  ///< default: superstructure, if isolated

 private:
  Model how_;
  std::optional<DampedStiffness> of_{};
};

/// Number of modes of a structure: its unknowns with mass.
int count_of_modes(const Structure& structure);

/// Computes the lowest frequencies of a structure, at most modes_of_a_structure; zero for a body. Throws
/// std::invalid_argument like `modes`.
void set_frequencies(Structure& structure, const ModeSolver& modes = dense_modes);

/// Adds damping to a structure with known frequencies, and describes it in damping_note. Modal damping stores a single
/// ratio; it forms a matrix for ratios by mode, and for the structure above isolators. Throws std::invalid_argument for
/// a ratio outside [0, 1), negative factors, nonexistent modes, periods that are not positive, modes given together
/// with periods, damping that is proportional to the mass above isolators or of a structure without supports, and too
/// many modes for a matrix.
void set_damping(Structure& structure, const Damping& damping, const ModeSolver& modes = dense_modes);

}  // namespace pounding
