#pragma once
/// Records in texts of a test.

#include <string>

#include <pounding/core/error.hpp>
#include <pounding/ground/record.hpp>

namespace pounding::test {

inline Record read(const std::string& text, const RecordOptions& options = {}) { return read_record_text(text, "r.txt", options); }

/// The message that refuses a text; "no error" where none does.
inline std::string error_of(const std::string& text, const RecordOptions& options = {}) {
  try {
    read(text, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace pounding::test
