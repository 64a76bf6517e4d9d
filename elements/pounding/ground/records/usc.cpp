/// USC, the Los Angeles strong-motion network of the University of Southern California, Volumes I and II (M. D.
/// Trifunac and V. W. Lee, Routine Computer Processing of Strong-Motion Accelerograms, EERL 73-03, 1973).
///
/// Volume I: 13 lines of text, the first "FILE 0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:", 7 of integers, 7 of
/// reals; then pairs of time and acceleration (1X,10F7.3). Volume II: 25 lines of text, those of Volume I after one
/// additional line; accelerations after a line that states points, spacing and unit. Columns 73 to 80 of the text
/// contain the lengths of the lines. A file has one or more components.

#include <pounding/ground/records/format.hpp>

#include <fmt/format.h>

#include <pounding/ground/records/volumes.hpp>

namespace pounding::records {
namespace {

constexpr std::string_view v1_title = "UNCORRECTED ACCELEROGRAM DATA OF VOLUME";
constexpr std::string_view v2_title = "CORRECTED ACCELEROGRAM";
constexpr std::size_t text_width = 72;

bool is_v1(std::string_view line) { return contains(line.substr(0, text_width), v1_title); }
bool is_v2(const Lines& lines, std::size_t i) {
  return begins_with(trimmed(lines[i]), v2_title) && i + 1 < lines.size() && is_v1(lines[i + 1]);
}

bool recognises(const Lines& lines) { return lines.size() > 0 && (is_v1(lines[0]) || is_v2(lines, 0)); }

/// A line of the text header, numbered from 1 as in Volume I.
std::size_t text_line(const Lines& lines, std::size_t begin, std::size_t number) {
  return begin + number - (is_v1(lines[begin]) ? 1 : 0);
}

std::string text(const Lines& lines, std::size_t begin, std::size_t number) {
  return single_spaced(lines.at(text_line(lines, begin, number), "the end of its header").substr(0, text_width));
}

/// "COMP S05W"
Channel read_channel(const Lines& lines, std::size_t begin) {
  const std::string line = text(lines, begin, 7);
  if (!begins_with(line, "COMP ")) lines.fail(text_line(lines, begin, 7), "is not a line such as \"COMP S05W\"");
  return {.component = line.substr(5), .begin = begin};
}

std::vector<Channel> find_channels(const Lines& lines) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!is_v1(lines[i]) && !is_v2(lines, i)) continue;
    channels.push_back(read_channel(lines, i));
    if (is_v2(lines, i)) ++i;
  }
  return channels;
}

std::size_t end_of(const Lines& lines, std::size_t begin) {
  for (std::size_t i = begin + 2; i < lines.size(); ++i)
    if (is_v1(lines[i]) || is_v2(lines, i)) return i;
  return lines.size();
}

Record read(const Lines& lines, const RecordOptions& options) {
  static const std::regex number = pattern(R"(station\s+usc\S*\s+([0-9A-Z]+))");
  const Channel channel = chosen(lines, find_channels(lines), options);
  const std::size_t begin = channel.begin;
  Record record;
  record.channel = channel.text();
  record.title = text(lines, begin, 8);
  const auto code = captured(text(lines, begin, 5), number);
  record.station = single_spaced(fmt::format("{} {}", code ? code->front() : "", text(lines, begin, 6)));
  if (is_v1(lines[begin])) {
    record.format = "USC V1";
    record.remark = "uncorrected";
    volumes::read_pairs(lines, begin + 10, begin + 11, volumes::after_headers(lines, begin), options, record);
  } else {
    record.format = "USC V2";
    if (!volumes::read_stated(lines, begin, end_of(lines, begin), {8, 10}, options, record))
      lines.fail(
          begin,
          "the component that starts here has no line \"POINTS OF ACC DATA EQUALLY SPACED AT ... SEC. IN UNITS ...\"");
  }
  return record;
}

}  // namespace

constinit const Format usc{"USC V1 and V2", recognises, read};

}  // namespace pounding::records
