#pragma once
/// Shared by the fuzz targets. A target is a file with one function called by libFuzzer, LLVMFuzzerTestOneInput: it
/// passes bytes to a reader and accepts the reader's documented errors. Everything else ends the program: another
/// exception, a sanitizer, a broken guarantee.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include <pounding/base/excerpt.hpp>
#include <pounding/core/error.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace pounding::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program unless `kept`.
inline void require(bool kept, std::string_view promise, std::string_view read = {}) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s: %s\n", std::string(promise).c_str(), std::string(read).c_str());
  std::abort();
}

/// A message can be printed unchanged.
inline void require_printable(const std::exception& error) {
  const std::string_view text = error.what();
  require(!text.empty() && text == message_text(text), "messages are short, and UTF-8 without control characters",
          text);
}

/// Calls a reader that may refuse its input.
template <class Read>
void refusing(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    require_printable(error);
  }
}

/// Removes and returns the next line of `text`; empty at the end.
inline std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

}  // namespace pounding::fuzz
