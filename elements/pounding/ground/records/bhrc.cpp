/// BHRC: strong-motion network of Iran's Road, Housing and Urban Development Research Center. Based on published files,
/// in the absence of a published description.
///
/// Three components, each terminated by "/&", with 13 lines of text, the first "* VOL1DS FILE:  5522/01", then 7 of
/// integers, 7 of reals and the accelerations (10E13.6). Fields read: text line 5, the component; line 11, points and
/// duration; line 12, the unit; real 7, the first on the second line of reals, the sampling rate [Hz], which must agree
/// with the duration.

#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/ground/records/volumes.hpp>

namespace pounding::records {
namespace {

constexpr std::string_view title = "* VOL";
constexpr Columns numbers{10, 13};

bool recognises(const Lines& lines) {
  return lines.size() > 6 && begins_with(trimmed(lines[0]), title) && begins_with(trimmed(lines[6]), "COMP");
}

/// Component "L", "T" or "V"; its place is the azimuth of "Azimuth L 324   T 54".
Channel read_channel(const Lines& lines, std::size_t begin) {
  static const std::regex azimuths = pattern(R"(azimuth\s+L\s*([0-9]+)\s+T\s*([0-9]+))");
  const std::string component = single_spaced(lines.at(begin + 4, "the line of the component"));
  if (component.empty()) lines.fail(begin + 4, "is not a component such as L, T or V");
  const auto azimuth = captured(lines.at(begin + 7, "the line of the station"), azimuths);
  std::string place;
  if (azimuth && (component == "L" || component == "T"))
    place = fmt::format("{} deg", (*azimuth)[component == "T" ? 1 : 0]);
  return {.component = component, .place = place, .begin = begin};
}

std::vector<Channel> find_channels(const Lines& lines) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (begins_with(trimmed(lines[i]), title)) channels.push_back(read_channel(lines, i));
  return channels;
}

std::size_t end_of(const Lines& lines, std::size_t begin) {
  std::size_t i = begin + 1;
  while (i < lines.size() && !lines[i].starts_with("/&") && !begins_with(trimmed(lines[i]), title)) ++i;
  return i;
}

double read_step(const Lines& lines, std::size_t begin, std::size_t values_begin, std::size_t count, double duration) {
  const std::size_t i = values_begin - 6;
  const auto words = split_at_blanks(lines.at(i, "the reals of its header"));
  const double rate =
      checked_positive(lines, i, "the sampling rate", words.empty() ? 0 : lines.number(i, words.front()), "a number");
  // The duration refers to the samples, or to the intervals between them, and is rounded.
  if (std::abs(static_cast<double>(count) / rate - duration) > std::max(2 / rate, 0.001 * duration))
    lines.fail(i, fmt::format("states {:g} samples per second, which disagrees with {} points in {:g} s on line {}",
                              rate, count, duration, begin + 11));
  return 1 / rate;
}

Record read(const Lines& lines, const RecordOptions& options) {
  static const std::regex points = pattern(R"(no\. of points\s*=\s*([0-9]+)\s+duration\s*=\s*([0-9.]+))");
  static const std::regex units = pattern(R"(units are\s+(?:sec\w*\s+and\s+)?(\S+))");
  static const std::regex file = pattern(R"(file:\s*(\S+))");
  const Channel channel = chosen(lines, find_channels(lines), options);
  const std::size_t begin = channel.begin;
  const std::string_view station = lines.at(begin + 7, "the line of the station");
  Record record;
  record.channel = channel.text();
  const auto number = captured(lines[begin], file);
  record.station =
      single_spaced(fmt::format("{} {}", number ? number->front() : "", station.substr(0, station.find("Station"))));
  record.title = single_spaced(lines.at(begin + 2, "the end of its header"));
  if (!begins_with(trimmed(lines[begin]), "* VOL1")) {
    record.format = "BHRC V2";
    if (!volumes::read_stated(lines, begin, end_of(lines, begin), {8, 10}, options, record))
      lines.fail(begin,
                 "is not a file of Volume 1, and has no line \"points of accel data equally spaced at ... sec, in "
                 "...\"; use the V1 file");
    return record;
  }
  record.format = "BHRC V1";
  record.remark = "uncorrected";
  const auto stated = captured(lines.at(begin + 10, "the number of points"), points);
  if (!stated) lines.fail(begin + 10, "has no \"NO. OF POINTS =\" and \"DURATION =\"");
  const auto unit_text = captured(lines.at(begin + 11, "the unit"), units);
  if (!unit_text) lines.fail(begin + 11, "has no \"UNITS ARE SECONDS AND\"");
  const double unit = agreed_unit(lines, begin + 11, unit_text->front(), options, record.unit);
  const std::size_t count =
      checked_count(lines, begin + 10, "the number of points", lines.number(begin + 10, (*stated)[0]));
  const std::size_t values_begin = volumes::after_headers(lines, begin);
  const double dt = read_step(lines, begin, values_begin, count, lines.number(begin + 10, (*stated)[1]));
  set_samples(record, read_columns(lines, values_begin, numbers, {count, fmt::format("line {}", begin + 11)}), unit,
              dt);
  return record;
}

}  // namespace

constinit const Format bhrc{"BHRC", recognises, read};

}  // namespace pounding::records
