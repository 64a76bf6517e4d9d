#pragma once
/// History of contacts and yielding parts.

#include <pounding/core/archive.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// Writes or reads the history of all links of a system.
inline void archive_memory(const System& system, Archive& archive) {
  for (Contact* contact : system.contacts) contact->archive(archive);
  for (Spring* spring : system.springs) spring->archive(archive);
}

}  // namespace pounding
