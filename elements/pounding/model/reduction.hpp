#pragma once
/// Whether the linear structures of a model are solved in a few hundred coordinates, and in which.

#include <limits>
#include <string>

namespace pounding {

/// How one structure, or all of a model, are reduced before a run.
struct Reduction {
  /// Which coordinates.
  enum class Kind {
    none,       ///< not at all: all natural modes of small structures, factors of sparse matrices for large ones
    automatic,  ///< structures with more than 500 unknowns with mass, as deep as the tolerance asks
    all_modes,  ///< all natural modes, whatever the size
    blocks,     ///< Ritz modes on this many blocks of the two chains
    lowest      ///< the lowest natural modes, static answers and the block at the contact's frequency
  };
  Kind kind = Kind::none;
  int links = 5;     ///< blocks of the chain of the links, at least 1
  int ground = 20;   ///< blocks of the chain of the ground, at least 0
  int modes = 0;     ///< lowest modes, at least 1
  double error = 0;  ///< of what is automatic: largest error of forces of links and of displacements, relative; 0: a
                     ///< part of the tolerance
  bool of_acceleration = false,
       of_members = false;  ///< whether `error` holds for accelerations of floors and forces of members as well
  bool check =
      false;  ///< whether all unknowns are stepped through the hardest impacts, after the run; of what is reduced

  /// Same kind and numbers.
  bool operator==(const Reduction&) const = default;
  /// Whether numbers were given: what cannot be kept then is an error.
  bool is_explicit() const { return kind == Kind::blocks || kind == Kind::lowest; }
  /// As it is typed.
  std::string text() const;
};

/// A structure that was reduced, and three times the estimated errors that this made: largest differences over largest
/// values of the run. NaN where nothing estimates them.
struct ReducedStructure {
  std::string name;
  int coordinates = 0, unknowns = 0;
  int link_blocks = 0, links = 0;      ///< blocks of the chain of the links, and vectors that drive it
  int frictions = 0, devices = 0;      ///< of these vectors: directions in which its links rub; devices on it
  int part_blocks = 0, parts = 0;      ///< the same of what yields in it: storeys, hinges, isolators
  int ground_blocks = 0, grounds = 0;  ///< the same of the ground
  int modes = 0;                       ///< lowest modes beside the blocks
  double frequency = 0;                ///< of the block at the contact [Hz]; 0 for none
  double flexibility_error = 0, shadow_flexibility_error = 0;  ///< of its links about the frequency of the contact, in
                                                               ///< its modes and in its shadow's [m/N]; 0 for unknown
  double error_force = std::numeric_limits<double>::quiet_NaN();  ///< of peak forces of the links that hit it, over the
                                                                  ///< largest force of all links
  double error_displacement = std::numeric_limits<double>::quiet_NaN();  ///< of its floors
  double error_acceleration = std::numeric_limits<double>::quiet_NaN();  ///< of its floors, at ends of steps
  double error_members =
      std::numeric_limits<double>::quiet_NaN();  ///< of forces and moments at the ends of its members
  int checked_windows =
      0;  ///< stretches of time through which all unknowns were stepped, with the link forces of the run
  double check_force = std::numeric_limits<double>::quiet_NaN();  ///< largest difference of peak forces of links there,
                                                                  ///< over the largest force of all links
  double check_displacement =
      std::numeric_limits<double>::quiet_NaN();  ///< of displacements of floors, over the largest one of the run

  /// Size and blocks in one line: "tower: 239 coordinates of 4320 (links 4 x 40, 20 of them friction, ground 20 x 2,
  /// one at 10 Hz)".
  std::string size_text() const;
  /// The errors in one line: "forces 2e-4, displacements 1e-5".
  std::string error_text() const;
  /// Findings of the check: "all unknowns in the 3 hardest impacts: forces 2e-5, displacements 1e-7"; empty without
  /// one.
  std::string check_text() const;
};

}  // namespace pounding
