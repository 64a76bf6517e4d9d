#pragma once
/// Lines of numbers below a text header, as written by spreadsheets and programs. Users call read_record() instead.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/ground/records/format.hpp>

namespace pounding::records {

/// A file of numbers: a header of text or comments, lines of numbers, and optionally an end mark such as "*** End Data
/// ***" followed by text.
///
/// Columns are separated by semicolons, otherwise by commas, otherwise by blanks. Commas are decimal commas if
/// semicolons separate the columns, or if all commas are between digits, blanks separate the numbers and no number has
/// a point. Lines that start with # or % are comments.
class NumberTable {
 public:
  /// Throws InputError with "file:line: " for text among the values, and for values after the end mark.
  explicit NumberTable(const Lines& lines);

  std::size_t rows() const { return rows_.size(); }
  /// Number of values in a row.
  std::size_t columns(std::size_t row) const {
    return (row + 1 < rows_.size() ? rows_[row + 1].begin : values_.size()) - rows_[row].begin;
  }
  double at(std::size_t row, std::size_t column) const { return values_[rows_[row].begin + column]; }
  /// Line of a row.
  std::size_t line(std::size_t row) const { return rows_[row].line; }
  /// Number of values in this row and all later rows.
  std::size_t numbers_from(std::size_t row) const { return values_.size() - rows_[row].begin; }
  /// True if a row contains only integers without decimal mark or exponent, at least one of them nonzero.
  bool holds_integers(std::size_t row) const { return rows_[row].integers; }
  /// Removes the first rows.
  void drop(std::size_t rows);
  /// All values, row by row.
  const std::vector<double>& values() const { return values_; }
  /// One column, which must exist in all rows.
  std::vector<double> column(std::size_t index) const;
  /// Line of the first row; the number of lines if the table is empty.
  std::size_t header_end() const { return header_end_; }
  /// True if every line is like "0,12", which is ambiguous: one number with a decimal comma, or two numbers.
  bool commas_are_ambiguous() const { return commas_are_ambiguous_; }

 private:
  struct Row {
    std::size_t line, begin;
    bool integers;
  };
  std::vector<Row> rows_;
  std::vector<double> values_;
  std::size_t header_end_ = 0;
  bool commas_are_ambiguous_ = false;
};

/// True if one of the first hundred lines starts with a number, or if all are empty or comments.
bool holds_numbers(const Lines& lines);

/// True for an end mark such as "*** End Data ***" or "EOF".
bool ends_data(std::string_view line);

/// Names of columns in a line such as "time (s), acc (g)" or "# t[s] ns[g] ew[g]"; a bracket belongs to the preceding
/// name.
std::vector<std::string> column_names(std::string_view line);

}  // namespace pounding::records
