#pragma once
/// Natural modes of structures, shared by structures with identical matrices.

#include <memory>
#include <vector>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// All natural modes of groups, computed once for bitwise identical masses, stiffness and rigid-body motions. Solvers
/// of several systems may share them, such as those of the same structures in other combinations. Not thread-safe.
class NaturalModes {
 public:
  /// Modes of a group; massless degrees of freedom are statically condensed. Throws std::invalid_argument for a mass
  /// matrix that is not positive definite, and for a massless degree of freedom without stiffness.
  std::shared_ptr<const GroupModes> of(const System& system, const Group& group);

 private:
  struct Structure {
    SparseMatrix mass, stiffness;
    int rigid_motions = 0;
    std::shared_ptr<const GroupModes> modes;
  };
  std::vector<Structure> structures_;
};

/// Dynamic and massless degrees of freedom of a group, relative to its first one. Throws std::invalid_argument for a
/// negative mass.
MassSplit split_of(const System& system, const Group& group);

}  // namespace pounding
