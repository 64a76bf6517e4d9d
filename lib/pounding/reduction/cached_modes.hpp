#pragma once
/// Modes of reduced structures that lie on the disk from one run to the next.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/system.hpp>
#include <pounding/reduction/flexibility_errors.hpp>
#include <pounding/reduction/reduced_modes.hpp>

namespace pounding::petsc {

/// All that the modes of a reduced group follow from.
struct ModesOrigin {
  SparseMatrix mass, stiffness;  ///< of the group, M and K
  ClassicalDamping damping;
  ReducedInputs inputs;
  ReducedDepth depth;
  bool shadow = true;  ///< whether one is made

  /// Equal bytes for an equal origin, and for no other one.
  std::vector<std::byte> bytes() const;
};

/// A folder with a file for each origin. Processes may use one folder at the same time. A file is found only where it
/// holds every bit of the origin and none of it has changed since it was written; another one is written anew. Where
/// the folder would hold more than so many bytes, the files that were used longest ago go.
class CachedModes {
 public:
  /// The folder is made where it is not there. Throws InputError, with what to type, where it cannot be made or nothing
  /// can be written in it.
  explicit CachedModes(std::string folder, std::uintmax_t max_bytes = 5'000'000'000);

  /// The modes, the shadow and the errors of the flexibility of an origin by its bytes; nothing where there are none.
  std::optional<ReducedGroup> find(const std::vector<std::byte>& origin) const;
  /// Keeps the same of a group. Where the disk is full nothing is kept.
  void keep(const std::vector<std::byte>& origin, const ReducedGroup& group) const;

 private:
  /// Without its ending.
  std::string file_of(const std::vector<std::byte>& origin) const;
  void make_room() const;

  std::string folder_;
  std::uintmax_t max_bytes_;
};

}  // namespace pounding::petsc
