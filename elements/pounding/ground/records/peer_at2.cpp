/// PEER AT2: a header that states NPTS and DT [s], or DT in MSEC, with key and number in either order, and "UNITS OF
/// G"; then the values.

#include <pounding/ground/records/format.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t header_lines = 10;

/// Line that states NPTS and DT.
std::optional<std::size_t> find_npts(const Lines& lines) {
  for (std::size_t i = 0; i < std::min(lines.size(), header_lines); ++i) {
    const std::string line = upper(lines[i]);
    if (line.find("NPTS") != std::string::npos && line.find("DT") != std::string::npos) return i;
  }
  return std::nullopt;
}

struct Size {
  std::size_t npts;
  double dt;
};

/// Seconds per unit that follows DT; 1 if the next item is another key of the line.
double unit_of_dt(const Lines& lines, std::size_t i, const std::string& unit, bool is_key) {
  if (unit.empty() || is_key || unit == "NPTS" || unit == "UNITS") return 1;
  const std::optional<double> seconds = unit_of_time(unit);
  if (!seconds) lines.fail(i, fmt::format("\"{}\" is not the unit of DT; type SEC or MSEC", excerpt(unit)));
  return *seconds;
}

/// "NPTS=  5372, DT=   .0100 SEC", "DT= 5.0 MSEC, NPTS= 700", or the older "5372    0.0100    NPTS, DT".
Size read_size(const Lines& lines, std::size_t i) {
  static const std::regex stated_count = pattern(R"(NPTS\s*[=:]?\s*([0-9.]+))");
  static const std::regex stated_step = pattern(R"(DT\s*[=:]?\s*([0-9.]+(?:[ED][-+]?[0-9]+)?)\s*([A-Z]*)\s*([=:]?))");
  const std::string line = upper(lines[i]);
  const auto count = captured(line, stated_count), step = captured(line, stated_step);
  if (count && step)
    return {checked_count(lines, i, "NPTS", lines.number(i, count->front())),
            checked_positive(lines, i, "DT",
                             lines.number(i, (*step)[0]) * unit_of_dt(lines, i, (*step)[1], !(*step)[2].empty()),
                             "a time")};
  std::vector<double> numbers;
  std::string separated = line;
  std::replace_if(separated.begin(), separated.end(), [](char c) { return c == '=' || c == ','; }, ' ');
  for (const std::string_view word : split_at_blanks(separated))
    if (double value = 0; parse_number(word, value)) numbers.push_back(value);
  if (numbers.size() < 2) lines.fail(i, "NPTS and DT must each have a number, as in \"NPTS= 5372, DT= .0100 SEC\"");
  return {checked_count(lines, i, "NPTS", numbers[0]), checked_positive(lines, i, "DT", numbers[1], "a time")};
}

Record read(const Lines& lines, const RecordOptions& options) {
  refuse_channel(lines, options);
  const std::size_t npts_line = *find_npts(lines);
  const auto [npts, dt] = read_size(lines, npts_line);
  Record record;
  record.format = "PEER AT2";
  if (npts_line >= 2) record.title = trimmed(lines[1]);

  std::string stated;
  std::size_t stated_at = 0;
  for (std::size_t i = 0; i <= npts_line; ++i) {
    constexpr std::string_view mark = "UNITS OF ";
    const std::size_t at = upper(lines[i]).find(mark);
    if (at == std::string::npos) continue;
    stated = lines[i].substr(at + mark.size());
    stated = stated.substr(0, stated.find_first_of(" .,;\t"));  // "G. FILTER POINTS: ..." in old headers
    stated_at = i;
  }
  const double unit = agreed_unit(lines, stated_at, stated, options, record.unit);

  set_samples(record, read_numbers(lines, npts_line + 1, {npts, "NPTS"}), unit, dt);
  return record;
}

bool recognises(const Lines& lines) { return find_npts(lines).has_value(); }

}  // namespace

constinit const Format peer_at2{"PEER AT2", recognises, read};

}  // namespace pounding::records
