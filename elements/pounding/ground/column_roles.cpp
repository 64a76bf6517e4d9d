#include <pounding/ground/column_roles.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

namespace pounding::records {
namespace {

constexpr std::size_t fewest_counted_rows = 3, fewest_values = 10, longest_integer_header = 100;
constexpr double longest_stated_step = 1000;  // [s], or erroneously [ms]

/// Lower-case letters of a name, without its bracket.
std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name.substr(0, name.find_first_of("([")))
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// True if all rows, and enough of them, have a column.
bool is_whole(const NumberTable& table, std::size_t column) {
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.columns(row) <= column) return false;
  return table.rows() >= fewest_counted_rows;
}

template <std::size_t count>
bool is_one_of(std::string_view name, const std::array<std::string_view, count>& names) {
  return std::find(names.begin(), names.end(), letters_of(name)) != names.end();
}

}  // namespace

double integer_spacing(const NumberTable& table, std::size_t column) {
  if (!is_whole(table, column)) return 0;
  const double first = table.at(0, column), spacing = table.at(1, column) - first;
  if (first != std::floor(first) || spacing != std::floor(spacing) || spacing < 1) return 0;
  for (std::size_t row = 1; row < table.rows(); ++row)
    if (table.at(row, column) != first + static_cast<double>(row) * spacing) return 0;
  return spacing;
}

bool counts_rows(const NumberTable& table, std::size_t column) { return integer_spacing(table, column) == 1; }

bool ascends(const NumberTable& table, std::size_t column) {
  if (!is_whole(table, column) || table.at(0, column) < 0) return false;
  for (std::size_t row = 1; row < table.rows(); ++row)
    if (!(table.at(row, column) > table.at(row - 1, column))) return false;
  return true;
}

double even_spacing(const NumberTable& table, std::size_t column) {
  if (!ascends(table, column)) return 0;
  const double mean =
      (table.at(table.rows() - 1, column) - table.at(0, column)) / static_cast<double>(table.rows() - 1);
  for (std::size_t row = 1; row < table.rows(); ++row)
    if (!(std::abs(table.at(row, column) - table.at(row - 1, column) - mean) <= 0.1 * mean)) return 0;
  return mean;
}

bool names_times(std::string_view name) {
  constexpr std::array<std::string_view, 10> names{"t",     "time",  "times", "zeit", "tiempo",
                                                   "temps", "tempo", "zaman", "sec",  "seconds"};
  return is_one_of(name, names);
}

bool names_counter(std::string_view name) {
  constexpr std::array<std::string_view, 26> names{
      "no",    "nr",    "num",    "number",  "index",   "idx",    "id",      "i",        "n",
      "k",     "point", "points", "pt",      "pointno", "sample", "samples", "sampleno", "row",
      "rowno", "line",  "count",  "counter", "step",    "stepno", "sno",     "srno"};
  return is_one_of(name, names);
}

CountRows find_count_rows(const NumberTable& table, double step) {
  const auto states_count = [&](double number, std::size_t row) {
    return row < table.rows() && number >= fewest_values &&
           (number == static_cast<double>(table.rows() - row) ||
            number == static_cast<double>(table.numbers_from(row)));
  };
  const auto found = [](std::size_t rows, double count, double stated) {
    return CountRows{rows, static_cast<std::size_t>(count), stated};
  };
  const auto is_step = [](double number) { return number > 0 && number <= longest_stated_step; };
  if (table.rows() < 2) return {};
  const double first = table.at(0, 0);
  if (table.columns(0) == 1) {
    if (table.columns(1) == 1) {
      const double second = table.at(1, 0);
      if (states_count(first, 2) && is_step(second)) return found(2, first, second);
      if (states_count(second, 2) && is_step(first)) return found(2, second, first);
    }
    if (states_count(first, 1)) return found(1, first, 0);
  }
  if (table.columns(0) == 2) {
    const double second = table.at(0, 1);
    // If the first column increases, the row is a time and its value.
    const bool ascends = step == 0 && table.columns(1) == 2 && table.at(1, 0) > first;
    if (states_count(first, 1) && is_step(second)) return found(1, first, second);
    if (states_count(second, 1) && is_step(first) && !ascends) return found(1, second, first);
  }
  return {};
}

std::size_t integer_header(const NumberTable& table) {
  std::size_t header = 0;
  while (header < table.rows() && table.holds_integers(header)) ++header;
  if (header == 0 || header == table.rows() || header > longest_integer_header ||
      table.numbers_from(header) < fewest_values)
    return 0;
  for (std::size_t row = header; row < table.rows(); ++row)
    if (table.holds_integers(row)) return 0;
  return header;
}

}  // namespace pounding::records
