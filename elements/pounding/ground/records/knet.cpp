/// K-NET and KiK-net ASCII, described by NIED (https://www.kyoshin.bosai.go.jp/kyoshin/man/knetform_en.html).
///
/// A header of lines with names of 18 characters, from "Origin Time" to "Memo."; then counts. The acceleration in gal
/// is (count - mean) times the scale factor "3920(gal)/6182761", because the logger has a zero offset. KiK-net numbers
/// its channels: 1 to 3 are N-S, E-W and U-D in the borehole, 4 to 6 the same at the surface.

#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t name_width = 18;
constexpr std::size_t header_lines = 30;

bool recognises(const Lines& lines) { return lines.size() > 0 && begins_with(lines[0], "ORIGIN TIME"); }

/// Header line that starts with this name, given in capitals.
std::size_t find_line(const Lines& lines, std::string_view name) {
  for (std::size_t i = 0; i < std::min(lines.size(), header_lines); ++i)
    if (begins_with(lines[i], name)) return i;
  lines.fail(std::min(lines.size(), header_lines) - 1, fmt::format("the header has no line \"{}\"", name));
}

std::string value(const Lines& lines, std::size_t i) {
  return lines[i].size() > name_width ? std::string(trimmed(lines[i].substr(name_width))) : std::string();
}

Channel read_channel(const Lines& lines) {
  const std::size_t i = find_line(lines, "DIR.");
  const std::string direction = value(lines, i);
  if (direction.size() == 1 && direction[0] >= '1' && direction[0] <= '6') {
    constexpr const char* components[] = {"N-S", "E-W", "U-D"};
    const int k = direction[0] - '1';
    return {.number = direction, .component = components[k % 3], .place = k < 3 ? "borehole" : "surface", .begin = i};
  }
  return {.number = {}, .component = direction, .place = {}, .begin = i};
}

/// gal per count.
double read_scale(const Lines& lines) {
  static const std::regex fraction = pattern(R"(^([0-9.]+)\s*\(gal\)\s*/\s*([0-9.]+)$)");
  const std::size_t i = find_line(lines, "SCALE FACTOR");
  const auto parts = captured(value(lines, i), fraction);
  if (!parts)
    lines.fail(i, fmt::format("\"{}\" is not a scale factor such as 3920(gal)/6182761", excerpt(value(lines, i))));
  return checked_positive(lines, i, "the scale factor", lines.number(i, (*parts)[0]) / lines.number(i, (*parts)[1]),
                          "a number");
}

double read_frequency(const Lines& lines) {
  const std::size_t i = find_line(lines, "SAMPLING FREQ(HZ)");
  std::string text = value(lines, i);
  if (upper(text).ends_with("HZ")) text.resize(text.size() - 2);
  return checked_positive(lines, i, "the sampling frequency", lines.number(i, text), "a number");
}

Record read(const Lines& lines, const RecordOptions& options) {
  Record record;
  record.format = "K-NET";
  record.title = single_spaced(
      fmt::format("{}, M {}", value(lines, find_line(lines, "ORIGIN TIME")), value(lines, find_line(lines, "MAG."))));
  record.station = value(lines, find_line(lines, "STATION CODE"));
  record.channel = chosen(lines, {read_channel(lines)}, options).text();
  const double unit =
      agreed_unit(lines, find_line(lines, "SCALE FACTOR"), "gal", options, record.unit) * read_scale(lines);
  const double frequency = read_frequency(lines);
  const std::size_t i = find_line(lines, "DURATION TIME(S)");
  const double duration = checked_positive(lines, i, "the duration", lines.number(i, value(lines, i)), "a time");
  const std::size_t count =
      checked_count(lines, i, "duration times sampling frequency", std::round(duration * frequency));

  std::vector<double>& values = record.samples.accelerations;
  values = read_numbers(lines, find_line(lines, "MEMO.") + 1, {count, "duration times sampling frequency"});
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  for (double& a : values) a = unit * (a - mean);
  record.samples.times = even_times(count, 1 / frequency);
  record.remark = fmt::format("uncorrected, mean of {:.1f} counts removed", mean);
  return record;
}

}  // namespace

constinit const Format knet{"K-NET", recognises, read};

}  // namespace pounding::records
