#pragma once
/// Everything about the links of a system that changes during a run.

#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/links/contact_memory.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/element.hpp>

namespace pounding {

/// Memories of contacts and elements, in the order of the system: a plain value.
struct LinkMemory {
  std::vector<ContactMemory> contacts;
  ElementMemories elements;

  /// Before the first step.
  explicit LinkMemory(const System& system) : contacts(system.initial_contacts) {
    if (contacts.empty())
      for (const Contact* contact : system.contacts) contacts.push_back(contact->initial());
    for (const Element* element : system.elements) elements.add(*element);
  }

  void archive(Archive& archive) { archive(contacts, elements); }
};

}  // namespace pounding
