/// Numbers in columns, as text or CSV: a column of times and one or more of values; or, with a step given by the user,
/// only values, one or several per line in reading order, or a column of them. A column that numbers the rows is
/// skipped, as are lines that state the number of values and the step.

#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/ground/column_roles.hpp>
#include <pounding/ground/number_table.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t longest_line_of_names = 10'000;
constexpr std::string_view comma_advice = "for decimal commas, separate the columns by semicolons or blanks";
constexpr std::string_view step_advice = "values at a fixed step need \"step:\", such as step: 0.01 s";

/// Name of a column: "acc (m/s^2)" is "acc" in m/s^2, but "acc (NS)" is a name without a unit.
struct Name {
  std::string name, unit;
  std::string bracket;  ///< text in brackets
};

/// Splits off a bracket that contains a unit or a similar formula.
Name read_name(std::string text, const RecordOptions& options) {
  std::erase(text, '"');
  const std::size_t begin = text.find_first_of("(["), end = text.find_last_of(")]");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {text, {}, {}};
  const std::string inside(trimmed(std::string_view(text).substr(begin + 1, end - begin - 1)));
  const bool is_formula = inside.find_first_of("/^") != std::string::npos;
  if (!is_formula && !is_unit(inside) && !unit_of_values(inside, options)) return {text, {}, inside};
  return {std::string(trimmed(std::string_view(text).substr(0, begin))), inside, inside};
}

/// Header of a table; its last line may name the columns.
struct Header {
  std::vector<Name> columns;  ///< one per column; empty names if no line names them
  std::size_t line = 0;       ///< of the names
  bool is_comment = false;

  /// True if the names are certain: a column states a unit, or separators delimit the names.
  bool is_sure(const Lines& lines) const {
    const auto states = [](const Name& name) { return !name.unit.empty(); };
    const auto is_named = [](const Name& name) { return !name.name.empty(); };
    return std::any_of(columns.begin(), columns.end(), states) ||
           (std::all_of(columns.begin(), columns.end(), is_named) &&
            lines[line].find_first_of(";,\t") != std::string_view::npos);
  }
};

/// True if a comment with one name per column names them: it states no units, or a unit of time for a leading column of
/// times, or a unit of the values; "# depth 5 (km)" and "# acc (g), smoothed" do not.
bool names_columns(const std::vector<Name>& columns, const RecordOptions& options) {
  const auto states = [](const Name& name) { return !name.unit.empty(); };
  const auto fits = [&](const Name& name) { return unit_of_values(name.unit, options).has_value(); };
  if (std::none_of(columns.begin(), columns.end(), states)) return true;
  if (options.step == 0 && states(columns.front())) return unit_of_time(columns.front().unit).has_value();
  return std::any_of(columns.begin(), columns.end(), fits);
}

Header read_header(const Lines& lines, const NumberTable& table, const RecordOptions& options) {
  const std::size_t count = table.columns(0);
  Header header{.columns = std::vector<Name>(count)};
  for (std::size_t i = table.header_end(); i-- > 0;) {
    if (trimmed(lines[i]).empty()) continue;
    if (lines[i].size() > longest_line_of_names) break;
    const std::vector<std::string> names = column_names(lines[i]);
    if (names.size() != count) break;
    std::transform(names.begin(), names.end(), header.columns.begin(),
                   [&](const auto& name) { return read_name(std::string(name), options); });
    header.line = i;
    header.is_comment = trimmed(lines[i]).find_first_of("#%") == 0;
    if (header.is_comment && !names_columns(header.columns, options)) header.columns.assign(count, {});
    break;
  }
  return header;
}

/// Seconds per unit stated in the name of a column of times.
double time_unit(const Lines& lines, const Header& header, std::size_t column) {
  const std::string& stated = header.columns[column].bracket;
  if (stated.empty() || (header.is_comment && header.columns[column].unit.empty())) return 1;
  const std::optional<double> unit = unit_of_time(stated);
  if (!unit) lines.fail(header.line, fmt::format("\"{}\" is not the unit of a time; type s or ms", excerpt(stated)));
  return *unit;
}

/// Rejects rows of a different length than the first; the last may be shorter if values are in reading order.
void check_lengths(const Lines& lines, const NumberTable& table, bool last_may_be_shorter,
                   std::string_view advice = {}) {
  const std::size_t count = table.columns(0);
  for (std::size_t row = 1; row < table.rows(); ++row) {
    const std::size_t here = table.columns(row);
    if (here == count || (last_may_be_shorter && row + 1 == table.rows() && here < count)) continue;
    lines.fail(table.line(row), fmt::format("{} number{}; the previous line{} {} {}{}", here, here == 1 ? "" : "s",
                                            row == 1 ? "" : "s", row == 1 ? "has" : "have", count, advice));
  }
}

std::vector<double> read_times(const Lines& lines, const NumberTable& table, std::size_t column, double unit) {
  std::vector<double> times = table.column(column);
  for (std::size_t row = 0; row < times.size(); ++row) {
    const std::string_view line = lines[table.line(row)];
    const bool by_commas = table.columns(0) == 4 && line.find(',') != std::string_view::npos &&
                           line.find_first_of(".;") == std::string_view::npos;
    const std::string advice = by_commas                          ? fmt::format("; {}", comma_advice)
                               : table.columns(0) > 2 || row == 1 ? fmt::format("; {}", step_advice)
                                                                  : "";
    if (times[row] < 0)
      lines.fail(table.line(row),
                 fmt::format("time {} is negative, but a run starts at 0{}", times[row], row == 0 ? "" : advice));
    if (row > 0 && !(times[row] > times[row - 1]))
      lines.fail(table.line(row), fmt::format("time {} is not later than the previous one{}", times[row], advice));
  }
  for (double& time : times) time *= unit;
  return times;
}

/// Rejects the option `step` if a column increases like times.
void refuse_times(const Lines& lines, const NumberTable& table, double unit) {
  const std::vector<double> first = table.column(0);
  if (table.columns(0) < 2 || first.size() < 3) return;
  const double mean = (first.back() - first.front()) / static_cast<double>(first.size() - 1);
  for (std::size_t i = 1; i < first.size(); ++i)
    if (!(first[i] > first[i - 1]) || (table.columns(0) > 2 && std::abs(first[i] - first[i - 1] - mean) > 0.1 * mean))
      return;
  lines.fail(table.line(0),
             fmt::format("the first column contains times with a step of {:g} s; remove \"step\"", mean * unit));
}

/// Candidate columns of values: those that do not state a unit of another quantity.
std::vector<Channel> channels_of(const Header& header, const std::vector<std::size_t>& values,
                                 const RecordOptions& options) {
  std::vector<Channel> all, fitting;
  for (const std::size_t i : values) {
    const Name& column = header.columns[i];
    all.push_back({std::to_string(all.size() + 1), column.name, fmt::format("column {}", i + 1), i});
    if (column.unit.empty() || unit_of_values(column.unit, options)) fitting.push_back(all.back());
  }
  return fitting.empty() ? all : fitting;
}

/// Column of times: the one with a matching name, otherwise the first after a counter, otherwise the first.
std::size_t time_column(const Lines& lines, const NumberTable& table, const Header& header) {
  const auto is_time = [&](const Name& name) {
    const bool by_name = name.unit.empty() && names_times(name.name);
    return unit_of_time(name.unit) || (by_name && (&name == &header.columns.front() || header.is_sure(lines)));
  };
  const auto named = std::find_if(header.columns.begin(), header.columns.end(), is_time);
  if (named != header.columns.end()) return static_cast<std::size_t>(named - header.columns.begin());
  if (!counts_rows(table, 0)) return 0;
  if (table.columns(0) > 2 && ascends(table, 1)) return 1;
  if (names_counter(header.columns.front().name))
    lines.fail(table.line(0),
               fmt::format("the first column, \"{}\", numbers the rows, and a column of times is missing; {}",
                           excerpt(header.columns.front().name), step_advice));
  return 0;
}

/// All columns except that of the times and, if others remain, counters.
std::vector<std::size_t> value_columns(const NumberTable& table, const Header& header,
                                       std::optional<std::size_t> times) {
  std::vector<std::size_t> all, values;
  for (std::size_t i = 0; i < table.columns(0); ++i) {
    if (i == times) continue;
    all.push_back(i);
    if (!header.columns[i].unit.empty() || !counts_rows(table, i)) values.push_back(i);
  }
  return values.empty() ? all : values;
}

/// Removes the lines that state the number of values and the step. Returns their statement, for the remark.
std::string drop_count_rows(const Lines& lines, NumberTable& table, const RecordOptions& options) {
  const CountRows found = find_count_rows(table, options.step);
  if (found.rows == 0) return {};
  const bool one = found.rows == 1;
  const std::string place = one ? fmt::format("line {}", table.line(0) + 1)
                                : fmt::format("lines {} and {}", table.line(0) + 1, table.line(1) + 1);
  const std::string stated = fmt::format("{} state{} {} values{}", place, one ? "s" : "", found.count,
                                         found.step > 0 ? fmt::format(" and a step of {:g} s", found.step) : "");
  NumberTable rest = table;
  rest.drop(found.rows);
  // Times below these lines, as in "400 0.01" above "0 0.1", need no step.
  const bool has_times = rest.columns(0) > 1 && std::abs(even_spacing(rest, 0) - found.step) <= 1e-3 * found.step;
  if (found.step > 0 && options.step == 0 && !has_times)
    lines.fail(table.line(0), fmt::format("{}; type step: {:g} s", stated, found.step));
  if (found.step > 0 && options.step > 0 && std::abs(found.step - options.step) > 1e-6 * options.step)
    lines.fail(table.line(0),
               fmt::format("{}, but \"step\" is {:g} s; type step: {:g} s, or delete lines that are not samples",
                           stated, options.step, found.step));
  table = std::move(rest);
  return stated;
}

double unit_of_column(const Lines& lines, const Header& header, const NumberTable& table, std::size_t column,
                      const RecordOptions& options, std::string& unit) {
  const std::string& stated = header.columns[column].unit;
  if (!stated.empty()) return agreed_unit(lines, header.line, stated, options, unit);
  return agreed_unit(lines, stated_units(lines, table.header_end(), options), options, unit);
}

void require_samples(const Lines& lines, std::size_t count, std::string_view what) {
  if (count > max_samples)
    throw InputError(fmt::format("{}: {} samples; a record has at most {}", lines.name(), count, max_samples));
  if (count >= 2) return;
  throw InputError(
      fmt::format("{}: {} sample{}; a record needs at least two {}", lines.name(), count, count == 1 ? "" : "s", what));
}

/// Rejects lines of integers above values with decimals, a typical numeric header.
void refuse_integer_header(const Lines& lines, const NumberTable& table) {
  const std::size_t header = integer_header(table);
  if (header == 0) return;
  const std::size_t first = table.line(0) + 1, last = table.line(header - 1) + 1;
  lines.fail(table.line(0), fmt::format("{} only integers, like a header with the number of values, but all values "
                                        "below have decimals; delete {}, or put # in front of {}",
                                        first == last ? fmt::format("line {} contains", first)
                                                      : fmt::format("lines {} to {} contain", first, last),
                                        first == last ? "it" : "them", first == last ? "it" : "each"));
}

/// Warns of exceptional values at the start, which may be numbers of a header.
void warn_of_header(const NumberTable& table, const RecordOptions& options, const std::vector<double>& values,
                    Record& record) {
  constexpr std::size_t fewest = 100, head = 10;
  if (values.size() < fewest || options.force) return;
  const auto less = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto peak = std::max_element(values.begin(), values.end(), less);
  const std::size_t place = static_cast<std::size_t>(peak - values.begin());
  if (place < head)
    record.warnings.push_back(
        fmt::format("the maximum value, {:g}, is number {} of {}; if a line above the values states their number or "
                    "the step, delete it",
                    *peak, place + 1, values.size()));
  else if (table.columns(0) == 1 && values.front() == options.step)
    record.warnings.push_back(
        fmt::format("the first value, {:g}, equals the step; if line {} states the step, delete it", values.front(),
                    table.line(0) + 1));
}

/// Columns of values at a step, without counters; times must agree with the step.
std::vector<std::size_t> columns_at_step(const Lines& lines, const NumberTable& table, const Header& header,
                                         const RecordOptions& options) {
  // Integers without a unit may be milliseconds or sample numbers: the step of the user applies.
  const bool counts = counts_rows(table, 0) || (header.columns.front().unit.empty() && integer_spacing(table, 0) > 0);
  if (table.columns(0) == 1 || !counts) {
    refuse_times(lines, table, unit_of_time(header.columns.front().unit).value_or(1));
    return value_columns(table, header, std::nullopt);
  }
  check_lengths(lines, table, false);
  if (const double unit = unit_of_time(header.columns.front().unit).value_or(1); unit != 1)
    refuse_times(lines, table, unit);
  const double spacing =
      table.columns(0) > 2 ? even_spacing(table, 1) * unit_of_time(header.columns[1].unit).value_or(1) : 0;
  if (spacing > 0 && std::abs(spacing - options.step) > 1e-3 * options.step)
    lines.fail(table.line(0),
               fmt::format("the second column contains times with a step of {:g} s; remove \"step\"", spacing));
  std::vector<std::size_t> values =
      value_columns(table, header, spacing > 0 ? std::optional<std::size_t>(1) : std::nullopt);
  std::erase(values, std::size_t{0});
  return values;
}

Record read_at_step(const Lines& lines, const NumberTable& table, const Header& header, const RecordOptions& options) {
  const std::size_t count = table.columns(0);
  const std::vector<std::size_t> values = columns_at_step(lines, table, header, options);
  if (table.commas_are_ambiguous() && !header.is_sure(lines))
    lines.fail(table.line(0), fmt::format("\"{}\" may be one value with a decimal comma or two values; use decimal "
                                          "points, or separate the values by semicolons",
                                          excerpt(trimmed(lines[table.line(0)]))));
  refuse_integer_header(lines, table);
  Record record;
  std::size_t column = 0;
  std::vector<double> samples;
  if (count == 1 || (values.size() == count && options.channel.empty() && !header.is_sure(lines))) {
    refuse_channel(lines, options);
    check_lengths(lines, table, true);
    record.format = count == 1 ? "one column" : fmt::format("{} values per line", count);
    samples = table.values();
  } else {
    check_lengths(lines, table, false);
    const Channel channel = chosen(lines, channels_of(header, values, options), options);
    column = channel.begin;
    record.format = fmt::format("{} columns", count);
    record.channel = channel.text();
    samples = table.column(column);
  }
  require_samples(lines, samples.size(), "values");
  warn_of_header(table, options, samples, record);
  const double unit = unit_of_column(lines, header, table, column, options, record.unit);
  set_samples(record, std::move(samples), unit, options.step);
  return record;
}

Record read_with_times(const Lines& lines, const NumberTable& table, const Header& header,
                       const RecordOptions& options) {
  const std::size_t count = table.columns(0);
  if (count == 1)
    lines.fail(table.line(0), fmt::format("only one column; time and acceleration need two, and {}", step_advice));

  Record record;
  check_lengths(lines, table, false, count > 2 ? fmt::format("; {}", step_advice) : "");
  const std::size_t times = time_column(lines, table, header);
  const std::vector<std::size_t> values = value_columns(table, header, times);
  const double seconds = time_unit(lines, header, times);
  record.samples.times = read_times(lines, table, times, seconds);
  if (seconds == 1 && counts_rows(table, times))
    record.warnings.push_back(fmt::format(
        "the times {:g}, {:g}, {:g}, ... were read in s; if they are sample numbers, type the step, as in step: 0.01 s",
        table.at(0, times), table.at(1, times), table.at(2, times)));
  std::size_t column = values.front();
  if (count == 2) {
    refuse_channel(lines, options);
    record.format = "two columns";
  } else {
    const Channel channel = chosen(lines, channels_of(header, values, options), options);
    column = channel.begin;
    record.format = fmt::format("{} columns", count);
    record.channel = channel.text();
  }
  require_samples(lines, table.rows(), "lines of time and acceleration");
  record.samples.accelerations = table.column(column);
  const double unit = unit_of_column(lines, header, table, column, options, record.unit);
  for (double& a : record.samples.accelerations) a *= unit;
  return record;
}

Record read(const Lines& lines, const RecordOptions& options) {
  NumberTable table(lines);
  if (table.rows() == 0) require_samples(lines, 0, "lines of time and acceleration");
  const std::string remark = drop_count_rows(lines, table, options);
  const Header header = read_header(lines, table, options);
  Record record =
      options.step > 0 ? read_at_step(lines, table, header, options) : read_with_times(lines, table, header, options);
  record.remark = remark;
  return record;
}

}  // namespace

constinit const Format columns{"columns of numbers", holds_numbers, read};

}  // namespace pounding::records
