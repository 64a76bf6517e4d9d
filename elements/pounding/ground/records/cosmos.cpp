/// COSMOS V1 and V2 (COSMOS Strong Motion Data Format, version 1.20, 2001).
///
/// One or more series, each with a text header (13 lines unless its first line states another number), integers, reals,
/// comments and samples. Each of these parts starts with a line that states the number of values and their columns.
/// Fields read: real 62, the spacing [ms]; real 63, the length [s], which must agree; from the line above the samples
/// their number, quantity and unit. Series of velocity and displacement, which some networks include, are skipped.

#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

bool recognises(const Lines& lines) { return lines.size() > 0 && contains(lines[0], "(FORMAT V"); }

/// A part of a series: its number of values or lines, and their location.
struct Part {
  std::size_t count = 0;
  std::size_t line = 0;  ///< line that states it
  Columns columns{1, 1};

  std::size_t next() const { return line + 1 + columns.lines_for(count); }
};

struct Series {
  std::size_t begin = 0;
  std::string quantity;  ///< "acceleration"
  std::string unit;      ///< as stated
  Part reals, samples;
};

/// Line that states a part: "100 Real-header values follow on  17 lines, Format= (6F13.6)".
Part read_part(const Lines& lines, std::size_t i, std::string_view name, bool in_columns) {
  static const std::regex number = pattern(R"(^\s*([0-9]{1,9})\s)");
  const std::string_view line = lines.at(i, fmt::format("the line that states {}", name));
  const auto count = captured(line, number);
  if (!count || !contains(line, upper(name)))
    lines.fail(i, fmt::format("is not the line that states the number of {}", name));
  Part part{.count = std::stoul(count->front()), .line = i};
  if (!in_columns) return part;
  const auto columns = fortran_columns(line);
  if (!columns) lines.fail(i, "does not state columns such as \"Format= (8F10.5)\"");
  part.columns = *columns;
  return part;
}

Series read_series(const Lines& lines, std::size_t begin) {
  static const std::regex text_lines = pattern(R"(with\s+([0-9]{1,4})\s+text lines)");
  // The unit may be followed by its code: "units=cm/sec2(04)", "units=g.     (02)", "units=counts (50)",
  // "units=cm/s^2".
  static const std::regex stated = pattern(R"(^\s*[0-9]+\s+([a-z]+).*units\s*=\s*([^(,]*))");
  if (!contains(lines[begin], "(FORMAT V")) lines.fail(begin, "a series must start with \"(Format v01.20 ...\"");
  Series series{.begin = begin, .quantity = {}, .unit = {}, .reals = {}, .samples = {}};
  const auto text = captured(lines[begin], text_lines);
  const Part integers =
      read_part(lines, begin + (text ? std::stoul(text->front()) : 13), "integer-header values", true);
  series.reals = read_part(lines, integers.next(), "real-header values", true);
  const Part comments = read_part(lines, series.reals.next(), "comment line", false);
  series.samples = read_part(lines, comments.next(), "pts", true);
  const std::size_t i = series.samples.line;
  const auto parts = captured(lines[i], stated);
  if (!parts) lines.fail(i, "does not state quantity and unit such as \"acceleration pts, ... units=cm/sec2\"");
  series.quantity = (*parts)[0];
  series.unit = trimmed((*parts)[1]);
  if (series.unit.ends_with('.')) series.unit.pop_back();
  return series;
}

std::vector<Series> find_series(const Lines& lines) {
  std::vector<Series> all;
  for (std::size_t i = 0; i < lines.size();) {
    // In the standard, a series ends with "End-of-data for ..."; in its sample file, with "/&  ---  End of data for
    // channel  1 ---".
    if (trimmed(lines[i]).empty() || begins_with(trimmed(lines[i]), "END-OF-DATA") || lines[i].starts_with("/&")) {
      ++i;
      continue;
    }
    all.push_back(read_series(lines, i));
    i = all.back().samples.next();
  }
  if (all.empty()) lines.fail(0, "contains no samples, only \"END-OF-DATA\"");
  return all;
}

/// "Sta Chan  1: 340 deg (Rcrdr Chan  1) Location: roof"; an unknown number is "?".
Channel read_channel(const Lines& lines, std::size_t begin) {
  static const std::regex words = pattern(R"(^\s*sta cha\w*:?\s*([^:\s]*)\s*:([^(]*?)(\(.*|location.*)?$)");
  static const std::regex location = pattern(R"(location\s*:(.*)$)");
  const std::size_t i = begin + 8;
  const std::string_view line = lines.at(i, "the line of the channel");
  const auto parts = captured(line, words);
  if (!parts) lines.fail(i, "is not a line such as \"Sta Chan  1: 90 deg\"");
  const auto place = captured(line, location);
  return {.number = (*parts)[0] == "?" ? std::string() : (*parts)[0],
          .component = single_spaced((*parts)[1]),
          .place = place ? single_spaced(place->front()) : std::string(),
          .begin = begin};
}

/// Spacing [s]: real 62 [ms], checked against real 63.
double read_step(const Lines& lines, const Series& series) {
  const auto real = [&](std::size_t number) {
    const Part& reals = series.reals;
    if (number > reals.count)
      lines.fail(reals.line, fmt::format("states {} values, but number {} is needed", reals.count, number));
    return column_number(lines, reals.line + 1, reals.columns, number - 1);
  };
  const std::size_t i = series.reals.line + 1 + 61 / series.reals.columns.per_line;
  const double dt = checked_positive(lines, i, "real 62, the spacing in ms,", real(62), "a time") / 1000;
  // The length refers to the samples, or to the intervals between them, and is rounded.
  const double length = real(63), points = static_cast<double>(series.samples.count);
  if (length > 0 && std::abs(points * dt - length) > std::max(2 * dt, 0.001 * length))
    lines.fail(
        i,
        fmt::format("real 62 states a spacing of {:g} ms and real 63 a length of {:g} s, which disagree with {} points",
                    1000 * dt, length, series.samples.count));
  return dt;
}

Record read(const Lines& lines, const RecordOptions& options) {
  const std::vector<Series> all = find_series(lines);
  std::vector<Channel> channels;
  for (const Series& series : all)
    if (begins_with(series.quantity, "ACC")) channels.push_back(read_channel(lines, series.begin));
  if (channels.empty())
    lines.fail(all.front().samples.line,
               fmt::format("contains {}; use the file of accelerations", excerpt(all.front().quantity)));
  const Channel channel = chosen(lines, channels, options);
  std::size_t k = 0;
  while (all[k].begin != channel.begin) ++k;
  const Series& series = all[k];

  static const std::regex code = pattern(R"(code:\s*(.*)$)");
  Record record;
  record.title = single_spaced(lines[series.begin + 1]);
  const std::string_view station = lines[series.begin + 4];
  const auto after_code = captured(station, code);
  record.station = single_spaced(after_code ? std::string_view(after_code->front()) : station);
  record.channel = channel.text();
  const bool uncorrected = begins_with(trimmed(lines[series.begin]), "UNCORRECTED");
  record.format = uncorrected ? "COSMOS V1" : "COSMOS V2";
  if (uncorrected) record.remark = "uncorrected";

  const double unit = agreed_unit(lines, series.samples.line, series.unit, options, record.unit);
  const std::size_t count =
      checked_count(lines, series.samples.line, "the number of points", static_cast<double>(series.samples.count));
  const Stated stated{count, fmt::format("line {}", series.samples.line + 1)};
  set_samples(record, read_columns(lines, series.samples.line + 1, series.samples.columns, stated), unit,
              read_step(lines, series));
  return record;
}

}  // namespace

constinit const Format cosmos{"COSMOS V1 and V2", recognises, read};

}  // namespace pounding::records
