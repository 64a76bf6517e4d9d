/// GeoNet V1A and V2A of New Zealand (W. J. Cousins, GNS Accelerogram Data Files, Standard Format, 2008;
/// geonet.org.nz/data/supplementary/strong_motion_file_formats).
///
/// Three components, each with 16 lines of text, 4 of integers (10I8), 6 of reals (10F8.0) and the accelerations
/// (10F8.1); V2A files continue with velocities and displacements. Fields read: text line 10, the number of points;
/// line 11, the unit of raw readings; line 13, the component; line 14, the unit; integers 34 to 36, the numbers of
/// samples of acceleration, velocity and displacement; real 26, the interval [s]. All nines mark a missing sample:
/// those at the start and end are omitted, as stated in `remark`.

#include <pounding/ground/records/format.hpp>

#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

constexpr Columns fields{10, 8};
constexpr std::size_t integers_line = 16, reals_line = 20, values_line = 26;
constexpr std::string_view uncorrected = "UNCORRECTED ACCELEROGRAM", corrected = "CORRECTED ACCELEROGRAM";

bool begins_component(std::string_view line) {
  return begins_with(trimmed(line), uncorrected) || begins_with(trimmed(line), corrected);
}

bool recognises(const Lines& lines) {
  return lines.size() > 1 && begins_component(lines[0]) && begins_with(trimmed(lines[1]), "SITE ");
}

/// "Component N28W  Longitudinal Accelerometer Axis"
Channel read_channel(const Lines& lines, std::size_t begin) {
  static const std::regex words = pattern(R"(^\s*component\s+(\S+)\s*(.*)$)");
  const auto parts = captured(lines.at(begin + 12, "the line of the component"), words);
  if (!parts) lines.fail(begin + 12, "is not a line such as \"Component N28W\"");
  return {.component = (*parts)[0], .place = single_spaced((*parts)[1]), .begin = begin};
}

std::vector<Channel> find_channels(const Lines& lines) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (begins_component(lines[i])) channels.push_back(read_channel(lines, i));
  return channels;
}

/// Header values are numbered from 1, as in the description.
double header_number(const Lines& lines, std::size_t begin, std::size_t number) {
  return column_number(lines, begin, fields, number - 1);
}

std::size_t stated_count(const Lines& lines, std::size_t begin) {
  static const std::regex points = pattern(R"(number of points\s+([0-9]+))");
  const auto count = captured(lines[begin + 9], points);
  if (!count) lines.fail(begin + 9, "has no \"Number of points\"");
  return checked_count(lines, begin + 9, "the number of points", lines.number(begin + 9, count->front()));
}

/// Rejects a component whose number of value lines differs from that stated in its header.
void check_lines(const Lines& lines, std::size_t begin, std::size_t count) {
  std::size_t end = begin + values_line;
  while (end < lines.size() && !begins_component(lines[end])) ++end;
  while (end > begin + values_line && trimmed(lines[end - 1]).empty()) --end;
  std::size_t stated = fields.lines_for(count);
  for (const std::size_t number : {35, 36}) {
    const double others = header_number(lines, begin + integers_line, number);
    if (!(others >= 0 && others <= max_samples))
      lines.fail(begin + integers_line + 3,
                 fmt::format("integer {} is {:g}; it must be a number of samples", number, others));
    stated += fields.lines_for(static_cast<std::size_t>(others));
  }
  if (end - begin - values_line != stated)
    lines.fail(end - 1, fmt::format("the values end here, after {} lines, but line {} and integers 35 and 36 state {}",
                                    end - begin - values_line, begin + 10, stated));
}

/// Sampling interval [s]: real 26, with four decimals. It is replaced by that of a rate in whole Hz if this rounds to
/// it.
double read_interval(const Lines& lines, std::size_t begin) {
  const double stated = header_number(lines, begin + reals_line, 26);
  const double dt =
      checked_positive(lines, begin + reals_line + 2, "real 26, the sampling interval,", stated, "a time");
  const double whole = 1 / std::round(1 / dt);
  return std::abs(whole - dt) <= 0.5e-4 ? whole : dt;
}

bool is_missing(std::string_view field) { return field == "999999.9" || field == "9999.999" || field == "99.99999"; }

/// Accelerations in the unit of the file, without missing samples at the ends.
std::vector<double> read_values(const Lines& lines, std::size_t begin, std::size_t count, Record& record) {
  const std::size_t values_begin = begin + values_line;
  const auto field = [&](std::size_t k) { return column_field(lines, values_begin, fields, k); };
  std::size_t first = 0, end = count;
  while (first < count && is_missing(field(first))) ++first;
  while (end > first && is_missing(field(end - 1))) --end;
  if (end - first < 2) lines.fail(values_begin, "the component needs at least two samples that are not missing");
  if (end - first < count)
    record.remark += fmt::format(", {} missing samples at the ends omitted", count - (end - first));
  std::vector<double> values;
  for (std::size_t k = first; k < end; ++k) {
    const std::size_t i = values_begin + k / fields.per_line;
    if (is_missing(field(k))) lines.fail(i, fmt::format("{} marks a missing sample between others", field(k)));
    values.push_back(lines.sample(i, field(k)));
  }
  return values;
}

Record read(const Lines& lines, const RecordOptions& options) {
  static const std::regex readings = pattern(R"(in units of\s*([0-9.]+)\s*\S*/)");
  static const std::regex peak = pattern(R"(peak\s*-?([0-9.]+)\s+(\S+))");
  const Channel channel = chosen(lines, find_channels(lines), options);
  const std::size_t begin = channel.begin;
  lines.at(begin + values_line, "the values");
  Record record;
  const bool raw = begins_with(trimmed(lines[begin]), uncorrected);
  record.format = raw ? "GeoNet V1A" : "GeoNet V2A";
  record.title = single_spaced(fmt::format("{}, {}", trimmed(lines[begin + 7]), trimmed(lines[begin + 6])));
  const auto site = split_at_blanks(lines[begin + 1]);
  record.station = single_spaced(fmt::format("{} {}", site.size() > 1 ? site[1] : "", lines[begin + 2]));
  record.channel = channel.text();
  if (raw) record.remark = "uncorrected";

  const auto stated_peak = captured(lines[begin + 13], peak);
  if (!stated_peak) lines.fail(begin + 13, "has no \"Acceleration: Peak\" with its unit");
  const double unit = agreed_unit(lines, begin + 13, (*stated_peak)[1], options, record.unit);
  const std::size_t count = stated_count(lines, begin);
  check_lines(lines, begin, count);
  std::vector<double> values = read_values(lines, begin, count, record);
  const auto reading = captured(lines[begin + 10], readings);
  const double factor = raw && reading ? checked_positive(lines, begin + 10, "the unit of the readings",
                                                          lines.number(begin + 10, reading->front()), "a number")
                                       : 1;
  set_samples(record, std::move(values), unit * factor, read_interval(lines, begin));
  return record;
}

}  // namespace

constinit const Format geonet{"GeoNet V1A and V2A", recognises, read};

}  // namespace pounding::records
