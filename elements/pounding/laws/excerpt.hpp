#pragma once
/// Texts of a user in messages: short, valid UTF-8, and without characters that act on a terminal.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pounding::laws {

/// Characters that a message quotes of one text.
inline constexpr std::size_t longest_excerpt = 200;
/// Characters of a whole message.
inline constexpr std::size_t longest_message = 1800;

/// The first character of a text.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;   ///< bytes
  bool is_valid = false;  ///< whether the bytes are UTF-8 (RFC 3629)
};

/// Reads the first character of a text that is not empty; bytes that are no UTF-8 are taken one by one.
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

/// Whether a character is a control character of ASCII or Latin-1, line feed and tab among them.
constexpr bool is_control(std::uint32_t code) noexcept { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

/// Whether a character is shown as itself: no control character, line or paragraph separator, mark of the direction of
/// writing or of the order of bytes.
constexpr bool is_shown(std::uint32_t code) noexcept {
  const bool is_mark =
      (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F);
  return !is_control(code) && !is_mark && code != 0xFEFF && (code & 0xFFFEu) != 0xFFFE;
}

/// A text for a message: at most `most` characters, then "..."; characters that are not shown, and bytes that are no
/// UTF-8, as in
/// "\n", "\x1b", "\u202e". `kept` is a character that stays as it is.
inline std::string excerpt(std::string_view text, std::size_t most = longest_excerpt, char kept = ' ') {
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
    if (count > most) return shown + "...";
    shown += next;
    text.remove_prefix(c.size);
  }
  return shown;
}

/// A whole message, whose lines stay lines.
inline std::string message_text(std::string_view text) { return excerpt(text, longest_message, '\n'); }

}  // namespace pounding::laws
