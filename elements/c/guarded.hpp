#pragma once
/// Error handling of the C interface: a status code, and an error text per thread.

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pounding.h"

namespace pounding::c {

/// Stores the error text of the calling thread for pnd_error_text() and returns the status.
pnd_status fail(pnd_status status, std::string_view text) noexcept;

/// Calls a function and converts its exceptions to a status: none propagates into C.
template <class Call>
int guarded(Call&& call) noexcept {
  try {
    call();
    return PND_OK;
  } catch (const std::invalid_argument& error) {
    return fail(PND_BAD_ARGUMENT, error.what());
  } catch (const std::bad_alloc&) {
    return fail(PND_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(PND_FAILED, error.what());
  } catch (...) {
    return fail(PND_FAILED, "unknown failure");
  }
}

/// Throws std::invalid_argument for a null pointer.
inline void require(const void* pointer, const char* name) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " is a null pointer");
}

/// Item of a list. Throws std::invalid_argument for an index out of range, with the owner of the list and a noun.
template <class List>
const auto& item_at(const List& list, std::size_t index, std::string_view owner, const char* noun) {
  if (index >= list.size())
    throw std::invalid_argument(std::string(owner) + " has no " + noun + " with index " + std::to_string(index) +
                                "; number of these: " + std::to_string(list.size()));
  return list[index];
}

}  // namespace pounding::c
