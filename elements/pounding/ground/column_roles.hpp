#pragma once
/// Columns of a table that contain no values, and lines before the values: counters, times, numbers of values. Users
/// call read_record() instead.

#include <cstddef>
#include <string_view>

#include <pounding/ground/number_table.hpp>

namespace pounding::records {

/// Spacing of a column of evenly increasing integers with at least three rows; 0 for other columns.
double integer_spacing(const NumberTable& table, std::size_t column);

/// True if a column numbers the rows: consecutive integers in at least three rows.
bool counts_rows(const NumberTable& table, std::size_t column);

/// True if a column increases from row to row, from a first value >= 0.
bool ascends(const NumberTable& table, std::size_t column);

/// Mean spacing of a column that increases evenly, within 10 %, from a first value >= 0; 0 for other columns.
double even_spacing(const NumberTable& table, std::size_t column);

/// True for a typical name of a time column ("time", "t", "sec"), or of a counter ("No.", "index", "point").
bool names_times(std::string_view name);
bool names_counter(std::string_view name);

/// Rows before the values that state their number, and possibly the step.
struct CountRows {
  std::size_t rows = 0;   ///< 0 if there are none
  std::size_t count = 0;  ///< number of values, or of rows of values
  double step = 0;        ///< [s]; 0 if not stated
};

/// Finds rows such as "700" and "0.005", or "700 0.005", followed by the stated number of values, at least ten. `step`
/// is that given by the user [s]; 0 if unknown.
CountRows find_count_rows(const NumberTable& table, double step);

/// Number of leading rows that contain only integers, followed by at least ten values with decimals; 0 if any later row
/// contains only integers.
std::size_t integer_header(const NumberTable& table);

}  // namespace pounding::records
