/// USGS SMC, time series of versions 1 and 2 of the format (smcfmt, USGS National Strong-Motion Program).
///
/// 11 lines of text, the first with the type of data; 48 integers (8I10), of which number 16 is the number of comments
/// and 17 that of samples; 50 reals (5E15.7), of which number 1 marks "unknown" and 2 is the sampling rate; comments;
/// samples in cm/s^2 (8E10.4, or 5E14.7 if integer 47 is 8, as written by the programs of D. Boore for higher
/// precision).

#include <pounding/ground/records/format.hpp>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t integers_line = 11, reals_line = 17, comments_line = 27;
constexpr Columns integers{8, 10}, reals{5, 15};
constexpr std::string_view uncorrected = "1 UNCORRECTED ACCELEROGRAM";
constexpr std::string_view corrected = "2 CORRECTED ACCELEROGRAM";
constexpr std::string_view others[] = {"0 UNKNOWN", "3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA",
                                       "6 FOURIER AMPLITUDE SPECTRA"};

bool recognises(const Lines& lines) {
  if (lines.size() == 0) return false;
  const std::string_view first = trimmed(lines[0]);
  for (const std::string_view other : others)
    if (begins_with(first, other)) return true;
  return begins_with(first, uncorrected) || begins_with(first, corrected);
}

/// Integers of the header are numbered from 1, as in the description.
double header_integer(const Lines& lines, std::size_t number) {
  return column_number(lines, integers_line, integers, number - 1);
}

double read_rate(const Lines& lines) {
  const double unknown = column_number(lines, reals_line, reals, 0), rate = column_number(lines, reals_line, reals, 1);
  if (rate == unknown || rate <= 0)
    lines.fail(reals_line, "does not state a sampling rate; uneven samples are not supported");
  return rate;
}

Record read(const Lines& lines, const RecordOptions& options) {
  const std::string_view kind = trimmed(lines[0]);
  if (!begins_with(kind, uncorrected) && !begins_with(kind, corrected))
    lines.fail(0, fmt::format("contains \"{}\"; use the file of accelerations", excerpt(kind)));
  Record record;
  record.format = "USGS SMC";
  record.title = single_spaced(lines.at(3, "the end of its header"));
  static const std::regex names = pattern(R"(^station\s*=(.*?)component\s*=(.*)$)");
  const auto parts = captured(lines.at(5, "the end of its header"), names);
  if (!parts) lines.fail(5, "has no \"station = ... component= ...\"");
  record.station = single_spaced((*parts)[0]);
  record.channel = chosen(lines, {{.component = single_spaced((*parts)[1])}}, options).text();
  if (begins_with(kind, uncorrected)) record.remark = "uncorrected";
  const double unit = agreed_unit(lines, 0, "cm/s^2", options, record.unit);

  const double rate = read_rate(lines);
  const std::size_t count =
      checked_count(lines, integers_line + 2, "integer 17, the number of samples", header_integer(lines, 17));
  const double comments = header_integer(lines, 16);
  std::size_t begin = comments_line;
  for (; begin < lines.size() && lines[begin].starts_with('|'); ++begin) {
  }
  if (comments >= 0 && static_cast<double>(begin - comments_line) != comments)
    lines.fail(integers_line + 1, fmt::format("integer 16 states {:g} comments, but {} lines start with \"|\"",
                                              comments, begin - comments_line));
  const bool many_digits = header_integer(lines, 47) == 8;
  const Columns columns = many_digits ? Columns{5, 14} : Columns{8, 10};
  set_samples(record, read_columns(lines, begin, columns, {count, "integer 17 of its header"}), unit, 1 / rate);
  return record;
}

}  // namespace

constinit const Format smc{"USGS SMC", recognises, read};

}  // namespace pounding::records
