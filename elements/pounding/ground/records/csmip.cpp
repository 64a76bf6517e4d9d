/// CSMIP (CDMG) V1 and V2 (Shakal & Huang 1985, Standard tape format for CSMIP strong-motion data tapes, OSMS 85-03).
///
/// One or more channels, each terminated by a line that starts with "/&". V1: 13 lines of text, 7 of integers, 7 of
/// reals; then a line that states points, rate or spacing, unit and columns, or, in older files, pairs of time and
/// acceleration (10F7.3). V2: 25 lines of text, 7 of integers, 13 of reals; then acceleration, velocity and
/// displacement, each after a line that states points, spacing and unit. Only accelerations are read.

#include <pounding/ground/records/format.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/ground/records/volumes.hpp>

namespace pounding::records {
namespace {

constexpr std::string_view v1_title = "UNCORRECTED ACCELEROGRAM DATA";
constexpr std::string_view v2_title = "CORRECTED ACCELEROGRAM";
constexpr std::string_view v3_title = "RESPONSE AND FOURIER";
constexpr std::size_t v1_pairs_line = 27;

bool is_v1(const Lines& lines, std::size_t begin) { return begins_with(trimmed(lines[begin]), v1_title); }

bool recognises(const Lines& lines) {
  if (lines.size() < 2) return false;
  if (is_v1(lines, 0)) return true;
  // Other networks use the first line of a V2 file with a different second line.
  const std::string_view first = trimmed(lines[0]);
  return (begins_with(first, v2_title) && begins_with(trimmed(lines[1]), v1_title)) ||
         (begins_with(first, v3_title) && begins_with(trimmed(lines[1]), v2_title));
}

/// A line of the text header; a V2 header is that of V1 after one additional line.
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
  if (!parts) lines.fail(i, "is not a line such as \"Chan  1: 90 Deg\"");
  const auto place = captured(line, location);
  return {.number = single_spaced((*parts)[0]),
          .component = single_spaced((*parts)[1]),
          .place = place ? single_spaced(place->front()) : std::string(),
          .begin = begin};
}

std::vector<Channel> find_channels(const Lines& lines) {
  std::vector<Channel> channels;
  bool between = true;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with("/&")) {
      between = true;
    } else if (between && !trimmed(lines[i]).empty()) {
      if (!begins_with(trimmed(lines[i]), v1_title) && !begins_with(trimmed(lines[i]), v2_title))
        lines.fail(i, "a channel must start with \"Corrected accelerogram\" or \"Uncorrected accelerogram data\"");
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

void read_v1(const Lines& lines, std::size_t begin, const RecordOptions& options, Record& record) {
  static const std::regex stated =
      pattern(R"(^\s*([0-9]+)\s+accelerogram points at\s*([0-9.]+)\s*pts/sec\s*in units of\s*(.*)$)");
  const std::size_t end = begin + v1_pairs_line;
  for (std::size_t i = begin; i < std::min(end + 1, lines.size()); ++i)
    if (const auto parts = captured(lines[i], stated)) {
      const double rate = checked_positive(lines, i, "the sampling rate", lines.number(i, (*parts)[1]), "a number");
      return volumes::read_even(lines, i, (*parts)[0], (*parts)[2], 1 / rate, {8, 9}, options, record);
    }
  if (volumes::read_stated(lines, begin, end + 1, {8, 9}, options, record)) return;
  volumes::read_pairs(lines, begin + 10, begin + 11, end, options, record);
}

void read_v2(const Lines& lines, std::size_t begin, const RecordOptions& options, Record& record) {
  if (!volumes::read_stated(lines, begin, end_of(lines, begin), {8, 10}, options, record))
    lines.fail(begin,
               "the channel that starts here has no line \"points of accel data equally spaced at ... sec, in ...\"");
}

Record read(const Lines& lines, const RecordOptions& options) {
  if (begins_with(trimmed(lines[0]), v3_title))
    lines.fail(0, "contains spectra (V3); use the file of accelerations, V1 or V2");
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
  record.station =
      single_spaced(fmt::format("{} {}", code ? code->front() : "", lines[text_line(lines, begin, 6)].substr(0, 40)));
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
