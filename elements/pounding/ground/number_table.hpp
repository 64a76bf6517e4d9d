#pragma once
/// Lines of numbers under a header of text, as spreadsheets and programs write them. Users call read_record() instead.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/ground/records/format.hpp>

namespace pounding::records {

/// A file of numbers: a header of text or comments, lines of numbers, and nothing after them but a line such as "***
/// End Data ***" and text below it.
///
/// Columns are parted by semicolons, else by commas, else by blanks. Commas are decimal commas where semicolons part
/// the columns, and where every comma stands between digits, blanks part numbers and no number has a point. Lines that
/// begin with # or % are comments.
class NumberTable {
 public:
  /// Throws InputError with "file:line: " for a text among the values, and for values after the end mark.
  explicit NumberTable(const Lines& lines);

  std::size_t rows() const { return rows_.size(); }
  /// Numbers in a row.
  std::size_t columns(std::size_t row) const;
  double at(std::size_t row, std::size_t column) const { return values_[rows_[row].begin + column]; }
  /// Line of a row.
  std::size_t line(std::size_t row) const { return rows_[row].line; }
  /// Numbers in this row and all below it.
  std::size_t numbers_from(std::size_t row) const { return values_.size() - rows_[row].begin; }
  /// Whether a row holds integers alone, one of them other than 0, written without a decimal mark or an exponent.
  bool holds_integers(std::size_t row) const { return rows_[row].integers; }
  /// Forgets the first rows.
  void drop(std::size_t rows);
  /// Every number, row after row.
  const std::vector<double>& values() const { return values_; }
  /// One column; every row must have it.
  std::vector<double> column(std::size_t index) const;
  /// Line of the first row; the number of lines where there is none.
  std::size_t header_end() const { return header_end_; }
  /// Whether a line such as "0,12" may as well be one number with a decimal comma as two numbers, and every line is
  /// like it.
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

/// Whether one of the first hundred lines begins with a number, or none says anything.
bool holds_numbers(const Lines& lines);

/// Whether a line is a mark such as "*** End Data ***" or "EOF".
bool ends_data(std::string_view line);

/// Names of columns in a line such as "time (s), acc (g)" or "# t[s] ns[g] ew[g]": a bracket belongs to the word before
/// it.
std::vector<std::string> column_names(std::string_view line);

}  // namespace pounding::records
