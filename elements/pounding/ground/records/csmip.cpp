/// CSMIP (CDMG) V1 and V2 (Shakal & Huang 1985, Standard tape format for CSMIP strong-motion data tapes, OSMS 85-03).
///
/// One or more channels, each ended by a line that begins with "/&". V1: 13 lines of text, 7 of integers, 7 of reals; then
/// either a line that states points, rate, unit and columns, or, in older files, pairs of time and acceleration (10F7.3).
/// V2: 25 lines of text, 7 of integers, 13 of reals; then acceleration, velocity and displacement, each after a line that
/// states points, spacing and unit. Only accelerations are read.

#include <pounding/ground/records/format.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace pounding::records {
namespace {

constexpr std::string_view v1_title = "UNCORRECTED ACCELEROGRAM DATA";
constexpr std::string_view v2_title = "CORRECTED ACCELEROGRAM";
constexpr std::string_view v3_title = "RESPONSE AND FOURIER";
constexpr std::size_t v1_pairs_line = 27;
constexpr Columns pairs_columns{10, 7};

bool is_v1(const Lines& lines, std::size_t begin) { return begins_with(trimmed(lines[begin]), v1_title); }

bool recognises(const Lines& lines) {
  if (lines.size() < 2) return false;
  if (is_v1(lines, 0)) return true;
  // Other networks use the first line of a V2 file with another second line.
  const std::string_view first = trimmed(lines[0]);
  return (begins_with(first, v2_title) && begins_with(trimmed(lines[1]), v1_title)) ||
         (begins_with(first, v3_title) && begins_with(trimmed(lines[1]), v2_title));
}

/// A line of the text header; a V2 header is that of V1 after one line of its own.
std::size_t text_line(const Lines& lines, std::size_t begin, std::size_t number) {
  return begin + number - (is_v1(lines, begin) ? 1 : 0);
}

/// "Chan  1: 360 Deg     Sta Chn:  3    Location: Roof"
Channel read_channel(const Lines& lines, std::size_t begin) {
  static const std::regex words = pattern(R"(^\s*chan\s*([^:]*):(.*?)(\(.*|sta chn.*|location.*)?$)");
  static const std::regex location = pattern(R"(location\s*:(.*)$)");
  const std::size_t i = text_line(lines, begin, 7);
  const std::string_view line = lines.at(i, "the line of the channel");
  const auto parts = captured(line, words);
  if (!parts) lines.fail(i, "is no line \"Chan  1: 90 Deg\"");
  const auto place = captured(line, location);
  return {.number = single_spaced((*parts)[0]), .component = single_spaced((*parts)[1]),
          .place = place ? single_spaced(place->front()) : std::string(), .begin = begin};
}

std::vector<Channel> find_channels(const Lines& lines) {
  std::vector<Channel> channels;
  bool between = true;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with("/&")) {
      between = true;
    } else if (between && !trimmed(lines[i]).empty()) {
      if (!begins_with(trimmed(lines[i]), v1_title) && !begins_with(trimmed(lines[i]), v2_title))
        lines.fail(i, "a channel begins here, but not with \"Corrected accelerogram\" or \"Uncorrected accelerogram data\"");
      channels.push_back(read_channel(lines, i));
      between = false;
    }
  }
  return channels;
}

std::size_t end_of(const Lines& lines, std::size_t begin) {
  while (begin < lines.size() && !lines[begin].starts_with("/&")) ++begin;
  return begin;
}

/// The unit without what follows it: "cm/sec2. (8f10.6)", "CM/SEC/SEC)", "g .      Format: (8f9.6)".
std::string unit_alone(std::string_view text) {
  return std::string(trimmed(text.substr(0, text.find_first_of(".();,"))));
}

/// Evenly spaced samples after the line that states them.
void read_even(const Lines& lines, std::size_t i, const std::vector<std::string>& parts, double dt, const Columns& usual,
               const RecordOptions& options, Record& record) {
  const double unit = agreed_unit(lines, i, unit_alone(parts[2]), options, record.unit);
  const std::size_t count = checked_count(lines, i, "the number of points", lines.number(i, parts[0]));
  record.samples.accelerations =
      read_columns(lines, i + 1, fortran_columns(lines[i]).value_or(usual), {count, fmt::format("line {}", i + 1)});
  for (double& a : record.samples.accelerations) a *= unit;
  record.samples.times = even_times(count, dt);
}

/// Pairs of time [s] and acceleration, uneven because film was digitised by hand.
void read_pairs(const Lines& lines, std::size_t begin, const RecordOptions& options, Record& record) {
  static const std::regex points = pattern(R"(no\. of points\s*=\s*([0-9]+))");
  static const std::regex units = pattern(R"(units of uncor \w+ are sec and\s*([^ ]+))");
  const std::size_t count_line = begin + 10, unit_line = begin + 11;
  const auto count_text = captured(lines.at(count_line, "its header ends"), points);
  const auto unit_text = captured(lines.at(unit_line, "its header ends"), units);
  if (!count_text) lines.fail(count_line, "has no \"No. of points =\"");
  if (!unit_text) lines.fail(unit_line, "has no \"Units of uncor data are sec and\"");
  const double unit = agreed_unit(lines, unit_line, unit_alone((*unit_text)[0]), options, record.unit);
  const std::size_t count =
      checked_count(lines, count_line, "the number of points", lines.number(count_line, (*count_text)[0]));
  const std::size_t first = begin + v1_pairs_line;
  const std::vector<double> values =
      read_columns(lines, first, pairs_columns, {2 * count, fmt::format("line {}, two for a point,", count_line + 1)});
  auto& [times, accelerations, uniform] = record.samples;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + 2 * k / pairs_columns.per_line;
    if (values[2 * k] < 0) lines.fail(i, fmt::format("time {:g} is before 0, where every run begins", values[2 * k]));
    if (k > 0 && values[2 * k] <= times.back())
      lines.fail(i, fmt::format("time {:g} does not come after the one before it", values[2 * k]));
    times.push_back(values[2 * k]);
    accelerations.push_back(unit * values[2 * k + 1]);
  }
}

void read_v1(const Lines& lines, std::size_t begin, const RecordOptions& options, Record& record) {
  static const std::regex stated =
      pattern(R"(^\s*([0-9]+)\s+accelerogram points at\s*([0-9.]+)\s*pts/sec\s*in units of\s*(.*)$)");
  for (std::size_t i = begin; i < std::min(begin + v1_pairs_line + 1, lines.size()); ++i)
    if (const auto parts = captured(lines[i], stated)) {
      const double rate = checked_positive(lines, i, "the sampling rate", lines.number(i, (*parts)[1]), "a number");
      return read_even(lines, i, *parts, 1 / rate, {8, 9}, options, record);
    }
  read_pairs(lines, begin, options, record);
}

void read_v2(const Lines& lines, std::size_t begin, const RecordOptions& options, Record& record) {
  static const std::regex stated = pattern(
      R"(^\s*([0-9]+)\s+points of accel\w* data equally spaced at\s*([0-9.]+)\s*sec\s*[.,]*\s*(?:in\s|\(\s*units:)\s*(.*)$)");
  for (std::size_t i = begin; i < end_of(lines, begin); ++i)
    if (const auto parts = captured(lines[i], stated)) {
      const double dt = checked_positive(lines, i, "the spacing", lines.number(i, (*parts)[1]), "a time");
      return read_even(lines, i, *parts, dt, {8, 10}, options, record);
    }
  lines.fail(begin, "the channel that begins here has no line \"points of accel data equally spaced at ... sec, in ...\"");
}

Record read(const Lines& lines, const RecordOptions& options) {
  if (begins_with(trimmed(lines[0]), v3_title))
    lines.fail(0, "holds spectra (V3); take the file of accelerations, V1 or V2");
  const Channel channel = chosen(lines, find_channels(lines), options);
  const std::size_t begin = channel.begin;
  const bool v1 = is_v1(lines, begin);
  Record record;
  record.format = v1 ? "CSMIP V1" : "CSMIP V2";
  record.channel = channel.text();
  record.title = single_spaced(lines.at(text_line(lines, begin, 8), "the line of the earthquake"));
  static const std::regex number = pattern(R"(station no\.?\s*([0-9A-Z]+))");
  const auto code = captured(lines[text_line(lines, begin, 5)], number);
  // Columns 1 to 40; the owner of the station follows.
  record.station = single_spaced(
      fmt::format("{} {}", code ? code->front() : "", lines[text_line(lines, begin, 6)].substr(0, 40)));
  if (v1) {
    record.remark = "uncorrected";
    read_v1(lines, begin, options, record);
  } else {
    read_v2(lines, begin, options, record);
  }
  return record;
}

}  // namespace

constinit const Format csmip{"CSMIP V1 and V2", recognises, read};

}  // namespace pounding::records
