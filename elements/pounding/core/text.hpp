#pragma once
/// Text files of users: read whole, within a limit, and checked to be text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// The bytes of a file, "model" or "record" in messages. Pipes are read where they stand in /dev, as standard input
/// does. Throws InputError for a file that is not there or cannot be read, a folder, another pipe, and more than
/// `maximum` bytes.
std::string read_text_file(const std::string& path, std::string_view kind, std::size_t maximum);

/// Without the mark of UTF-8 (EF BB BF) in front that editors of Windows write.
std::string_view without_mark(std::string_view text);

/// The place of something in a text, and what is wrong there.
struct WrongText {
  int line, column;  ///< from 1; a character of several bytes is one column
  std::string what;
};

/// The first place at which a text is no UTF-8, or holds a control character other than tabs and ends of lines; nothing
/// where all is well. Of UTF-16 and UTF-32 that is its first character.
std::optional<WrongText> wrong_text(std::string_view text);

/// A text in UTF-8 that can be shown in a line: bytes that are no UTF-8 are taken as Latin-1, control characters become
/// blanks.
std::string shown_line(std::string_view text);

/// The non-empty parts of a text between any of these characters.
std::vector<std::string_view> parts_between(std::string_view text, std::string_view separators);

/// The fault of a name: more than 200 bytes, a control character, no UTF-8. Empty where all is well.
std::string wrong_name(std::string_view name);

}  // namespace pounding
