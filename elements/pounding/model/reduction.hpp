#pragma once
/// Reduction of the linear structures of a model to a few hundred coordinates.

#include <limits>
#include <string>

namespace pounding {

/// Reduction of one structure, or of all structures of a model.
struct Reduction {
  /// Method.
  enum class Kind {
    none,       ///< no reduction: all natural modes of small structures, sparse factorizations for large ones
    automatic,  ///< for structures with more than 500 unknowns with mass, with as many blocks as the tolerance requires
    all_modes,  ///< all natural modes, whatever the size
    blocks,     ///< Ritz modes from the given numbers of blocks of the two chains
    lowest      ///< the lowest natural modes, static responses and the block at the frequency of the contact
  };
  Kind kind = Kind::none;
  int links = 5;    ///< blocks of the chain of the links, at least 1
  int ground = 20;  ///< blocks of the chain of the ground, at least 0
  int modes = 0;    ///< lowest modes, at least 1
  double error =
      0;  ///< for automatic: maximum relative error of link forces and displacements; 0: a fraction of the tolerance
  bool of_acceleration = false,
       of_members = false;  ///< true if `error` also applies to floor accelerations and member forces
  bool check = false;       ///< true to check the hardest impacts in all unknowns after the run; of reduced structures

  /// Equal method and numbers.
  bool operator==(const Reduction&) const = default;
  /// True if numbers were given; they must then be applicable to all structures.
  bool is_explicit() const { return kind == Kind::blocks || kind == Kind::lowest; }
  /// The reduction as typed in an input.
  std::string text() const;
};

/// A reduced structure, with three times the estimated reduction errors: maximum differences relative to maximum values
/// of the run. NaN without an estimate.
struct ReducedStructure {
  std::string name;
  int coordinates = 0, unknowns = 0;
  int link_blocks = 0, links = 0;      ///< blocks of the chain of the links, and its starting vectors
  int frictions = 0, devices = 0;      ///< of these vectors: friction directions of its links; devices on it
  int part_blocks = 0, parts = 0;      ///< the same for its yielding parts: storeys, hinges, isolators
  int ground_blocks = 0, grounds = 0;  ///< the same for the ground
  int modes = 0;                       ///< lowest modes in addition to the blocks
  double frequency = 0;                ///< of the block at the contact [Hz]; 0 for none
  double flexibility_error = 0,
         shadow_flexibility_error = 0;  ///< of its links near the frequency of the contact, in its modes and in those
                                        ///< of its shadow [m/N]; 0 if unknown
  double error_force = std::numeric_limits<double>::quiet_NaN();  ///< of the peak forces of its links, relative to the
                                                                  ///< maximum force of all links
  double error_displacement = std::numeric_limits<double>::quiet_NaN();  ///< of its floors
  double error_acceleration = std::numeric_limits<double>::quiet_NaN();  ///< of its floors, at the ends of steps
  double error_members =
      std::numeric_limits<double>::quiet_NaN();  ///< of forces and moments at the ends of its members
  int checked_windows = 0;  ///< number of time intervals computed in all unknowns, with the link forces of the run
  double check_force = std::numeric_limits<double>::quiet_NaN();  ///< maximum difference of peak link forces there,
                                                                  ///< relative to the maximum force of all links
  double check_displacement =
      std::numeric_limits<double>::quiet_NaN();  ///< of floor displacements, relative to the maximum of the run

  /// Size and blocks in one line: "tower: 239 coordinates of 4320 (links 4 x 40, 20 of them friction, ground 20 x 2,
  /// one at 10 Hz)".
  std::string size_text() const;
  /// The errors in one line: "forces 2e-4, displacements 1e-5".
  std::string error_text() const;
  /// Results of the check: "all unknowns in the 3 hardest impacts: forces 2e-5, displacements 1e-7"; empty without one.
  std::string check_text() const;
};

}  // namespace pounding
