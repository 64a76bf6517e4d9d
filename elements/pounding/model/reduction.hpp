#pragma once
/// Whether the linear structures of a model are solved in a few hundred coordinates, and in which.

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
  int links = 5;    ///< blocks of the chain of the links, at least 1
  int ground = 20;  ///< blocks of the chain of the ground, at least 0
  int modes = 0;    ///< lowest modes, at least 1

  /// Whether numbers were given: what cannot be kept then is an error.
  bool is_explicit() const { return kind == Kind::blocks || kind == Kind::lowest; }
  /// As it is typed.
  std::string text() const;
};

}  // namespace pounding
