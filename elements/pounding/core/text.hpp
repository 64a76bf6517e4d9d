#pragma once
/// Text files of users: read whole, up to a maximum size, and checked to be text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// Bytes of a file; `kind` is "model" or "record" in messages. Pipes are read only from /dev, such as standard input.
/// Throws InputError for a missing or unreadable file, a folder, any other pipe, and more than `maximum` bytes.
std::string read_text_file(const std::string& path, std::string_view kind, std::size_t maximum);

/// Text without the UTF-8 byte order mark (EF BB BF) written by Windows editors.
std::string_view without_mark(std::string_view text);

/// Location in a text, and the error there.
struct WrongText {
  int line, column;  ///< from 1; a character of several bytes is one column
  std::string what;
};

/// First location that is not UTF-8 or is a control character other than tab and line ending; nullopt if there is none.
/// In UTF-16 and UTF-32 this is the first character.
std::optional<WrongText> wrong_text(std::string_view text);

/// UTF-8 text that can be displayed in one line: invalid bytes are interpreted as Latin-1, control characters become
/// spaces.
std::string shown_line(std::string_view text);

/// Text without these characters at its ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

/// Non-empty substrings of a text between any of these characters.
std::vector<std::string_view> parts_between(std::string_view text, std::string_view separators);

/// Error in a name: more than 200 bytes, a control character, or invalid UTF-8. Empty if there is none.
std::string wrong_name(std::string_view name);

}  // namespace pounding
