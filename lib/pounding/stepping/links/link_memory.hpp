#pragma once
/// The memory of contacts and of parts that yield.

#include <pounding/core/archive.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// Writes or reads the memory of all links of a system, which moves with its steps.
inline void archive_memory(const System& system, Archive& archive) {
  for (Contact* contact : system.contacts) contact->archive(archive);
  for (Spring* spring : system.springs) spring->archive(archive);
}

}  // namespace pounding
