#include <pounding/ground/number_table.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>

namespace pounding::records {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// True for blank lines, lines of empty cells, and comments.
bool says_nothing(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.find_first_not_of(",; \t\"") == std::string_view::npos || text.front() == '#' || text.front() == '%';
}

std::string_view unquoted(std::string_view cell) {
  return cell.size() > 1 && cell.front() == '"' && cell.back() == '"' ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

bool has_decimals(std::string_view number) { return number.find_first_of(".,eEdD") != std::string_view::npos; }

/// Text between separators, without surrounding blanks and quotes.
std::vector<std::string_view> split_at(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    parts.push_back(unquoted(trimmed(text.substr(begin, end - begin))));
    begin = end + 1;
  }
  return parts;
}

/// True if a line contains at least three consecutive letters other than "nan" and "inf".
bool has_word(std::string_view line) {
  std::string word;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && is_letter(line[i])) {
      word += line[i];
      continue;
    }
    if (word.size() >= 3 && upper(word) != "NAN" && upper(word) != "INF") return true;
    word.clear();
  }
  return false;
}

/// Number format of a file.
struct Style {
  bool decimal_comma = false;
  bool ambiguous = false;

  std::vector<std::string_view> split(std::string_view line) const {
    if (line.find(';') != std::string_view::npos) return split_at(line, ';');
    if (!decimal_comma && line.find(',') != std::string_view::npos) return split_at(line, ',');
    return split_at_blanks(line);
  }
  double number(const Lines& lines, std::size_t i, std::string_view text) const {
    if (!decimal_comma) return lines.sample(i, text);
    double value = 0;
    if (is_number(text, value) && std::abs(value) <= largest_value) return value;
    return lines.sample(i, text);
  }
  bool is_number(std::string_view text, double& value) const {
    if (!decimal_comma) return parse_number(text, value);
    std::string pointed(text);
    const bool has_both = text.find('.') != std::string_view::npos && text.find(',') != std::string_view::npos;
    std::replace(pointed.begin(), pointed.end(), ',', '.');
    return !has_both && parse_number(pointed, value);
  }
  bool begin_with_number(const std::vector<std::string_view>& columns) const {
    double value = 0;
    return !columns.empty() && is_number(columns.front(), value);
  }
};

/// True if all commas are between two digits, at most one per item.
bool has_decimal_commas(const std::vector<std::string_view>& words) {
  return std::all_of(words.begin(), words.end(), [](std::string_view word) {
    const std::size_t at = word.find(',');
    if (at == std::string_view::npos) return true;
    return at > 0 && at + 1 < word.size() && is_digit(word[at - 1]) && is_digit(word[at + 1]) &&
           word.find(',', at + 1) == word.npos;
  });
}

Style style_of(const Lines& lines) {
  bool semicolons = false, commas = false, points = false, between_digits = true, blanks = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = trimmed(lines[i]);
    if (line.empty() || line.find_first_not_of("0123456789+-.,;eE \t\"") != std::string_view::npos) continue;
    if (line.find('.') != std::string_view::npos) points = true;
    if (line.find(';') != std::string_view::npos) semicolons = true;
    if (line.find(',') == std::string_view::npos) continue;
    commas = true;
    const auto words = split_at_blanks(line);
    between_digits = between_digits && has_decimal_commas(words);
    blanks = blanks || words.size() > 1;
  }
  const bool may_be_decimal = commas && !points && between_digits;
  return {.decimal_comma = (commas && semicolons) || (may_be_decimal && blanks),
          .ambiguous = may_be_decimal && !semicolons && !blanks};
}

}  // namespace

bool ends_data(std::string_view line) {
  const auto begin = std::find_if(line.begin(), line.end(), is_letter);
  const std::string word = upper(std::string_view(begin, std::find_if_not(begin, line.end(), is_letter)));
  return (word == "END" || word == "EOF") && std::none_of(line.begin(), begin, is_digit);
}

NumberTable::NumberTable(const Lines& lines) : header_end_(lines.size()) {
  const Style style = style_of(lines);
  commas_are_ambiguous_ = style.ambiguous;
  std::size_t end = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i];
    if (says_nothing(line)) continue;
    const std::vector<std::string_view> columns = style.split(line);
    const bool begins = style.begin_with_number(columns);
    if (rows_.empty() && (!begins || has_word(line))) continue;
    if (end < i) {
      if (begins && !has_word(line))
        lines.fail(i, fmt::format("values continue after the end mark on line {}; keep one record per file", end + 1));
      continue;
    }
    if (!begins && ends_data(line)) {
      end = i;
      continue;
    }
    if (!begins && has_word(line))
      lines.fail(i,
                 fmt::format("\"{}\" is not a line of values; delete it, or put # in front", excerpt(trimmed(line))));
    if (rows_.empty()) header_end_ = i;
    rows_.push_back({i, values_.size(), std::none_of(columns.begin(), columns.end(), has_decimals)});
    if (values_.size() + columns.size() > max_numbers)
      lines.fail(i, fmt::format("too many numbers; a record has at most {}", max_numbers));
    for (const std::string_view text : columns) values_.push_back(style.number(lines, i, text));
    if (std::all_of(values_.begin() + static_cast<std::ptrdiff_t>(rows_.back().begin), values_.end(),
                    [](double value) { return value == 0; }))
      rows_.back().integers = false;
  }
}

void NumberTable::drop(std::size_t rows) {
  const std::size_t numbers = rows < rows_.size() ? rows_[rows].begin : values_.size();
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(rows));
  values_.erase(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(numbers));
  for (Row& row : rows_) row.begin -= numbers;
}

std::vector<double> NumberTable::column(std::size_t index) const {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows(); ++row) values.push_back(at(row, index));
  return values;
}

bool holds_numbers(const Lines& lines) {
  constexpr std::size_t searched = 100;
  const Style style = style_of(lines);
  bool says_something = false;
  for (std::size_t i = 0; i < std::min(lines.size(), searched); ++i) {
    if (says_nothing(lines[i])) continue;
    if (style.begin_with_number(style.split(lines[i])) && !has_word(lines[i])) return true;
    says_something = true;
  }
  return !says_something;
}

std::vector<std::string> column_names(std::string_view line) {
  std::string_view text = trimmed(line);
  while (!text.empty() && (text.front() == '#' || text.front() == '%')) text = trimmed(text.substr(1));
  std::vector<std::string> names;
  for (const char mark : {';', ',', '\t'}) {
    if (text.find(mark) == std::string_view::npos) continue;
    for (const std::string_view name : split_at(text, mark)) names.emplace_back(name);
    return names;
  }
  for (const std::string_view word : split_at_blanks(text)) {
    const bool is_inside = !names.empty() && std::count(names.back().begin(), names.back().end(), '(') >
                                                 std::count(names.back().begin(), names.back().end(), ')');
    if (!names.empty() && (is_inside || word.front() == '(' || word.front() == '['))
      names.back().append(" ").append(word);
    else
      names.emplace_back(word);
  }
  return names;
}

}  // namespace pounding::records
