#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/units.hpp>
#include <pounding/ground/number_table.hpp>

namespace pounding::records {
namespace {

constexpr std::string_view blanks = " \t";

constexpr char zero = '\0', end_of_file = '\x1A';

char capital(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

/// Text without padding of zero bytes and DOS end-of-file marks after the last line.
std::string_view without_padding(std::string_view text) {
  constexpr std::string_view padding("\0\x1A\f\v \t\r\n", 8);
  const std::size_t last = text.find_last_not_of(padding);
  const std::size_t begin = last == std::string_view::npos ? 0 : last + 1;
  return text.substr(0, std::min({text.find(zero, begin), text.find(end_of_file, begin), text.size()}));
}

}  // namespace

std::span<const Format* const> formats() {
#define FORMAT(name) &name,
  static constexpr const Format* all[] = {
#include <pounding/ground/records/formats.inc>
  };
#undef FORMAT
  return all;
}

Lines::Lines(std::string_view text, std::string name) : name_(std::move(name)) {
  if (text.size() > longest_record)
    throw InputError(fmt::format("{}: has more than {} MB, the maximum for a record; check the file name", name_,
                                 longest_record / 1'000'000));
  text = without_padding(without_mark(text));
  const char mark = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    // Printed and joined files have page breaks and end-of-file marks at the ends of lines.
    const std::string_view line = trimmed(text.substr(begin, end - begin), "\f\v\x1A\r");
    if (line.size() > longest_line)
      fail(size(), fmt::format("has {} bytes; a line has at most {}", line.size(), longest_line));
    if (size() == max_lines) fail(size(), fmt::format("too many lines; a record has at most {}", max_lines));
    if (line.find(zero) != std::string_view::npos)
      fail(size(),
           "contains zero bytes, as in UTF-16, Excel workbooks and binary files; save the file as UTF-8 text, or a "
           "sheet as CSV");
    lines_.push_back(line);
    begin = end + 1;
  }
}

std::string_view Lines::at(std::size_t i, std::string_view expected) const {
  if (i >= size()) fail(size() - 1, fmt::format("the file ends here, before {}", expected));
  return lines_[i];
}

void Lines::fail(std::size_t i, const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", name_, i + 1, message));
}

double Lines::number(std::size_t i, std::string_view text) const {
  double value = 0;
  if (!parse_number(text, value)) fail(i, fmt::format("\"{}\" is not a finite number", excerpt(text)));
  return value;
}

double Lines::sample(std::size_t i, std::string_view text) const {
  const double value = number(i, text);
  if (std::abs(value) > largest_value)
    fail(i, fmt::format("\"{}\" exceeds the maximum of times and samples ({:g})", excerpt(text), largest_value));
  return value;
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), capital);
  return result;
}

std::string single_spaced(std::string_view text) { return fmt::format("{}", fmt::join(split_at_blanks(text), " ")); }

std::vector<std::string_view> split_at_blanks(std::string_view text) { return parts_between(text, blanks); }

bool contains(std::string_view text, std::string_view part) { return upper(text).find(part) != std::string::npos; }

bool begins_with(std::string_view text, std::string_view part) { return upper(text.substr(0, part.size())) == part; }

std::regex pattern(const char* text) { return std::regex(text, std::regex::ECMAScript | std::regex::icase); }

std::optional<std::vector<std::string>> captured(std::string_view line, const std::regex& pattern) {
  // Header lines are short. std::regex is recursive and would overflow the stack on a long line.
  if (line.size() > 500) return std::nullopt;
  std::cmatch match;
  if (!std::regex_search(line.data(), line.data() + line.size(), match, pattern)) return std::nullopt;
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < match.size(); ++i) parts.push_back(match[i].str());
  return parts;
}

std::size_t checked_count(const Lines& lines, std::size_t i, std::string_view name, double value) {
  if (!(value >= 2 && value == std::floor(value)))
    lines.fail(i, fmt::format("{} is {:g}; it must be an integer >= 2", name, value));
  if (value > max_samples)
    lines.fail(i, fmt::format("{} is {:g}; a record has at most {} samples", name, value, max_samples));
  return static_cast<std::size_t>(value);
}

double checked_positive(const Lines& lines, std::size_t i, std::string_view name, double value, std::string_view what) {
  if (!(value > 0) || std::isinf(value)) lines.fail(i, fmt::format("{} is {:g}; it must be {} > 0", name, value, what));
  return value;
}

namespace {

[[noreturn]] void fail_early(const Lines& lines, std::size_t i, std::size_t read, const Stated& stated) {
  lines.fail(i, fmt::format("the values end here, after {}, but {} states {}", read, stated.by, stated.count));
}

[[noreturn]] void fail_late(const Lines& lines, std::size_t i, const Stated& stated) {
  lines.fail(i, fmt::format("more values than the {} that {} states", stated.count, stated.by));
}

/// True if a line ends the numbers: it is blank or contains four consecutive letters. "NaN" and "***" count as numbers.
bool ends_numbers(std::string_view line) {
  if (trimmed(line).empty() || line.starts_with('/')) return true;
  int letters = 0;
  for (const char c : line) {
    letters = std::isalpha(static_cast<unsigned char>(c)) ? letters + 1 : 0;
    if (letters == 4) return true;
  }
  return false;
}

}  // namespace

std::vector<double> read_numbers(const Lines& lines, std::size_t begin, const Stated& stated) {
  std::vector<double> values;
  std::size_t last_line = begin - 1;
  bool has_ended = false;
  for (std::size_t i = begin; i < lines.size(); ++i) {
    has_ended = has_ended || ends_data(lines[i]);
    if (has_ended) {
      // An end mark may be followed by text, but not by more values.
      double value = 0;
      if (const auto words = split_at_blanks(lines[i]); !words.empty() && parse_number(words.front(), value))
        fail_late(lines, i, stated);
      continue;
    }
    for (const std::string_view word : split_at_blanks(lines[i])) {
      if (values.size() == stated.count) fail_late(lines, i, stated);
      values.push_back(lines.sample(i, word));
      last_line = i;
    }
  }
  if (values.size() < stated.count) fail_early(lines, last_line, values.size(), stated);
  return values;
}

std::optional<Columns> fortran_columns(std::string_view line) {
  static const std::regex format = pattern(R"(\(\s*([0-9]{1,3})\s*[FEIG]([0-9]{1,3})(\.[0-9]+)?E?\s*\))");
  const auto parts = captured(line, format);
  if (!parts) return std::nullopt;
  const Columns columns{std::stoul((*parts)[0]), std::stoul((*parts)[1])};
  if (columns.per_line == 0 || columns.width == 0) return std::nullopt;
  return columns;
}

std::string_view column_field(const Lines& lines, std::size_t begin, const Columns& columns, std::size_t i) {
  const std::string_view line = lines.at(begin + i / columns.per_line, "the end of its header");
  const std::size_t at = columns.begin_of(i % columns.per_line);
  return at < line.size() ? trimmed(line.substr(at, columns.width)) : std::string_view{};
}

std::vector<double> read_columns(const Lines& lines, std::size_t begin, const Columns& columns, const Stated& stated) {
  std::vector<double> values;
  const auto rest_is_blank = [&](std::size_t line, std::size_t fields) {
    const std::size_t at = columns.begin_of(fields);
    return at >= lines[line].size() || trimmed(lines[line].substr(at)).empty();
  };
  std::size_t i = begin;
  for (; values.size() < stated.count; ++i) {
    if (i >= lines.size() || ends_numbers(lines[i])) fail_early(lines, i - 1, values.size(), stated);
    const std::size_t fields = std::min(columns.per_line, stated.count - values.size());
    for (std::size_t k = 0; k < fields; ++k) {
      const std::string_view field = column_field(lines, i, columns, k);
      if (field.empty() && rest_is_blank(i, k)) fail_early(lines, i, values.size(), stated);
      values.push_back(lines.sample(i, field));
    }
    if (rest_is_blank(i, fields)) continue;
    if (fields < columns.per_line) fail_late(lines, i, stated);
    lines.fail(
        i, fmt::format("has more than {} numbers of {} characters, as {} states", fields, columns.width, stated.by));
  }
  if (i < lines.size() && !ends_numbers(lines[i])) fail_late(lines, i, stated);
  return values;
}

double column_number(const Lines& lines, std::size_t begin, const Columns& columns, std::size_t i) {
  return lines.number(begin + i / columns.per_line, column_field(lines, begin, columns, i));
}

void set_samples(Record& record, std::vector<double> values, double unit, double dt) {
  std::vector<double>& times = record.samples.times;
  for (double& value : values) {
    value *= unit;
    times.push_back(static_cast<double>(times.size()) * dt);
  }
  record.samples.accelerations = std::move(values);
}

std::optional<std::size_t> NamedLines::find(std::string_view name) const {
  for (std::size_t i = 0; i < count_; ++i)
    if (begins_with(trimmed(lines_[i]), name)) return i;
  return std::nullopt;
}

std::size_t NamedLines::at(std::string_view name) const {
  const auto found = find(name);
  if (!found) lines_.fail(count_ - 1, fmt::format("the header has no line \"{}\"", name));
  return *found;
}

std::string NamedLines::value(std::size_t line) const {
  const std::size_t end = width_ > 0 ? width_ : lines_[line].find(':');
  return end < lines_[line].size() ? single_spaced(lines_[line].substr(width_ > 0 ? end : end + 1)) : std::string();
}

std::string NamedLines::value_or_none(std::string_view name) const {
  const auto found = find(name);
  return found ? value(*found) : std::string();
}

std::string Channel::text() const {
  std::string result = component;
  if (!number.empty()) result = component.empty() ? number : number + ": " + component;
  return place.empty() ? result : result + ", " + place;
}

Channel chosen(const Lines& lines, std::vector<Channel> channels, const RecordOptions& options) {
  std::set<std::string> numbers;
  for (const Channel& channel : channels) numbers.insert(channel.number);
  if (channels.size() > 1 && (numbers.size() < channels.size() || numbers.count("")))
    for (std::size_t i = 0; i < channels.size(); ++i) channels[i].number = std::to_string(i + 1);

  std::vector<std::string> texts;
  for (const Channel& channel : channels) texts.push_back(channel.text());
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", lines.name(), what, fmt::join(texts, "; ")));
  };
  const std::string requested = upper(single_spaced(options.channel));
  if (requested.empty()) {
    if (channels.size() > 1)
      fail(fmt::format("{} channels; add \"channel:\" with the number or component of one", channels.size()));
    return channels.front();
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (upper(channels[i].number) == requested) return channels[i];
    if (upper(channels[i].component) == requested) found.push_back(i);
  }
  if (found.empty())
    fail(fmt::format("no channel with number or component \"{}\"; channels in the file", excerpt(options.channel)));
  if (found.size() > 1)
    fail(fmt::format("{} channels have the component \"{}\"; type the number of one", found.size(),
                     excerpt(options.channel)));
  return channels[found.front()];
}

void refuse_channel(const Lines& lines, const RecordOptions& options) {
  if (!options.channel.empty())
    throw InputError(fmt::format("{}: the file has one channel without a name; remove \"channel\"", lines.name()));
}

}  // namespace pounding::records
