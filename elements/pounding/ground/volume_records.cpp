#include <pounding/ground/records/volumes.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace pounding::records::volumes {
namespace {

constexpr std::size_t text_lines = 13, real_lines = 7, max_integer_lines = 10;
constexpr std::size_t pair_width = 7;

std::size_t length_of(std::string_view line) {
  const std::size_t last = line.find_last_not_of(" \t");
  return last == std::string_view::npos ? 0 : last + 1;
}

/// Lines with eight numbers have 72 or 80 characters.
Columns even_columns(const Lines& lines, std::size_t i, const Columns& usual) {
  if (const auto stated = fortran_columns(lines[i])) return *stated;
  const std::size_t length = i + 1 < lines.size() ? length_of(lines[i + 1]) : 0;
  return length == 72 || length == 80 ? Columns{8, length / 8} : usual;
}

/// (10F7.3), (1X,10F7.3), or with eight numbers per line.
Columns pair_columns(std::string_view line) {
  const std::size_t length = length_of(line), fields = length / pair_width, indent = length % pair_width;
  return {fields == 8 ? fields : 10, pair_width, indent <= 1 ? indent : 0};
}

}  // namespace

std::string unit_alone(std::string_view text) {
  return std::string(trimmed(text.substr(0, text.find_first_of(".();,"))));
}

std::size_t after_headers(const Lines& lines, std::size_t begin) {
  std::size_t i = begin + text_lines;
  const std::size_t last = std::min(i + max_integer_lines, lines.size());
  while (i < last && lines[i].find('.') == std::string_view::npos) ++i;
  return i + real_lines;
}

void read_even(const Lines& lines, std::size_t i, const std::string& count_text, const std::string& unit_text,
               double dt, const Columns& usual, const RecordOptions& options, Record& record) {
  const double unit = agreed_unit(lines, i, unit_alone(unit_text), options, record.unit);
  const std::size_t count = checked_count(lines, i, "the number of points", lines.number(i, count_text));
  const Stated stated{count, fmt::format("line {}", i + 1)};
  set_samples(record, read_columns(lines, i + 1, even_columns(lines, i, usual), stated), unit, dt);
}

bool read_stated(const Lines& lines, std::size_t begin, std::size_t end, const Columns& usual,
                 const RecordOptions& options, Record& record) {
  static const std::regex stated = pattern(
      R"(^\s*([0-9]+)\s+points of acc\w* data equally spaced at\s*([0-9.]+)\s*sec\s*[.,]*\s*(?:in\s+(?:units\s+(?:of\s+)?)?|\(\s*units:)\s*(.*)$)");
  for (std::size_t i = begin; i < std::min(end, lines.size()); ++i)
    if (const auto parts = captured(lines[i], stated)) {
      const double dt = checked_positive(lines, i, "the spacing", lines.number(i, (*parts)[1]), "a time");
      read_even(lines, i, (*parts)[0], (*parts)[2], dt, usual, options, record);
      return true;
    }
  return false;
}

void read_pairs(const Lines& lines, std::size_t count_line, std::size_t unit_line, std::size_t first,
                const RecordOptions& options, Record& record) {
  static const std::regex points = pattern(R"(no\. of points\s*=\s*([0-9]+))");
  static const std::regex units = pattern(R"(units (?:of uncor \w+ )?(?:are|is)\s+(?:sec\w* and\s*)?([^ ]+))");
  const auto count_text = captured(lines.at(count_line, "the end of its header"), points);
  const auto unit_text = captured(lines.at(unit_line, "the end of its header"), units);
  if (!count_text) lines.fail(count_line, "has no \"No. of points =\"");
  if (!unit_text) lines.fail(unit_line, "has no \"Units of uncor data are sec and\"");
  const double unit = agreed_unit(lines, unit_line, unit_alone((*unit_text)[0]), options, record.unit);
  const std::size_t count =
      checked_count(lines, count_line, "the number of points", lines.number(count_line, (*count_text)[0]));
  const Columns columns = pair_columns(lines.at(first, "its values"));
  const std::vector<double> values =
      read_columns(lines, first, columns, {2 * count, fmt::format("line {}, two per point,", count_line + 1)});
  std::vector<double>&times = record.samples.times, &accelerations = record.samples.accelerations;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + 2 * k / columns.per_line;
    if (values[2 * k] < 0) lines.fail(i, fmt::format("time {:g} is negative, but a run starts at 0", values[2 * k]));
    if (k > 0 && values[2 * k] <= times.back())
      lines.fail(i, fmt::format("time {:g} is not later than the previous one", values[2 * k]));
    times.push_back(values[2 * k]);
    accelerations.push_back(unit * values[2 * k + 1]);
  }
}

}  // namespace pounding::records::volumes
