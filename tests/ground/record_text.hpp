#pragma once
/// Helpers: texts of records.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <pounding/core/error.hpp>
#include <pounding/ground/record.hpp>
#include "support/messages.hpp"

namespace pounding::test {

inline Record read(const std::string& text, const RecordOptions& options = {}) {
  return read_record_text(text, "r.txt", options);
}

/// The message that rejects a text; "taken" if it is accepted.
inline std::string error_of(const std::string& text, const RecordOptions& options = {}) {
  return test::refusal<InputError>([&] { read(text, options); });
}

/// The text with its first `part` replaced.
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

/// Fortran-formatted numbers, `per_line` on each line.
template <typename Number>
std::string table(const std::vector<Number>& values, std::size_t per_line, const char* format) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format(fmt::runtime(format), values[i]);
    if ((i + 1) % per_line == 0 || i + 1 == values.size()) text += '\n';
  }
  return text;
}

}  // namespace pounding::test
