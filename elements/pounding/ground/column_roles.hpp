#pragma once
/// Columns of a table that hold no values, and lines in front of the values: counters, times, numbers of values. Users
/// call read_record() instead.

#include <cstddef>
#include <string_view>

#include <pounding/ground/number_table.hpp>

namespace pounding::records {

/// Spacing of a column of integers that increase evenly, in three rows or more; 0 for any other column.
double integer_spacing(const NumberTable& table, std::size_t column);

/// Whether a column counts the rows: consecutive integers in three rows or more.
bool counts_rows(const NumberTable& table, std::size_t column);

/// Whether a column increases from row to row, from a value >= 0 on.
bool ascends(const NumberTable& table, std::size_t column);

/// Mean spacing of a column that increases evenly, within 10 %, from a value >= 0; 0 for any other column.
double even_spacing(const NumberTable& table, std::size_t column);

/// Whether a name is that of a column of times ("time", "t", "sec"), or of a counter ("No.", "index", "point").
bool names_times(std::string_view name);
bool names_counter(std::string_view name);

/// Rows in front of the values that state their number, and perhaps the step.
struct CountRows {
  std::size_t rows = 0;   ///< 0 if there are none
  std::size_t count = 0;  ///< number of values, or of rows of values
  double step = 0;        ///< [s]; 0 if it is not stated
};

/// Finds rows such as "700" and "0.005", or "700 0.005", above as many values as they state, ten or more. `step` is
/// that of the user [s]; 0 if unknown.
CountRows find_count_rows(const NumberTable& table, double step);

/// Number of rows at the begin that hold integers alone, above ten values or more with decimals; 0 if any value below
/// is such an integer.
std::size_t integer_header(const NumberTable& table);

}  // namespace pounding::records
