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

Channel read_channel(const NamedLines& header) {
  const std::string direction = header.value("DIR.");
  if (direction.size() == 1 && direction[0] >= '1' && direction[0] <= '6') {
    constexpr const char* components[] = {"N-S", "E-W", "U-D"};
    const int k = direction[0] - '1';
    return {.number = direction, .component = components[k % 3], .place = k < 3 ? "borehole" : "surface"};
  }
  return {.component = direction};
}

/// gal per count.
double read_scale(const Lines& lines, const NamedLines& header) {
  static const std::regex fraction = pattern(R"(^([0-9.]+)\s*\(gal\)\s*/\s*([0-9.]+)$)");
  const std::size_t i = header.at("SCALE FACTOR");
  const auto parts = captured(header.value(i), fraction);
  if (!parts)
    lines.fail(i, fmt::format("\"{}\" is not a scale factor such as 3920(gal)/6182761", excerpt(header.value(i))));
  return checked_positive(lines, i, "the scale factor", lines.number(i, (*parts)[0]) / lines.number(i, (*parts)[1]),
                          "a number");
}

double read_frequency(const Lines& lines, const NamedLines& header) {
  const std::size_t i = header.at("SAMPLING FREQ(HZ)");
  std::string text = header.value(i);
  if (upper(text).ends_with("HZ")) text.resize(text.size() - 2);
  return checked_positive(lines, i, "the sampling frequency", lines.number(i, text), "a number");
}

Record read(const Lines& lines, const RecordOptions& options) {
  const NamedLines header(lines, header_lines, name_width);
  Record record;
  record.format = "K-NET";
  record.title = fmt::format("{}, M {}", header.value("ORIGIN TIME"), header.value("MAG."));
  record.station = header.value("STATION CODE");
  record.channel = chosen(lines, {read_channel(header)}, options).text();
  const double unit =
      agreed_unit(lines, header.at("SCALE FACTOR"), "gal", options, record.unit) * read_scale(lines, header);
  const double frequency = read_frequency(lines, header);
  const std::size_t i = header.at("DURATION TIME(S)");
  const double duration = checked_positive(lines, i, "the duration", header.number("DURATION TIME(S)"), "a time");
  const std::size_t count =
      checked_count(lines, i, "duration times sampling frequency", std::round(duration * frequency));

  std::vector<double> values =
      read_numbers(lines, header.at("MEMO.") + 1, {count, "duration times sampling frequency"});
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  for (double& value : values) value -= mean;
  set_samples(record, std::move(values), unit, 1 / frequency);
  record.remark = fmt::format("uncorrected, mean of {:.1f} counts removed", mean);
  return record;
}

}  // namespace

constinit const Format knet{"K-NET", recognises, read};

}  // namespace pounding::records
