/// Two columns, time and acceleration, as text or CSV.

#include <pounding/ground/records/format.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>

namespace pounding::records {
namespace {

/// Blank, or a comment.
bool says_nothing(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#' || text.front() == '%';
}

/// Columns of a line: at semicolons, else at commas, else at blanks.
std::vector<std::string_view> split_columns(std::string_view text) {
  const char mark = text.find(';') != std::string_view::npos ? ';' : ',';
  if (text.find(mark) == std::string_view::npos) return split_at_blanks(text);
  std::vector<std::string_view> columns;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    columns.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return columns;
}

/// Text inside the first "(" or "[" of a name: the unit in "acc (m/s^2)".
std::string bracketed(std::string_view text) {
  const std::size_t begin = text.find_first_of("([");
  const std::size_t end = text.find_last_of(")]");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return {};
  return std::string(trimmed(text.substr(begin + 1, end - begin - 1)));
}

/// A line of names states units in brackets: "time (s), acc (g)".
void read_names(const Lines& lines, std::size_t i, double& time_unit, std::string& stated) {
  const std::string_view line = lines[i];
  const bool marked = line.find_first_of(",;") != std::string_view::npos;
  const auto columns = split_columns(line);
  if (marked && columns.size() != 2)
    lines.fail(i, fmt::format("{} columns; two are read, time and acceleration", columns.size()));
  // Without a mark between the columns, the last bracket belongs to the acceleration.
  const std::size_t last_bracket = std::min(line.find_last_of("(["), line.size());
  const std::string_view first = marked ? columns[0] : line.substr(0, last_bracket);
  stated = bracketed(marked ? columns[1] : line.substr(last_bracket));
  const std::string time = bracketed(first);
  if (time.empty() || time == "sec") return;
  const Unit unit = [&] {
    try {
      return parse_unit(time);
    } catch (const InputError& error) {
      lines.fail(i, error.what());
    }
  }();
  if (unit.dimension != dimension::time) lines.fail(i, fmt::format("\"{}\" is not the unit of a time", time));
  time_unit = unit.factor;
}

Record read(const Lines& lines, const RecordOptions& options) {
  refuse_channel(lines, options);
  Record record;
  record.format = "two columns";
  auto& [times, accelerations, uniform] = record.samples;
  std::string stated;
  std::size_t names_line = 0;
  double time_unit = 1;
  bool begun = false, ended = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (says_nothing(lines[i])) continue;
    if (ended) lines.fail(i, "follows the line that ends the data; remove one of the two");
    ended = begun && says_end(lines[i]);
    if (ended) continue;
    const std::string_view line = lines[i];
    const auto columns = split_columns(line);
    if (double value = 0; !begun && !parse_number(columns.front(), value)) {
      begun = true;
      names_line = i;
      read_names(lines, i, time_unit, stated);
      continue;
    }
    begun = true;
    if (columns.size() != 2)
      lines.fail(i, fmt::format("{} column{}; two are read, time and acceleration", columns.size(),
                                columns.size() == 1 ? "" : "s"));
    const double time = time_unit * lines.number(i, columns[0]);
    if (time < 0) lines.fail(i, fmt::format("time {} is before 0, where every run begins", columns[0]));
    if (!times.empty() && time <= times.back())
      lines.fail(i, fmt::format("time {} does not come after the one before it", columns[0]));
    times.push_back(time);
    accelerations.push_back(lines.number(i, columns[1]));
  }
  if (times.size() < 2)
    throw InputError(fmt::format("{}: {} sample{}; a record has two or more lines of time and acceleration", lines.name(),
                                 times.size(), times.size() == 1 ? "" : "s"));
  const double unit = agreed_unit(lines, names_line, stated, options, record.unit);
  for (double& a : accelerations) a *= unit;
  return record;
}

/// One of the first two lines that say something begins with a number. An empty file is told that it has no samples.
bool recognises(const Lines& lines) {
  int read = 0;
  for (std::size_t i = 0; i < lines.size() && read < 2; ++i) {
    if (says_nothing(lines[i])) continue;
    if (double value = 0; parse_number(split_columns(trimmed(lines[i])).front(), value)) return true;
    ++read;
  }
  return read == 0;
}

}  // namespace

constinit const Format two_columns{"two columns", recognises, read};

}  // namespace pounding::records
