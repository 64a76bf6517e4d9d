/// AFAD (TR-NSMN), the strong-motion network of Turkey: text files published until 2019. Later files of AFAD are in the
/// ESM format.
///
/// "STRONG GROUND MOTION RECORDS OF TURKIYE", lines "KEY : value", a line with the names of the components, and lines
/// with one value for each. The unit is in "RAW PGA VALUES (gal)".

#include <pounding/ground/records/format.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t header_lines = 40;

bool recognises(const Lines& lines) {
  return lines.size() > 0 && begins_with(trimmed(lines[0]), "STRONG GROUND MOTION RECORDS OF T");
}

bool holds_values(std::string_view line) {
  const auto words = split_at_blanks(line);
  double number = 0;
  return !words.empty() && parse_number(words.front(), number);
}

Record read(const Lines& lines, const RecordOptions& options) {
  static const std::regex bracket = pattern(R"(\(([^)]*)\)\s*:)");
  const NamedLines header(lines, header_lines);
  const std::size_t count_line = header.at("NUMBER OF DATA"), step_line = header.at("SAMPLING INTERVAL");
  std::size_t unit_line = count_line;
  while (unit_line + 1 < std::min(lines.size(), header_lines) && !contains(lines[unit_line], "PGA VALUES")) ++unit_line;
  std::size_t begin = std::max(count_line, step_line) + 1;
  while (begin < lines.size() && !holds_values(lines[begin])) ++begin;
  std::size_t names_line = std::min(begin, lines.size()) - 1;
  while (names_line > step_line && trimmed(lines[names_line]).empty()) --names_line;
  std::vector<Channel> channels;
  for (const std::string_view name : split_at_blanks(lines[names_line]))
    channels.push_back({std::to_string(channels.size() + 1), std::string(name), {}, channels.size()});
  lines.at(begin, "the values");
  const std::size_t columns = split_at_blanks(lines[begin]).size();
  if (channels.size() != columns)
    lines.fail(names_line,
               fmt::format("names {} components, but the lines below have {} values", channels.size(), columns));
  const Channel channel = chosen(lines, channels, options);

  Record record;
  record.format = "AFAD (TR-NSMN)";
  record.title = fmt::format("{}, M {}", header.value("EARTHQUAKE DATE"), header.value("EARTHQUAKE MAGNITUDE"));
  record.station = single_spaced(header.value("STATION ID") + " " + header.value("PLACE"));
  record.channel = channel.text();
  record.remark = "uncorrected";
  const auto unit_text = captured(lines[unit_line], bracket);
  const double unit =
      agreed_unit(lines, unit_line, unit_text ? unit_text->front() : std::string(), options, record.unit);
  static const std::regex in_bracket = pattern(R"(\(([^)]*)\))");
  const auto time_text = captured(lines[step_line].substr(0, lines[step_line].find(':')), in_bracket);
  const std::optional<double> seconds = unit_of_time(time_text ? time_text->front() : "s");
  if (!seconds) lines.fail(step_line, fmt::format("\"{}\" is not the unit of a time", time_text->front()));
  const double dt =
      checked_positive(lines, step_line, "SAMPLING INTERVAL", header.number("SAMPLING INTERVAL") * *seconds, "a time");
  const std::size_t count = checked_count(lines, count_line, "NUMBER OF DATA", header.number("NUMBER OF DATA"));
  const std::vector<double> all =
      read_numbers(lines, begin, {count * columns, fmt::format("NUMBER OF DATA, in {} columns,", columns)});
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(all[i * columns + channel.begin]);
  set_samples(record, std::move(values), unit, dt);
  return record;
}

}  // namespace

constinit const Format nsmn{"AFAD (TR-NSMN)", recognises, read};

}  // namespace pounding::records
