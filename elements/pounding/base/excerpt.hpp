#pragma once
/// User texts in messages: short, valid UTF-8, and without characters that control a terminal.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pounding {

/// Maximum number of characters that a message quotes from one text.
inline constexpr std::size_t longest_excerpt = 200;
/// Maximum number of characters of a message.
inline constexpr std::size_t longest_message = 1800;

/// First character of a text.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;   ///< bytes
  bool is_valid = false;  ///< true if the bytes are valid UTF-8 (RFC 3629)
};

/// Reads the first character of a non-empty text; bytes that are not valid UTF-8 are read one at a time.
constexpr Character first_character(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {lead, 1, false};
  std::uint32_t code = lead & (0xFFu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return {lead, 1, false};
    code = (code << 6) | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < smallest[size] || is_surrogate || code > 0x10FFFF) return {lead, 1, false};
  return {code, size, true};
}

/// True for control characters of ASCII and Latin-1, including line feed and tab.
constexpr bool is_control(std::uint32_t code) noexcept { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

/// True for printable characters: not a control character, line or paragraph separator, bidirectional or byte order
/// mark.
constexpr bool is_shown(std::uint32_t code) noexcept {
  const bool is_mark =
      (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F);
  return !is_control(code) && !is_mark && code != 0xFEFF && (code & 0xFFFEu) != 0xFFFE;
}

/// Text for a message, truncated at a maximum length with "...". Unprintable characters and invalid UTF-8 are escaped
/// as in "\n", "\x1b", "\u202e", except the character `kept`.
inline std::string excerpt(std::string_view text, std::size_t maximum = longest_excerpt, char kept = ' ') {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string shown;
  std::size_t count = 0;
  while (!text.empty()) {
    const Character c = first_character(text);
    std::string next(text.substr(0, c.size));
    if (c.is_valid && (is_shown(c.code) || c.code == static_cast<unsigned char>(kept))) {
      ++count;
    } else {
      if (c.code == '\n')
        next = "\\n";
      else if (c.code == '\t')
        next = "\\t";
      else if (c.code == '\r')
        next = "\\r";
      else
        next = c.code < 0x100 ? "\\x" : "\\u";
      if (next == "\\x" || next == "\\u")
        for (int shift = c.code < 0x100 ? 4 : c.code < 0x10000 ? 12 : 20; shift >= 0; shift -= 4)
          next += digits[(c.code >> shift) & 0xFu];
      count += next.size();
    }
    if (count > maximum) return shown + "...";
    shown += next;
    text.remove_prefix(c.size);
  }
  return shown;
}

/// A whole message; line breaks are kept.
inline std::string message_text(std::string_view text) { return excerpt(text, longest_message, '\n'); }

}  // namespace pounding
