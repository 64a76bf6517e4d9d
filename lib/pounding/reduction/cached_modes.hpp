#pragma once
/// Disk cache of the modes of reduced structures.

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

/// Everything that determines the modes of a reduced group.
struct ModesOrigin {
  SparseMatrix mass, stiffness;  ///< M and K of the group
  ClassicalDamping damping;
  ReducedInputs inputs;
  ReducedDepth depth;
  bool shadow = true;  ///< true if a shadow is computed

  /// Equal bytes for equal origins, different bytes otherwise.
  std::vector<std::byte> bytes() const;
};

/// A directory with one file per origin, safe for concurrent processes. A file is used only if it contains the exact
/// origin and passes its checksum; otherwise it is rewritten. Above `max_bytes` files are evicted in LRU order.
class CachedModes {
 public:
  /// Creates the directory if necessary. Throws InputError, stating what to type, if it cannot be created or is not
  /// writable.
  explicit CachedModes(std::string folder, std::uintmax_t max_bytes = 5'000'000'000);

  /// Modes, shadow and flexibility errors for an origin, given by its bytes; nullopt if not cached.
  std::optional<ReducedGroup> find(const std::vector<std::byte>& origin) const;
  /// Stores the same for a group. Does nothing if the disk is full.
  void keep(const std::vector<std::byte>& origin, const ReducedGroup& group) const;

 private:
  /// Path without its extension.
  std::string file_of(const std::vector<std::byte>& origin) const;
  void make_room() const;

  std::string folder_;
  std::uintmax_t max_bytes_;
};

}  // namespace pounding::petsc
