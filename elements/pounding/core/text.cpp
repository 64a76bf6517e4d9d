#include <pounding/core/text.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <pounding/base/excerpt.hpp>
#include <pounding/core/error.hpp>

namespace pounding {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
constexpr std::size_t longest_name = 200;

// "UTF-16" or "UTF-32" if the first bytes are a byte order mark, or zeros next to the first letter; otherwise empty.
std::string_view other_encoding(std::string_view text) {
  const auto begins = [&](std::string_view bytes) { return text.starts_with(bytes); };
  using namespace std::string_view_literals;
  const auto zero = [&](std::size_t i) { return i < text.size() && text[i] == '\0'; };
  if (begins("\xFF\xFE\0\0"sv) || begins("\0\0\xFE\xFF"sv) || (zero(0) && zero(1) && zero(2)) ||
      (zero(1) && zero(2) && zero(3)))
    return "UTF-32";
  if (begins("\xFF\xFE"sv) || begins("\xFE\xFF"sv) || (zero(0) && zero(2)) || (zero(1) && zero(3))) return "UTF-16";
  return {};
}

void append_utf8(std::string& text, std::uint32_t latin) {
  text += static_cast<char>(0xC0 | (latin >> 6));
  text += static_cast<char>(0x80 | (latin & 0x3F));
}

}  // namespace

std::string read_text_file(const std::string& path, std::string_view kind, std::size_t maximum) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: this is a folder; give the {} in it", excerpt(path), kind));
  const bool is_pipe = std::filesystem::is_fifo(status) || std::filesystem::is_socket(status);
  if (is_pipe && !path.starts_with("/dev/"))
    throw InputError(
        fmt::format("{}: this is a pipe, not a file; write it to a file, or read it from /dev/stdin", excerpt(path)));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: no such file, or it cannot be read", excerpt(path)));
  std::string text;
  std::array<char, 1 << 16> part;
  while (file) {
    file.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > maximum)
      throw InputError(fmt::format("{}: has more than {} MB, the maximum for a {}; is it the right file?",
                                   excerpt(path), maximum / 1'000'000, kind));
  }
  if (file.bad()) throw InputError(fmt::format("{}: cannot be read", excerpt(path)));
  return text;
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  return text;
}

std::optional<WrongText> wrong_text(std::string_view text) {
  if (const std::string_view other = other_encoding(text); !other.empty())
    return WrongText{1, 1, fmt::format("this file is in {}; save it as UTF-8", other)};
  int line = 1, column = 1;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (!c.is_valid)
      return WrongText{
          line, column,
          fmt::format(
              "the byte {:02X} is not UTF-8; save the file as UTF-8 (Latin-1 encodes letters such as \u00e4 this way)",
              c.code)};
    const bool ends_line = c.code == '\n' || (c.code == '\r' && text.size() > 1 && text[1] == '\n');
    if (c.code == '\r' && !ends_line)
      return WrongText{line, column, "isolated carriage return; save the file with Unix or Windows line endings"};
    if (is_control(c.code) && !ends_line && c.code != '\t')
      return WrongText{line, column, fmt::format("control character {}; delete it", excerpt(text.substr(0, c.size)))};
    ++column;
    if (c.code == '\n') {
      ++line;
      column = 1;
    }
    text.remove_prefix(c.size);
  }
  return std::nullopt;
}

std::string shown_line(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character c = first_character(text);
    if (is_control(c.code))
      shown += ' ';
    else if (c.is_valid)
      shown += text.substr(0, c.size);
    else
      append_utf8(shown, c.code);
    text.remove_prefix(c.size);
  }
  return shown;
}

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> parts_between(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return parts;
}

std::string wrong_name(std::string_view name) {
  if (name.size() > longest_name)
    return fmt::format("a name has at most {} bytes; \"{}\" has {}", longest_name, excerpt(name), name.size());
  for (std::string_view rest = name; !rest.empty();) {
    const Character c = first_character(rest);
    if (!c.is_valid || is_control(c.code))
      return fmt::format("the name \"{}\" contains {}; type letters, digits and spaces", excerpt(name),
                         c.is_valid ? "a control character" : "bytes that are not UTF-8");
    rest.remove_prefix(c.size);
  }
  return {};
}

}  // namespace pounding
